// Any bytes as a database: each command reads them or says InputError. Which command follows from
// the bytes.
#include <numeric>

#include "fuzz/read_database.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace avoidbench::fuzz;
  const std::filesystem::path file = scratch_folder() / "input.db";
  write_bytes(file, {data, size});
  read_as_command_does(static_cast<int>(std::accumulate(data, data + size, 0U) % kCommandCount),
                       file);
  return 0;
}
