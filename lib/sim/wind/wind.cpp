#include "wind/wind.hpp"

#include <algorithm>
#include <limits>

#include "base/check.hpp"
#include "base/input_error.hpp"
#include "geometry/pose.hpp"
#include "wind/gust.hpp"

namespace avoidbench {
namespace {

using Eigen::Vector3d;

void start_turbulence(Wind& wind, std::uint64_t seed) {
  const TurbulenceSpec& spec = wind.spec.turbulence;
  const TurbulenceScales scales = turbulence_scales(spec);
  wind.sigma_mps = spec.intensity_ratio * to_eigen(scales.sigma_mps);
  wind.is_turbulent = wind.sigma_mps.maxCoeff() > 0.0;
  if (!wind.is_turbulent) return;
  // Dryden's u is along the mean wind; without one, along x.
  const Vector3d across(wind.steady.wind_world_mps.x(), wind.steady.wind_world_mps.y(), 0.0);
  if (across.norm() > 0.0) wind.along_world = across / across.norm();
  wind.turbulence_period = *period_ticks(spec.rate_hz);
  wind.turbulence_random = RandomStream(seed);
  wind.dryden = make_dryden(scales.length_m, spec.airspeed_mps, seconds(wind.turbulence_period));
  wind.turbulence = stationary(wind.turbulence_random);
}

Vector3d turbulence_world(const Wind& wind) {
  const Vector3d velocity = wind.sigma_mps.cwiseProduct(unit_velocity(wind.turbulence));
  // From the wind's axes to the world's: turned about z by its heading.
  const Vector3d& x = wind.along_world;
  return {x.x() * velocity.x() - x.y() * velocity.y(), x.y() * velocity.x() + x.x() * velocity.y(),
          velocity.z()};
}

}  // namespace

void check_wind(const WindSpec& wind) {
  std::vector<InputProblem> problems;
  const auto add = [&](const std::string& message) {
    InputProblem problem;
    problem.message = message;
    problems.push_back(std::move(problem));
  };
  const GustSpec& gust = wind.gust;
  // Up, held and down again, begun as late as it may.
  const double longest_s = 2.0 * gust.rise_s + gust.hold_s + gust.start_jitter_s;
  if (gust.period_s > 0.0 && gust.period_s < longest_s) {
    add("gust.period_s: shorter than a gust with its jitter (2 rise_s + hold_s + start_jitter_s)");
  }
  if (!period_ticks(wind.turbulence.rate_hz)) {
    add("turbulence.rate_hz: the period is not a whole number of ticks of 1/36000 s");
  }
  if (!problems.empty()) throw InputError(problems);
}

Wind make_wind(const WindSpec& spec, std::uint64_t seed, double until_s) {
  check_wind(spec);
  // Another wind.seed is another wind for the same trial.
  const std::uint64_t own_seed = stream_seed(seed, spec.seed);
  Wind wind;
  wind.spec = spec;
  wind.steady.wind_world_mps = to_eigen(spec.mean_world_mps);
  wind.steady.force_world_n = to_eigen(spec.force_world_n);
  wind.steady.torque_body_nm = to_eigen(spec.torque_body_nm);
  if (!spec.field.file.empty())
    wind.field = read_wind_field(spec.field.file, spec.field.file_digest);
  wind.gust_seed = stream_seed(own_seed, "gust");
  wind.kicks = make_kicks(spec.kicks, stream_seed(own_seed, "kicks"), until_s);
  if (!to_eigen(spec.force_gust.force_world_n).isZero(0.0)) {
    wind.force_from = ticks(spec.force_gust.start_s);
    wind.force_until = wind.force_from + ticks(spec.force_gust.duration_s);
  }
  start_turbulence(wind, stream_seed(own_seed, "turbulence"));
  // Nothing changes with time or place: one constant for the whole flight.
  wind.is_steady = wind.field.is_empty() && wind.kicks.empty() && !wind.is_turbulent &&
                   wind.force_from == wind.force_until &&
                   to_eigen(spec.gust.amplitude_world_mps).isZero(0.0);
  return wind;
}

Environment environment_at(Wind& wind, Tick tick, const Vector3d& position_world) {
  // Most trials have no wind, and this is asked at each physics step.
  if (wind.is_steady) return wind.steady;
  // Turbulence and kicks only go forward.
  AB_CHECK(tick >= wind.tick, tick, wind.tick);
  wind.tick = tick;
  Environment now = wind.steady;
  if (!wind.field.is_empty()) {
    now.wind_world_mps += wind.spec.field.scale * wind_at(wind.field, position_world);
  }
  now.wind_world_mps += gust_velocity_world(wind.spec.gust, wind.gust_seed, seconds(tick));
  if (wind.is_turbulent) {
    // In whole steps of its own period, however often it is asked.
    while (wind.turbulence_tick + wind.turbulence_period <= tick) {
      advance(wind.turbulence, wind.dryden, wind.turbulence_random);
      wind.turbulence_tick += wind.turbulence_period;
    }
    now.wind_world_mps += turbulence_world(wind);
  }
  if (tick >= wind.force_from && tick < wind.force_until) {
    now.force_world_n += to_eigen(wind.spec.force_gust.force_world_n);
  }
  // Kicks that are over are never looked at again.
  while (wind.first_kick < wind.kicks.size() && wind.kicks[wind.first_kick].until <= tick) {
    ++wind.first_kick;
  }
  for (std::size_t i = wind.first_kick; i < wind.kicks.size(); ++i) {
    const Kick& kick = wind.kicks[i];
    if (kick.from > tick) break;
    now.force_world_n += kick.force_world_n;
    now.torque_body_nm += kick.torque_body_nm;
  }
  return now;
}

Tick next_force_change(const Wind& wind, Tick now) {
  Tick next = std::numeric_limits<Tick>::max();
  if (wind.is_steady) return next;
  const auto consider = [&](Tick tick) {
    if (tick > now) next = std::min(next, tick);
  };
  if (wind.force_from < wind.force_until) {
    consider(wind.force_from);
    consider(wind.force_until);
  }
  for (std::size_t i = wind.first_kick; i < wind.kicks.size(); ++i) {
    consider(wind.kicks[i].from);
    if (wind.kicks[i].from > now) break;  // they begin in order and last equally long
    consider(wind.kicks[i].until);
  }
  return next;
}

}  // namespace avoidbench
