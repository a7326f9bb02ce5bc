#include <algorithm>
#include <cmath>
#include <cstring>
#include <initializer_list>
#include <limits>
#include <stdexcept>
#include <utility>

#include "avoidbench/planner.hpp"
#include "avoidbench/portable_math.hpp"
#include "flight.hpp"
#include "geometry_msgs/PointStamped.h"
#include "geometry_msgs/PoseStamped.h"
#include "geometry_msgs/TransformStamped.h"
#include "geometry_msgs/TwistStamped.h"
#include "nav_msgs/Odometry.h"
#include "nav_msgs/Path.h"
#include "sensor_msgs/CameraInfo.h"
#include "sensor_msgs/Image.h"
#include "sensor_msgs/Imu.h"
#include "sensor_msgs/PointCloud2.h"
#include "tf2_msgs/TFMessage.h"

namespace ros_shim {
namespace {

template <class To>
void set_xyz(To& to, const double (&from)[3]) {
  to.x = from[0];
  to.y = from[1];
  to.z = from[2];
}

geometry_msgs::Pose pose_of(const double (&position_m)[3], const double (&q_wxyz)[4]) {
  geometry_msgs::Pose pose;
  set_xyz(pose.position, position_m);
  pose.orientation.w = q_wxyz[0];
  pose.orientation.x = q_wxyz[1];
  pose.orientation.y = q_wxyz[2];
  pose.orientation.z = q_wxyz[3];
  return pose;
}

std_msgs::Header header_of(std::uint32_t sequence, double time_s, const std::string& frame) {
  std_msgs::Header header;
  header.seq = sequence;
  header.stamp.fromNSec(ros_time_ns(time_s));
  header.frame_id = frame;
  return header;
}

template <class M, class Topics>
std::vector<ros::Publisher> advertised(ros::NodeHandle& host, const Topics& topics) {
  std::vector<ros::Publisher> made;
  for (const auto& one : topics) made.push_back(host.advertise<M>(one.topic, 1));
  return made;
}

sensor_msgs::CameraInfo info_of(const std_msgs::Header& header, int width_px, int height_px,
                                double fx_px, double fy_px, double cx_px, double cy_px,
                                double baseline_m) {
  sensor_msgs::CameraInfo info;
  info.header = header;
  info.width = static_cast<std::uint32_t>(width_px);
  info.height = static_cast<std::uint32_t>(height_px);
  info.distortion_model = "plumb_bob";
  info.D.assign(5, 0.0);
  info.K[0] = info.P[0] = fx_px;
  info.K[2] = info.P[2] = cx_px;
  info.K[4] = info.P[5] = fy_px;
  info.K[5] = info.P[6] = cy_px;
  info.K[8] = info.P[10] = 1.0;
  info.R[0] = info.R[4] = info.R[8] = 1.0;
  info.P[3] = -fx_px * baseline_m;  // of a right eye; a left one has 0
  return info;
}

template <class Pixel>
void put_pixel(std::vector<std::uint8_t>& data, std::size_t index, Pixel value) {
  std::memcpy(data.data() + index * sizeof(Pixel), &value, sizeof(Pixel));
}

sensor_msgs::Image depth_message(const ab_depth_image& image, const DepthTopic& topic) {
  sensor_msgs::Image message;
  const bool in_mm = topic.format == PixelFormat::unsigned_mm;
  const std::size_t size = in_mm ? sizeof(std::uint16_t) : sizeof(float);
  message.width = static_cast<std::uint32_t>(image.width_px);
  message.height = static_cast<std::uint32_t>(image.height_px);
  message.encoding = in_mm ? "16UC1" : "32FC1";
  message.step = static_cast<std::uint32_t>(size) * message.width;
  const std::size_t count = std::size_t{message.width} * message.height;
  message.data.resize(count * size);
  for (std::size_t i = 0; i < count; ++i) {
    float depth_m = image.depth_m[i];
    if (std::isnan(depth_m)) depth_m = static_cast<float>(topic.invalid_m);
    if (std::isinf(depth_m)) depth_m = static_cast<float>(topic.no_return_m);
    if (!in_mm) {
      put_pixel(message.data, i, depth_m);
      continue;
    }
    const float mm = std::round(depth_m * 1000.0F);
    // Beyond 65.5 m there is no number: as no return.
    put_pixel(message.data, i, static_cast<std::uint16_t>(mm > 0.0F && mm <= 65535.0F ? mm : 0.0F));
  }
  return message;
}

/// Without points; a point's fields are float32 and follow one another.
sensor_msgs::PointCloud2 empty_cloud(std::initializer_list<const char*> names) {
  sensor_msgs::PointCloud2 cloud;
  for (const char* name : names) {
    sensor_msgs::PointField field;
    field.name = name;
    field.offset = cloud.point_step;
    field.datatype = sensor_msgs::PointField::FLOAT32;
    field.count = 1;
    cloud.fields.push_back(field);
    cloud.point_step += 4;
  }
  cloud.height = 1;
  cloud.is_dense = 1;
  return cloud;
}

/// Where a point of a sweep lies, m.
avoidbench::Vec3 place_of(const ab_lidar_point& point, const ab_cloud& sweep, const ab_lidar& lidar,
                          PointsIn points_in) {
  if (points_in == PointsIn::world) return avoidbench::point_in_world(sweep, point);
  const avoidbench::Vec3 place{static_cast<double>(point.position_lidar_m[0]),
                               static_cast<double>(point.position_lidar_m[1]),
                               static_cast<double>(point.position_lidar_m[2])};
  if (points_in == PointsIn::lidar) return place;
  const avoidbench::Vec3 turned = avoidbench::rotated(lidar.q_body_lidar, place);
  return {turned[0] + lidar.position_body_m[0], turned[1] + lidar.position_body_m[1],
          turned[2] + lidar.position_body_m[2]};
}

[[noreturn]] void fail_topic(const std::string& topic, const std::string& problem) {
  throw std::runtime_error("publish: " + topic + ": " + problem);
}

/// A host refuses a sensor of which the nodes see nothing. What it lets pass is one that has either
/// cameras or lidars, where a file publishes of both: nodes would wait in silence.
void require_sensors(const PlannerSpec& spec, const std::vector<ab_camera>& cameras,
                     const std::vector<ab_lidar>& lidars) {
  const auto require_cameras = [&cameras](const auto& topics) {
    if (!topics.empty() && cameras.empty()) {
      fail_topic(topics.front().topic, "is of a camera, and the sensor has none");
    }
  };
  for (const TransformTopic& one : spec.transforms) {
    if (one.camera_frame.empty() || one.camera < cameras.size()) continue;
    fail_topic(one.topic, "there is no camera " + std::to_string(one.camera) + ": the sensor has " +
                              std::to_string(cameras.size()) + ", counted from 0");
  }
  require_cameras(spec.camera_poses);
  require_cameras(spec.depth);
  require_cameras(spec.clouds);
  require_cameras(spec.pictures);
  for (const SweepTopic& one : spec.sweeps) {
    if (one.lidar < lidars.size()) continue;
    fail_topic(one.topic, lidars.empty() ? "is of a lidar, and the sensor has none"
                                         : "there is no lidar " + std::to_string(one.lidar) +
                                               ": the sensor has " + std::to_string(lidars.size()) +
                                               ", counted from 0");
  }
}

}  // namespace

std::int64_t ros_time_ns(double time_s) { return kStart_ns + nanoseconds_of(time_s); }

Observations::Observations(const PlannerSpec& spec, const ab_setup& setup,
                           const ab_mission& mission, Given given)
    : spec_(&spec), mission_(mission), given_(std::move(given)) {
  for (std::uint32_t i = 0; i < setup.camera_count; ++i) cameras_.push_back(*setup.cameras[i]);
  // Hosts that know of points know of lidars.
  for (std::uint32_t i = 0; !spec.sweeps.empty() && i < setup.lidar_count; ++i) {
    lidars_.push_back(*setup.lidars[i]);
  }
  require_sensors(spec, cameras_, lidars_);
  odometry_ = advertised<nav_msgs::Odometry>(host_, spec.odometry);
  poses_ = advertised<geometry_msgs::PoseStamped>(host_, spec.poses);
  twists_ = advertised<geometry_msgs::TwistStamped>(host_, spec.twists);
  imu_ = advertised<sensor_msgs::Imu>(host_, spec.imu);
  transforms_ = advertised<tf2_msgs::TFMessage>(host_, spec.transforms);
  depth_ = advertised<sensor_msgs::Image>(host_, spec.depth);
  pictures_ = advertised<sensor_msgs::Image>(host_, spec.pictures);
  clouds_ = advertised<sensor_msgs::PointCloud2>(host_, spec.clouds);
  sweeps_ = advertised<sensor_msgs::PointCloud2>(host_, spec.sweeps);
  const auto add_info = [this](const std::string& topic, std::vector<ros::Publisher>& to) {
    to.push_back(topic.empty() ? ros::Publisher()
                               : host_.advertise<sensor_msgs::CameraInfo>(topic, 1));
  };
  for (const DepthTopic& one : spec.depth) add_info(one.info_topic, depth_info_);
  for (const PictureTopic& one : spec.pictures) add_info(one.info_topic, picture_info_);
  for (const CameraPoseTopic& one : spec.camera_poses) {
    camera_poses_.push_back(one.type == PoseType::pose_stamped
                                ? host_.advertise<geometry_msgs::PoseStamped>(one.topic, 1)
                            : one.type == PoseType::odometry
                                ? host_.advertise<nav_msgs::Odometry>(one.topic, 1)
                                : host_.advertise<geometry_msgs::TransformStamped>(one.topic, 1));
  }
  for (const GoalTopic& one : spec.goals) {
    goals_.push_back(one.type == GoalType::pose_stamped
                         ? host_.advertise<geometry_msgs::PoseStamped>(one.topic, 1)
                     : one.type == GoalType::point_stamped
                         ? host_.advertise<geometry_msgs::PointStamped>(one.topic, 1)
                     : one.type == GoalType::path
                         ? host_.advertise<nav_msgs::Path>(one.topic, 1)
                         : host_.advertise<geometry_msgs::Pose>(one.topic, 1));
  }
  for (const MessageTopic& one : spec.messages) {
    const std::size_t k = messages_.size();
    messages_.push_back({one.advertise(host_, given_), {}, false});
    if (one.every_s <= 0.0) continue;
    messages_[k].repeat = host_.createTimer(
        ros::Duration(one.every_s),
        ros::TimerCallback([this, k](const ros::TimerEvent&) { publish_message(k); }), false,
        false);
  }
  goal_.reset(mission);
  goal_due_ns_.assign(spec.goals.size(), 0);
  const auto wants_all = [](const auto& topic) { return topic.all_states; };
  sees_states_ = std::any_of(spec.odometry.begin(), spec.odometry.end(), wants_all) ||
                 std::any_of(spec.poses.begin(), spec.poses.end(), wants_all) ||
                 std::any_of(spec.twists.begin(), spec.twists.end(), wants_all);
}

void Observations::publish_start() {
  ab_state state{};
  state.time_s = 1e-9 * static_cast<double>(now_ns() - kStart_ns);
  std::copy(std::begin(mission_.start_world_m), std::end(mission_.start_world_m),
            state.position_world_m);
  const double half = 0.5 * mission_.start_yaw_rad;
  state.q_world_body[0] = avoidbench::portable::cos(half);
  state.q_world_body[3] = avoidbench::portable::sin(half);
  publish_state(state, StateTopics::of_the_newest);
  publish_state(state, StateTopics::of_all_states);
  publish_messages(true);
}

/// What was sampled since the last call, each at its own time, for which the nodes go on.
void Observations::publish_samples(const ab_observation& seen, std::int64_t to_ns) {
  const std::uint32_t imu_count = imu_.empty() ? 0 : seen.imu_count;
  const std::uint32_t state_count = sees_states_ ? seen.state_count : 0;
  for (std::uint32_t i = 0, k = 0; i < imu_count || k < state_count;) {
    const bool is_imu =
        k == state_count || (i < imu_count && seen.imu[i].time_s <= seen.states[k]->time_s);
    const std::int64_t at_ns = ros_time_ns(is_imu ? seen.imu[i].time_s : seen.states[k]->time_s);
    if (at_ns > now_ns() && at_ns <= to_ns) advance(at_ns);
    if (is_imu) {
      publish_imu(seen.imu[i++]);
    } else {
      publish_state(*seen.states[k++], StateTopics::of_all_states);
    }
  }
}

void Observations::publish_imu(const ab_imu_sample& sample) {
  for (std::size_t k = 0; k < imu_.size(); ++k) {
    sensor_msgs::Imu message;
    message.header = header_of(sequence_, sample.time_s, spec_->imu[k].frame);
    message.orientation_covariance[0] = -1.0;  // ROS's sign for: no orientation
    set_xyz(message.angular_velocity, sample.rates_body_radps);
    set_xyz(message.linear_acceleration, sample.specific_force_body_mps2);
    imu_[k].publish(message);
  }
}

void Observations::publish(const ab_observation& seen, std::int64_t to_ns) {
  publish_samples(seen, to_ns);
  // What was due before this observation saw the one before.
  if (to_ns > now_ns()) {
    advance(to_ns - 1);
    set_now(to_ns);
  }
  publish_state(*seen.state, StateTopics::of_the_newest);
  // Oldest first, as they were taken.
  for (std::uint32_t i = seen.depth_count; i-- > 0;) publish_depth(*seen.depth[i]);
  for (std::uint32_t i = seen.stereo_count; i-- > 0;) {
    publish_picture(*seen.stereo[i]->left, 0);
    publish_picture(*seen.stereo[i]->right, 1);
  }
  for (std::uint32_t i = seen.color_count; i-- > 0;) publish_picture(*seen.color[i], 2);
  if (!sweeps_.empty()) {
    for (std::uint32_t i = seen.cloud_count; i-- > 0;) publish_sweep(*seen.clouds[i]);
  }
  // Another goal, or one that has moved, is sent at once.
  if (goal_.update(seen)) {
    goal_due_ns_.assign(goals_.size(), 0);
    for (std::size_t k = 0; k < messages_.size(); ++k) {
      if (!spec_->messages[k].at_start) messages_[k].is_sent = false;
    }
  }
  given_.goal_x_m = goal_.place_world_m()[0];
  given_.goal_y_m = goal_.place_world_m()[1];
  given_.goal_z_m = goal_.place_world_m()[2];
  publish_goals();
  publish_messages(false);
  ++sequence_;
}

void Observations::publish_transforms(const ab_state& state) {
  const auto add = [&](tf2_msgs::TFMessage& message, const std::string& frame,
                       const std::string& child, const double(&position_m)[3],
                       const double(&q)[4]) {
    geometry_msgs::TransformStamped one;
    one.header = header_of(sequence_, state.time_s, frame);
    one.child_frame_id = child;
    set_xyz(one.transform.translation, position_m);
    one.transform.rotation = pose_of(position_m, q).orientation;
    message.transforms.push_back(one);
  };
  for (std::size_t k = 0; k < transforms_.size(); ++k) {
    const TransformTopic& topic = spec_->transforms[k];
    tf2_msgs::TFMessage message;
    add(message, topic.frame, topic.child_frame, state.position_world_m, state.q_world_body);
    if (!topic.camera_frame.empty()) {
      const ab_camera& camera = cameras_[topic.camera];
      add(message, topic.child_frame, topic.camera_frame, camera.position_body_m,
          camera.q_body_camera);
    }
    transforms_[k].publish(message);
  }
}

void Observations::publish_state(const ab_state& state, StateTopics which) {
  const bool all = which == StateTopics::of_all_states;
  if (!all) publish_transforms(state);
  const avoidbench::Vec3 world{state.velocity_world_mps[0], state.velocity_world_mps[1],
                               state.velocity_world_mps[2]};
  const double q_body_world[4] = {state.q_world_body[0], -state.q_world_body[1],
                                  -state.q_world_body[2], -state.q_world_body[3]};
  const avoidbench::Vec3 body = avoidbench::rotated(q_body_world, world);
  for (std::size_t k = 0; k < odometry_.size(); ++k) {
    const OdometryTopic& topic = spec_->odometry[k];
    if (topic.all_states != all) continue;
    nav_msgs::Odometry message;
    message.header = header_of(sequence_, state.time_s, topic.frame);
    message.child_frame_id = topic.child_frame;
    message.pose.pose = pose_of(state.position_world_m, state.q_world_body);
    const avoidbench::Vec3& velocity = topic.body_velocity ? body : world;
    message.twist.twist.linear.x = velocity[0];
    message.twist.twist.linear.y = velocity[1];
    message.twist.twist.linear.z = velocity[2];
    set_xyz(message.twist.twist.angular, state.rates_body_radps);
    odometry_[k].publish(message);
  }
  for (std::size_t k = 0; k < poses_.size(); ++k) {
    if (spec_->poses[k].all_states != all) continue;
    geometry_msgs::PoseStamped message;
    message.header = header_of(sequence_, state.time_s, spec_->poses[k].frame);
    message.pose = pose_of(state.position_world_m, state.q_world_body);
    poses_[k].publish(message);
  }
  for (std::size_t k = 0; k < twists_.size(); ++k) {
    if (spec_->twists[k].all_states != all) continue;
    geometry_msgs::TwistStamped message;
    message.header = header_of(sequence_, state.time_s, spec_->twists[k].frame);
    set_xyz(message.twist.linear, state.velocity_world_mps);
    set_xyz(message.twist.angular, state.rates_body_radps);
    twists_[k].publish(message);
  }
}

void Observations::publish_depth(const ab_depth_image& image) {
  for (std::size_t k = 0; k < camera_poses_.size(); ++k) {
    const CameraPoseTopic& topic = spec_->camera_poses[k];
    if (topic.camera != image.camera) continue;
    const std_msgs::Header header = header_of(sequence_, image.time_s, topic.frame);
    const geometry_msgs::Pose pose = pose_of(image.position_world_m, image.q_world_camera);
    if (topic.type == PoseType::pose_stamped) {
      geometry_msgs::PoseStamped message;
      message.header = header;
      message.pose = pose;
      camera_poses_[k].publish(message);
    } else if (topic.type == PoseType::odometry) {
      nav_msgs::Odometry message;
      message.header = header;
      message.pose.pose = pose;
      camera_poses_[k].publish(message);
    } else {
      geometry_msgs::TransformStamped message;
      message.header = header;
      set_xyz(message.transform.translation, image.position_world_m);
      message.transform.rotation = pose.orientation;
      camera_poses_[k].publish(message);
    }
  }
  for (std::size_t k = 0; k < depth_.size(); ++k) {
    const DepthTopic& topic = spec_->depth[k];
    if (topic.camera != image.camera) continue;
    sensor_msgs::Image message = depth_message(image, topic);
    message.header = header_of(sequence_, image.time_s, topic.frame);
    if (!topic.info_topic.empty()) {
      depth_info_[k].publish(info_of(message.header, image.width_px, image.height_px, image.fx_px,
                                     image.fy_px, image.cx_px, image.cy_px, 0.0));
    }
    depth_[k].publish(message);
  }
  for (std::size_t k = 0; k < clouds_.size(); ++k) {
    if (spec_->clouds[k].camera == image.camera) publish_cloud(image, k);
  }
}

void Observations::publish_cloud(const ab_depth_image& image, std::size_t index) {
  const CloudTopic& topic = spec_->clouds[index];
  sensor_msgs::PointCloud2 cloud = empty_cloud({"x", "y", "z"});
  cloud.header = header_of(sequence_, image.time_s, topic.frame);
  for (int row = 0; row < image.height_px; row += topic.stride_px) {
    for (int column = 0; column < image.width_px; column += topic.stride_px) {
      const auto pixel = static_cast<std::size_t>(row) * static_cast<std::size_t>(image.width_px) +
                         static_cast<std::size_t>(column);
      const double depth_m = static_cast<double>(image.depth_m[pixel]);
      if (!std::isfinite(depth_m) || depth_m <= 0.0) continue;
      const avoidbench::Vec3 point = avoidbench::pixel_in_world(image, column, row, depth_m);
      const std::size_t at = cloud.data.size();
      cloud.data.resize(at + 12);
      for (std::size_t i = 0; i < 3; ++i) {
        put_pixel(cloud.data, at / 4 + i, static_cast<float>(point[i]));
      }
    }
  }
  cloud.width = static_cast<std::uint32_t>(cloud.data.size() / 12);
  cloud.row_step = static_cast<std::uint32_t>(cloud.data.size());
  clouds_[index].publish(cloud);
}

void Observations::publish_sweep(const ab_cloud& sweep) {
  for (std::size_t k = 0; k < sweeps_.size(); ++k) {
    const SweepTopic& topic = spec_->sweeps[k];
    if (topic.lidar != sweep.lidar) continue;
    const ab_lidar& lidar = lidars_[sweep.lidar];
    sensor_msgs::PointCloud2 cloud = empty_cloud({"x", "y", "z", "intensity", "time"});
    cloud.header = header_of(sequence_, sweep.time_s, topic.frame);
    cloud.width = sweep.point_count;
    cloud.row_step = cloud.point_step * cloud.width;
    cloud.data.resize(cloud.row_step);
    std::size_t at = 0;
    for (std::uint32_t i = 0; i < sweep.point_count; ++i) {
      const ab_lidar_point& point = sweep.points[i];
      for (const double number : place_of(point, sweep, lidar, topic.points_in)) {
        put_pixel(cloud.data, at++, static_cast<float>(number));
      }
      put_pixel(cloud.data, at++, point.intensity);
      put_pixel(cloud.data, at++, point.time_s);
    }
    sweeps_[k].publish(cloud);
  }
}

void Observations::publish_picture(const ab_picture& picture, int eye) {
  for (std::size_t k = 0; k < pictures_.size(); ++k) {
    const PictureTopic& topic = spec_->pictures[k];
    if (topic.eye != eye || topic.camera != picture.camera) continue;
    sensor_msgs::Image message;
    message.header = header_of(sequence_, picture.time_s, topic.frame);
    message.width = static_cast<std::uint32_t>(picture.width_px);
    message.height = static_cast<std::uint32_t>(picture.height_px);
    message.encoding = picture.channels == 3 ? "rgb8" : "mono8";
    message.step = picture.channels * message.width;
    message.data.assign(picture.pixels,
                        picture.pixels + std::size_t{message.step} * message.height);
    if (!topic.info_topic.empty()) {
      const double baseline_m = eye == 1 ? cameras_.at(picture.camera).baseline_m : 0.0;
      picture_info_[k].publish(info_of(message.header, picture.width_px, picture.height_px,
                                       picture.fx_px, picture.fy_px, picture.cx_px, picture.cy_px,
                                       baseline_m));
    }
    pictures_[k].publish(message);
  }
}

void Observations::publish_messages(bool are_starting) {
  for (std::size_t k = 0; k < messages_.size(); ++k) {
    Message& message = messages_[k];
    if (message.is_sent || (are_starting && !spec_->messages[k].at_start)) continue;
    message.is_sent = true;
    publish_message(k);
    // From now on at its own times, whenever calls come.
    message.repeat.stop();
    message.repeat.start();
  }
}

void Observations::publish_message(std::size_t index) {
  try {
    messages_[index].publish();
  } catch (const std::runtime_error& error) {
    fail_topic(spec_->messages[index].topic, error.what());
  }
}

void Observations::publish_goals() {
  for (std::size_t k = 0; k < goals_.size(); ++k) {
    const GoalTopic& topic = spec_->goals[k];
    if (now_ns() < goal_due_ns_[k]) continue;
    goal_due_ns_[k] = topic.repeat_s > 0.0 ? now_ns() + nanoseconds_of(topic.repeat_s)
                                           : std::numeric_limits<std::int64_t>::max();
    const double upright[4] = {1.0, 0.0, 0.0, 0.0};
    geometry_msgs::PoseStamped stamped;
    stamped.header =
        header_of(sequence_, 1e-9 * static_cast<double>(now_ns() - kStart_ns), topic.frame);
    double place_world_m[3];
    std::copy(goal_.place_world_m().begin(), goal_.place_world_m().end(), place_world_m);
    stamped.pose = pose_of(place_world_m, upright);
    if (topic.type == GoalType::pose_stamped) {
      goals_[k].publish(stamped);
    } else if (topic.type == GoalType::pose) {
      goals_[k].publish(stamped.pose);
    } else if (topic.type == GoalType::point_stamped) {
      geometry_msgs::PointStamped message;
      message.header = stamped.header;
      message.point = stamped.pose.position;
      goals_[k].publish(message);
    } else {
      nav_msgs::Path message;
      message.header = stamped.header;
      message.poses.push_back(stamped);
      goals_[k].publish(message);
    }
  }
}

}  // namespace ros_shim
