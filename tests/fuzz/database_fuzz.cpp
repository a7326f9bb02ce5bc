// Any bytes as a database: each command reads them or says InputError.
#include "fuzz/read_database.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace avoidbench::fuzz;
  const std::filesystem::path file = scratch_folder() / "input.db";
  write_bytes(file, {data, size});
  read_as_commands_do(file);
  return 0;
}
