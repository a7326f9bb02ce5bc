#include "anchors.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace ego {
namespace {

using Eigen::Index;
using Eigen::Matrix3Xd;
using Eigen::Vector3d;

bool is_line_blocked(const Surroundings& surroundings, const Vector3d& from, const Vector3d& to) {
  const double step_m = 0.5 * surroundings.grid.spec().resolution_m;
  const int steps = std::max(1, static_cast<int>(std::ceil((to - from).norm() / step_m)));
  for (int i = 0; i <= steps; ++i) {
    if (surroundings.is_blocked(from + (static_cast<double>(i) / steps) * (to - from))) return true;
  }
  return false;
}

/// Where the path crosses the plane through `place`, as near to its middle as may be.
std::optional<Vector3d> crossing(const std::vector<Vector3d>& path, const Vector3d& place,
                                 const Vector3d& normal) {
  const auto height = [&](std::size_t k) { return (path[k] - place).dot(normal); };
  const std::size_t middle = path.size() / 2;
  const bool is_ahead = height(middle) < 0.0;  // the plane lies further along the path
  std::size_t k = middle;
  while (is_ahead ? k + 1 < path.size() : k > 0) {
    const std::size_t next = is_ahead ? k + 1 : k - 1;
    const double here = height(k), there = height(next);
    if ((here < 0.0) != (there < 0.0)) {
      const double part = here / (here - there);
      return Vector3d(path[k] + part * (path[next] - path[k]));
    }
    k = next;
  }
  return std::nullopt;
}

/// The anchor that pushes `place` toward `free`: on the surface of the first obstacle met on the
/// way back from there.
std::optional<Anchor> anchor_between(const Surroundings& surroundings, const Vector3d& place,
                                     const Vector3d& free) {
  const Vector3d way = free - place;
  const double length = way.norm(), step_m = surroundings.grid.spec().resolution_m;
  if (length < 0.1 * step_m) return std::nullopt;
  const Vector3d direction = way / length;
  Vector3d surface = free;
  for (int i = 0; i * step_m < length; ++i) {
    const Vector3d at = free - (i * step_m) * direction;
    if (surroundings.is_blocked(at)) break;
    surface = at;
  }
  return Anchor{surface, direction};
}

}  // namespace

std::vector<Segment> blocked_segments(const Surroundings& surroundings, const Matrix3Xd& points) {
  const Index last = last_checked(points.cols());
  std::vector<Segment> segments;
  for (Index i = 2; i < last; ++i) {
    if (!is_line_blocked(surroundings, points.col(i), points.col(i + 1))) continue;
    if (!segments.empty() && segments.back().out == i) {
      segments.back().out = i + 1;
    } else {
      segments.push_back({i, i + 1});
    }
  }
  if (!segments.empty()) {
    Index& out = segments.back().out;
    while (out + 1 < points.cols() && surroundings.is_blocked(points.col(out))) ++out;
  }
  return segments;
}

bool anchor_segment(Surroundings& surroundings, const Matrix3Xd& points, const Segment& segment,
                    Anchors& anchors) {
  const auto path =
      surroundings.search.find(surroundings.grid, points.col(segment.in), points.col(segment.out));
  if (!path || path->size() < 2) return false;
  const auto anchors_of = [&](Index j) -> std::vector<Anchor>& {
    return anchors[static_cast<std::size_t>(j)];
  };
  if (segment.out == segment.in + 1) {  // nothing between them: what pushes the middle pushes both
    const Vector3d middle = 0.5 * (points.col(segment.in) + points.col(segment.out));
    const auto free = crossing(*path, middle, points.col(segment.out) - points.col(segment.in));
    const auto anchor =
        anchor_between(surroundings, middle, free.value_or((*path)[path->size() / 2]));
    if (!anchor) return false;
    anchors_of(segment.in).push_back(*anchor);
    anchors_of(segment.out).push_back(*anchor);
    return true;
  }
  std::vector<std::optional<Anchor>> found(static_cast<std::size_t>(segment.out - segment.in + 1));
  bool is_any = false;
  for (Index j = segment.in + 1; j < segment.out; ++j) {
    const auto free = crossing(*path, points.col(j), points.col(j + 1) - points.col(j - 1));
    if (!free) continue;
    auto& anchor = found[static_cast<std::size_t>(j - segment.in)];
    anchor = anchor_between(surroundings, points.col(j), *free);
    is_any = is_any || anchor.has_value();
  }
  if (!is_any) return false;
  // Points without one take their neighbour's, forward and then backward.
  for (std::size_t k = 2; k + 1 < found.size(); ++k) {
    if (!found[k]) found[k] = found[k - 1];
  }
  for (std::size_t k = found.size() - 2; k >= 2; --k) {
    if (!found[k - 1]) found[k - 1] = found[k];
  }
  for (Index j = segment.in + 1; j < segment.out; ++j) {
    const auto& anchor = found[static_cast<std::size_t>(j - segment.in)];
    if (anchor) anchors_of(j).push_back(*anchor);
  }
  return true;
}

bool is_new(const Surroundings& surroundings, const Matrix3Xd& points, const Segment& segment,
            const Anchors& anchors) {
  const double outside_m = surroundings.grid.spec().resolution_m;
  for (Index j = std::max<Index>(segment.in, 3); j <= segment.out && j + 3 < points.cols(); ++j) {
    if (!surroundings.is_blocked(points.col(j))) continue;
    const std::vector<Anchor>& known = anchors[static_cast<std::size_t>(j)];
    const bool is_outside_all = std::all_of(known.begin(), known.end(), [&](const Anchor& anchor) {
      return (points.col(j) - anchor.point).dot(anchor.direction) >= outside_m;
    });
    if (is_outside_all) return true;
  }
  return false;
}

}  // namespace ego
