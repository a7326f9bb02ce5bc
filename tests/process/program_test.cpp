#include "process/program.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "base/input_error.hpp"

namespace avoidbench {
namespace {

/// Modules of Python's own by their names, in the folder that one stands in: a stranger's results,
/// say.
TEST(Program, PythonImportsNothingFromTheFolderThatOneStandsIn) {
  const std::filesystem::path before = std::filesystem::current_path();
  const std::filesystem::path folder =
      std::filesystem::temp_directory_path() / ("python_" + std::to_string(::getpid()));
  std::filesystem::create_directories(folder);
  std::filesystem::current_path(folder);
  for (const char* module : {"contextlib.py", "warnings.py", "sitecustomize.py", "importlib.py"}) {
    std::ofstream(module) << "open('hijacked', 'w')\n";
  }
  std::ofstream("only_here.py") << "";
  EXPECT_NE(python_with({"json"}, "this test needs"), "");
  EXPECT_THROW(python_with({"only_here"}, "this test needs"), InputError);
  EXPECT_FALSE(std::filesystem::exists("hijacked"));
  std::filesystem::current_path(before);
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace avoidbench
