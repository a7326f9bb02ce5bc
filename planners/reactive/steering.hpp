#pragma once

#include <vector>

#include "polar_histogram.hpp"
#include "rollout.hpp"
#include "sight.hpp"
#include "vector3.hpp"

namespace reactive {

/// Fixed for a flight.
struct SteeringSettings {
  double max_speed_mps = 2.5;
  double braking_mps2 = 3.0;
  double body_radius_m = 0.36;
  double margin_m = 0.3;
  double lookahead_m = 6.0;
  double max_departure_m = 1.0;  ///< up or down from the height line
  Response response;
};

/// What is known at one moment.
struct Situation {
  Vector3 position, velocity, goal;              ///< in the world
  double line_height_m = 0.0;                    ///< height of the line from start to goal, here
  const std::vector<Vector3>* points = nullptr;  ///< obstacles relative to `position`
  const Sight* sight = nullptr;
};

struct Steering {
  Vector3 velocity;  ///< commanded, in the world
  Vector3 look;      ///< unit direction to look along
};

/// Chooses where to fly: the direction of the polar histogram with the least cost, as fast as sight
/// and braking allow, checked by a short prediction of the motion. Remembers only its last choice
/// and the side it passes on.
class Steerer {
 public:
  explicit Steerer(const SteeringSettings& settings) : settings_(settings) {}
  void forget();
  Steering steer(const Situation& now);

 private:
  struct Candidate {
    Vector3 direction;
    double free_m, cost;
    bool is_seen;
    bool has_second_leg = false;  ///< `cost` holds the way on to the goal
    int rank = 0;                 ///< by cost without it
  };
  struct Aim {
    Vector3 direction;  ///< unit, to the goal along the height line
    double distance_m;
  };
  Aim aim(const Situation& now) const;
  std::vector<Candidate> candidates(const Situation& now, const Aim& aim, double radius_m);
  double cost(const Situation& now, const Aim& aim, const Candidate& candidate) const;
  /// Whether the end of this way is nearer to the goal than the vehicle has been.
  bool leads_on(const Situation& now, const Candidate& candidate) const;
  /// Brings the cheapest of the candidates from `first` on to its place.
  void next_best(const Situation& now, const Aim& aim, double radius_m, std::size_t first,
                 std::vector<Candidate>& candidates) const;
  void add_second_leg(const Situation& now, const Aim& aim, double radius_m,
                      Candidate& candidate) const;
  double speed_limit(const Situation& now, const Aim& aim, const Candidate& candidate) const;
  /// Orders the candidates by cost as far as it looks.
  bool find_flyable(const Situation& now, const Aim& aim, double radius_m, double speed_mps,
                    std::vector<Candidate>& candidates, Steering& found);
  Vector3 safest_velocity(const std::vector<Candidate>& candidates) const;
  void commit(const Aim& aim, const Vector3& direction);

  SteeringSettings settings_;
  PolarHistogram histogram_;
  std::vector<Vector3> near_;  // points that matter within the prediction
  double nearest_m_ = 0.0;
  Vector3 last_;                 // the last choice; zero where there is none
  int side_ = 0;                 // 1: passes on the left of the course, -1: right, 0: not committed
  double nearest_goal_m_ = 0.0;  // least distance to the goal before it committed
  Vector3 velocity_;
};

}  // namespace reactive
