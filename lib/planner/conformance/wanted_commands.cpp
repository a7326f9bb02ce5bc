#include "conformance/wanted_commands.hpp"

#include <vector>

namespace avoidbench {
namespace {

constexpr double kSpeed_mps = 3.0, kStep_s = 0.1;
constexpr int kPointCount = 20;  // two seconds: past the wall
constexpr double kHover_mps2 = 9.81;

void put(const Eigen::Vector3d& from, double (&to)[3]) {
  for (int i = 0; i < 3; ++i) to[i] = from[i];
}

std::vector<ab_point> points_onward(const Eigen::Vector3d& from_world) {
  std::vector<ab_point> points;
  for (int i = 0; i < kPointCount; ++i) {
    ab_point& point = points.emplace_back(ab_point{});
    point.time_s = i * kStep_s;
    put(from_world + Eigen::Vector3d(kSpeed_mps * point.time_s, 0.0, 0.0), point.position_world_m);
    point.velocity_world_mps[0] = kSpeed_mps;
  }
  return points;
}

}  // namespace

PlanResult wanted_onward(const Frame& frame, std::uint32_t kind) {
  PlanResult wanted;
  wanted.status = PlanStatus::command;
  wanted.command.kind = kind;
  switch (kind) {
    case AB_COMMAND_POSITION:
      put(frame.position_world + Eigen::Vector3d(1.0, 0.0, 0.0), wanted.command.position_world_m);
      break;
    case AB_COMMAND_VELOCITY:
      wanted.command.velocity_world_mps[0] = kSpeed_mps;
      break;
    case AB_COMMAND_TRAJECTORY:
      wanted.points = points_onward(frame.position_world);
      break;
    case AB_COMMAND_RATES:
      wanted.command.thrust_mps2 = kHover_mps2;
      break;
    default:  // an acceleration of zero
      break;
  }
  return wanted;
}

PlanResult no_plan() {
  PlanResult wanted;
  wanted.status = PlanStatus::no_plan;
  return wanted;
}

PlanResult wanted_in_turn(const Frame& frame, std::uint32_t kinds, std::size_t index) {
  std::vector<std::uint32_t> declared;
  for (std::uint32_t kind = AB_COMMAND_POSITION; kind <= AB_COMMAND_RATES; kind <<= 1U) {
    if ((kinds & kind) != 0) declared.push_back(kind);
  }
  return declared.empty() ? no_plan() : wanted_onward(frame, declared[index % declared.size()]);
}

}  // namespace avoidbench
