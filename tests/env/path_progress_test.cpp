#include "env/path_progress.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace avoidbench {
namespace {

using Eigen::Vector3d;

TEST(PathProgress, IsTheArcLengthOfTheNearestPoint) {
  const std::vector<Vector3d> path{{0, 0, 2}, {3, 0, 2}, {3, 4, 2}};
  EXPECT_EQ(arc_length_m(path, {1.25, 0.5, 2}), 1.25);
  EXPECT_EQ(arc_length_m(path, {-5, 0, 2}), 0.0);
  EXPECT_EQ(arc_length_m(path, {4, 1, 7}), 4.0);
  EXPECT_EQ(arc_length_m(path, {3, 9, 2}), 7.0);
  EXPECT_EQ(arc_length_m(path, {2, 1, 2}), 2.0) << "of two that are as near the first";
}

TEST(PathProgress, OfNoPathIsNone) {
  EXPECT_EQ(arc_length_m({}, {1, 2, 3}), 0.0);
  const std::vector<Vector3d> same{{1, 1, 1}, {1, 1, 1}};
  EXPECT_EQ(arc_length_m(same, {5, 1, 1}), 0.0);
}

}  // namespace
}  // namespace avoidbench
