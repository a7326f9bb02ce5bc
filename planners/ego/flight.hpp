#pragma once

#include <optional>
#include <vector>

#include "local_planner.hpp"
#include "planning/trajectory_command.hpp"
#include "settings.hpp"
#include "surroundings.hpp"

namespace ego {

/// One trial as the planner sees it: the map, the trajectory under way, and when to make another.
///
/// A trajectory's time is 0 at the observation it was planned for. Commands act a little later, by
/// the same time each, so that a new one that begins where the old one stands now takes over
/// without a jump.
class Flight {
 public:
  explicit Flight(const Settings& settings);

  void reset(const ab_mission& mission);

  /// Whether the mission's start and goal are places; without, there is nothing to plan.
  bool has_mission() const { return has_mission_; }

  /// From now on to this goal.
  void fly_to(const avoidbench::CurrentGoal& goal);

  /// Takes an image into the map, if it is its camera's first of its map period.
  void see(const ab_depth_image& image);

  /// Takes a lidar's sweep into the map.
  void see(const ab_cloud& cloud) { surroundings_.grid.integrate(cloud); }

  /// What to fly from now on; valid until the next call. Only where has_mission().
  const std::vector<ab_point>& plan(const ab_state& state);

  const Surroundings& surroundings() const { return surroundings_; }
  const std::optional<planning::Bspline>& curve() const { return executed_.curve; }
  const planning::Motion& target() const { return target_; }

  /// The curves that the last planning began with, in order.
  const std::vector<planning::Bspline>& candidates() const { return candidates_; }

 private:
  enum class Kind { hover, curve, stop, step_aside };

  struct Executed {
    Kind kind = Kind::hover;
    planning::TimedMotion motion;
    std::optional<planning::Bspline> curve;  ///< of Kind::curve
    double start_s = 0.0;
    bool ends_at_goal = false;
  };

  void follow(const ab_state& state);
  bool is_plan_due(double phase_s, const std::optional<double>& blocked_s) const;
  std::optional<double> blocked_s(double phase_s) const;
  bool replan(double phase_s);
  void stop();
  void hover();
  void leave_dead_end();
  void execute(Kind kind, const planning::Quintic& quintic);

  Settings settings_;
  Surroundings surroundings_;
  /// By camera: number of the map period of which an image was last taken.
  std::vector<double> map_ticks_;
  planning::Random random_;
  Eigen::Vector3d line_start_ = Eigen::Vector3d::Zero(), goal_ = Eigen::Vector3d::Zero();
  double start_yaw_rad_ = 0.0;
  bool has_mission_ = false, is_first_ = true;

  double now_s_ = 0.0;
  planning::Motion now_;  ///< of the trajectory under way
  planning::Heading heading_;
  planning::Motion target_;
  std::vector<planning::Bspline> candidates_;
  Executed executed_;
  int failures_ = 0;
  bool has_come_out_ = false;  ///< of an obstacle's reach, when it last left a dead end
  double tried_s_ = 0.0, resting_since_s_ = 0.0;
  std::vector<ab_point> points_;
  double points_s_ = 0.0;  ///< when the first of them is
};

}  // namespace ego
