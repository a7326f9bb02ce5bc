#include "page/flight_data.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "page/packed.hpp"

namespace avoidbench {
namespace {

using nlohmann::ordered_json;

constexpr std::int64_t kNoClearance = -1;

/// A list of numbers for each quantity: alike numbers side by side deflate best.
struct Channels {
  std::vector<std::int64_t> time, speed, clearance, has_reference;
  std::array<std::vector<std::int64_t>, 3> position, ahead;
  std::array<std::vector<std::int64_t>, 4> rotation;
};

/// Of the samples from `first` up to `last`, NaN where none has one.
double least_clearance_m(std::span<const Sample> samples, std::size_t first, std::size_t last) {
  double least_m = std::nan("");
  for (std::size_t i = first; i <= last; ++i) least_m = std::fmin(least_m, samples[i].clearance_m);
  return least_m;
}

/// The rotation with the sign that lies nearer to `before`: q and -q are one, but numbers that jump
/// take more bytes and can't be interpolated.
Eigen::Vector4d continued(const Eigen::Quaterniond& q, const Eigen::Vector4d& before) {
  const Eigen::Vector4d wxyz(q.w(), q.x(), q.y(), q.z());
  return wxyz.dot(before) < 0.0 ? Eigen::Vector4d(-wxyz) : wxyz;
}

Channels channels_of(std::span<const Sample> samples, const std::vector<std::size_t>& kept) {
  Channels c;
  Eigen::Vector4d rotation(1.0, 0.0, 0.0, 0.0);
  std::size_t next = 0;
  for (const std::size_t i : kept) {
    const Sample& s = samples[i];
    c.time.push_back(steps(s.time_s, kPageTimeStep_s));
    c.speed.push_back(steps(s.velocity_world.norm(), kPageSpeedStep_mps));
    const double clearance_m = least_clearance_m(samples, next, i);
    next = i + 1;
    c.clearance.push_back(
        steps(std::min(clearance_m, kClearanceLimit_m), kPageClearanceStep_m, kNoClearance));
    // min() of a NaN is the limit.
    if (std::isnan(clearance_m)) c.clearance.back() = kNoClearance;
    const Eigen::Vector3d ahead = s.reference_world - s.position_world;
    const bool has_reference = ahead.allFinite();
    c.has_reference.push_back(has_reference ? 1 : 0);
    for (std::size_t k = 0; k < 3; ++k) {
      const auto axis = static_cast<Eigen::Index>(k);
      c.position[k].push_back(steps(s.position_world[axis], kPagePositionStep_m));
      c.ahead[k].push_back(has_reference ? steps(ahead[axis], kPagePositionStep_m) : 0);
    }
    rotation = continued(s.q_world_body, rotation);
    for (std::size_t k = 0; k < 4; ++k) {
      c.rotation[k].push_back(
          steps(rotation[static_cast<Eigen::Index>(k)], 1.0 / kPageQuaternionSteps));
    }
  }
  return c;
}

/// [time, status] of each call whose status is another than that of the one before.
ordered_json status_changes(std::span<const PlanCall> calls) {
  ordered_json changes = ordered_json::array();
  std::int32_t last = 0;
  for (const PlanCall& call : calls) {
    if (call.status == last) continue;
    last = call.status;
    changes.push_back({std::round(1000.0 * call.time_s) / 1000.0, call.status});
  }
  return changes;
}

ordered_json touches(std::span<const Collision> collisions) {
  ordered_json all = ordered_json::array();
  for (const Collision& c : collisions) {
    all.push_back({{"t", c.time_s}, {"obstacle", c.obstacle}});
  }
  return all;
}

}  // namespace

std::vector<std::size_t> kept_samples(std::span<const Sample> samples, double rate_hz) {
  std::vector<std::size_t> kept;
  double next_s = -std::numeric_limits<double>::infinity();
  const double period_s = 1.0 / rate_hz;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    // Times are whole ticks as doubles: a hair too early is in time.
    if (i + 1 < samples.size() && samples[i].time_s < next_s - 1e-6) continue;
    kept.push_back(i);
    next_s = samples[i].time_s + period_s;
  }
  return kept;
}

ordered_json flight_json(const TrialRecord& record, double rate_hz) {
  const std::vector<std::size_t> kept = kept_samples(record.samples, rate_hz);
  const Channels c = channels_of(record.samples, kept);
  Packed packed;
  packed.add_second_deltas(c.time);
  for (const auto& axis : c.position) packed.add_second_deltas(axis);
  for (const auto& part : c.rotation) packed.add_deltas(part);
  packed.add_deltas(c.speed);
  packed.add_deltas(c.clearance);
  const bool has_reference = std::any_of(c.has_reference.begin(), c.has_reference.end(),
                                         [](auto has) { return has != 0; });
  if (has_reference) {
    packed.add_deltas(c.has_reference);
    for (const auto& axis : c.ahead) packed.add_deltas(axis);
  }
  return {{"n", kept.size()},
          {"reference", has_reference},
          {"data", packed.text()},
          {"touches", touches(record.collisions)},
          {"status", status_changes(record.plan_calls)}};
}

}  // namespace avoidbench
