#pragma once

#include <gtest/gtest.h>

#include "support/conformance.hpp"

namespace avoidbench {

/// Expects that the planner at `file` keeps every rule of the interface.
inline void expect_conformance(const std::filesystem::path& file) {
  const std::vector<ConformanceResult> results = test::check_conformance(file);
  EXPECT_GT(results.size(), 10U);
  for (const ConformanceResult& result : results) {
    EXPECT_TRUE(result.passed) << result.name << ": " << result.finding;
  }
}

}  // namespace avoidbench
