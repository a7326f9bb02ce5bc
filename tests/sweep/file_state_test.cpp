#include "sweep/file_state.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>

namespace avoidbench {
namespace {

TEST(FileState, SeesAFileWrittenAnewWithItsOldTime) {
  const std::filesystem::path file =
      std::filesystem::temp_directory_path() / ("state_" + std::to_string(::getpid()));
  std::ofstream(file) << "one";
  const FileState before = file_state(file);
  EXPECT_EQ(file_state(file), before);
  const auto written = std::filesystem::last_write_time(file);
  std::this_thread::sleep_for(std::chrono::milliseconds(20));
  std::ofstream(file) << "two";
  std::filesystem::last_write_time(file, written);
  EXPECT_EQ(std::filesystem::last_write_time(file), written);
  EXPECT_NE(file_state(file), before);
  std::filesystem::remove(file);
  EXPECT_EQ(file_state(file), FileState{});
  EXPECT_EQ(file_state(file).bytes, -1);
  EXPECT_EQ(file_state(file).inode, 0U);
}

}  // namespace
}  // namespace avoidbench
