#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "base/input_error.hpp"
#include "conformance/conformance.hpp"
#include "plugin/planner_library.hpp"
#include "support/input_error_message.hpp"

namespace avoidbench {

/// The library of one of the planners in bad/.
inline std::filesystem::path bad_planner(const std::string& name) {
  return std::filesystem::path(BAD_PLANNERS) / (name + ".so");
}

/// An empty folder of this name.
inline std::filesystem::path scratch_folder(const std::string& name) {
  const auto folder = std::filesystem::path(testing::TempDir()) / ("avoidbench_" + name);
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  return folder;
}

/// What load says of the file; empty when it loads.
inline std::string load_error(const std::filesystem::path& file) {
  return test::message_of([&] { PlannerLibrary::load(file); });
}

/// What the rule `name` found; "not tried" where it wasn't.
inline std::string finding(const std::vector<ConformanceResult>& results, const std::string& name) {
  for (const ConformanceResult& result : results) {
    if (result.name == name) return result.finding;
  }
  return "not tried";
}

/// Names of the rules that were tried and failed.
inline std::vector<std::string> failed_rules(const std::vector<ConformanceResult>& results) {
  std::vector<std::string> failed;
  for (const ConformanceResult& result : results) {
    if (!result.passed && result.was_tried) failed.push_back(result.name);
  }
  return failed;
}

}  // namespace avoidbench
