#pragma once

#include <optional>
#include <vector>

#include "flown_path.hpp"
#include "planning/heading.hpp"
#include "planning/rolling_grid.hpp"
#include "planning/trajectory_command.hpp"
#include "selection.hpp"
#include "settings.hpp"
#include "tree.hpp"

namespace mbplanner {

/// Decides from map and motion what to fly: new paths, the stored stop, the way back.
class Pilot {
 public:
  explicit Pilot(const Settings& settings);

  void reset(const ab_mission& mission);

  /// Points to fly from now on; nothing where the state is not finite.
  std::optional<std::vector<ab_point>> plan(const ab_observation& seen);

  const planning::RollingGrid& grid() const { return grid_; }

  /// The map at the height of flight, the newest tree and the course, for who looks.
  void draw(const avoidbench::Canvas& canvas) const;

 private:
  /// What the course is.
  enum class Kind { hover, path, brake, retreat };

  /// What is flown: knots, one a step, the first at time 0; at its end it rests.
  struct Course {
    Kind kind = Kind::hover;
    std::vector<Motion> knots;
    std::vector<Primitive> primitives;  ///< of the path, from the first knot on
    double began_s = 0.0;
    double path_s = 0.0;  ///< without the stop at its end
    int relaxation = 0;   ///< which box it was planned with
    double end_potential_m = 0.0;

    double duration_s() const { return static_cast<double>(knots.size() - 1) * kStep_s; }
    Motion at(double phase_s) const;
  };

  void prepare_grid(const ab_mission& mission);
  void take_goal(const Eigen::Vector3d& position, double time_s);
  void look(const ab_observation& seen, const Eigen::Vector3d& position);
  void clear_around(const Eigen::Vector3d& position, const Eigen::Vector3d& size_m);
  void begin(Course course, double time_s);
  void hover(const Eigen::Vector3d& position, double time_s);
  void rejoin(const Eigen::Vector3d& position, const Eigen::Vector3d& velocity, double time_s);

  double phase_s(double time_s) const;
  bool is_resting(double time_s) const;
  bool is_blocked(double phase_s, int relaxation) const;
  Space space(int relaxation) const;
  Limits limits(int relaxation) const;
  std::vector<Primitive> chain_left(double phase_s) const;

  std::vector<Motion> knots_left(double phase_s) const;

  void decide(double time_s);
  int most_relaxed(double speed_mps, bool is_in_the_way) const;
  bool find_path(double time_s, bool is_blocked_now, bool is_tight);
  void brake(double time_s);
  void search(double time_s);
  void set_trap(const Eigen::Vector3d& place);
  void watch_progress(const Eigen::Vector3d& position, double time_s);

  std::vector<ab_point> points(double time_s);

  Settings settings_;
  planning::RollingGrid grid_;
  Tree tree_;
  planning::Random random_;
  FlownPath flown_;
  avoidbench::CurrentGoal goal_;
  Potential potential_;
  Course course_;
  std::vector<ab_point> points_;
  double points_began_s_ = 0.0;
  planning::Heading heading_;
  std::optional<double> facing_rad_;
  double start_yaw_rad_ = 0.0, goal_radius_m_ = 0.0;
  double lowest_m_ = 0.0, highest_m_ = 0.0;
  double pace_ = 1.0;  ///< of the course's time over the clock's
  double planned_s_ = 0.0, braked_s_ = 0.0, searched_s_ = 0.0;
  double closest_m_ = 0.0, closest_s_ = 0.0;
  int look_ = 0, retreats_ = 0;  ///< of a search
  bool has_begun_ = false, has_seen_ = false;
};

}  // namespace mbplanner
