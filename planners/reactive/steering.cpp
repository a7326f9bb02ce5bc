#include "steering.hpp"

#include <algorithm>
#include <limits>

namespace reactive {
namespace {

// Weights of the cost, whose terms are of the order of one.
constexpr double kGoalWeight = 1.0;     // turned from the goal: 1 - cos
constexpr double kMotionWeight = 0.25;  // turned from the present motion
constexpr double kKeepWeight = 0.35;    // turned from the last choice
constexpr double kClearWeight = 1.2;    // blocked within the lookahead
constexpr double kOnwardWeight = 0.6;   // blocked on the way on to the goal
constexpr double kHeightWeight = 0.25;  // a metre beside the height line
constexpr double kUnseenCost = 0.5;     // has to turn first
constexpr double kSideCost = 0.8;       // other side than committed to
constexpr double kDeadEndCost = 1.2;    // ends no nearer to the goal than it has already been
constexpr double kProgress_m = 0.5;
constexpr double kLeastFree_m = 0.6;  // shorter ways are no ways
constexpr std::size_t kTried = 24;    // candidates that are looked at closely
constexpr double kPredicted_m = 3.5;  // points beyond don't matter to the prediction
constexpr double kContactMargin_m = 0.08;

double cross_z(const Vector3& a, const Vector3& b) { return a.x * b.y - a.y * b.x; }

Vector3 level(const Vector3& v) { return direction({v.x, v.y, 0.0}, {0.0, 0.0, 0.0}); }

}  // namespace

void Steerer::forget() {
  last_ = {};
  side_ = 0;
  nearest_goal_m_ = std::numeric_limits<double>::infinity();
}

Steerer::Aim Steerer::aim(const Situation& now) const {
  Vector3 to_goal = now.goal - now.position;
  const double level_m = horizontal_norm(to_goal);
  // Back to the height line within a few metres; the goal's own height when it is near.
  const double back_m = std::clamp(now.line_height_m - now.position.z, -1.0, 1.0);
  if (level_m > 3.0) to_goal.z = level_m * back_m / 4.0;
  return {direction(to_goal, {0.0, 0.0, 0.0}), level_m};
}

double Steerer::cost(const Situation& now, const Aim& aim, const Candidate& candidate) const {
  const Vector3& d = candidate.direction;
  const double wanted_m = std::clamp(aim.distance_m, 1.0, settings_.lookahead_m);
  const double blocked = 1.0 - std::min(1.0, candidate.free_m / wanted_m);
  const double speed = norm(now.velocity);
  double total = kGoalWeight * (1.0 - dot(d, aim.direction)) + kClearWeight * blocked * blocked;
  if (speed > 0.2) {
    const double weight = kMotionWeight * std::min(1.0, speed / settings_.max_speed_mps);
    total += weight * (1.0 - dot(d, now.velocity) / speed);
  }
  if (norm(last_) > 0.0) total += kKeepWeight * (1.0 - dot(d, last_));
  const double later_height_m = now.position.z + d.z * std::min(3.0, candidate.free_m);
  total += kHeightWeight * std::abs(later_height_m - now.line_height_m);
  if (!candidate.is_seen) total += kUnseenCost;
  if (side_ != 0 && side_ * cross_z(level(aim.direction), level(d)) < -0.25) total += kSideCost;
  if (side_ != 0 && candidate.free_m < settings_.lookahead_m && !leads_on(now, candidate)) {
    total += kDeadEndCost;
  }
  return total;
}

bool Steerer::leads_on(const Situation& now, const Candidate& candidate) const {
  const Vector3 end = now.position + candidate.free_m * candidate.direction;
  return horizontal_norm(now.goal - end) < nearest_goal_m_ - kProgress_m;
}

std::vector<Steerer::Candidate> Steerer::candidates(const Situation& now, const Aim& aim,
                                                    double radius_m) {
  histogram_.clear(settings_.lookahead_m);
  for (const Vector3& point : *now.points) histogram_.add(point, radius_m);
  std::vector<Candidate> all;
  const auto consider = [&](const Vector3& d, double free_m) {
    if (free_m < std::min(kLeastFree_m, aim.distance_m)) return;
    const double later_m = now.position.z + d.z * std::min(2.0, free_m) - now.line_height_m;
    const bool departs = std::abs(later_m) > settings_.max_departure_m && later_m * d.z > 0.0;
    if (departs) return;
    Candidate candidate{
        .direction = d, .free_m = free_m, .cost = 0.0, .is_seen = now.sight->has_seen(d)};
    candidate.cost = cost(now, aim, candidate);
    all.push_back(candidate);
  };
  for (int i = 0; i < PolarHistogram::kDirections; ++i)
    consider(histogram_.direction(i), histogram_.free_m(i));
  // Exactly to the goal, which the grid only nears.
  consider(aim.direction,
           free_distance(*now.points, {}, aim.direction, radius_m, settings_.lookahead_m));
  std::stable_sort(all.begin(), all.end(),
                   [](const Candidate& a, const Candidate& b) { return a.cost < b.cost; });
  if (all.size() > kTried) all.resize(kTried);
  for (std::size_t i = 0; i < all.size(); ++i) all[i].rank = static_cast<int>(i);
  return all;
}

void Steerer::add_second_leg(const Situation& now, const Aim& aim, double radius_m,
                             Candidate& candidate) const {
  candidate.has_second_leg = true;
  const double leg_m = std::min({candidate.free_m, 3.0, aim.distance_m});
  const Vector3 corner = leg_m * candidate.direction;
  const Vector3 onward = (now.goal - now.position) - corner;
  const double wanted_m = std::min(horizontal_norm(onward), 3.0);
  if (wanted_m < 0.1) return;
  const Vector3 along = direction({onward.x, onward.y, 0.0}, aim.direction);
  const double free_m = free_distance(*now.points, corner, along, radius_m, wanted_m);
  candidate.cost += kOnwardWeight * (1.0 - free_m / wanted_m);
}

void Steerer::next_best(const Situation& now, const Aim& aim, double radius_m, std::size_t first,
                        std::vector<Candidate>& candidates) const {
  const auto begin = candidates.begin() + static_cast<std::ptrdiff_t>(first);
  const auto is_cheaper = [](const Candidate& a, const Candidate& b) {
    return a.cost < b.cost || (a.cost == b.cost && a.rank < b.rank);
  };
  // A second leg only adds to the cost: it need not be known of those that cost more without.
  for (;;) {
    const auto best = std::min_element(begin, candidates.end(), is_cheaper);
    if (best->has_second_leg) return std::iter_swap(begin, best);
    add_second_leg(now, aim, radius_m, *best);
  }
}

double Steerer::speed_limit(const Situation& now, const Aim& aim,
                            const Candidate& candidate) const {
  if (!candidate.is_seen) return 0.0;
  // Stop before what blocks the way, or at the goal.
  const double way_m = std::max(0.0, candidate.free_m - 0.1);
  double limit = std::min(settings_.max_speed_mps, std::sqrt(2.0 * settings_.braking_mps2 * way_m));
  limit = std::min(limit, 0.6 + std::sqrt(2.0 * settings_.braking_mps2 * aim.distance_m));
  // Slower past near surfaces, and while the camera looks elsewhere.
  limit = std::min(limit, 0.7 + 3.0 * std::max(0.0, nearest_m_ - settings_.body_radius_m));
  const double looked_along = now.sight->looked_along(candidate.direction);
  return limit * std::clamp(1.6 * looked_along - 0.4, 0.25, 1.0);
}

bool Steerer::find_flyable(const Situation& now, const Aim& aim, double radius_m, double speed_mps,
                           std::vector<Candidate>& candidates, Steering& found) {
  const double needed_m = std::min(settings_.body_radius_m + kContactMargin_m, 0.95 * nearest_m_);
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    next_best(now, aim, radius_m, i, candidates);
    const Candidate& candidate = candidates[i];
    const double limit = std::min(speed_mps, speed_limit(now, aim, candidate));
    for (const double share : {1.0, 0.6, 0.3}) {
      const Vector3 velocity = (share * limit) * candidate.direction;
      const double clearance_m =
          rollout_clearance(near_, now.velocity, velocity, settings_.response, kPredicted_m);
      if (clearance_m < needed_m) continue;
      found = {velocity, candidate.direction};
      return true;
    }
  }
  return false;
}

