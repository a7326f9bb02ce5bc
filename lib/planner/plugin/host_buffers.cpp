#include "plugin/host_buffers.hpp"

#include <cstring>
#include <span>
#include <string_view>
#include <utility>

#include "base/check.hpp"
#include "base/utf8.hpp"
#include "plugin/planner_table.hpp"

namespace avoidbench {
namespace {

// Eight of these bytes are no address of x86-64: who follows such a pointer crashes at once.
constexpr int kRubbish = 0xA7;

void copy(const Eigen::Vector3d& from, double (&to)[3]) {
  to[0] = from.x();
  to[1] = from.y();
  to[2] = from.z();
}

/// w first, as planner.h has it; Eigen keeps it last.
void copy(const Eigen::Quaterniond& from, double (&to)[4]) {
  to[0] = from.w();
  to[1] = from.x();
  to[2] = from.y();
  to[3] = from.z();
}

template <class Struct>
void fill_with_rubbish(Struct& value) {
  std::memset(&value, kRubbish, sizeof(Struct));
}

template <class Struct>
void fill_with_rubbish(std::vector<Struct>& values) {
  // NOLINTNEXTLINE(bugprone-sizeof-expression): some of the vectors hold pointers
  if (!values.empty()) std::memset(values.data(), kRubbish, values.size() * sizeof(Struct));
}

template <class Struct>
void set_size(Struct& value) {
  value.struct_size = static_cast<std::uint32_t>(sizeof(Struct));
}

/// Adds the addresses of all elements, which must not move from now on.
template <class Struct>
void point_to(const std::vector<Struct>& values, std::vector<const Struct*>& pointers) {
  pointers.clear();
  for (const Struct& value : values) pointers.push_back(&value);
}

/// The fields that depth images and pictures share.
template <class Image>
Image image_of(const CameraSetup& camera, double time_s, const Eigen::Isometry3d& T_world_camera,
               std::uint32_t index) {
  Image image{};
  set_size(image);
  image.width_px = camera.width_px;
  image.height_px = camera.height_px;
  image.camera = index;
  image.time_s = time_s;
  image.fx_px = camera.fx_px;
  image.fy_px = camera.fy_px;
  image.cx_px = camera.cx_px;
  image.cy_px = camera.cy_px;
  copy(T_world_camera.translation(), image.position_world_m);
  copy(Eigen::Quaterniond(T_world_camera.linear()), image.q_world_camera);
  return image;
}

template <class Pixel>
void check_size(std::span<const Pixel> pixels, const CameraSetup& camera, std::size_t channels) {
  const std::size_t expected = static_cast<std::size_t>(camera.width_px) *
                               static_cast<std::size_t>(camera.height_px) * channels;
  AB_CHECK(pixels.size() == expected, pixels.size(), expected);
}

ab_state to_state(const StateView& view) {
  ab_state out{};
  set_size(out);
  out.time_s = view.time_s;
  copy(view.position_world, out.position_world_m);
  copy(view.velocity_world, out.velocity_world_mps);
  copy(view.q_world_body, out.q_world_body);
  copy(view.rates_body, out.rates_body_radps);
  return out;
}

ab_point to_point(const ReferenceView& view, double time_s) {
  ab_point out{};
  out.time_s = time_s;
  copy(view.position_world, out.position_world_m);
  copy(view.velocity_world, out.velocity_world_mps);
  copy(view.acceleration_world, out.acceleration_world_mps2);
  copy(view.jerk_world, out.jerk_world_mps3);
  out.yaw_rad = view.yaw_rad;
  out.yaw_rate_radps = view.yaw_rate_radps;
  return out;
}

ab_lidar to_lidar(const LidarSetup& lidar) {
  ab_lidar out{};
  set_size(out);
  out.is_deskewed = lidar.is_deskewed ? 1 : 0;
  copy(lidar.T_body_lidar.translation(), out.position_body_m);
  copy(Eigen::Quaterniond(lidar.T_body_lidar.linear()), out.q_body_lidar);
  out.rate_hz = lidar.rate_hz;
  out.min_range_m = lidar.min_range_m;
  out.max_range_m = lidar.max_range_m;
  out.lowest_elevation_rad = lidar.lowest_elevation_rad;
  out.highest_elevation_rad = lidar.highest_elevation_rad;
  out.shots = lidar.shots;
  return out;
}

ab_track to_track(const TrackView& view) {
  ab_track out{};
  out.id = view.id;
  out.kind = view.kind;
  out.time_s = view.time_s;
  copy(view.center_world, out.center_world_m);
  copy(view.velocity_world, out.velocity_world_mps);
  copy(view.size_m, out.size_m);
  return out;
}

ab_camera to_camera(const CameraSetup& camera) {
  ab_camera out{};
  set_size(out);
  out.width_px = camera.width_px;
  out.height_px = camera.height_px;
  out.fx_px = camera.fx_px;
  out.fy_px = camera.fy_px;
  out.cx_px = camera.cx_px;
  out.cy_px = camera.cy_px;
  copy(camera.T_body_camera.translation(), out.position_body_m);
  copy(Eigen::Quaterniond(camera.T_body_camera.linear()), out.q_body_camera);
  out.rate_hz = camera.rate_hz;
  out.min_range_m = camera.min_range_m;
  out.max_range_m = camera.max_range_m;
  out.baseline_m = camera.baseline_m;
  return out;
}

}  // namespace

HostSide::HostSide(bool has_debug, std::uint32_t needs)
    : has_debug_(has_debug), world_((needs & AB_INPUT_WORLD) != 0) {
  // Planners keep the table's address and hand back the context: this object never moves.
  set_size(table_);
  table_.abi_version = AVOIDBENCH_ABI_VERSION;
  table_.context = this;
  table_.set_error = [](void* context, const char* text) {
    static_cast<HostSide*>(context)->error_ =
        shortened(text != nullptr ? text : "", kMostTextBytes);
  };
  table_.log = [](void* context, std::int32_t level, const char* text) {
    // A level that is not known is taken for information.
    const std::string prefix = level == AB_LOG_WARNING ? "warning: " : "";
    static_cast<HostSide*>(context)->add_to_log(
        prefix + shortened(text != nullptr ? text : "", kMostTextBytes));
  };
  table_.get_extension = [](void* context, const char* id) -> const void* {
    const HostSide& self = *static_cast<HostSide*>(context);
    const std::string_view name = id != nullptr ? id : "";
    if (name == AB_WORLD_EXTENSION) return self.world_.table();
    return name == AB_DEBUG_EXTENSION && self.has_debug_ ? &self.board_.table() : nullptr;
  };
}

void HostSide::add_to_log(std::string line) {
  // What nobody takes during a sweep must not fill the memory.
  constexpr std::size_t kMostBytes = std::size_t{1} << 20U, kOfALine = 64;
  const std::lock_guard lock(log_mutex_);
  const bool had_room = log_bytes_ < kMostBytes;
  log_bytes_ += line.size() + kOfALine;
  if (log_bytes_ < kMostBytes) {
    log_.push_back(std::move(line));
  } else if (had_room) {
    log_.emplace_back("warning: further lines of the log are left out: it is longer than a MiB");
  }
}

std::string HostSide::take_error() {
  std::string taken;
  taken.swap(error_);
  return taken;
}

std::vector<std::string> HostSide::take_log() {
  const std::lock_guard lock(log_mutex_);
  std::vector<std::string> taken;
  taken.swap(log_);
  log_bytes_ = 0;
  return taken;
}

std::vector<Drawing> HostSide::take_drawings() {
  if (board_.is_full()) {
    add_to_log("warning: drawings beyond " + std::to_string(kMostDrawnPoints) +
               " points in one call are left out");
  }
  return board_.take();
}

SetupBuffers::SetupBuffers(const PlannerSetup& setup, const std::vector<ParameterValue>& values,
                           std::uint32_t needs) {
  // All texts before the first value: strings move when the vector grows.
  for (const ParameterValue& value : values) texts_.push_back(value.text);
  for (std::size_t i = 0; i < values.size(); ++i) {
    ab_value value{};
    set_size(value);
    value.number = values[i].number;
    value.text = texts_[i].c_str();
    values_.push_back(value);
  }
  for (const ab_value& value : values_) pointers_.push_back(&value);

  set_size(setup_);
  setup_.value_count = static_cast<std::uint32_t>(pointers_.size());
  setup_.values = pointers_.data();
  setup_.max_speed_mps = setup.max_speed_mps;
  setup_.max_acceleration_mps2 = setup.max_acceleration_mps2;
  setup_.max_yaw_rate_radps = setup.max_yaw_rate_radps;
  copy(setup.body_size_m, setup_.body_size_m);
  // Of the ball around the body, however it is turned: larger than the reference path's, which is
  // inside the outline.
  setup_.body_radius_m = 0.5 * setup.body_size_m.norm();
  setup_.plan_period_s = setup.plan_period_s;
  setup_.gravity_mps2 = setup.gravity_mps2;
  // Who declares no eyes gets no camera, so that no result depends on what was not declared.
  if ((needs & AB_INPUT_POINTS) != 0) {
    for (const LidarSetup& lidar : setup.lidars) lidars_.push_back(to_lidar(lidar));
  }
  point_to(lidars_, lidar_pointers_);
  setup_.lidar_count = static_cast<std::uint32_t>(lidar_pointers_.size());
  setup_.lidars = lidar_pointers_.data();
  if (!sees_images(needs)) return;
  for (const CameraSetup& camera : setup.cameras) cameras_.push_back(to_camera(camera));
  point_to(cameras_, camera_pointers_);
  setup_.depth_camera = camera_pointers_.empty() ? nullptr : camera_pointers_.front();
  setup_.camera_count = static_cast<std::uint32_t>(camera_pointers_.size());
  setup_.cameras = camera_pointers_.data();
}

// After a call, in the conformance suite: a planner that kept a pointer reads rubbish and answers
// otherwise than the one whose inputs stayed.
void SetupBuffers::poison() {
  fill_with_rubbish(setup_);
  fill_with_rubbish(cameras_);
  fill_with_rubbish(camera_pointers_);
  fill_with_rubbish(lidars_);
  fill_with_rubbish(lidar_pointers_);
  fill_with_rubbish(values_);
  fill_with_rubbish(pointers_);
  for (std::string& text : texts_) std::fill(text.begin(), text.end(), '#');
}

ab_mission to_mission(const PlannerMission& mission) {
  ab_mission out{};
  set_size(out);
  out.seed = mission.seed;
  copy(mission.start_world, out.start_world_m);
  out.start_yaw_rad = mission.start_yaw_rad;
  copy(mission.goal_world, out.goal_world_m);
  out.goal_radius_m = mission.goal_radius_m;
  out.time_limit_s = mission.time_limit_s;
  copy(mission.lowest_world, out.lowest_world_m);
  copy(mission.highest_world, out.highest_world_m);
  out.command_latency_s = mission.command_latency_s;
  const std::vector<Eigen::Vector3d>& goals = mission.goals_world;
  out.goal_count = goals.empty() ? 1 : static_cast<std::uint32_t>(goals.size());
  // Eigen's vectors are three doubles each and nothing else.
  out.goals_world_m = (goals.empty() ? mission.goal_world : goals.front()).data();
  return out;
}

const ab_observation& ObservationBuffers::fill(const PlannerView& view,
                                               const std::vector<CameraSetup>& cameras,
                                               std::uint32_t needs, const GoalView& goal,
                                               const PlanResult* wanted) {
  // Memory of the last call is used again: none is allocated at each of them.
  state_ = to_state(view);
  observation_ = ab_observation{};
  set_size(observation_);
  observation_.state = &state_;
  observation_.time_s = view.call_time_s;
  images_.clear();
  if ((needs & AB_INPUT_DEPTH) != 0) {
    for (const DepthView& seen : view.depth) {
      const CameraSetup& camera = cameras[seen.camera];
      check_size(seen.depth_m, camera, 1);
      images_.push_back(
          image_of<ab_depth_image>(camera, seen.time_s, seen.T_world_camera, seen.camera));
      images_.back().depth_m = seen.depth_m.data();
    }
  }
  point_to(images_, pointers_);
  observation_.depth_count = static_cast<std::uint32_t>(pointers_.size());
  observation_.depth = pointers_.data();
  fill_stereo((needs & AB_INPUT_STEREO) != 0 ? view.stereo : std::vector<StereoView>{}, cameras);
  fill_color((needs & AB_INPUT_COLOR) != 0 ? view.color : std::vector<ColorView>{}, cameras);
  fill_imu((needs & AB_INPUT_IMU) != 0 ? view.imu : std::vector<ImuView>{});
  states_.clear();
  if ((needs & AB_INPUT_STATES) != 0) {
    for (const StateView& seen : view.states) states_.push_back(to_state(seen));
  }
  point_to(states_, state_pointers_);
  observation_.state_count = static_cast<std::uint32_t>(states_.size());
  observation_.states = state_pointers_.data();
  if ((needs & AB_INPUT_REFERENCE) != 0 && view.reference) {
    reference_ = to_point(*view.reference, view.call_time_s);
    observation_.reference = &reference_;
  }
  fill_clouds((needs & AB_INPUT_POINTS) != 0 ? view.clouds : std::vector<CloudView>{});
  if ((needs & AB_INPUT_GOALS) != 0) {
    const GoalView& shown = view.goal ? *view.goal : goal;
    observation_.goal_index = shown.index;
    copy(shown.place_world, observation_.goal_world_m);
  }
  tracks_.clear();
  if ((needs & AB_INPUT_TRACKS) != 0) {
    for (const TrackView& seen : view.tracks) tracks_.push_back(to_track(seen));
  }
  observation_.track_count = static_cast<std::uint32_t>(tracks_.size());
  observation_.tracks = tracks_.data();
  fill_wanted((needs & AB_INPUT_COMMAND) != 0 ? wanted : nullptr);
  return observation_;
}

/// A copy, which stays until the next call: a filter that returns it returns its points, too.
void ObservationBuffers::fill_wanted(const PlanResult* wanted) {
  wanted_points_.clear();
  if (wanted == nullptr || wanted->status != PlanStatus::command) return;
  wanted_ = wanted->command;
  wanted_points_ = wanted->points;
  set_size(wanted_);
  wanted_.point_count = static_cast<std::uint32_t>(wanted_points_.size());
  wanted_.points = wanted_points_.empty() ? nullptr : wanted_points_.data();
  observation_.wanted = &wanted_;
}

void ObservationBuffers::fill_stereo(const std::vector<StereoView>& seen,
                                     const std::vector<CameraSetup>& cameras) {
  eyes_.clear();
  pairs_.clear();
  for (const StereoView& view : seen) {
    const CameraSetup& camera = cameras[view.camera];
    const Eigen::Isometry3d T_world_right =
        view.T_world_camera * Eigen::Translation3d(camera.baseline_m, 0.0, 0.0);
    // planner.h: the right eye is the same camera, baseline_m further along camera x.
    for (const bool is_left : {true, false}) {
      const std::span<const std::uint8_t> pixels = is_left ? view.left : view.right;
      check_size(pixels, camera, 1);
      eyes_.push_back(image_of<ab_picture>(
          camera, view.time_s, is_left ? view.T_world_camera : T_world_right, view.camera));
      eyes_.back().channels = 1;
      eyes_.back().pixels = pixels.data();
    }
  }
  // Only now, when eyes_ moves no more.
  for (std::size_t i = 0; i < seen.size(); ++i) {
    ab_stereo_pair pair{};
    set_size(pair);
    pair.baseline_m = cameras[seen[i].camera].baseline_m;
    pair.left = &eyes_[2 * i];
    pair.right = &eyes_[2 * i + 1];
    pairs_.push_back(pair);
  }
  point_to(pairs_, pair_pointers_);
  observation_.stereo_count = static_cast<std::uint32_t>(pairs_.size());
  observation_.stereo = pair_pointers_.data();
}

void ObservationBuffers::fill_color(const std::vector<ColorView>& seen,
                                    const std::vector<CameraSetup>& cameras) {
  colors_.clear();
  for (const ColorView& view : seen) {
    const CameraSetup& camera = cameras[view.camera];
    check_size(view.rgb, camera, 3);
    colors_.push_back(image_of<ab_picture>(camera, view.time_s, view.T_world_camera, view.camera));
    colors_.back().channels = 3;
    colors_.back().pixels = view.rgb.data();
  }
  point_to(colors_, color_pointers_);
  observation_.color_count = static_cast<std::uint32_t>(colors_.size());
  observation_.color = color_pointers_.data();
}

void ObservationBuffers::fill_imu(const std::vector<ImuView>& seen) {
  imu_.clear();
  // Samples lie one after the other, not behind pointers: their struct never grows in ABI 1.
  for (const ImuView& view : seen) {
    ab_imu_sample sample{};
    sample.time_s = view.time_s;
    copy(view.rates_body, sample.rates_body_radps);
    copy(view.specific_force_body_mps2, sample.specific_force_body_mps2);
    imu_.push_back(sample);
  }
  observation_.imu_count = static_cast<std::uint32_t>(imu_.size());
  observation_.imu = imu_.data();
}

void ObservationBuffers::fill_clouds(const std::vector<CloudView>& seen) {
  static_assert(sizeof(Eigen::Vector3f) == 3 * sizeof(float), "misses lie one after the other");
  clouds_.clear();
  for (const CloudView& view : seen) {
    ab_cloud cloud{};
    set_size(cloud);
    cloud.lidar = view.lidar;
    cloud.time_s = view.time_s;
    copy(view.T_world_lidar.translation(), cloud.position_world_m);
    copy(Eigen::Quaterniond(view.T_world_lidar.linear()), cloud.q_world_lidar);
    cloud.point_count = static_cast<std::uint32_t>(view.points.size());
    cloud.miss_count = static_cast<std::uint32_t>(view.misses_lidar.size());
    cloud.points = view.points.data();
    cloud.misses_lidar = view.misses_lidar.empty() ? nullptr : view.misses_lidar.front().data();
    clouds_.push_back(cloud);
  }
  point_to(clouds_, cloud_pointers_);
  observation_.cloud_count = static_cast<std::uint32_t>(clouds_.size());
  observation_.clouds = cloud_pointers_.data();
}

void ObservationBuffers::poison() {
  fill_with_rubbish(observation_);
  fill_with_rubbish(state_);
  fill_with_rubbish(reference_);
  fill_with_rubbish(images_);
  fill_with_rubbish(pointers_);
  fill_with_rubbish(eyes_);
  fill_with_rubbish(pairs_);
  fill_with_rubbish(pair_pointers_);
  fill_with_rubbish(colors_);
  fill_with_rubbish(color_pointers_);
  fill_with_rubbish(imu_);
  fill_with_rubbish(states_);
  fill_with_rubbish(tracks_);
  fill_with_rubbish(state_pointers_);
  fill_with_rubbish(clouds_);
  fill_with_rubbish(cloud_pointers_);
  fill_with_rubbish(wanted_);
  fill_with_rubbish(wanted_points_);
}

}  // namespace avoidbench
