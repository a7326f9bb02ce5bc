#include "flown_path.hpp"

#include <algorithm>

namespace mbplanner {
namespace {

using Eigen::Vector3d;

constexpr double kStep_m = 0.3;
constexpr std::size_t kMostPlaces = 400, kOpenPlaces = 4;

}  // namespace

void FlownPath::visit(const Vector3d& position) {
  if (!places_.empty() && (places_.back() - position).norm() < kStep_m) return;
  // Back at an older place: what lies between was a detour.
  for (std::size_t i = 0; i + kOpenPlaces < places_.size(); ++i) {
    if ((places_[i] - position).norm() >= kStep_m) continue;
    places_.resize(i + 1);
    break;
  }
  places_.push_back(position);
  if (places_.size() > kMostPlaces) places_.erase(places_.begin());
}

std::vector<Motion> FlownPath::back(const Vector3d& from, double length_m,
                                    const Limits& limits) const {
  std::vector<Motion> knots;
  Motion at;
  at.position = from;
  double flown_m = 0.0;
  for (std::size_t i = places_.size(); i-- > 0 && flown_m < length_m;) {
    const double way_m = (places_[i] - at.position).norm();
    if (way_m < kStep_m) continue;
    // From rest to rest: slow, but it goes through where it has been and nowhere else.
    const std::vector<Motion> leg = stop_at(at, places_[i], limits);
    knots.insert(knots.end(), leg.begin(), leg.end());
    at.position = places_[i];
    flown_m += way_m;
  }
  return knots;
}

}  // namespace mbplanner
