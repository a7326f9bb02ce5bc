#include "plugin/host_buffers.hpp"

#include <cstring>

#include "base/check.hpp"

namespace avoidbench {
namespace {

constexpr int kRubbish = 0xA7;

void copy(const Eigen::Vector3d& from, double (&to)[3]) {
  to[0] = from.x();
  to[1] = from.y();
  to[2] = from.z();
}

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

}  // namespace

HostSide::HostSide() {
  set_size(table_);
  table_.abi_version = AVOIDBENCH_ABI_VERSION;
  table_.context = this;
  table_.set_error = [](void* context, const char* text) {
    static_cast<HostSide*>(context)->error_ = text != nullptr ? text : "";
  };
  table_.log = [](void* context, std::int32_t level, const char* text) {
    const std::string prefix = level == AB_LOG_WARNING ? "warning: " : "";
    static_cast<HostSide*>(context)->log_.push_back(prefix + (text != nullptr ? text : ""));
  };
  table_.get_extension = [](void*, const char*) -> const void* { return nullptr; };
}

std::string HostSide::take_error() {
  std::string taken;
  taken.swap(error_);
  return taken;
}

std::vector<std::string> HostSide::take_log() {
  std::vector<std::string> taken;
  taken.swap(log_);
  return taken;
}

SetupBuffers::SetupBuffers(const PlannerSetup& setup, const std::vector<ParameterValue>& values,
                           bool with_camera) {
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
  setup_.body_radius_m = 0.5 * setup.body_size_m.norm();
  setup_.plan_period_s = setup.plan_period_s;
  setup_.gravity_mps2 = setup.gravity_mps2;
  const CameraSetup& camera = setup.depth_camera;
  if (!with_camera || camera.width_px == 0) return;
  set_size(camera_);
  camera_.width_px = camera.width_px;
  camera_.height_px = camera.height_px;
  camera_.fx_px = camera.fx_px;
  camera_.fy_px = camera.fy_px;
  camera_.cx_px = camera.cx_px;
  camera_.cy_px = camera.cy_px;
  copy(camera.T_body_camera.translation(), camera_.position_body_m);
  copy(Eigen::Quaterniond(camera.T_body_camera.linear()), camera_.q_body_camera);
  camera_.rate_hz = camera.rate_hz;
  camera_.min_range_m = camera.min_range_m;
  camera_.max_range_m = camera.max_range_m;
  setup_.depth_camera = &camera_;
}

void SetupBuffers::poison() {
  fill_with_rubbish(setup_);
  fill_with_rubbish(camera_);
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
  return out;
}

const ab_observation& ObservationBuffers::fill(const PlannerView& view, const CameraSetup& camera,
                                               bool with_depth) {
  state_ = ab_state{};
  set_size(state_);
  state_.time_s = view.time_s;
  copy(view.position_world, state_.position_world_m);
  copy(view.velocity_world, state_.velocity_world_mps);
  copy(view.q_world_body, state_.q_world_body);
  copy(view.rates_body, state_.rates_body_radps);

  images_.clear();
  pointers_.clear();
  if (with_depth) {
    for (const DepthView& seen : view.depth) {
      ab_depth_image image{};
      set_size(image);
      const auto pixel_count =
          static_cast<std::size_t>(camera.width_px) * static_cast<std::size_t>(camera.height_px);
      AB_CHECK(seen.depth_m.size() == pixel_count, seen.depth_m.size(), pixel_count);
      image.width_px = camera.width_px;
      image.height_px = camera.height_px;
      image.time_s = seen.time_s;
      image.fx_px = camera.fx_px;
      image.fy_px = camera.fy_px;
      image.cx_px = camera.cx_px;
      image.cy_px = camera.cy_px;
      copy(seen.T_world_camera.translation(), image.position_world_m);
      copy(Eigen::Quaterniond(seen.T_world_camera.linear()), image.q_world_camera);
      image.depth_m = seen.depth_m.data();
      images_.push_back(image);
    }
    for (const ab_depth_image& image : images_) pointers_.push_back(&image);
  }
  observation_ = ab_observation{};
  set_size(observation_);
  observation_.state = &state_;
  observation_.depth_count = static_cast<std::uint32_t>(pointers_.size());
  observation_.depth = pointers_.data();
  return observation_;
}

void ObservationBuffers::poison() {
  fill_with_rubbish(observation_);
  fill_with_rubbish(state_);
  fill_with_rubbish(images_);
  fill_with_rubbish(pointers_);
}

}  // namespace avoidbench
