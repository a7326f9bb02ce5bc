#include "explain/collision_cause.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "base/ticks.hpp"
#include "explain/sight.hpp"
#include "render/scene.hpp"
#include "trial/noise_seed.hpp"
#include "trial/planner_view.hpp"
#include "vehicle/vehicle_spec.hpp"
#include "wind/wind.hpp"

namespace avoidbench {
namespace {

/// "Lately": so many exposures. Far off, an image has much else at about the patch's depth.
constexpr std::size_t kLately = 15;
constexpr double kTrackingWindow_s = 2.0;
/// What can show a planner an obstacle.
constexpr std::uint32_t kShowingInputs = AB_INPUT_DEPTH | AB_INPUT_STEREO | AB_INPUT_COLOR |
                                         AB_INPUT_POINTS | AB_INPUT_TRACKS | AB_INPUT_WORLD;

/// From light to command.
double reaction_s(const FailedFlight& flight) {
  const TrialSpec& spec = flight.spec;
  double latency_s = spec.latency.mode == LatencyMode::fixed ? spec.latency.ms / 1000.0 : 0.0;
  if (is_measured(spec.latency) && !flight.record.plan_calls.empty()) {
    double sum_s = 0.0;
    for (const PlanCall& call : flight.record.plan_calls) sum_s += call.latency_s;
    latency_s = sum_s / static_cast<double>(flight.record.plan_calls.size());
  }
  const SensorSpec sensor = seen_sensor(spec);
  const bool has_camera = !camera_kinds(sensor).empty();
  const double delay_ms =
      has_camera || sensor.lidars.empty() ? sensor.delay_ms : sensor.lidars.front().delay_ms;
  return delay_ms / 1000.0 + 1.0 / spec.rates.plan_hz + latency_s;
}

/// The way to the contact from each sample on.
std::vector<double> ways_left_m(const std::vector<Sample>& samples) {
  std::vector<double> ways(samples.size(), 0.0);
  for (std::size_t i = samples.size(); i-- > 1;) {
    ways[i - 1] = ways[i] + (samples[i].position_world - samples[i - 1].position_world).norm();
  }
  return ways;
}

/// v t + v² / 2a: to react, then to brake.
double needed_way_m(const FailedFlight& flight, double reaction_time_s, double speed_mps) {
  return speed_mps * reaction_time_s +
         speed_mps * speed_mps / (2.0 * flight.spec.vehicle.max_acceleration_mps2);
}

std::size_t sample_at(const std::vector<Sample>& samples, double time_s) {
  const auto after = std::upper_bound(samples.begin(), samples.end(), time_s,
                                      [](double time, const Sample& s) { return time < s.time_s; });
  return after == samples.begin() ? 0 : static_cast<std::size_t>(after - samples.begin()) - 1;
}

/// When the vehicle could have stopped for the last time.
void add_last_chance(const FailedFlight& flight, Facts& facts) {
  const std::vector<Sample>& samples = flight.record.samples;
  const std::vector<double> ways = ways_left_m(samples);
  facts.reaction_s = reaction_s(flight);
  // The first sample hovers: nothing is needed then.
  for (std::size_t i = samples.size(); i-- > 0;) {
    const double speed_mps = samples[i].velocity_world.norm();
    const double need_m = needed_way_m(flight, facts.reaction_s, speed_mps);
    if (ways[i] < need_m && i > 0) continue;
    facts.last_chance_s = samples[i].time_s;
    facts.last_chance_speed_mps = speed_mps;
    facts.last_chance_way_m = ways[i];
    facts.last_chance_need_m = need_m;
    return;
  }
}

/// The time of the third exposure of which `is_so` holds.
template <class IsSo>
double third_s(const std::vector<PatchExposure>& exposures, IsSo&& is_so) {
  std::size_t count = 0;
  for (const PatchExposure& exposure : exposures) {
    if (is_so(exposure) && ++count == kEnoughImages) return exposure.time_s;
  }
  return Facts::kNone;
}

/// What the planner looked through: of a rig of cameras and lidars what it was shown, where that
/// was watched. Who sees nothing could have seen by all of it.
SensorSpec used_sensor(const FailedFlight& flight, const FlightWatch* watch) {
  SensorSpec sensor = seen_sensor(flight.spec);
  if (watch == nullptr || sensor.lidars.empty() || camera_kinds(sensor).empty()) return sensor;
  const bool has_images =
      watch->depth_image_count() > watch->sweep_count() || watch->has_pictures();
  if (has_images && watch->sweep_count() == 0) sensor.lidars.clear();
  if (!has_images && watch->sweep_count() > 0) {
    sensor.method = NoCameraSpec{};
    sensor.more_cameras.clear();
  }
  return sensor;
}

void add_sight(const FailedFlight& flight, const StruckPatch& patch, const FlightWatch* watch,
               Facts& facts) {
  const std::vector<Sample>& samples = flight.record.samples;
  const std::vector<PatchExposure> exposures =
      patch_exposures(used_sensor(flight, watch), flight.world, patch, samples);
  // A glimpse from far beyond the range is none, unless it never came near in time.
  const double near_s = third_s(exposures, [](const PatchExposure& e) { return e.is_near; });
  const bool is_any = !(near_s <= facts.last_chance_s);
  facts.in_cone_s = third_s(
      exposures, [&](const PatchExposure& e) { return e.in_cone && (is_any || e.is_near); });
  facts.unoccluded_s = third_s(
      exposures, [&](const PatchExposure& e) { return e.unoccluded && (is_any || e.is_near); });
  facts.in_range_s = third_s(exposures, [](const PatchExposure& e) { return e.in_range; });
  std::size_t count = 0;
  for (std::size_t i = exposures.size(); i-- > 0 && count < kLately;) {
    if (!exposures[i].in_range || exposures[i].time_s > facts.last_chance_s) continue;
    facts.lately_s = exposures[i].time_s;
    ++count;
  }
  if (std::isnan(facts.in_range_s)) return;
  const std::size_t seen = sample_at(samples, facts.in_range_s);
  facts.seen_way_m = ways_left_m(samples)[seen];
  facts.seen_need_m = needed_way_m(flight, facts.reaction_s, samples[seen].velocity_world.norm());
}

void add_knowledge(const FlightWatch& watch, Facts& facts) {
  const std::vector<double>& sensed = watch.sensed_s();
  facts.depth_image_count = static_cast<double>(watch.depth_image_count());
  facts.sweep_count = static_cast<double>(watch.sweep_count());
  facts.sensed_image_count = static_cast<double>(sensed.size());
  if (sensed.size() >= kEnoughImages) facts.sensed_s = sensed[kEnoughImages - 1];
  for (std::size_t i = 1; i < sensed.size(); ++i) {
    const double gap_s = sensed[i] - sensed[i - 1];
    if (!(facts.longest_gap_s >= gap_s)) facts.longest_gap_s = gap_s;
  }
  facts.sensed_lately_count = 0.0;
  for (const double time_s : sensed) {
    // With the slack of rounding: lately_s is the time of an exposure.
    if (time_s >= facts.lately_s - 1e-6 && time_s <= facts.last_chance_s) {
      ++facts.sensed_lately_count;
    }
  }
  // A planner that matches pictures itself has what is in sight.
  if (watch.depth_image_count() == 0 && watch.has_pictures()) {
    facts.sensed_s = facts.in_range_s;
    facts.sensed_lately_count = static_cast<double>(kEnoughImages);
  }
  for (const CallKnowledge& call : watch.calls()) {
    if (!call.mapped_share) continue;
    if (std::isnan(facts.mapped_s) && *call.mapped_share >= kEnoughOfPatch) {
      facts.mapped_s = call.time_s;
    }
    // The first call counts where the last chance was before it.
    if (call.time_s <= facts.last_chance_s || std::isnan(facts.mapped_share)) {
      facts.mapped_share = *call.mapped_share;
    }
  }
}

double no_plan_share(const std::vector<PlanCall>& calls, double from_s) {
  std::size_t count = 0, without = 0;
  for (const PlanCall& call : calls) {
    if (call.time_s < from_s) continue;
    ++count;
    if (call.status == AB_NO_PLAN) ++without;
  }
  return count == 0 ? 0.0 : static_cast<double>(without) / static_cast<double>(count);
}

/// The call whose command was flown at the contact.
double flown_call_s(const FailedFlight& flight, double contact_s) {
  const double latency_s =
      flight.spec.latency.mode == LatencyMode::fixed ? flight.spec.latency.ms / 1000.0 : 0.0;
  double flown_s = 0.0;
  for (const PlanCall& call : flight.record.plan_calls) {
    const double acts_s = call.time_s + (std::isnan(call.latency_s) ? latency_s : call.latency_s);
    if (acts_s <= contact_s) flown_s = call.time_s;
  }
  return flown_s;
}

/// Whether the body would have passed what it struck, had that stood still since the planner's last
/// word. Nothing where it does not move.
void add_motion(const FailedFlight& flight, const StruckPatch& patch, Facts& facts) {
  if (!patch.is_moving()) return;
  const double since_s = flown_call_s(flight, patch.contact_s);
  const std::vector<Eigen::Vector3d> then = places_at(patch, since_s);
  for (std::size_t i = 0; i < then.size(); ++i) {
    const double way_m = (patch.places_world[i] - then[i]).norm();
    if (!(facts.obstacle_way_m >= way_m)) facts.obstacle_way_m = way_m;
  }
  const World still = alone(flight.world, patch.obstacle, since_s);
  const Scene scene(still);
  const Eigen::Vector3d body_m = to_eigen(flight.spec.vehicle.body_size_m);
  facts.still_clearance_m = kClearanceLimit_m;
  for (const Sample& sample : flight.record.samples) {
    if (sample.time_s < since_s) continue;
    const Pose pose(Eigen::Translation3d(sample.position_world) * sample.q_world_body);
    facts.still_clearance_m =
        std::min(facts.still_clearance_m, scene.body_clearance(body_m, pose, kClearanceLimit_m));
  }
}

double wind_at_contact_mps(const FailedFlight& flight, double contact_s) {
  Wind wind = make_wind(flight.spec.wind, noise_seed(flight.spec, "wind"),
                        flight.spec.mission.time_limit_s);
  return environment_at(wind, ticks(contact_s), flight.record.samples.back().position_world)
      .wind_world_mps.norm();
}

/// Whether the commanded path was clear, and how far off it the vehicle was. Nothing under rates,
/// which say no place.
void add_tracking(const FailedFlight& flight, Facts& facts) {
  const std::vector<Sample>& samples = flight.record.samples;
  const Eigen::Vector3d body_m = to_eigen(flight.spec.vehicle.body_size_m);
  const Sample& last = samples.back();
  if (!last.reference_world.allFinite()) return;
  facts.tracking_error_m = (last.position_world - last.reference_world).norm();
  facts.commanded_clearance_m = kClearanceLimit_m;
  Scene scene(flight.world);
  for (const Sample& sample : samples) {
    if (sample.time_s < last.time_s - kTrackingWindow_s) continue;
    if (!sample.reference_world.allFinite()) continue;
    scene.set_time(sample.time_s);
    // As it flew: a reference has no attitude of its own.
    const Pose commanded(Eigen::Translation3d(sample.reference_world) * sample.q_world_body);
    facts.commanded_clearance_m = std::min(
        facts.commanded_clearance_m, scene.body_clearance(body_m, commanded, kClearanceLimit_m));
  }
}

}  // namespace

CauseFound collision_explained(const FailedFlight& flight, const StruckPatch& patch,
                               const FlightWatch* watch) {
  CauseFound found;
  Facts& facts = found.facts;
  facts.contact_s = patch.contact_s;
  facts.contact_speed_mps = flight.record.collisions.back().speed_mps;
  facts.wind_mps = wind_at_contact_mps(flight, patch.contact_s);
  add_last_chance(flight, facts);
  if (flight.planner_needs) {
    facts.sight_input_count =
        static_cast<double>(std::popcount(*flight.planner_needs & kShowingInputs));
  }
  add_sight(flight, patch, watch, facts);
  if (watch != nullptr) add_knowledge(*watch, facts);
  facts.no_plan_share = no_plan_share(flight.record.plan_calls, facts.last_chance_s);
  add_motion(flight, patch, facts);
  add_tracking(flight, facts);
  found.cause = collision_cause(facts, watch != nullptr);
  return found;
}

}  // namespace avoidbench
