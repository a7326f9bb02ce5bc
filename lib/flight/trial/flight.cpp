#include "trial/flight.hpp"

#include <cmath>
#include <limits>
#include <utility>

#include "base/check.hpp"
#include "base/number_text.hpp"
#include "control/perfect_tracking.hpp"
#include "trial/flown_world.hpp"
#include "trial/goals.hpp"
#include "trial/noise_seed.hpp"
#include "trial/periods.hpp"
#include "trial/planner_view.hpp"

namespace avoidbench {
namespace {

/// "(1.00, -2.50, 3.00) m"
std::string place_text(const Eigen::Vector3d& place_world) {
  return "(" + fixed_digits(place_world.x(), 2) + ", " + fixed_digits(place_world.y(), 2) + ", " +
         fixed_digits(place_world.z(), 2) + ") m";
}

/// Of the call that just came back after `wall_time_s`.
Tick latency_of_call(const Flight& flight, double wall_time_s) {
  const LatencySpec& latency = flight.spec->latency;
  if (latency.mode == LatencyMode::zero) return 0;
  if (latency.mode == LatencyMode::fixed) return ticks(latency.ms / 1000.0);
  // From here on the latency is measured: now, or in the recorded flight.
  if (flight.recorded_latency_s == nullptr) return ticks(latency.scale * wall_time_s);
  const std::size_t call = flight.record.plan_calls.size();
  const std::vector<double>& recorded_s = *flight.recorded_latency_s;
  // A crash leaves no times; what then flies past them acts at once.
  return call < recorded_s.size() ? ticks(recorded_s[call]) : 0;
}

/// Whether the planner is called now. Of the images that come while it is busy, those of the last
/// second wait for it.
bool is_plan_due(Flight& flight) {
  const Tick now = flight.state.tick;
  if (now % flight.plan_period != 0) return false;
  if (now >= flight.busy_until) return true;
  // A planner that computes for a minute would otherwise be shown a minute of images.
  forget_images(flight.perception, now - kTicksPerSecond);
  return false;
}

/// Lets commands that are due take effect.
void apply_due_commands(Flight& flight) {
  while (!flight.pending.empty() && flight.pending.front().due <= flight.state.tick) {
    const std::optional<Command>& command = flight.pending.front().command;
    const VehicleState believed = believed_state(flight);
    if (command) {
      accept(flight.tracker, flight.model, *command, believed);
    } else {
      // No plan: the vehicle brakes.
      hold(flight.tracker, flight.model, believed);
    }
    flight.pending.pop_front();
  }
}

/// Where the vehicle is told to be now; NaN where the command does not say.
Eigen::Vector3d commanded_position(const Flight& flight) {
  if (flight.tracker.following_rates) {
    return Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
  }
  return reference(flight.tracker).position_world;
}

/// The same for a planner, at this tick.
std::optional<ReferenceView> reference_view(const Flight& flight) {
  if (flight.tracker.following_rates) return std::nullopt;
  // A copy: samples are taken before the reference is brought to their tick, whoever looks.
  Tracker tracker = flight.tracker;
  advance(tracker, flight.model, believed_state(flight));
  const Reference& now = reference(tracker);
  return ReferenceView{.position_world = now.position_world,
                       .velocity_world = now.velocity_world,
                       .acceleration_world = now.acceleration_world,
                       .jerk_world = now.jerk_world,
                       .yaw_rad = now.yaw_rad,
                       .yaw_rate_radps = now.yaw_rate_radps};
}

/// What moves around the vehicle, where its odometry believes that to be.
std::vector<TrackView> track_views(const Flight& flight) {
  const Pose T_world_body = pose_of(flight.state);
  const Pose T_believed_world = pose_of(believed_state(flight)) * T_world_body.inverse();
  std::vector<TrackView> views;
  for (const Track& track : tracks_at(flight.spec->tracks, flight.scene->world(), flight.tracked,
                                      noise_seed(*flight.spec, "tracks"),
                                      {.now = flight.state.tick,
                                      .T_world_body = T_world_body,
                                      .still_at_s = flight.change.still_at_s})) {
    views.push_back({.id = track.id,
                     .kind = track.kind,
                     .time_s = track.time_s,
                     .center_world = T_believed_world * track.center_world,
                     .velocity_world = T_believed_world.linear() * track.velocity_world,
                     .size_m = track.size_m});
  }
  return views;
}

/// The state at this tick, with what is measured of it: clearance and power.
void sample(Flight& flight) {
  const VehicleState& state = flight.state;
  // The end of a flight may be a sample's own tick.
  if (!flight.record.samples.empty() && flight.record.samples.back().time_s == seconds(state.tick))
    return;
  const Pose T_world_body = pose_of(state);
  const double clearance_m =
      body_clearance(flight.collision_check, *flight.scene, T_world_body, kClearanceLimit_m);
  flight.record.samples.push_back(
      {.time_s = seconds(state.tick),
       .position_world = state.position_world,
       .velocity_world = state.velocity_world,
       .acceleration_world = acceleration_world(flight.model, state, flight.environment),
       .q_world_body = state.q_world_body,
       .rates_body_radps = state.rates_body,
       .reference_world = commanded_position(flight),
       .clearance_m = clearance_m,
       .rotor_power_w = rotor_power_w(flight.model, state)});
}

/// Brings what moves to the flight's own time.
void move_obstacles(Flight& flight, Tick dt) {
  if (flight.moving == nullptr || flight.change.still_at_s) return;
  flight.moving->set_time(seconds(flight.state.tick));
  move_obstacles(flight.collision_check, flight.obstacle_speed_mps * seconds(dt));
}

/// Records a contact that begins now. True when it is one more than a flight may survive.
bool collided(Flight& flight) {
  const auto touched = contact(flight.collision_check, *flight.scene, pose_of(flight.state));
  // A touch that lasts is one contact.
  const bool begins = touched.has_value() && !flight.was_touching;
  flight.was_touching = touched.has_value();
  if (!begins) return false;
  const World& world = flight.scene->world();
  const std::uint32_t obstacle = world.instances[touched->instance].obstacle;
  const Eigen::Vector3d& place = flight.state.position_world;
  const double speed_mps = flight.state.velocity_world.norm();
  const std::string& obstacle_kind = world.obstacles[obstacle].kind;
  flight.record.collisions.push_back({.time_s = seconds(flight.state.tick),
                                      .speed_mps = speed_mps,
                                      .obstacle = obstacle,
                                      .kind = obstacle_kind});
  const auto survivable = static_cast<std::size_t>(flight.spec->mission.max_collisions);
  if (flight.record.collisions.size() <= survivable) return false;
  flight.record.reason = "touched " + obstacle_kind + " " + std::to_string(obstacle) + " at " +
                         place_text(place) + ", " + fixed_digits(speed_mps, 2) + " m/s";
  return true;
}

/// The outcome, once there is one.
std::optional<Outcome> ended(Flight& flight) {
  if (flight.stopped) return flight.stopped;
  const Eigen::Vector3d& place = flight.state.position_world;
  // First of all: a vehicle that touches something as it enters the goal or leaves the map has
  // collided.
  if (collided(flight)) return Outcome::collided;
  if (!flight.scene->world().bounds.contains(place)) {
    flight.record.reason = "left the map at " + place_text(place);
    return Outcome::left_bounds;
  }
  const MissionSpec& rules = flight.spec->mission;
  const std::size_t last = flight.mission->waypoints_world.size();
  const double now_s = seconds(flight.state.tick);
  const auto way_left_m = [&] {
    return distance_to_goal_m(rules, *flight.mission, flight.goal_index, place, now_s);
  };
  double to_goal_m = way_left_m();
  for (; flight.goal_index < last && to_goal_m <= rules.goal_radius_m; to_goal_m = way_left_m()) {
    ++flight.goal_index;
    flight.has_reached = true;
  }
  if (to_goal_m <= rules.goal_radius_m) {
    flight.record.reason = "reached the goal after " + fixed_digits(now_s, 2) + " s";
    return Outcome::reached_goal;
  }
  if (now_s >= rules.time_limit_s) {
    const std::string goal = last == 0 ? "the goal"
                                       : "goal " + std::to_string(flight.goal_index + 1) + " of " +
                                             std::to_string(last + 1);
    flight.record.reason = fixed_digits(to_goal_m, 2) + " m from " + goal + " at the time limit";
    return Outcome::timed_out;
  }
  return std::nullopt;
}

/// The next tick at which anything but physics happens, or the next of the physics' own grid.
Tick next_tick(const Flight& flight) {
  const Tick now = flight.state.tick;
  // The next multiple of a period, counted from tick 0.
  const auto after = [now](Tick period) { return (now / period + 1) * period; };
  Tick next = std::min({after(flight.physics_period), after(flight.plan_period),
                        after(flight.sample_period), after(flight.jerk_period),
                        next_sensing(flight.perception, now)});
  next = std::min(next, next_force_change(flight.wind, now));
  if (!flight.pending.empty()) next = std::min(next, flight.pending.front().due);
  return next;
}

/// Moves the vehicle to where its reference is at this tick, if it has one.
void put_on_reference(Flight& flight) {
  // With what it believes, as a step's tracking; the leash of the reference sees no lag then.
  advance(flight.tracker, flight.model, believed_state(flight));
  if (flight.tracker.following_rates) return;
  const VehicleState wanted = state_on(reference(flight.tracker), flight.model, flight.state);
  // Not by white noise, of which there is another draw each tick of the odometry: the vehicle would
  // jump to and fro.
  flight.state = truth_believed_as(flight.perception, wanted);
}

/// What is due at this tick after the planner was asked, and the step to the next one.
void fly_on(Flight& flight) {
  const Tick now = flight.state.tick;
  apply_due_commands(flight);
  // After commands: the sample's reference is the one that is followed from now on.
  // A goal reached is a sample's moment, too: from samples alone it is known when that was.
  const bool has_reached = std::exchange(flight.has_reached, false);
  if (has_reached || now % flight.sample_period == 0 || now % flight.jerk_period == 0) {
    sample(flight);
  }
  if (!flight.stopped) {
    // By what the vehicle believes; it moves by the truth.
    const RotorVector rotors = track(flight.tracker, flight.model, believed_state(flight));
    const Tick dt = next_tick(flight) - now;
    flight.state = step(flight.model, flight.state, rotors, flight.environment, dt);
    if (flight.change.tracks_perfectly) put_on_reference(flight);
    move_obstacles(flight, dt);
  }
  flight.outcome = ended(flight);
}

/// From begin_flight(), or from the tick of the last plan, to the next tick.
void resume(Flight& flight) {
  if (flight.is_asked) {
    // A caller that asks for the next plan must have answered this one.
    AB_CHECK(flight.is_answered || flight.stopped);
    flight.is_asked = false;
    if (flight.is_answered) forget_seen(flight.perception, flight.state.tick);
    fly_on(flight);
  } else if (!flight.is_begun) {
    flight.is_begun = true;
    // A start may be at the goal or touch something already.
    flight.outcome = ended(flight);
  }
}

/// Gives the flight a scene whose time is set at each step, where anything moves; the caller's
/// stays at 0 for other trials.
void add_motion(Flight& flight) {
  const Scene& map = *flight.scene;
  if (auto world = world_with_movers(*flight.spec, map, *flight.mission)) {
    flight.own_world = std::make_unique<World>(*std::move(world));
    flight.moving = std::make_unique<Scene>(*flight.own_world, map);
  } else if (!map.world().motions.empty()) {
    flight.moving = std::make_unique<Scene>(map.world());
  } else {
    return;
  }
  flight.scene = flight.moving.get();
  if (flight.change.still_at_s) {
    flight.moving->set_time(*flight.change.still_at_s);
    return;
  }
  const World& world = flight.scene->world();
  for (const Motion& motion : world.motions) {
    flight.obstacle_speed_mps =
        std::max(flight.obstacle_speed_mps, greatest_surface_speed_mps(world, motion));
  }
}

}  // namespace

Flight begin_flight(const TrialSpec& spec, const Scene& scene, const Mission& mission,
                    std::uint32_t needs, const std::vector<double>* recorded_latency_s,
                    const FlightChange& change) {
  AB_CHECK(spec.latency.mode != LatencyMode::replay || recorded_latency_s != nullptr);
  VehicleModel model = make_model(spec.vehicle);
  const VehicleState start = hovering_at(spec.vehicle, mission.start_world, mission.start_yaw_rad);
  Tracker tracker = make_tracker(model, start);
  Flight flight{.spec = &spec,
                .scene = &scene,
                .mission = &mission,
                .recorded_latency_s = recorded_latency_s,
                .change = change,
                .own_world = nullptr,
                .moving = nullptr,
                .obstacle_speed_mps = 0.0,
                .model = std::move(model),
                .wind = make_wind(spec.wind, noise_seed(spec, "wind"), spec.mission.time_limit_s),
                .environment = {},
                .state = start,
                .tracker = std::move(tracker),
                .collision_check = {.body_size_m = to_eigen(spec.vehicle.body_size_m)},
                .perception = make_perception(spec, needs, start),
                .physics_period = required_period(spec.rates.physics_hz),
                .plan_period = required_period(spec.rates.plan_hz),
                .sample_period = required_period(spec.rates.sample_hz),
                .jerk_period = required_period(
                    adds_jerk_samples(spec.rates) ? kJerkRate_hz : spec.rates.sample_hz),
                .busy_until = 0,
                .pending = {},
                .sees_reference = (needs & AB_INPUT_REFERENCE) != 0,
                .sees_goals = (needs & AB_INPUT_GOALS) != 0,
                .sees_tracks = (needs & AB_INPUT_TRACKS) != 0,
                .tracked = {},
                .view = {},
                .stopped = {},
                .outcome = {},
                .record = {}};
  add_motion(flight);
  if (flight.sees_tracks) {
    flight.tracked = tracked_things(flight.scene->world(), noise_seed(spec, "tracks"));
  }
  return flight;
}

Eigen::Vector3d goal_now_world(const Flight& flight) {
  return goal_place(flight.spec->mission, *flight.mission, flight.goal_index,
                    seconds(flight.state.tick));
}

const PlannerView* next_plan(Flight& flight) {
  resume(flight);
  while (!flight.outcome) {
    const VehicleState& state = flight.state;
    // The order within a tick: wind, senses, plan, commands, sample, step, end.
    flight.environment = environment_at(flight.wind, state.tick, state.position_world);
    sense(flight.perception, *flight.scene, flight.model, state, flight.environment);
    // Before commands take effect: with zero latency what is planned now acts now.
    if (is_plan_due(flight)) {
      flight.is_asked = true;
      flight.is_answered = false;
      flight.view = planner_view(flight.perception, state);
      if (flight.sees_reference) flight.view.reference = reference_view(flight);
      if (flight.sees_goals) {
        flight.view.goal = GoalView{.index = static_cast<std::uint32_t>(flight.goal_index),
                                    .place_world = goal_now_world(flight)};
      }
      if (flight.sees_tracks) flight.view.tracks = track_views(flight);
      return &flight.view;
    }
    fly_on(flight);
  }
  return nullptr;
}

Tick answer(Flight& flight, const PlanResult& result) {
  AB_CHECK(flight.is_asked && !flight.is_answered && !flight.stopped);
  flight.is_answered = true;
  const Tick latency = latency_of_call(flight, result.wall_time_s);
  const Tick due = flight.state.tick + latency;
  PlanCall call{.time_s = seconds(flight.state.tick),
                .cpu_time_s = result.cpu_time_s,
                .wall_time_s = result.wall_time_s};
  // A busy planner is not called: commands can't overtake each other.
  if (is_measured(flight.spec->latency)) {
    call.latency_s = seconds(latency);
    flight.busy_until = due;
  }
  switch (result.status) {
    case PlanStatus::command:
      call.status = AB_OK;
      call.command_kind = result.command.kind;
      // A trajectory's time begins when it takes effect.
      flight.pending.push_back({due, vehicle_command(result, due)});
      break;
    case PlanStatus::no_plan:
      call.status = AB_NO_PLAN;
      // Also "no plan" takes effect a latency later.
      flight.pending.push_back({due, std::nullopt});
      break;
    case PlanStatus::gave_up:
      call.status = AB_GIVE_UP;
      stop_flight(flight, Outcome::planner_gave_up,
                  result.reason.empty() ? "the planner gave up" : result.reason);
      break;
    case PlanStatus::error:
      call.status = AB_ERROR;
      stop_flight(flight, result.has_crashed ? Outcome::planner_crashed : Outcome::planner_error,
                  result.reason);
      break;
  }
  flight.record.plan_calls.push_back(call);
  return due;
}

void stop_flight(Flight& flight, Outcome outcome, std::string reason) {
  flight.stopped = outcome;
  flight.record.reason = std::move(reason);
}

TrialRecord end_flight(Flight&& flight) {
  AB_CHECK(flight.outcome.has_value());
  // The last sample's acceleration is that of the wind at the end.
  flight.environment = environment_at(flight.wind, flight.state.tick, flight.state.position_world);
  sample(flight);
  flight.record.outcome = *flight.outcome;
  flight.record.end_time_s = seconds(flight.state.tick);
  return std::move(flight.record);
}

}  // namespace avoidbench
