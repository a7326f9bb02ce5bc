#include "trial/contradictions.hpp"

#include <cmath>

#include "base/input_error.hpp"
#include "base/number_text.hpp"
#include "base/spec_json.hpp"
#include "base/ticks.hpp"
#include "vehicle/capability.hpp"

namespace avoidbench {
namespace {

using Found = std::vector<Contradiction>;

void check_not_faster(const std::string& path, double rate_hz, double physics_hz, Found& found) {
  if (rate_hz <= physics_hz) return;
  found.push_back(
      {path, shortest(rate_hz) + " Hz is faster than rates.physics_hz, " + shortest(physics_hz)});
}

/// The problems of an InputError whose messages begin with "field: ", as fields of `block`.
void add_fields(const std::string& block, const InputError& error, Found& found) {
  for (const InputProblem& problem : error.problems()) {
    const std::size_t colon = problem.message.find(": ");
    const bool has_field = colon != std::string::npos;
    found.push_back({has_field ? block + "." + problem.message.substr(0, colon) : block,
                     has_field ? problem.message.substr(colon + 2) : problem.message});
  }
}

/// `path`: "sensor", or that of one of its more_cameras.
void check_matcher(const std::string& path, const CameraSpec& sensor, Found& found) {
  // Both matchers take multiples of 16.
  const auto check_disparities = [&](std::int64_t disparities) {
    if (disparities % 16 != 0) {
      found.push_back({path + ".disparities", std::to_string(disparities) +
                                                  " is not a multiple of 16; the next is " +
                                                  std::to_string((disparities / 16 + 1) * 16)});
    }
    if (disparities >= sensor.width_px) {
      found.push_back({path + ".disparities", std::to_string(disparities) +
                                                  " is not below width_px, " +
                                                  std::to_string(sensor.width_px)});
    }
  };
  if (const auto* sgm = std::get_if<StereoSgbmSpec>(&sensor.method)) {
    check_disparities(sgm->disparities);
    if (sgm->block_px % 2 == 0) {
      found.push_back({path + ".block_px", std::to_string(sgm->block_px) + " is not odd"});
    }
    // OpenCV's matcher asks for P2 > P1; the paper (Hirschmüller 2008) and census allow P2 = P1.
    if (sgm->p1_factor >= sgm->p2_factor) {
      found.push_back({path + ".p1_factor", shortest(sgm->p1_factor) + " is not below p2_factor, " +
                                                shortest(sgm->p2_factor)});
    }
  }
  if (const auto* census = std::get_if<StereoSgmSpec>(&sensor.method)) {
    check_disparities(census->disparities);
    if (census->paths != 4 && census->paths != 8) {
      found.push_back({path + ".paths", std::to_string(census->paths) + " is neither 4 nor 8"});
    }
    if (census->p1 > census->p2) {
      found.push_back({path + ".p1",
                       std::to_string(census->p1) + " is above p2, " + std::to_string(census->p2)});
    }
  }
}

void check_camera(const std::string& path, const CameraSpec& sensor, Found& found) {
  if (!(sensor.min_range_m < sensor.max_range_m)) {
    found.push_back({path + ".min_range_m", shortest(sensor.min_range_m) +
                                                " is not below max_range_m, " +
                                                shortest(sensor.max_range_m)});
  }
  // A later image would be overtaken by the next, and a longer exposure run into it.
  const double period_ms = 1000.0 / sensor.rate_hz;
  for (const auto& [name, time_ms] :
       {std::pair(".jitter_ms", sensor.jitter_ms), std::pair(".exposure_ms", sensor.exposure_ms)}) {
    if (time_ms < period_ms) continue;
    found.push_back({path + name, shortest(time_ms) +
                                      " ms is not below the time between two images, " +
                                      shortest(period_ms) + " ms"});
  }
  check_matcher(path, sensor, found);
}

/// "sensor.more_cameras[1]" of the second further one.
std::string camera_path(std::size_t index) {
  return "sensor.more_cameras[" + std::to_string(index) + "]";
}

/// "sensor.lidars[1]" of the second one.
std::string lidar_path(std::size_t index) { return "sensor.lidars[" + std::to_string(index) + "]"; }

void check_lidar(const std::string& path, const LidarSpec& lidar, Found& found) {
  const auto check_order = [&](const std::string& lesser, double less, const std::string& greater,
                               double more) {
    if (less < more) return;
    found.push_back(
        {path + "." + lesser, shortest(less) + " is not below " + greater + ", " + shortest(more)});
  };
  check_order("min_range_m", lidar.min_range_m, "max_range_m", lidar.max_range_m);
  const auto* spinning = std::get_if<LidarSpinningSpec>(&lidar.scan);
  // One ring is at the lowest elevation.
  if (spinning != nullptr && spinning->rings == 1) return;
  std::visit(
      [&](const auto& scan) {
        check_order("lowest_elevation_deg", scan.lowest_elevation_deg, "highest_elevation_deg",
                    scan.highest_elevation_deg);
      },
      lidar.scan);
}

/// Keys of a camera that is not there: of a lidar they were meant.
void check_no_camera(const SensorSpec& sensor, Found& found) {
  CameraSpec none;
  none.name = sensor.name;
  none.method = NoCameraSpec{};
  const auto given = spec_to_json(static_cast<const CameraSpec&>(sensor));
  const auto plain = spec_to_json(none);
  for (const auto& [key, value] : given.items()) {
    if (value == plain.at(key)) continue;
    found.push_back({"sensor." + key,
                     "belongs to a camera, and a sensor of kind none has none; for a lidar it is "
                     "given as in sensor: {preset: mid360_like, lidars: [{preset: mid360_like, " +
                         key + ": …}]}"});
  }
}

void check_sensor(const SensorSpec& sensor, Found& found) {
  if (std::holds_alternative<NoCameraSpec>(sensor.method)) check_no_camera(sensor, found);
  check_camera("sensor", sensor, found);
  for (std::size_t i = 0; i < sensor.more_cameras.size(); ++i) {
    check_camera(camera_path(i), sensor.more_cameras[i], found);
  }
  for (std::size_t i = 0; i < sensor.lidars.size(); ++i) {
    check_lidar(lidar_path(i), sensor.lidars[i], found);
  }
  if (rig_cameras(sensor).empty() && sensor.lidars.empty()) {
    found.push_back({"sensor.lidars", "a sensor of kind none has lidars"});
  } else if (rig_cameras(sensor).empty() && sensor.name == SensorSpec{}.name) {
    found.push_back({"sensor.name", "reports would call these lidars '" + sensor.name +
                                        "', which is a camera: give the sensor a name"});
  }
}

/// At the field where the message names one of those that others follow from.
Contradiction vehicle_contradiction(const std::string& message, const std::string& name) {
  // The contradiction's path says "vehicle" already.
  const std::string prefix = "vehicle ";
  const std::string text = message.substr(message.starts_with(prefix) ? prefix.size() : 0);
  for (const std::string field : {"thrust_to_weight", "angular_acceleration_radps2"}) {
    const std::string lead = name + ": " + field + ": ";
    if (text.starts_with(lead)) return {"vehicle." + field, text.substr(lead.size())};
  }
  return {"vehicle", text};
}

}  // namespace

std::vector<std::pair<std::string, double*>> rates_hz(TrialSpec& spec) {
  std::vector<std::pair<std::string, double*>> rates{
      {"rates.physics_hz", &spec.rates.physics_hz},
      {"rates.plan_hz", &spec.rates.plan_hz},
      {"rates.sample_hz", &spec.rates.sample_hz},
      {"sensor.rate_hz", &spec.sensor.rate_hz},
      {"imu.rate_hz", &spec.imu.rate_hz},
      {"odometry.rate_hz", &spec.odometry.rate_hz},
      {"tracks.rate_hz", &spec.tracks.rate_hz},
      {"wind.turbulence.rate_hz", &spec.wind.turbulence.rate_hz}};
  for (std::size_t i = 0; i < spec.sensor.more_cameras.size(); ++i) {
    rates.emplace_back(camera_path(i) + ".rate_hz", &spec.sensor.more_cameras[i].rate_hz);
  }
  for (std::size_t i = 0; i < spec.sensor.lidars.size(); ++i) {
    rates.emplace_back(lidar_path(i) + ".rate_hz", &spec.sensor.lidars[i].rate_hz);
  }
  return rates;
}

/// Of the two periods in whole ticks around the exact one, that whose rate is nearer.
double nearest_rate_hz(double rate_hz) {
  if (period_ticks(rate_hz)) return rate_hz;
  const double exact = static_cast<double>(kTicksPerSecond) / rate_hz;
  // No period is shorter than a tick.
  const double below = static_cast<double>(kTicksPerSecond) / std::max(1.0, std::floor(exact));
  const double above = static_cast<double>(kTicksPerSecond) / std::max(1.0, std::ceil(exact));
  return std::abs(below - rate_hz) < std::abs(above - rate_hz) ? below : above;
}

std::vector<Contradiction> contradictions(const TrialSpec& spec) {
  Found found;
  check_not_faster("rates.plan_hz", spec.rates.plan_hz, spec.rates.physics_hz, found);
  check_not_faster("rates.sample_hz", spec.rates.sample_hz, spec.rates.physics_hz, found);
  check_not_faster("sensor.rate_hz", spec.sensor.rate_hz, spec.rates.physics_hz, found);
  for (std::size_t i = 0; i < spec.sensor.more_cameras.size(); ++i) {
    check_not_faster(camera_path(i) + ".rate_hz", spec.sensor.more_cameras[i].rate_hz,
                     spec.rates.physics_hz, found);
  }
  check_not_faster("imu.rate_hz", spec.imu.rate_hz, spec.rates.physics_hz, found);
  check_not_faster("odometry.rate_hz", spec.odometry.rate_hz, spec.rates.physics_hz, found);
  check_sensor(spec.sensor, found);
  if (spec.latency.mode == LatencyMode::replay && spec.latency.database.empty()) {
    found.push_back({"latency.database", "is needed by mode replay: the measured run's"});
  }
  try {
    check_map(spec.map);
  } catch (const InputError& error) {
    add_fields("map", error, found);
  }
  for (const std::string& problem : mover_problems(spec.movers)) {
    add_fields("movers", InputError(problem), found);
  }
  try {
    check_wind(spec.wind);
  } catch (const InputError& error) {
    add_fields("wind", error, found);
  }
  try {
    check_vehicle(settled(spec.vehicle));
  } catch (const InputError& error) {
    for (const InputProblem& problem : error.problems()) {
      found.push_back(vehicle_contradiction(problem.message, spec.vehicle.name));
    }
  }
  return found;
}

}  // namespace avoidbench