Vector3 Steerer::safest_velocity(const std::vector<Candidate>& candidates) const {
  Vector3 safest{};
  double most_m = rollout_clearance(near_, velocity_, {}, settings_.response, kPredicted_m);
  for (const Candidate& candidate : candidates) {
    if (!candidate.is_seen) continue;
    const Vector3 velocity = std::min(1.0, settings_.max_speed_mps) * candidate.direction;
    const double clearance_m =
        rollout_clearance(near_, velocity_, velocity, settings_.response, kPredicted_m);
    if (clearance_m > most_m + 0.02) {
      most_m = clearance_m;
      safest = velocity;
    }
  }
  return safest;
}

void Steerer::commit(const Aim& aim, const Vector3& chosen) {
  last_ = chosen;
  const Vector3 course = level(aim.direction), way = level(chosen);
  const double along = dot(course, way);
  if (side_ == 0 && along < 0.5) {
    side_ = cross_z(course, way) >= 0.0 ? 1 : -1;
  } else if (side_ != 0 && along > 0.85 && aim.distance_m < nearest_goal_m_ - kProgress_m) {
    side_ = 0;
  }
  if (side_ == 0) nearest_goal_m_ = aim.distance_m;
}

Steering Steerer::steer(const Situation& now) {
  velocity_ = now.velocity;
  near_.clear();
  nearest_m_ = kPredicted_m;
  for (const Vector3& point : *now.points) {
    const double distance_m = norm(point);
    nearest_m_ = std::min(nearest_m_, distance_m);
    if (distance_m < kPredicted_m) near_.push_back(point);
  }
  const Aim goal = aim(now);
  Steering found{{}, norm(last_) > 0.0 ? last_ : goal.direction};
  // First with the whole margin, then with a third of it and slowly.
  std::vector<Candidate> tried;
  for (const double share : {1.0, 0.35}) {
    const double radius_m = settings_.body_radius_m + share * settings_.margin_m;
    tried = candidates(now, goal, radius_m);
    if (share == 1.0 && (tried.empty() || dot(tried.front().direction, goal.direction) < 0.3))
      continue;
    const double speed = share == 1.0 ? settings_.max_speed_mps : 0.5 * settings_.max_speed_mps;
    if (find_flyable(now, goal, radius_m, speed, tried, found)) {
      commit(goal, found.look);
      return found;
    }
  }
  found.velocity = safest_velocity(tried);
  return found;
}

}  // namespace reactive
