#include "nodes_world.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>

#include "avoidbench/portable_math.hpp"

namespace ros_shim {
namespace {

namespace portable = avoidbench::portable;

/// As much of a host's struct as it has, the rest zero.
template <class T>
T copy_of(const T& from) {
  T copy{};
  std::memcpy(&copy, &from, std::min<std::size_t>(from.struct_size, sizeof(T)));
  return copy;
}

}  // namespace

template <class T>
const T* const* NodesWorld::Copies<T>::point() {
  pointers.clear();
  for (const T& one : values) pointers.push_back(&one);
  return pointers.data();
}

NodesWorld::NodesWorld(const std::array<double, 3>& origin_m, double yaw_rad)
    : yaw_rad_(yaw_rad),
      cos_(portable::cos(yaw_rad)),
      sin_(portable::sin(yaw_rad)),
      half_cos_(portable::cos(0.5 * yaw_rad)),
      half_sin_(portable::sin(0.5 * yaw_rad)) {
  std::copy(origin_m.begin(), origin_m.end(), origin_m_);
}

void NodesWorld::direction(const Vec3& from, Vec3& to) const {
  const double x = from[0], y = from[1];
  to[0] = cos_ * x + sin_ * y;
  to[1] = -sin_ * x + cos_ * y;
  to[2] = from[2];
}

void NodesWorld::place(const Vec3& from, Vec3& to) const {
  const Vec3 shifted = {from[0] - origin_m_[0], from[1] - origin_m_[1], from[2] - origin_m_[2]};
  direction(shifted, to);
}

void NodesWorld::direction_back(Vec3& at) const {
  const double x = at[0], y = at[1];
  at[0] = cos_ * x - sin_ * y;
  at[1] = sin_ * x + cos_ * y;
}

void NodesWorld::place_back(Vec3& at) const {
  direction_back(at);
  for (std::size_t i = 0; i < 3; ++i) at[i] += origin_m_[i];
}

/// The turn back about z, from the left.
void NodesWorld::turn(double (&q)[4]) const {
  const double w = q[0], x = q[1], y = q[2], z = q[3];
  q[0] = half_cos_ * w + half_sin_ * z;
  q[1] = half_cos_ * x + half_sin_ * y;
  q[2] = half_cos_ * y - half_sin_ * x;
  q[3] = half_cos_ * z - half_sin_ * w;
}

ab_mission NodesWorld::of(const ab_mission& mission) {
  ab_mission turned = copy_of(mission);
  place(mission.start_world_m, turned.start_world_m);
  place(mission.goal_world_m, turned.goal_world_m);
  turned.start_yaw_rad = portable::wrapped_angle(mission.start_yaw_rad - yaw_rad_);
  if (mission.struct_size > offsetof(ab_mission, highest_world_m)) {
    std::fill_n(turned.lowest_world_m, 3, INFINITY);
    std::fill_n(turned.highest_world_m, 3, -INFINITY);
    for (unsigned corner = 0; corner < 8; ++corner) {
      Vec3 at{};
      for (unsigned i = 0; i < 3; ++i) {
        at[i] = (corner >> i & 1U) != 0 ? mission.highest_world_m[i] : mission.lowest_world_m[i];
      }
      place(at, at);
      for (std::size_t i = 0; i < 3; ++i) {
        turned.lowest_world_m[i] = std::min(turned.lowest_world_m[i], at[i]);
        turned.highest_world_m[i] = std::max(turned.highest_world_m[i], at[i]);
      }
    }
  }
  goals_.assign(turned.goals_world_m, turned.goals_world_m + 3 * std::size_t{turned.goal_count});
  for (std::size_t i = 0; i < goals_.size(); i += 3) {
    Vec3 at = {goals_[i], goals_[i + 1], goals_[i + 2]};
    place(at, at);
    std::copy_n(at, 3, goals_.begin() + static_cast<std::ptrdiff_t>(i));
  }
  turned.goals_world_m = goals_.data();
  return turned;
}

ab_state NodesWorld::of(const ab_state& state) const {
  ab_state turned = copy_of(state);
  place(state.position_world_m, turned.position_world_m);
  direction(state.velocity_world_mps, turned.velocity_world_mps);
  turn(turned.q_world_body);
  return turned;
}

template <class Image>
Image NodesWorld::of_camera(const Image& image) const {
  Image turned = copy_of(image);
  place(image.position_world_m, turned.position_world_m);
  turn(turned.q_world_camera);
  return turned;
}

const ab_observation& NodesWorld::of(const ab_observation& seen) {
  seen_ = copy_of(seen);
  state_ = of(*seen.state);
  seen_.state = &state_;
  seen_.reference = nullptr;
  seen_.track_count = 0;
  states_.values.clear();
  for (std::uint32_t i = 0; i < seen_.state_count; ++i) {
    states_.values.push_back(of(*seen_.states[i]));
  }
  seen_.states = states_.point();
  depth_.values.clear();
  for (std::uint32_t i = 0; i < seen_.depth_count; ++i) {
    depth_.values.push_back(of_camera(*seen_.depth[i]));
  }
  seen_.depth = depth_.point();
  color_.values.clear();
  for (std::uint32_t i = 0; i < seen_.color_count; ++i) {
    color_.values.push_back(of_camera(*seen_.color[i]));
  }
  seen_.color = color_.point();
  for (auto* copies : {&left_, &right_}) copies->values.clear();
  stereo_.values.clear();
  for (std::uint32_t i = 0; i < seen_.stereo_count; ++i) {
    left_.values.push_back(of_camera(*seen_.stereo[i]->left));
    right_.values.push_back(of_camera(*seen_.stereo[i]->right));
    stereo_.values.push_back(copy_of(*seen_.stereo[i]));
  }
  for (std::size_t i = 0; i < stereo_.values.size(); ++i) {
    stereo_.values[i].left = &left_.values[i];
    stereo_.values[i].right = &right_.values[i];
  }
  seen_.stereo = stereo_.point();
  clouds_.values.clear();
  for (std::uint32_t i = 0; i < seen_.cloud_count; ++i) {
    ab_cloud& cloud = clouds_.values.emplace_back(copy_of(*seen_.clouds[i]));
    place(seen_.clouds[i]->position_world_m, cloud.position_world_m);
    turn(cloud.q_world_lidar);
  }
  seen_.clouds = clouds_.point();
  place(seen_.goal_world_m, seen_.goal_world_m);
  return seen_;
}

ab_command NodesWorld::back(const ab_command& command) {
  ab_command turned = command;
  place_back(turned.position_world_m);
  direction_back(turned.velocity_world_mps);
  direction_back(turned.acceleration_world_mps2);
  turned.yaw_rad += yaw_rad_;
  points_.assign(command.points, command.points + command.point_count);
  for (ab_point& point : points_) {
    place_back(point.position_world_m);
    for (auto* motion :
         {&point.velocity_world_mps, &point.acceleration_world_mps2, &point.jerk_world_mps3}) {
      direction_back(*motion);
    }
    point.yaw_rad += yaw_rad_;
  }
  turned.points = points_.empty() ? nullptr : points_.data();
  return turned;
}

}  // namespace ros_shim
