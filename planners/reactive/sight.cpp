#include "sight.hpp"

#include <algorithm>

namespace reactive {
namespace {

/// Whether at least `needed` of the views from `view` to `end` say yes. Asks no more of them than
/// decide it.
template <class View, class Question>
bool agree(View view, View end, int needed, const Question& question) {
  for (; needed > 0 && needed <= end - view; ++view) {
    if (question(*view)) --needed;
  }
  return needed <= 0;
}

}  // namespace

void Sight::take(const ab_depth_image& image) {
  if (static_cast<int>(views_.size()) < kImages) {
    views_.emplace_back();
  } else {
    std::rotate(views_.begin(), views_.begin() + 1, views_.end());  // the oldest's buffers go on
  }
  views_.back().take(image);
}

void Sight::append_points(double range_m, std::vector<Vector3>& points_world) const {
  if (!is_ready()) return;
  const std::size_t first = points_world.size();
  views_.back().append_points(range_m, points_world);
  const auto is_alone = [&](const Vector3& point) {
    return !agree(views_.begin(), views_.end() - 1, kNeeded - 1,
                  [&](const DepthView& view) { return view.shows(point); });
  };
  points_world.erase(std::remove_if(points_world.begin() + static_cast<std::ptrdiff_t>(first),
                                    points_world.end(), is_alone),
                     points_world.end());
}

bool Sight::has_seen(const Vector3& direction_world) const {
  return agree(views_.begin(), views_.end(), kNeeded,
               [&](const DepthView& view) { return view.has_seen(direction_world); });
}

bool Sight::sees_through(const Vector3& point_world) const {
  return agree(views_.begin(), views_.end(), kNeeded,
               [&](const DepthView& view) { return view.sees_through(point_world); });
}

}  // namespace reactive
