#pragma once

#include <gtest/gtest.h>
#include <stdlib.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <regex>
#include <string>
#include <vector>

#include "base/spec_json.hpp"
#include "config/sweep_file.hpp"
#include "support/input_error_message.hpp"

namespace avoidbench {

/// A folder of its own for each test, and a search path with the planner `tunable`.
class SweepFiles : public testing::Test {
 protected:
  void SetUp() override {
    std::string name = (std::filesystem::temp_directory_path() / "avoidbench_XXXXXX").string();
    ASSERT_NE(mkdtemp(name.data()), nullptr);
    folder_ = name;
    setenv("AVOIDBENCH_PLANNER_PATH", CONFIG_TEST_PLANNERS, 1);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::filesystem::path write(const std::string& name, const std::string& text) const {
    const std::filesystem::path file = folder_ / name;
    std::filesystem::create_directories(file.parent_path());
    std::ofstream(file) << text;
    return file;
  }

  SweepSpec read(const std::string& text, const std::vector<std::string>& overrides = {}) const {
    return read_sweep(write("s.yaml", text), overrides);
  }

  /// The printed problems, with the folder's name left out.
  std::string problems(const std::string& text,
                       const std::vector<std::string>& overrides = {}) const {
    std::string all = test::message_of([&] { read(text, overrides); });
    const std::string prefix = folder_.string() + "/";
    for (std::size_t at = all.find(prefix); at != std::string::npos; at = all.find(prefix)) {
      all.erase(at, prefix.size());
    }
    return all;
  }

  std::filesystem::path folder_;
};

}  // namespace avoidbench
