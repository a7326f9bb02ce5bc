#include "sight.hpp"

#include <algorithm>
#include <limits>

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

bool is_believed(const std::vector<DepthView>& views) {
  return static_cast<int>(views.size()) >= Sight::kNeeded;
}

}  // namespace

void Sight::take(const ab_depth_image& image) {
  if (image.camera >= cameras_.size()) cameras_.resize(image.camera + 1);
  Views& views = cameras_[image.camera];
  if (static_cast<int>(views.size()) < kImages) {
    views.emplace_back();
  } else {
    std::rotate(views.begin(), views.begin() + 1, views.end());  // the oldest's buffers go on
  }
  views.back().take(image);
}

void Sight::take(const ab_cloud& cloud) {
  if (cloud.lidar >= lidars_.size()) lidars_.resize(cloud.lidar + 1);
  lidars_[cloud.lidar].take(cloud);
}

bool Sight::is_ready() const {
  return !lidars_.empty() || std::any_of(cameras_.begin(), cameras_.end(), is_believed);
}

void Sight::append_points(double range_m, std::vector<Vector3>& points_world) const {
  for (const Views& views : cameras_) {
    if (!is_believed(views)) continue;
    const std::size_t first = points_world.size();
    views.back().append_points(range_m, points_world);
    const auto is_alone = [&](const Vector3& point) {
      return !agree(views.begin(), views.end() - 1, kNeeded - 1,
                    [&](const DepthView& view) { return view.shows(point); });
    };
    points_world.erase(std::remove_if(points_world.begin() + static_cast<std::ptrdiff_t>(first),
                                      points_world.end(), is_alone),
                       points_world.end());
  }
  for (const PointView& lidar : lidars_) lidar.append_points(range_m, points_world);
}

bool Sight::has_seen(const Vector3& direction_world) const {
  const bool by_lidar = std::any_of(lidars_.begin(), lidars_.end(), [&](const PointView& lidar) {
    return lidar.has_seen(direction_world);
  });
  return by_lidar || std::any_of(cameras_.begin(), cameras_.end(), [&](const Views& views) {
           return agree(views.begin(), views.end(), kNeeded,
                        [&](const DepthView& view) { return view.has_seen(direction_world); });
         });
}

bool Sight::sees_through(const Vector3& point_world) const {
  const bool by_lidar = std::any_of(lidars_.begin(), lidars_.end(), [&](const PointView& lidar) {
    return lidar.sees_through(point_world);
  });
  return by_lidar || std::any_of(cameras_.begin(), cameras_.end(), [&](const Views& views) {
           return agree(views.begin(), views.end(), kNeeded,
                        [&](const DepthView& view) { return view.sees_through(point_world); });
         });
}

double Sight::looked_along(const Vector3& direction_world) const {
  for (const PointView& lidar : lidars_) {
    if (lidar.has_seen(direction_world)) return 1.0;
  }
  const auto level = [](const Vector3& v) { return direction({v.x, v.y, 0.0}, {0.0, 0.0, 0.0}); };
  Vector3 forward;
  double most = -std::numeric_limits<double>::infinity();
  for (const Views& views : cameras_) {
    const double along = views.empty() ? most : dot(views.back().forward_world(), direction_world);
    if (!(along > most)) continue;
    most = along;
    forward = views.back().forward_world();
  }
  return dot(level(forward), level(direction_world));
}

}  // namespace reactive
