#include <gtest/gtest.h>

#include "planners/support/conformance_expectation.hpp"
#include "planners/support/kinematic_flight.hpp"

namespace avoidbench {
namespace {

TEST(RosExample, KeepsEveryRule) { expect_conformance(PLANNER_FILE); }

}  // namespace
}  // namespace avoidbench
