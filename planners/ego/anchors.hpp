#pragma once

#include <vector>

#include "cost.hpp"
#include "surroundings.hpp"

namespace ego {

/// The last control point of n whose way is checked for obstacles: two thirds of a trajectory, what
/// is flown before the next one.
inline Eigen::Index last_checked(Eigen::Index count) { return count - 3 - (count - 6) / 3; }

/// Control points before and behind a blocked part of their polygon.
struct Segment {
  Eigen::Index in = 0, out = 0;
};

/// The blocked parts between the third control point and the last checked one, in order. Their ends
/// are free, except the third, which can't be moved, and the last of all.
std::vector<Segment> blocked_segments(const Surroundings& surroundings,
                                      const Eigen::Matrix3Xd& points);

/// Finds a way around (A*) and gives each control point of the segment an anchor on the obstacle's
/// surface that lies toward it. False where there is no way.
bool anchor_segment(Surroundings& surroundings, const Eigen::Matrix3Xd& points,
                    const Segment& segment, Anchors& anchors);

/// Whether the segment holds a blocked control point that lies on the free side of all its anchors:
/// an obstacle that they don't know.
bool is_new(const Surroundings& surroundings, const Eigen::Matrix3Xd& points,
            const Segment& segment, const Anchors& anchors);

}  // namespace ego
