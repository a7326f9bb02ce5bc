#include <gtest/gtest.h>

#include "planners/support/conformance_expectation.hpp"

namespace avoidbench {
namespace {

TEST(Mbplanner, KeepsEveryRule) { expect_conformance(PLANNER_FILE); }

}  // namespace
}  // namespace avoidbench
