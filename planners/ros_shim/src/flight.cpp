#include "flight.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <exception>
#include <new>
#include <stdexcept>

namespace ros_shim {
namespace {

Given given_of(const ab_setup& setup, const ab_mission& mission) {
  Given given;
  given.vehicle_max_speed_mps = setup.max_speed_mps;
  given.vehicle_max_acceleration_mps2 = setup.max_acceleration_mps2;
  given.vehicle_max_yaw_rate_radps = setup.max_yaw_rate_radps;
  given.gravity_mps2 = setup.gravity_mps2;
  given.plan_period_s = setup.plan_period_s;
  given.body_length_m = setup.body_size_m[0];
  given.body_width_m = setup.body_size_m[1];
  given.body_height_m = setup.body_size_m[2];
  given.body_radius_m = setup.body_radius_m;
  if (const ab_camera* camera = setup.depth_camera) {
    given.width_px = camera->width_px;
    given.height_px = camera->height_px;
    given.fx_px = camera->fx_px;
    given.fy_px = camera->fy_px;
    given.cx_px = camera->cx_px;
    given.cy_px = camera->cy_px;
    given.camera_rate_hz = camera->rate_hz;
    given.min_range_m = camera->min_range_m;
    given.max_range_m = camera->max_range_m;
    given.baseline_m = camera->baseline_m;
    given.camera_x_m = camera->position_body_m[0];
    given.camera_y_m = camera->position_body_m[1];
    given.camera_z_m = camera->position_body_m[2];
  }
  // Hosts of before these were there say nothing of lidars.
  if (setup.struct_size >= sizeof(ab_setup) && setup.lidar_count > 0) {
    const ab_lidar& lidar = *setup.lidars[0];
    given.lidar_rate_hz = lidar.rate_hz;
    given.lidar_min_range_m = lidar.min_range_m;
    given.lidar_max_range_m = lidar.max_range_m;
    given.lidar_x_m = lidar.position_body_m[0];
    given.lidar_y_m = lidar.position_body_m[1];
    given.lidar_z_m = lidar.position_body_m[2];
  }
  given.start_x_m = mission.start_world_m[0];
  given.start_y_m = mission.start_world_m[1];
  given.start_z_m = mission.start_world_m[2];
  given.start_yaw_rad = mission.start_yaw_rad;
  given.goal_x_m = mission.goal_world_m[0];
  given.goal_y_m = mission.goal_world_m[1];
  given.goal_z_m = mission.goal_world_m[2];
  given.goal_radius_m = mission.goal_radius_m;
  // Hosts of before these were there say nothing of them.
  if (mission.struct_size >= sizeof(ab_mission)) {
    given.lowest_x_m = mission.lowest_world_m[0];
    given.lowest_y_m = mission.lowest_world_m[1];
    given.lowest_z_m = mission.lowest_world_m[2];
    given.highest_x_m = mission.highest_world_m[0];
    given.highest_y_m = mission.highest_world_m[1];
    given.highest_z_m = mission.highest_world_m[2];
    given.command_latency_s = mission.command_latency_s;
  }
  given.time_limit_s = mission.time_limit_s;
  given.seed = static_cast<double>(mission.seed % 2147483648U);  // as a ROS integer
  for (std::uint32_t i = 0; i < setup.value_count; ++i) {
    given.numbers.push_back(setup.values[i]->number);
    given.texts.emplace_back(setup.values[i]->text != nullptr ? setup.values[i]->text : "");
  }
  return given;
}

/// The vehicle's limit, or a lower one that a parameter of the planner sets.
double max_speed_mps(const ab_setup& setup, const Given& given) {
  double limit_mps = setup.max_speed_mps;
  for (std::uint32_t i = 0; i < planner_table.parameter_count; ++i) {
    if (std::strcmp(planner_table.parameters[i]->name, "max_speed_mps") != 0) continue;
    limit_mps = std::min(limit_mps, given.numbers[i]);
  }
  return limit_mps;
}

void require_finite(const double (&values)[3], const char* what) {
  for (const double value : values) {
    if (!std::isfinite(value)) throw std::runtime_error(std::string(what) + " is not finite");
  }
}

const char* word_of(Level level) {
  switch (level) {
    case Level::error:
      return "error: ";
    case Level::fatal:
      return "fatal: ";
    default:
      return "";
  }
}

template <class Call>
ab_status guarded(const ab_host* host, Call&& call) noexcept {
  try {
    return call();
  } catch (const std::exception& error) {
    host->set_error(host->context, error.what());
  } catch (...) {
    host->set_error(host->context, "an exception that is no std::exception");
  }
  return AB_ERROR;
}

/// A flight with the host it tells of errors.
struct Guarded {
  const ab_host* host;
  std::unique_ptr<Flight> flight;
};

void* begin(const ab_host* host, const ab_setup* setup, const ab_mission* mission) {
  auto guarded_flight = std::make_unique<Guarded>();
  guarded_flight->host = host;
  const ab_status status = guarded(host, [&]() -> ab_status {
    guarded_flight->flight = std::make_unique<Flight>(*host, *setup, *mission);
    return AB_OK;
  });
  return status == AB_OK ? guarded_flight.release() : nullptr;
}

ab_status plan(void* flight, const ab_observation* seen, ab_command* command) {
  Guarded& self = *static_cast<Guarded*>(flight);
  return guarded(self.host, [&]() -> ab_status {
    const std::optional<ab_command> planned = self.flight->plan(*seen);
    if (!planned) return AB_NO_PLAN;
    const std::uint32_t room = command->struct_size;
    std::memcpy(command, &*planned, std::min<std::size_t>(room, sizeof(ab_command)));
    command->struct_size = room;
    return AB_OK;
  });
}

void end(void* flight) {
  Guarded* self = static_cast<Guarded*>(flight);
  guarded(self->host, [&]() -> ab_status {
    self->flight.reset();
    return AB_OK;
  });
  delete self;
}

constexpr CopyTable kCopyTable{&begin, &plan, &end};

}  // namespace

Flight::Flight(const ab_host& host, const ab_setup& setup, const ab_mission& of_host)
    : spec_(planner_spec()) {
  require_finite(of_host.start_world_m, "the mission's start");
  require_finite(of_host.goal_world_m, "the mission's goal");
  if (spec_.world != nullptr) {
    const std::array<double, 4> lies = spec_.world(given_of(setup, of_host));
    for (const double number : lies) {
      if (!std::isfinite(number)) throw std::runtime_error("world: a number that is not finite");
    }
    world_.emplace(std::array<double, 3>{lies[0], lies[1], lies[2]}, lies[3]);
  }
  const ab_mission turned = world_ ? world_->of(of_host) : ab_mission{};
  const ab_mission& mission = world_ ? turned : of_host;
  const Given given = given_of(setup, mission);
  const std::int64_t lead_ns = nanoseconds_of(spec_.lead_s);
  auto fresh = std::make_unique<Core>();
  fresh->now_ns = kStart_ns - lead_ns;
  set_core(std::move(fresh), nanoseconds_of(1e-6 * given.numbers.at(spec_.compute_clock)),
           mission.seed);
  Core& core = ros_shim::core();
  const ab_host* const to = &host;
  core.write_log = [to](Level level, const std::string& text) {
    const bool is_bad = level != Level::info;
    to->log(to->context, is_bad ? AB_LOG_WARNING : AB_LOG_INFO, (word_of(level) + text).c_str());
  };
  for (const auto& [package, folder] : spec_.packages) core.packages[package] = folder;
  try {
    observations_ = std::make_unique<Observations>(spec_, setup, mission, given);
    commands_ =
        std::make_unique<Commands>(spec_.command, setup, mission, max_speed_mps(setup, given));
    ros::NodeHandle node;
    command_ = spec_.subscribe(node, spec_.command,
                               [this](SetPoints points) { commands_->take(std::move(points)); });
    for (const NodeSpec& one : spec_.nodes) add_node(one);
    spec_.set_parameters(given);
    // Until the trial begins the nodes start; the vehicle hovers and tells so.
    const std::int64_t period_ns =
        std::max<std::int64_t>(1000000, nanoseconds_of(setup.plan_period_s));
    for (std::int64_t at_ns = core.now_ns; at_ns < kStart_ns; at_ns += period_ns) {
      advance(at_ns);
      observations_->publish_start();
    }
  } catch (...) {
    command_.shutdown();
    observations_.reset();
    end_nodes();
    set_core(nullptr);
    throw;
  }
}

Flight::~Flight() {
  enter_nodes();
  command_.shutdown();
  observations_.reset();
  end_nodes();
  set_core(nullptr);
}

std::optional<ab_command> Flight::plan(const ab_observation& of_host) {
  require_finite(of_host.state->position_world_m, "the position");
  require_finite(of_host.state->velocity_world_mps, "the velocity");
  const ab_observation& seen = world_ ? world_->of(of_host) : of_host;
  const ab_state& state = *seen.state;
  // A delayed state is not the present. Hosts of before they said the time: the state's.
  const bool has_time = seen.struct_size >= offsetof(ab_observation, state_count);
  const double call_s = has_time ? seen.time_s : state.time_s;
  const std::int64_t to_ns = std::max(enter_nodes().now_ns, ros_time_ns(call_s));
  observations_->publish(seen, to_ns);
  advance(to_ns);
  const std::optional<ab_command> command = commands_->answer(to_ns, state);
  return command && world_ ? world_->back(*command) : command;
}

}  // namespace ros_shim

/// For the loader: the library is opened once more for each trial, and this is of that copy.
extern "C" __attribute__((visibility("default"))) const ros_shim::CopyTable* ros_shim_copy_v1() {
  return &ros_shim::kCopyTable;
}
