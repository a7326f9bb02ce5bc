#include "real_flights/alignment.hpp"

#include <gtest/gtest.h>

#include "base/math.hpp"
#include "support/input_error_message.hpp"

namespace avoidbench {
namespace {

const InputProblem kPlace{.file = "flights.yaml", .line = 7, .column = 1, .message = ""};

AlignmentSpec of_points(const Pose& T_map_log, double off_m = 0.0) {
  AlignmentSpec spec;
  for (const Eigen::Vector3d& log : {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(10, 0, 1),
                                     Eigen::Vector3d(3, 8, 0), Eigen::Vector3d(-4, 5, 2)}) {
    spec.points.push_back({to_array(log), to_array(T_map_log * log)});
  }
  spec.points.front().map[0] += off_m;
  return spec;
}

TEST(Alignment, FindsRotationAndTranslation) {
  Pose pose = make_pose({100.0, -20.0, 3.0}, yaw_rotation(2.0));
  pose.linear() = pose.linear() * Eigen::AngleAxisd(0.1, Eigen::Vector3d::UnitX()).matrix();
  const Alignment found = align(of_points(pose), kPlace);
  EXPECT_TRUE(found.T_map_log.isApprox(pose, 1e-9));
  EXPECT_LT(found.residual_m, 1e-9);
}

TEST(Alignment, ReportsWhatDoesNotFit) {
  const Alignment found = align(of_points(Pose::Identity(), 0.4), kPlace);
  EXPECT_GT(found.residual_m, 0.05);
  EXPECT_LT(found.residual_m, 0.2);
}

TEST(Alignment, ByTranslationAndYaw) {
  const Alignment found =
      align({.points = {}, .translation_m = {1.0, 2.0, 3.0}, .yaw_deg = 90.0}, kPlace);
  const Eigen::Vector3d moved = found.T_map_log * Eigen::Vector3d(1, 0, 0);
  EXPECT_LT((moved - Eigen::Vector3d(1, 3, 3)).norm(), 1e-12);
}

TEST(Alignment, RefusesPointsOnALine) {
  AlignmentSpec spec;
  for (const double x : {0.0, 1.0, 2.0}) spec.points.push_back({{x, 2 * x, 0}, {x, 2 * x, 0}});
  const std::string message = test::message_of([&] { align(spec, kPlace); });
  EXPECT_NE(message.find("flights.yaml:7:1: alignment.points: lie on one line"), std::string::npos)
      << message;
}

}  // namespace
}  // namespace avoidbench
