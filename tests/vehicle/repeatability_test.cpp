#include <gtest/gtest.h>

#include <cstring>
#include <thread>
#include <vector>

#include "base/math.hpp"
#include "base/random.hpp"
#include "geometry/pose.hpp"
#include "support/flights.hpp"

namespace avoidbench {
namespace {

using Eigen::Vector3d;

void append(std::vector<double>& log, const VehicleState& s) {
  for (int i = 0; i < 3; ++i) log.push_back(s.position_world[i]);
  for (int i = 0; i < 3; ++i) log.push_back(s.velocity_world[i]);
  for (int i = 0; i < 3; ++i) log.push_back(s.rates_body[i]);
  for (int i = 0; i < 4; ++i) log.push_back(s.q_world_body.coeffs()[i]);
  for (int i = 0; i < s.rotor_speed_radps.size(); ++i) log.push_back(s.rotor_speed_radps[i]);
}

/// A flight whose commands of all kinds are drawn from the seed.
std::vector<double> random_flight(const VehicleSpec& spec, std::uint64_t seed) {
  const VehicleModel model = make_model(spec);
  RandomStream random = stream(seed, "flight");
  VehicleState state = hovering_at(spec, {0, 0, 5}, 0.3);
  Tracker tracker = make_tracker(model, state);
  std::vector<double> log;
  const auto any = [&](double size) {
    const double x = random.uniform(-size, size);
    const double y = random.uniform(-size, size);
    const double z = random.uniform(-size, size);
    return Vector3d(x, y, z);
  };
  Environment environment;
  environment.wind_world_mps = any(2.0);
  for (int i = 0; i < 3000; ++i) {
    if (i % 150 == 0) {
      Command command = circle(2, 3, 3, 0.1);
      command.kind = static_cast<CommandKind>(random.below(5));
      command.position_world = any(5.0);
      command.velocity_world = any(4.0);
      command.acceleration_world = any(3.0);
      command.rates_body_radps = any(1.0);
      command.thrust_mps2 = 10.0;
      command.yaw_rad = random.uniform(-3.0, 3.0);
      command.start_tick = state.tick;
      accept(tracker, model, command, state);
    }
    const RotorVector rotors = track(tracker, model, state);
    state = step(model, state, rotors, environment, kTicksPerMillisecond);
    append(log, state);
  }
  return log;
}

bool same_bits(const std::vector<double>& a, const std::vector<double>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0;
}

TEST(Repeatability, SameBitsTwiceAndInThreads) {
  for (const VehicleSpec& spec : {hummingbird_spec(), firefly_spec()}) {
    const std::vector<double> first = random_flight(spec, 5);
    EXPECT_TRUE(same_bits(first, random_flight(spec, 5)));
    EXPECT_FALSE(same_bits(first, random_flight(spec, 6)));
    std::vector<std::vector<double>> logs(4);
    std::vector<std::thread> threads;
    for (auto& log : logs) threads.emplace_back([&log, &spec] { log = random_flight(spec, 5); });
    for (std::thread& thread : threads) thread.join();
    for (const auto& log : logs) EXPECT_TRUE(same_bits(first, log));
    for (const double value : first) ASSERT_TRUE(std::isfinite(value));
  }
}

TEST(Repeatability, SteppingManyBesideEachOtherIsSteppingOne) {
  const VehicleModel model = make_model(hummingbird_spec());
  std::vector<VehicleState> batch(8, hovering_at(model.spec, {0, 0, 0}, 0));
  for (std::size_t k = 0; k < batch.size(); ++k) {
    batch[k].rates_body = {static_cast<double>(k), 1, 0};
  }
  VehicleState alone = batch[5];
  const RotorVector command = all_rotors(model, 500.0);
  for (int i = 0; i < 500; ++i) {
    for (VehicleState& state : batch) state = step(model, state, command, {}, kTicksPerMillisecond);
    alone = step(model, alone, command, {}, kTicksPerMillisecond);
  }
  std::vector<double> a, b;
  append(a, batch[5]);
  append(b, alone);
  EXPECT_TRUE(same_bits(a, b));
}

/// The world turned about z and moved.
struct Moved {
  Eigen::Quaterniond turn;
  double yaw_rad;
  Vector3d shift;

  Vector3d point(const Vector3d& p) const { return turn * p + shift; }
  Vector3d direction(const Vector3d& d) const { return turn * d; }
};

Command moved(Command command, const Moved& world) {
  command.position_world = world.point(command.position_world);
  command.velocity_world = world.direction(command.velocity_world);
  command.acceleration_world = world.direction(command.acceleration_world);
  command.yaw_rad += world.yaw_rad;
  for (TrajectoryPoint& point : command.trajectory) {
    point.position_world = world.point(point.position_world);
    point.velocity_world = world.direction(point.velocity_world);
    point.acceleration_world = world.direction(point.acceleration_world);
    point.yaw_rad += world.yaw_rad;
  }
  return command;
}

TEST(Repeatability, TurningAndMovingTheWorldTurnsAndMovesTheFlight) {
  const Moved world{yaw_rotation(1.1), 1.1, {3, -2, 1}};
  for (const VehicleSpec& spec : {hummingbird_spec(), hummingbird_rotors_spec(), firefly_spec()}) {
    const VehicleModel model = make_model(spec);
    Command acceleration = fly_at({0, 0, 0}, -0.2);
    acceleration.kind = CommandKind::acceleration;
    acceleration.acceleration_world = {1, 2, 0.5};
    for (const Command& command :
         {go_to({6, -3, 4}, 0.9), fly_at({2, 3, 0.5}, -0.4), acceleration, circle(2, 2, 4, 0.1)}) {
      const VehicleState start = hovering_at(spec, {2, 0, 2}, 0.3);
      VehicleState other = start;
      other.position_world = world.point(start.position_world);
      other.q_world_body = world.turn * start.q_world_body;
      std::vector<VehicleState> here, there;
      fly(model, start, command, 3,
          [&](const Tracker&, const VehicleState& s) { here.push_back(s); });
      fly(model, other, moved(command, world), 3,
          [&](const Tracker&, const VehicleState& s) { there.push_back(s); });
      double worst = 0;
      for (std::size_t i = 0; i < here.size(); ++i) {
        worst =
            std::max(worst, (world.point(here[i].position_world) - there[i].position_world).norm());
        worst = std::max(worst, (here[i].rates_body - there[i].rates_body).norm());
      }
      EXPECT_LT(worst, 1e-9) << spec.name << ' ' << text(command.kind);
    }
  }
}

}  // namespace
}  // namespace avoidbench
