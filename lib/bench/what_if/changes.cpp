#include "what_if/changes.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "base/math.hpp"
#include "base/option_error.hpp"
#include "base/words.hpp"
#include "plugin/planner_table.hpp"

namespace avoidbench {
namespace {

/// All kinds of cameras of the rig.
std::vector<CameraSpec*> cameras_of(SensorSpec& sensor) {
  std::vector<CameraSpec*> cameras{&sensor};
  for (CameraSpec& camera : sensor.more_cameras) cameras.push_back(&camera);
  std::erase_if(cameras, [](const CameraSpec* camera) {
    return std::holds_alternative<NoCameraSpec>(camera->method);
  });
  return cameras;
}

bool has_need(const FlownTrial& flown, std::uint32_t bits) { return (flown.needs & bits) != 0; }

std::string change_nothing(const FlownTrial&, ChangedTrial&) { return ""; }

std::string make_depth_true(const FlownTrial& flown, ChangedTrial& trial) {
  if (!has_need(flown, AB_INPUT_DEPTH | AB_INPUT_POINTS)) {
    return "the planner sees neither depth images nor points";
  }
  bool is_changed = false;
  for (CameraSpec* camera : cameras_of(trial.spec.sensor)) {
    is_changed = is_changed || !std::holds_alternative<DepthIdealSpec>(camera->method);
    camera->method = DepthIdealSpec{};
  }
  for (LidarSpec& lidar : trial.spec.sensor.lidars) {
    is_changed = is_changed || lidar.range_sigma_m > 0.0 || lidar.angle_sigma_deg > 0.0 ||
                 lidar.dropout_ratio > 0.0;
    lidar.range_sigma_m = lidar.angle_sigma_deg = lidar.dropout_ratio = 0.0;
  }
  return is_changed ? "" : "its depth is the true one";
}

std::string take_latency(const FlownTrial&, ChangedTrial& trial) {
  LatencySpec& latency = trial.spec.latency;
  const bool is_zero = latency.mode == LatencyMode::zero ||
                       (latency.mode == LatencyMode::fixed && ticks(latency.ms / 1000.0) == 0);
  latency.mode = LatencyMode::zero;
  return is_zero ? "it has no latency" : "";
}

std::string make_state_true(const FlownTrial&, ChangedTrial& trial) {
  OdometrySpec& odometry = trial.spec.odometry;
  if (is_perfect(odometry)) return "its state is the true one";
  odometry = {.rate_hz = odometry.rate_hz};
  return "";
}

bool is_still_air(const WindSpec& wind) {
  const auto is_zero = [](const std::array<double, 3>& v) {
    return std::all_of(v.begin(), v.end(), [](double x) { return x == 0.0; });
  };
  const bool has_kicks =
      wind.kicks.rate_per_min > 0.0 && (wind.kicks.force_n > 0.0 || wind.kicks.torque_nm > 0.0);
  return is_zero(wind.mean_world_mps) && is_zero(wind.force_world_n) &&
         is_zero(wind.torque_body_nm) && is_zero(wind.gust.amplitude_world_mps) &&
         wind.turbulence.model == TurbulenceModel::none && wind.field.file.empty() &&
         is_zero(wind.force_gust.force_world_n) && !has_kicks;
}

std::string take_wind(const FlownTrial&, ChangedTrial& trial) {
  if (is_still_air(trial.spec.wind)) return "the air is still";
  WindSpec still;
  still.seed = trial.spec.wind.seed;
  trial.spec.wind = still;
  return "";
}

std::string track_perfectly(const FlownTrial& flown, ChangedTrial& trial) {
  const std::vector<PlanCall>& calls = flown.record.plan_calls;
  const bool has_rates = std::any_of(calls.begin(), calls.end(), [](const PlanCall& call) {
    return call.status == AB_OK && call.command_kind == AB_COMMAND_RATES;
  });
  trial.flight.tracks_perfectly = true;
  return has_rates ? "body rates are not a reference that can be tracked" : "";
}

/// Calls that take half as long: where latency is measured, that acts sooner; where a clock that
/// goes on by looks is the budget of computing, twice as many looks fit in it.
std::string double_compute(const FlownTrial& flown, ChangedTrial& trial) {
  constexpr double kLeastScale = 0.001;  // of the field
  bool is_changed = false;
  LatencySpec& latency = trial.spec.latency;
  if (latency.mode == LatencyMode::measured && latency.scale > kLeastScale) {
    latency.scale = std::max(0.5 * latency.scale, kLeastScale);
    is_changed = true;
  }
  for (ParameterChoice& choice : trial.spec.planner.parameters) {
    if (choice.name != "compute_clock_us") continue;
    for (const ParameterDef& def : flown.planner.parameters) {
      if (def.name != choice.name) continue;
      const double halved = std::max(0.5 * choice.number, def.lowest);
      is_changed = is_changed || halved < choice.number;
      choice.number = halved;
    }
  }
  return is_changed ? "" : "its latency is not measured, and its budget is not a clock";
}

/// Whether the parameter says how fast the planner is to fly.
bool is_speed(const ParameterDef& parameter) {
  return parameter.kind == AB_NUMBER && parameter.unit == "m/s" &&
         parameter.name.find("speed") != std::string::npos;
}

std::string fly_slower(const FlownTrial& flown, ChangedTrial& trial) {
  constexpr double kLeastLimit_mps = 0.1, kLongest_s = 3600.0;  // of the fields
  VehicleSpec& vehicle = trial.spec.vehicle;
  const double limit_mps = vehicle.max_speed_mps;
  vehicle.max_speed_mps = std::max(0.5 * limit_mps, kLeastLimit_mps);
  for (ParameterChoice& choice : trial.spec.planner.parameters) {
    for (const ParameterDef& def : flown.planner.parameters) {
      if (def.name != choice.name || !is_speed(def)) continue;
      // Half of what was flown by: of a parameter beyond the limit, that was the limit.
      choice.number = std::max(0.5 * std::min(choice.number, limit_mps), def.lowest);
    }
  }
  double& time_limit_s = trial.spec.mission.time_limit_s;
  time_limit_s = std::min(2.0 * time_limit_s, kLongest_s);
  return vehicle.max_speed_mps < limit_mps ? "" : "it already has the lowest speed limit";
}

std::string widen_view(const FlownTrial& flown, ChangedTrial& trial) {
  if (!sees_images(flown.needs)) return "the planner sees no images";
  if (cameras_of(trial.spec.sensor).empty()) return "the sensor has no camera";
  constexpr double kWidest_deg = 170.0;  // of the field
  constexpr std::int64_t kMost_px = 4096;
  for (CameraSpec* camera : cameras_of(trial.spec.sensor)) {
    const double half_rad = 0.5 * camera->fov_x_deg * math::kPi / 180.0;
    // At the same focal length: a pixel stays as sharp, and disparities stay what they are.
    const double wide_rad = math::atan2(2.0 * math::tan(half_rad), 1.0);
    camera->fov_x_deg = 2.0 * wide_rad * 180.0 / math::kPi;
    camera->width_px *= 2;
    if (camera->fov_x_deg > kWidest_deg || camera->width_px > kMost_px) {
      return "a camera of twice the width is too large for a sensor";
    }
  }
  return "";
}

std::string lengthen_range(const FlownTrial& flown, ChangedTrial& trial) {
  if (!has_need(flown, AB_INPUT_DEPTH | AB_INPUT_POINTS)) {
    return "the planner sees neither depth images nor points";
  }
  constexpr double kFarthest_m = 1000.0;  // of the field
  bool is_changed = false;
  for (CameraSpec* camera : cameras_of(trial.spec.sensor)) {
    const double range_m = camera->max_range_m;
    camera->max_range_m = std::min(2.0 * range_m, kFarthest_m);
    is_changed = is_changed || camera->max_range_m > range_m;
  }
  for (LidarSpec& lidar : trial.spec.sensor.lidars) {
    const double range_m = lidar.max_range_m;
    lidar.max_range_m = std::min(2.0 * range_m, kFarthest_m);
    lidar.range_at_10_percent_m = std::min(2.0 * lidar.range_at_10_percent_m, kFarthest_m);
    is_changed = is_changed || lidar.max_range_m > range_m;
  }
  return is_changed ? "" : "it already has the longest range";
}

std::string hold_obstacles(const FlownTrial& flown, ChangedTrial& trial) {
  const auto* hall = std::get_if<HallSpec>(&trial.spec.map);  // the only map in which things move
  const bool has_motions = hall != nullptr && hall->moving_ratio > 0.0;
  if (!has_motions && !has_movers(trial.spec.movers)) return "nothing moves on its map";
  if (std::isnan(flown.record.end_time_s)) return "it is not known when its flight ended";
  trial.flight.still_at_s = flown.record.end_time_s;
  return "";
}

constexpr Change kChanges[] = {
    {kNoChange, "with nothing changed", "Fly it as it was: the flight must be the same bit for bit",
     change_nothing},
    {"true_depth", "with true depth",
     "Depth images are the true depth, of the same cameras at the same times", make_depth_true},
    {"no_latency", "without latency",
     "Commands act at the time of the observation that they answer", take_latency},
    {"true_state", "with the true state",
     "Odometry without noise, drift and delay, for the planner and the vehicle's controller",
     make_state_true},
    {"no_wind", "without wind", "No wind, gusts, turbulence, forces and kicks", take_wind},
    {"perfect_tracking", "with perfect tracking",
     "The vehicle is exactly where its reference is; not for planners that command body rates",
     track_perfectly},
    {"twice_compute", "with twice the compute",
     "Measured latencies are half as long; a planner's compute_clock_us is half of what it was",
     double_compute},
    {"slower", "at half the speed",
     "Half the speed limit, half of the planner's own parameters of speed, twice the time limit",
     fly_slower},
    {"wider_view", "with a view twice as wide",
     "Images of twice the width at the same focal length (90° become 127°)", widen_view},
    {"longer_range", "with twice the range", "Depth up to twice the distance", lengthen_range},
    {"still_obstacles", "with obstacles that stand still",
     "Moving obstacles stand all the time where they were when the flight ended", hold_obstacles},
};

}  // namespace

std::span<const Change> changes() { return kChanges; }

std::vector<const Change*> changes_of(const std::vector<std::string>& names) {
  std::vector<std::string> known{"all"};
  for (const Change& change : kChanges) known.emplace_back(change.name);
  for (const std::string& name : names) {
    if (std::find(known.begin(), known.end(), name) != known.end()) continue;
    throw OptionError(
        "no change '" + name + "'" + did_you_mean(name, known) + "; there are: " + joined(known),
        "what-if");
  }
  std::vector<const Change*> chosen;
  const bool has_all = std::find(names.begin(), names.end(), "all") != names.end();
  for (const Change& change : kChanges) {
    const bool is_named = std::find(names.begin(), names.end(), change.name) != names.end();
    if (is_named || (has_all && change.name != kNoChange)) chosen.push_back(&change);
  }
  return chosen;
}

}  // namespace avoidbench
