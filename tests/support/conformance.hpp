#pragma once

#include <filesystem>
#include <vector>

#include "conformance/conformance.hpp"
#include "conformance/conformance_run.hpp"

namespace avoidbench::test {

/// What every rule says of the planner at `file`, tried in this process.
inline std::vector<ConformanceResult> check_conformance(const std::filesystem::path& file) {
  std::vector<ConformanceResult> results;
  run_conformance(
      file, [](const ConformanceResult&) {},
      [&](const ConformanceResult& result) { results.push_back(result); });
  return results;
}

}  // namespace avoidbench::test
