#pragma once

#include <Eigen/Core>
#include <array>
#include <deque>
#include <functional>
#include <optional>
#include <vector>

#include "curve.hpp"
#include "network.hpp"
#include "planning/trajectory_command.hpp"
#include "settings.hpp"
#include "situation.hpp"

namespace agile {

using Modes = std::array<Mode, kModes>;

/// Who thinks: the net, or in training the expert that knows the map.
using Think = std::function<Modes(const Situation&, const Image&)>;

/// What is known at one call.
struct Seen {
  double time_s = 0.0;
  Eigen::Vector3d position_world = Eigen::Vector3d::Zero();
  Eigen::Vector3d velocity_world = Eigen::Vector3d::Zero();
  const ab_depth_image* depth = nullptr;  ///< null: none is new
};

/// Of what the host shows in a call; the image is the newest.
Seen seen_of(const ab_observation& seen);

/// One mode as it would be flown.
struct Candidate {
  planning::Quintic curve;
  double end_s = kHorizon_s;  ///< until then, and
  planning::Quintic stop;     ///< from there to rest
  double cost = 0.0;
  bool is_flyable = false;  ///< within the vehicle's limits, if need be on a shorter way
};

/// Flies by what is thought of each image: the best mode, or to a stop where none is good enough.
class Pilot {
 public:
  Pilot(const Settings& settings, Think think);

  /// Begin a trial. A mission to nowhere has no plan.
  void reset(const ab_mission& mission);
  /// From now on to this goal.
  void fly_to(const Eigen::Vector3d& goal_world);
  bool has_mission() const { return has_mission_; }

  /// The trajectory from now on, by the time after the command's effect.
  const std::vector<ab_point>& plan(const Seen& seen);

  /// Of the newest image, for drawings.
  const std::vector<Candidate>& candidates() const { return candidates_; }
  const planning::TimedMotion& motion() const { return flown_.back().motion; }

 private:
  enum class Kind { mode, stop, hover };
  struct Flown {
    Kind kind = Kind::hover;
    double start_s = 0.0;
    planning::TimedMotion motion;
  };

  planning::Motion planned_at(double time_s) const;
  planning::Motion next_start(const Seen& seen);
  double desired_speed_mps(const Eigen::Vector3d& position) const;
  Candidate candidate(const Situation& situation, const Mode& mode) const;
  const Candidate* chosen() const;
  void think_of(const ab_depth_image& depth, const planning::Motion& start);
  void execute(Kind kind, planning::TimedMotion motion);
  void stop(const planning::Motion& start);
  void hover(const Eigen::Vector3d& place);
  std::optional<double> facing_rad(const Eigen::Vector3d& place) const;

  Settings settings_;
  Think think_;
  bool has_mission_ = false, is_first_ = true;
  Eigen::Vector3d goal_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d lowest_ = Eigen::Vector3d::Zero(), highest_ = Eigen::Vector3d::Zero();
  double start_yaw_rad_ = 0.0, latency_s_ = 0.0;
  double effect_s_ = 0.0;    ///< of the command that is made
  double standing_s_ = 0.0;  ///< since when it stands
  std::deque<Flown> flown_;  ///< by the time they begin; the last was commanded last
  std::vector<Candidate> candidates_;
  std::vector<ab_point> points_;
  double points_s_ = 0.0;  ///< the time of the first
};

}  // namespace agile
