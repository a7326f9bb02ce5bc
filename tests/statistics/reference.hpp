#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace avoidbench {

/// The cases of tests/statistics/reference.json (SciPy's answers) named `name`.
inline nlohmann::json reference(const std::string& name) {
  std::ifstream in(AVOIDBENCH_SOURCE_DIR "/tests/statistics/reference.json");
  const nlohmann::json cases = nlohmann::json::parse(in).at(name);
  EXPECT_FALSE(cases.empty());
  return cases;
}

/// Numbers, null being NaN.
inline std::vector<double> numbers(const nlohmann::json& values) {
  std::vector<double> result;
  for (const nlohmann::json& value : values) {
    result.push_back(value.is_null() ? std::numeric_limits<double>::quiet_NaN()
                                     : value.get<double>());
  }
  return result;
}

inline std::vector<std::int64_t> counts(const nlohmann::json& values) {
  return values.get<std::vector<std::int64_t>>();
}

/// Equal to a relative error; NaN equals NaN.
inline void expect_close(double value, double expected, double relative = 1e-11) {
  if (std::isnan(expected)) {
    EXPECT_TRUE(std::isnan(value)) << value;
  } else {
    EXPECT_NEAR(value, expected, relative * std::max(1e-300, std::abs(expected)));
  }
}

}  // namespace avoidbench
