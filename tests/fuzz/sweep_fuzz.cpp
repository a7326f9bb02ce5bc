// Any bytes as a sweep file: a sweep, or an InputError that says what is wrong. The planners that
// it asks for are not there: what else is wrong is found all the same.
#include <cstdint>
#include <cstdlib>
#include <string>

#include "base/input_error.hpp"
#include "config/sweep_file.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  // Files of this machine are nothing to read.
  if (text.find("include") != std::string::npos || text.find("file") != std::string::npos) return 0;
  try {
    avoidbench::sweep_of_text(text, "fuzz.yaml");
  } catch (const avoidbench::InputError& error) {
    if (error.problems().empty()) std::abort();
  }
  return 0;
}
