#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>

#include "avoidbench/planner.h"
#include "network.hpp"
#include "planning/polynomial.hpp"

/// What the net is told: one image and 22 numbers, both in axes that do not depend on where the
/// vehicle is or how the map lies.
namespace agile {

inline constexpr double kHorizon_s = 2.0;  ///< how far a mode reaches
/// Of the net's camera, a pinhole with its principal point in the middle: 90° × 67°.
inline constexpr double kFocal_px = 48.0;
inline constexpr double kFovX_rad = 1.57079632679489662;  ///< 2 atan(48 / 48)
inline constexpr double kFovY_rad = 1.17600520709513510;  ///< 2 atan(32 / 48)

/// 255 · min(1, 1 m / depth), row-major; 0: no return, invalid, or beyond the camera's edge.
using Image = std::array<std::uint8_t, kImageHeight * kImageWidth>;
using Inputs = std::array<float, kInputs>;

/// The nearest depth of all pixels that fall into each of the net's: thin things stay visible.
Image net_image(const ab_depth_image& depth);

/// Level axes at a camera: x where it looks, y left, z up.
struct ImageFrame {
  Eigen::Vector3d origin_world = Eigen::Vector3d::Zero();
  double yaw_rad = 0.0;
  Eigen::Vector3d up_camera = -Eigen::Vector3d::UnitY();  ///< the world's z in the camera's axes
};

ImageFrame image_frame(const ab_depth_image& depth);

/// Directions and differences, between the world's axes and the frame's.
Eigen::Vector3d turned_to_world(const ImageFrame& frame, const Eigen::Vector3d& in_frame);
Eigen::Vector3d turned_to_frame(const ImageFrame& frame, const Eigen::Vector3d& in_world);

/// What a plan is made for; all in world axes.
struct Situation {
  ImageFrame frame;
  planning::Motion start;  ///< when the plan takes effect
  Eigen::Vector3d goal_world = Eigen::Vector3d::Zero();
  double desired_speed_mps = 1.0;
  Eigen::Vector3d lowest_world = Eigen::Vector3d::Zero();  ///< the map's box: flights end beyond it
  Eigen::Vector3d highest_world = Eigen::Vector3d::Zero();
};

/// The unit of the modes' points.
inline double reach_m(const Situation& situation) {
  return situation.desired_speed_mps * kHorizon_s;
}

/// From the start to the goal, of length 1; along the camera where the start is the goal.
Eigen::Vector3d goal_direction_world(const Situation& situation);

/// In this order, lengths and directions in the image's frame:
///    0 –  2  the start, from the camera, m
///    3 –  5  its velocity over the desired speed
///    6 –  8  its acceleration over 10 m/s²
///    9 – 11  the world's z in the camera's axes
///   12 – 14  direction to the goal
///   15       distance to the goal over the reach, at most 1
///   16       desired speed over 5 m/s
///   17, 18   height above the map's floor, and up to its ceiling, over 3 m, at most 2
///   19 – 21  way to the map's sides ahead, left and right over the reach, at most 1
Inputs net_inputs(const Situation& situation);

}  // namespace agile
