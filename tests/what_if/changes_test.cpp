#include "what_if/changes.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <set>

#include "base/spec_json.hpp"
#include "support/flight_worlds.hpp"
#include "trial/flight.hpp"
#include "trial/planner_view.hpp"

/// Each change changes one thing, and no draw of noise.
namespace avoidbench {
namespace {

/// Everything that a change could touch is there: wind of all kinds, noise of all kinds.
TrialSpec noisy_spec() {
  TrialSpec spec;
  spec.map = HallSpec{.moving_ratio = 0.5};
  spec.map_seed = 3;
  spec.mission_index = 2;
  spec.mission.time_limit_s = 1.5;
  // A whole plan period: without it there are no other physics steps.
  spec.latency.ms = 1000.0 / 30.0;
  spec.sensor.method = DepthNoisySpec{};
  spec.sensor.width_px = 64;
  spec.sensor.height_px = 48;
  spec.sensor.jitter_ms = 5.0;
  spec.sensor.delay_ms = 10.0;
  spec.odometry.position_sigma_m = 0.02;
  spec.odometry.velocity_sigma_mps = 0.02;
  spec.odometry.attitude_sigma_deg = 0.2;
  spec.odometry.yaw_drift_deg_per_sqrt_s = 0.5;
  spec.odometry.position_drift_ratio = 0.05;
  spec.odometry.delay_ms = 20.0;
  spec.wind.mean_world_mps = {1.0, 0.0, 0.0};
  spec.wind.turbulence.model = TurbulenceModel::given;
  spec.wind.gust.amplitude_world_mps = {0.0, 2.0, 0.0};
  spec.wind.gust.start_s = 0.2;
  spec.wind.gust.start_jitter_s = 0.3;
  spec.wind.gust.random_heading = true;
  spec.wind.kicks = {.rate_per_min = 300.0, .force_n = 1.0, .torque_nm = 0.01};
  spec.planner.parameters = {{.name = "max_speed_mps", .number = 3.0, .text = {}},
                             {.name = "gain", .number = 3.0, .text = {}},
                             {.name = "compute_clock_us", .number = 100.0, .text = {}}};
  return spec;
}

PlannerDescription planner() {
  PlannerDescription planner;
  planner.needs = AB_INPUT_STATE | AB_INPUT_DEPTH | AB_INPUT_IMU;
  planner.parameters = {{.name = "max_speed_mps",
                         .unit = "m/s",
                         .doc = {},
                         .lowest = 0.2,
                         .highest = 9.0,
                         .choices = {},
                         .preset_text = {}},
                        {.name = "gain",
                         .unit = "1/s",
                         .doc = {},
                         .lowest = 0.0,
                         .highest = 9.0,
                         .choices = {},
                         .preset_text = {}},
                        {.name = "compute_clock_us",
                         .unit = "us",
                         .doc = {},
                         .lowest = 1.0,
                         .highest = 1e6,
                         .choices = {},
                         .preset_text = {}}};
  return planner;
}

ChangedTrial changed_by(std::string_view name, std::string& problem) {
  TrialRecord record;
  record.end_time_s = 0.7;
  const PlannerDescription description = planner();
  ChangedTrial trial{.spec = noisy_spec()};
  problem = changes_of({std::string(name)}).front()->apply({record, description}, trial);
  return trial;
}

/// What is drawn, at one call of the planner: nothing of it follows from how it flies.
struct Draws {
  std::vector<std::uint64_t> wind, odometry, imu, images;
};

template <class... Numbers>
void add_bits(std::vector<std::uint64_t>& bits, Numbers... numbers) {
  (bits.push_back(std::bit_cast<std::uint64_t>(static_cast<double>(numbers))), ...);
}

void add_vector(std::vector<std::uint64_t>& bits, const Eigen::Vector3d& v) {
  add_bits(bits, v.x(), v.y(), v.z());
}

Draws draws_of(const Flight& flight) {
  Draws draws;
  const Environment& air = flight.environment;
  for (const auto& v : {air.wind_world_mps, air.force_world_n, air.torque_body_nm})
    add_vector(draws.wind, v);
  const OdometryState& state = flight.perception.odometry_state;
  for (const auto& v :
       {state.position_noise, state.velocity_noise, state.attitude_noise_rad, state.rates_noise})
    add_vector(draws.odometry, v);
  add_bits(draws.odometry, state.yaw_drift_rad);
  RandomStream odometry = flight.perception.odometry_random;  // a copy, to see where it stands
  draws.odometry.push_back(odometry.bits());
  add_vector(draws.imu, flight.perception.imu_state.gyro_bias);
  add_vector(draws.imu, flight.perception.imu_state.accelerometer_bias);
  add_vector(draws.imu, flight.perception.imu_state.accelerometer_turn_on);
  RandomStream imu = flight.perception.imu_random;
  draws.imu.push_back(imu.bits());
  draws.images.push_back(flight.perception.image_seed);
  for (const CameraGroup& group : flight.perception.cameras) {
    draws.images.push_back(static_cast<std::uint64_t>(group.image_index));
    draws.images.push_back(static_cast<std::uint64_t>(group.next_exposure));
  }
  return draws;
}

/// A planner that never has a plan, and so ignores all that it sees and is told.
struct Ignorant {
  TrialRecord record;
  std::vector<Draws> draws;
  std::vector<std::vector<float>> depth;
  std::vector<double> seen;  ///< times and states
};

World moving_world() {
  World world = test::flight_world();
  test::add_obstacle(world, test::box_mesh({1.0F, 1.0F, 4.0F}), {2.0, -11.0, 2.0}, "box");
  world.motions.push_back(
      {.instance = 1,
       .path = Sway{.amplitude_world = {1.0, 0.0, 0.0}, .period_s = 2.0, .phase = 0.1}});
  return world;
}

Ignorant flown_by_nobody(const ChangedTrial& trial, const Scene& scene) {
  Ignorant nobody;
  const Mission mission = test::straight_mission();
  Flight flight = begin_flight(trial.spec, scene, mission, planner().needs, nullptr, trial.flight);
  while (const PlannerView* view = next_plan(flight)) {
    nobody.draws.push_back(draws_of(flight));
    nobody.seen.insert(nobody.seen.end(), {view->call_time_s, view->time_s,
                                           view->position_world.x(), view->velocity_world.y()});
    for (const DepthView& image : view->depth) {
      nobody.depth.emplace_back(image.depth_m.begin(), image.depth_m.end());
      nobody.seen.push_back(image.time_s);
    }
    answer(flight, {.status = PlanStatus::no_plan, .reason = {}, .points = {}});
  }
  nobody.record = end_flight(std::move(flight));
  return nobody;
}

bool same_depth(const std::vector<std::vector<float>>& a,
                const std::vector<std::vector<float>>& b) {
  if (a.size() != b.size()) return false;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (a[i].size() != b[i].size()) return false;
    for (std::size_t k = 0; k < a[i].size(); ++k) {
      if (std::bit_cast<std::uint32_t>(a[i][k]) != std::bit_cast<std::uint32_t>(b[i][k]))
        return false;
    }
  }
  return true;
}

bool same_flight(const TrialRecord& a, const TrialRecord& b) {
  if (a.samples.size() > b.samples.size()) return same_flight(b, a);
  for (std::size_t i = 0; i + 1 < a.samples.size(); ++i) {
    const Sample& one = a.samples[i];
    const Sample& other = b.samples[i];
    if (one.position_world != other.position_world || one.velocity_world != other.velocity_world ||
        one.q_world_body.coeffs() != other.q_world_body.coeffs() ||
        one.rates_body_radps != other.rates_body_radps)
      return false;
  }
  return true;
}

class EachChange : public testing::TestWithParam<const Change*> {};

/// No change moves a draw of another source of noise, whatever it does to the flight.
TEST_P(EachChange, MovesNoDrawOfAnother) {
  const std::string name(GetParam()->name);
  std::string problem;
  const ChangedTrial changed = changed_by(name, problem);
  ASSERT_EQ(problem, "");
  const World world = moving_world();
  const Scene scene(world);
  const Ignorant before = flown_by_nobody({.spec = noisy_spec()}, scene);
  const Ignorant after = flown_by_nobody(changed, scene);
  ASSERT_EQ(before.draws.size(), 45U);
  ASSERT_EQ(after.draws.size(), name == "slower" ? 90U : 45U);
  for (std::size_t i = 0; i < before.draws.size(); ++i) {
    if (name != "no_wind") {
      ASSERT_EQ(before.draws[i].wind, after.draws[i].wind) << "call " << i;
    }
    if (name != "true_state") {
      ASSERT_EQ(before.draws[i].odometry, after.draws[i].odometry) << "call " << i;
    }
    ASSERT_EQ(before.draws[i].imu, after.draws[i].imu) << "call " << i;
    ASSERT_EQ(before.draws[i].images, after.draws[i].images) << "call " << i;
  }
}

/// Who ignores what is changed flies the same to the bit; the three others change the flight
/// itself.
TEST_P(EachChange, LeavesThoseThatIgnoreIt) {
  const std::string name(GetParam()->name);
  std::string problem;
  const World world = moving_world();
  const Scene scene(world);
  const Ignorant before = flown_by_nobody({.spec = noisy_spec()}, scene);
  const Ignorant after = flown_by_nobody(changed_by(name, problem), scene);
  const std::set<std::string> of_flight{"true_state", "no_wind", "perfect_tracking"};
  EXPECT_EQ(same_flight(before.record, after.record), !of_flight.contains(name));
  if (of_flight.contains(name) || name == "slower") return;
  EXPECT_EQ(before.seen, after.seen) << "times and states";
  const std::set<std::string> of_images{"true_depth", "wider_view", "longer_range",
                                        "still_obstacles"};
  EXPECT_EQ(same_depth(before.depth, after.depth), !of_images.contains(name));
  EXPECT_EQ(before.record.end_time_s, after.record.end_time_s);
}

/// The fields of the spec that differ.
std::set<std::string> differing_fields(const TrialSpec& a, const TrialSpec& b) {
  const nlohmann::json one = spec_to_json(a).flatten(), other = spec_to_json(b).flatten();
  std::set<std::string> fields;
  for (const auto& [path, value] : one.items()) {
    if (!other.contains(path) || other.at(path) != value) fields.insert(path);
  }
  for (const auto& [path, value] : other.items()) {
    if (!one.contains(path)) fields.insert(path);
  }
  return fields;
}

/// Whose latency is measured gets answers sooner; what is least already can't be halved.
TEST(Changes, TwiceTheComputeHalvesMeasuredLatencyAndTheBudgetsClock) {
  TrialRecord record;
  const PlannerDescription description = planner();
  const auto apply = changes_of({"twice_compute"}).front()->apply;
  ChangedTrial trial{.spec = noisy_spec()};
  trial.spec.latency.mode = LatencyMode::measured;
  trial.spec.latency.scale = 3.0;
  EXPECT_EQ(apply({record, description}, trial), "");
  EXPECT_EQ(trial.spec.latency.scale, 1.5);
  EXPECT_EQ(trial.spec.planner.parameters[2].number, 50.0);
  trial.spec.latency = {};
  trial.spec.planner.parameters[2].number = description.parameters.back().lowest;
  EXPECT_NE(apply({record, description}, trial), "");
}

TEST(Changes, ChangeTheseFieldsAndNoOthers) {
  const std::map<std::string, std::set<std::string>> expected{
      {"nothing", {}},
      {"no_latency", {"/latency/mode"}},
      {"true_state",
       {"/odometry/attitude_sigma_deg", "/odometry/delay_ms", "/odometry/position_drift_ratio",
        "/odometry/position_sigma_m", "/odometry/velocity_sigma_mps",
        "/odometry/yaw_drift_deg_per_sqrt_s"}},
      {"perfect_tracking", {}},
      {"twice_compute", {"/planner/parameters/2/number"}},
      {"slower",
       {"/mission/time_limit_s", "/planner/parameters/0/number", "/vehicle/max_speed_mps"}},
      {"wider_view", {"/sensor/fov_x_deg", "/sensor/width_px"}},
      {"longer_range", {"/sensor/max_range_m"}},
      {"still_obstacles", {}}};
  for (const auto& [name, fields] : expected) {
    std::string problem;
    EXPECT_EQ(differing_fields(noisy_spec(), changed_by(name, problem).spec), fields) << name;
    EXPECT_EQ(problem, "") << name;
  }
  std::string problem;
  for (const std::string& field :
       differing_fields(noisy_spec(), changed_by("true_depth", problem).spec)) {
    // The kind, and the fields that only the other kind has.
    EXPECT_TRUE(field.starts_with("/sensor/")) << field;
    EXPECT_FALSE(field.ends_with("_deg") || field.ends_with("_hz") || field.ends_with("_ms") ||
                 field.ends_with("range_m") || field == "/sensor/baseline_m")
        << field;
  }
  for (const std::string& field :
       differing_fields(noisy_spec(), changed_by("no_wind", problem).spec)) {
    EXPECT_TRUE(field.starts_with("/wind/")) << field;
  }
  const TrialSpec slower = changed_by("slower", problem).spec;
  EXPECT_EQ(slower.planner.parameters[0].number, 1.5);
  EXPECT_EQ(slower.vehicle.max_speed_mps, 4.0);
  EXPECT_EQ(slower.mission.time_limit_s, 3.0);
  const TrialSpec wider = changed_by("wider_view", problem).spec;
  EXPECT_NEAR(wider.sensor.fov_x_deg, 126.87, 0.01);
  EXPECT_NEAR(sensor_camera(wider.sensor).fx_px, sensor_camera(noisy_spec().sensor).fx_px, 1e-9);
}

TEST(Changes, AreNotApplicableWhereTheyChangeNothing) {
  TrialRecord record;
  record.plan_calls = {{.status = AB_OK, .command_kind = AB_COMMAND_RATES}};
  PlannerDescription blind = planner();
  blind.needs = AB_INPUT_STATE;
  TrialSpec plain;
  plain.latency.mode = LatencyMode::zero;
  for (const Change& change : changes()) {
    ChangedTrial trial{.spec = plain};
    const bool is_applicable = change.apply({record, blind}, trial).empty();
    EXPECT_EQ(is_applicable, change.name == kNoChange || change.name == "slower") << change.name;
  }
}

INSTANTIATE_TEST_SUITE_P(All, EachChange, testing::ValuesIn([] {
                           std::vector<const Change*> all;
                           for (const Change& change : changes()) all.push_back(&change);
                           return all;
                         }()),
                         [](const auto& of) { return std::string(of.param->name); });

/// Flies north along the line by velocity.
TrialRecord flown_north(const TrialSpec& spec, const Scene& scene, const FlightChange& change,
                        double speed_mps) {
  const Mission mission = test::straight_mission();
  Flight flight = begin_flight(spec, scene, mission, AB_INPUT_STATE, nullptr, change);
  while (next_plan(flight) != nullptr) {
    PlanResult result{.status = PlanStatus::command, .reason = {}, .points = {}};
    result.command.kind = AB_COMMAND_VELOCITY;
    result.command.velocity_world_mps[1] = speed_mps;
    result.command.yaw_rad = mission.start_yaw_rad;
    answer(flight, result);
  }
  return end_flight(std::move(flight));
}

TEST(StillObstacles, StandWhereTheyWereStruck) {
  World world = test::flight_world();
  test::add_obstacle(world, test::box_mesh({1.0F, 1.0F, 8.0F}), {2.5, 0.0, 4.0}, "box");
  // On the line at 5 s, when the vehicle passes there at 3 m/s; 2.5 m beside it at first.
  world.motions.push_back(
      {.instance = 1,
       .path = Sway{.amplitude_world = {-2.5, 0.0, 0.0}, .period_s = 21.0, .phase = 0.0}});
  const Scene scene(world);
  TrialSpec spec;
  spec.mission.time_limit_s = 20.0;
  const TrialRecord moving = flown_north(spec, scene, {}, 3.0);
  ASSERT_EQ(moving.outcome, Outcome::collided) << moving.reason;
  EXPECT_EQ(flown_north(spec, scene, {.still_at_s = 0.0}, 3.0).outcome, Outcome::reached_goal)
      << "as the flight begins it is out of the way";
  const TrialRecord still = flown_north(spec, scene, {.still_at_s = moving.end_time_s}, 3.0);
  ASSERT_EQ(still.outcome, Outcome::collided) << "who does not look hits it there, too";
  EXPECT_NEAR(still.end_time_s, moving.end_time_s, 0.02);
  EXPECT_TRUE(same_flight(moving, still));
}

TEST(PerfectTracking, IsWhereTheReferenceIs) {
  const World world = test::flight_world();
  const Scene scene(world);
  TrialSpec spec;
  spec.mission.time_limit_s = 20.0;
  spec.wind.mean_world_mps = {6.0, 0.0, 0.0};
  const auto farthest_m = [](const TrialRecord& record) {
    double most = 0.0;
    for (const Sample& sample : record.samples) {
      most = std::max(most, (sample.position_world - sample.reference_world).norm());
    }
    return most;
  };
  const TrialRecord pushed = flown_north(spec, scene, {}, 3.0);
  const TrialRecord perfect = flown_north(spec, scene, {.tracks_perfectly = true}, 3.0);
  EXPECT_GT(farthest_m(pushed), 0.05);
  EXPECT_LT(farthest_m(perfect), 1e-9);
  EXPECT_EQ(perfect.outcome, Outcome::reached_goal);
  // A drift of the odometry stays: the vehicle is where it believes to be on its reference.
  spec.odometry.position_drift_ratio = 0.1;
  const TrialRecord drifted = flown_north(spec, scene, {.tracks_perfectly = true}, 3.0);
  EXPECT_GT(farthest_m(drifted), 0.01);
}

}  // namespace
}  // namespace avoidbench
