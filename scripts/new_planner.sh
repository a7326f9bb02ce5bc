#!/usr/bin/env bash
# Writes a planner that builds, flies and is tested, to begin from.
set -euo pipefail

usage() {
  cat <<'EOF'
usage: scripts/new_planner.sh NAME [FOLDER]

Without FOLDER: planners/NAME and tests/planners/NAME in this repository, built with everything else.
With FOLDER:    a project of its own there, which finds an installed avoidbench by find_package.
NAME is of a-z, 0-9 and _ and begins with a letter.
EOF
}

fail() {
  echo "new_planner.sh: $1" >&2
  exit 2
}

case "${1:-}" in
  -h | --help) usage; exit 0 ;;
  "") usage >&2; exit 2 ;;
esac
[ $# -le 2 ] || { usage >&2; exit 2; }
name=$1
[[ $name =~ ^[a-z][a-z0-9_]*$ ]] || fail "'$name' is no name: use a-z, 0-9 and _, and begin with a letter"
case "$name" in
  avoidbench* | program | support | test | all | install | clean | help) fail "the name '$name' is taken by the build" ;;
esac

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
class=$(sed -E 's/(^|_+)([a-z0-9])/\U\2/g; s/_//g' <<<"$name")
if [ $# -eq 2 ]; then
  planner_folder=$2
  test_folder=
else
  planner_folder=$root/planners/$name
  test_folder=$root/tests/planners/$name
fi
for folder in "$planner_folder" $test_folder; do
  [ ! -e "$folder" ] || fail "$folder exists already; nothing was written"
done

# Writes stdin to the file $1, with the planner's names filled in.
write() { sed "s/@NAME@/$name/g; s/@CLASS@/$class/g" >"$1"; }

mkdir -p "$planner_folder"
write "$planner_folder/$name.cpp" <<'EOF'
#include <algorithm>
#include <cmath>

#include "avoidbench/planner.hpp"
#include "avoidbench/portable_math.hpp"

namespace {

using avoidbench::Vec3;
namespace portable = avoidbench::portable;  // the same bits on every machine, unlike std::sin

constexpr double kDegree = portable::kPi / 180.0;

/// Flies toward the goal along the freest of a few headings that the camera sees: something to
/// begin from.
class @CLASS@ {
 public:
  static constexpr const char* name = "@NAME@";
  static constexpr const char* version = "0.1";
  static constexpr const char* summary = "Follows the freest heading in view.";
  // What it wants to see and what it may command; planner.h lists all of them.
  static constexpr std::uint32_t needs = AB_SEES_STATE | AB_SEES_DEPTH;
  static constexpr std::uint32_t commands = AB_COMMAND_VELOCITY;
  // Each can be set and swept in a sweep file. Values outside the range are refused before the
  // first trial.
  static constexpr std::array parameters{
      avoidbench::parameter("max_speed_mps", "m/s", 1.5, 0.1, 10.0,
                            "Speed where the way is free."),
      avoidbench::parameter("margin_m", "m", 0.3, 0.0, 2.0,
                            "Distance kept between body and surfaces.")};

  // Made once for many trials. What may throw belongs here: the text becomes the error that the
  // user sees.
  explicit @CLASS@(const ab_setup& setup) {
    const avoidbench::Parameters<@CLASS@> values(setup);
    max_speed_mps_ = values.number("max_speed_mps");
    corridor_m_ = setup.body_radius_m + values.number("margin_m");
  }

  // A trial begins: forget everything of earlier ones.
  void reset(const ab_mission& mission) {
    std::copy(std::begin(mission.goal_world_m), std::end(mission.goal_world_m),
              goal_world_m_.begin());
    points_world_m_.clear();
    yaw_rad_ = mission.start_yaw_rad;
  }

  // Called every plan period. Images are those since the last call, newest first; there may be
  // none.
  std::optional<ab_command> plan(const ab_observation& seen) {
    const ab_state& state = *seen.state;
    if (const ab_depth_image* image = avoidbench::newest_depth(seen)) take(*image, state);

    const double east_m = goal_world_m_[0] - state.position_world_m[0];
    const double north_m = goal_world_m_[1] - state.position_world_m[1];
    const double goal_m = std::sqrt(east_m * east_m + north_m * north_m);
    if (!std::isfinite(goal_m)) return std::nullopt;  // no plan: the host brakes and hovers
    const double goal_heading_rad = goal_m > 0.1 ? portable::atan2(north_m, east_m) : yaw_rad_;
    const Vec3 forward = avoidbench::rotated(state.q_world_body, {1.0, 0.0, 0.0});
    const double now_rad = portable::atan2(forward[1], forward[0]);

    // Of the headings in view, the one with the best sum of free way and little turning from the
    // goal.
    double best_score = -1e9, best_free_m = 0.0;
    yaw_rad_ = goal_heading_rad;
    for (int step = -9; step <= 9; ++step) {
      const double heading_rad = goal_heading_rad + step * 10.0 * kDegree;
      if (std::abs(portable::wrapped_angle(heading_rad - now_rad)) > 35.0 * kDegree) continue;
      const double free_m = std::min(free_along(state, heading_rad), std::max(1.0, goal_m));
      const double score = free_m - 0.3 * std::abs(step);
      if (score > best_score) {
        best_score = score;
        best_free_m = free_m;
        yaw_rad_ = heading_rad;
      }
    }
    // Slow enough to stop in half the free way, whose deceleration is 2 m/s².
    const double speed_mps =
        std::min(max_speed_mps_, std::sqrt(2.0 * std::max(0.0, best_free_m - 0.5)));
    const double climb_mps = std::clamp(goal_world_m_[2] - state.position_world_m[2], -0.5, 0.5);
    return avoidbench::make_velocity_command(
        {speed_mps * portable::cos(yaw_rad_), speed_mps * portable::sin(yaw_rad_), climb_mps},
        yaw_rad_);
  }

 private:
  static constexpr double kRange_m = 6.0;

  // Every fourth pixel that shows something near our height. +inf is free, NaN is unknown: neither
  // compares below the range.
  void take(const ab_depth_image& image, const ab_state& state) {
    points_world_m_.clear();
    for (int row = 0; row < image.height_px; row += 4) {
      for (int column = 0; column < image.width_px; column += 4) {
        const auto index =
            static_cast<std::size_t>(row) * static_cast<std::size_t>(image.width_px) +
            static_cast<std::size_t>(column);
        const double depth_m = static_cast<double>(image.depth_m[index]);
        if (!(depth_m < kRange_m)) continue;
        const Vec3 point = avoidbench::pixel_in_world(image, column, row, depth_m);
        if (std::abs(point[2] - state.position_world_m[2]) < corridor_m_)
          points_world_m_.push_back(point);
      }
    }
  }

  // How far a corridor of the body's width is free along this heading.
  double free_along(const ab_state& state, double heading_rad) const {
    const double east = portable::cos(heading_rad), north = portable::sin(heading_rad);
    double free_m = kRange_m;
    for (const Vec3& point : points_world_m_) {
      const double x = point[0] - state.position_world_m[0],
                   y = point[1] - state.position_world_m[1];
      const double ahead_m = x * east + y * north, aside_m = x * north - y * east;
      if (ahead_m > 0.0 && std::abs(aside_m) < corridor_m_) free_m = std::min(free_m, ahead_m);
    }
    return free_m;
  }

  double max_speed_mps_ = 0.0, corridor_m_ = 0.0, yaw_rad_ = 0.0;
  Vec3 goal_world_m_{};
  std::vector<Vec3> points_world_m_;
};

}  // namespace

AVOIDBENCH_PLANNER(@CLASS@)
EOF

write "$planner_folder/README.md" <<'EOF'
# @NAME@

Flies toward the goal along the freest of the headings that the camera sees.

- Sees: state, depth. Commands: velocity with yaw along it.

| parameter | unit | default | meaning |
|---|---|---|---|
| `max_speed_mps` | m/s | 1.5 | speed where the way is free |
| `margin_m` | m | 0.3 | distance kept between body and surfaces |
EOF

if [ -n "$test_folder" ]; then
  write "$planner_folder/CMakeLists.txt" <<'EOF'
# Follows the freest heading in view.
avoidbench_planner(@NAME@ SOURCES @NAME@.cpp)
EOF
  mkdir -p "$test_folder"
  write "$test_folder/CMakeLists.txt" <<'EOF'
avoidbench_planner_test(@NAME@)
EOF
  write "$test_folder/${name}_test.cpp" <<'EOF'
#include <gtest/gtest.h>

#include "planners/support/conformance_expectation.hpp"
#include "planners/support/kinematic_flight.hpp"

namespace avoidbench {
namespace {

TEST(@CLASS@, KeepsEveryRule) { expect_conformance(PLANNER_FILE); }

TEST(@CLASS@, ReachesAGoalPastATree) {
  PlannerInstance planner = kinematic::instance_of(PLANNER_FILE);
  kinematic::Course course = kinematic::meadow();
  course.cylinders.push_back({{0.1, 20.0}, 0.3});
  const kinematic::Result flight = kinematic::fly(planner, course);
  EXPECT_EQ(flight.ending, kinematic::Ending::reached_goal) << flight.reason;
}

}  // namespace
}  // namespace avoidbench
EOF
  cat <<EOF
wrote planners/$name and tests/planners/$name. Next:
  cmake --preset release && cmake --build build/release --target $name ${name}_planner_tests
  ctest --test-dir build/release -R ${name}_planner
  build/release/avoidbench planners describe $name
EOF
else
  write "$planner_folder/CMakeLists.txt" <<'EOF'
cmake_minimum_required(VERSION 3.22)
project(@NAME@ LANGUAGES CXX)
if(NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE Release)
endif()

find_package(avoidbench REQUIRED)
avoidbench_planner(@NAME@ SOURCES @NAME@.cpp)

# ctest runs the conformance suite where the program is installed.
enable_testing()
find_program(AVOIDBENCH_PROGRAM avoidbench HINTS ${avoidbench_DIR}/../../../bin ${avoidbench_DIR}/../../../../bin)
if(AVOIDBENCH_PROGRAM)
  add_test(NAME @NAME@.conformance COMMAND ${AVOIDBENCH_PROGRAM} planners check $<TARGET_FILE:@NAME@>)
endif()
EOF
  cat <<EOF
wrote $planner_folder. Next, with PREFIX where avoidbench was installed (cmake --install … --prefix PREFIX):
  cmake -S $planner_folder -B $planner_folder/build -DCMAKE_PREFIX_PATH=PREFIX
  cmake --build $planner_folder/build
  avoidbench planners check $planner_folder/build/planners/$name.so
EOF
fi
