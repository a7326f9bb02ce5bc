#include "conformance/conformance_flight.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <ctime>
#include <exception>
#include <iterator>
#include <limits>
#include <type_traits>

#include "base/math.hpp"
#include "conformance/wanted_commands.hpp"
#include "plugin/command_check.hpp"
#include "program_planner/program_planner.hpp"

namespace avoidbench {
namespace {

// The wall stands half-way to the goal, 12 m off; the gap beside the line is wide enough for the
// body, and the wall behind it is still within the camera's 15 m, so that the gap shows as depth,
// not as nothing.
constexpr double kWall_m = 6.0, kFarWall_m = 14.0, kGapFrom_m = 0.5, kGapTo_m = 2.5;
// Longer than any vector that a compiler writes at once. The value is one that no depth has.
constexpr std::size_t kFenceLength = 64;
constexpr float kFence = -12345.678F;

double clock_s(clockid_t clock) {
  timespec now{};
  clock_gettime(clock, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// CPU time of this process and, where the planner is one, of its program.
double used_cpu_s(const ab_planner& table, const void* instance) {
  const double own_s = clock_s(CLOCK_PROCESS_CPUTIME_ID);
  return own_s + (is_program_table(table) ? program_cpu_time_s(instance) : 0.0);
}

/// The depth image of the wall and the ground, seen by a level camera that looks along +x.
std::vector<float> wall_image(const CameraSetup& camera, const Eigen::Vector3d& eye_world) {
  std::vector<float> depth_m;
  for (int row = 0; row < camera.height_px; ++row) {
    for (int column = 0; column < camera.width_px; ++column) {
      // The camera looks along +x with RDF axes: columns grow to the right, rows downwards.
      const double left = -(column - camera.cx_px) / camera.fx_px;
      const double up = -(row - camera.cy_px) / camera.fy_px;
      double depth = kWall_m - eye_world.x();
      const double y = eye_world.y() + left * depth;
      if (y > kGapFrom_m && y < kGapTo_m) depth = kFarWall_m - eye_world.x();
      // Rows below the horizon meet the ground at z = 0 before the wall, if it is near enough.
      if (up < 0.0) depth = std::min(depth, -eye_world.z() / up);
      // As planner.h says of depth beyond the range: no return, not the range itself.
      depth_m.push_back(depth > camera.max_range_m ? std::numeric_limits<float>::infinity()
                                                   : static_cast<float>(depth));
    }
  }
  return depth_m;
}

/// How far the ground or the wall is from an eye along a unit vector; +inf: neither is met.
double wall_distance_m(const Eigen::Vector3d& eye_world, const Eigen::Vector3d& direction) {
  double distance_m = std::numeric_limits<double>::infinity();
  if (direction.x() > 0.0) {
    distance_m = (kWall_m - eye_world.x()) / direction.x();
    const double y = eye_world.y() + distance_m * direction.y();
    if (y > kGapFrom_m && y < kGapTo_m) distance_m = (kFarWall_m - eye_world.x()) / direction.x();
  }
  if (direction.z() < 0.0) distance_m = std::min(distance_m, -eye_world.z() / direction.z());
  return distance_m;
}

/// A sweep of a level lidar, one shot each 5°; `distance_m` gives how far each goes.
template <class Distance>
void sweep_lidar(const LidarSetup& lidar, Frame& frame, const Distance& distance_m) {
  constexpr int kColumns = 72, kRows = 13;
  frame.points.clear();
  frame.misses_lidar.clear();
  for (int i = 0; i < kColumns * kRows; ++i) {
    const int column = i / kRows - kColumns / 2, row = i % kRows - kRows / 2;
    const double azimuth_rad = column * math::kTau / kColumns;
    const double elevation_rad = row * math::kTau / kColumns;
    const double level = math::cos(elevation_rad);
    const Eigen::Vector3d direction(level * math::cos(azimuth_rad), level * math::sin(azimuth_rad),
                                    math::sin(elevation_rad));
    const double way_m = distance_m(direction);
    if (std::isnan(way_m)) continue;
    if (!(way_m <= lidar.max_range_m)) {
      frame.misses_lidar.emplace_back(direction.cast<float>());
      continue;
    }
    const Eigen::Vector3f place = (way_m * direction).cast<float>();
    frame.points.push_back({{place.x(), place.y(), place.z()}, 0.0F, 0.3F});
  }
}

/// From a place to the ground or the wall with its gap, as AB_WORLD_EXTENSION tells it.
double distance_to_wall_flight_m(const Eigen::Vector3d& place_world) {
  const double aside_m =
      std::max(0.0, std::min(place_world.y() - kGapFrom_m, kGapTo_m - place_world.y()));
  const double wall_m = Eigen::Vector2d(place_world.x() - kWall_m, aside_m).norm();
  constexpr double kFar_m = 2.5;
  return std::min({wall_m, std::abs(place_world.z()), kFar_m});
}

std::vector<Eigen::Vector3d> goals_of(const PlannerMission& mission) {
  return mission.goals_world.empty() ? std::vector{mission.goal_world} : mission.goals_world;
}

/// To the goal through the gap, or to several before the wall; a ball that is too large for the gap
/// has no way.
std::vector<Eigen::Vector3d> path_through_gap(const PlannerMission& mission, double radius_m) {
  if (2.0 * radius_m > kGapTo_m - kGapFrom_m) return {};
  if (mission.goals_world.size() > 1) {
    std::vector<Eigen::Vector3d> path = mission.goals_world;
    path.insert(path.begin(), mission.start_world);
    return path;
  }
  const Eigen::Vector3d gap(kWall_m, kGapFrom_m + radius_m, mission.start_world.z());
  const Eigen::Vector3d last_leg = (mission.goal_world - gap).normalized();
  return {mission.start_world, gap, mission.goal_world - mission.goal_radius_m * last_leg};
}

template <class Call>
std::string escaped_exception(Call&& call) {
  try {
    call();
  } catch (const std::exception& error) {
    return error.what();
  } catch (...) {
    return "not a std::exception";
  }
  return "";
}

/// A picture for planners that see light: near is bright. Each level `channels` times.
std::vector<std::uint8_t> painted(const std::vector<float>& depth_m, std::size_t channels) {
  std::vector<std::uint8_t> pixels;
  for (const float depth : depth_m) {
    const float level = depth > 0.0F ? 255.0F / (1.0F + depth) : 0.0F;  // 0 for +inf and NaN
    pixels.insert(pixels.end(), channels, static_cast<std::uint8_t>(std::min(level, 255.0F)));
  }
  return pixels;
}

/// A copy with a fence on either side, so that a write past the image shows.
std::vector<float> fenced(const std::vector<float>& pixels) {
  std::vector<float> copy(kFenceLength, kFence);
  copy.insert(copy.end(), pixels.begin(), pixels.end());
  copy.insert(copy.end(), kFenceLength, kFence);
  return copy;
}

/// Whether an array that was lent has other bytes now.
template <class Element>
bool has_changed(const Element* now, const std::vector<Element>& before) {
  static_assert(std::is_trivially_copyable_v<Element>);
  return !before.empty() && std::memcmp(now, before.data(), before.size() * sizeof(Element)) != 0;
}

std::string change_in(const std::vector<float>& now, const std::vector<float>& pixels) {
  const std::vector<float> before = fenced(pixels);
  if (std::memcmp(now.data() + kFenceLength, pixels.data(), pixels.size() * sizeof(float)) != 0) {
    return "it wrote into a depth image";
  }
  const bool same = std::memcmp(now.data(), before.data(), before.size() * sizeof(float)) == 0;
  return same ? "" : "it wrote past the ends of a depth image";
}

}  // namespace

PlannerSetup conformance_setup() {
  PlannerSetup setup;
  setup.max_speed_mps = 10.0;
  setup.max_acceleration_mps2 = 8.0;
  setup.max_yaw_rate_radps = 3.0;
  setup.body_size_m = {0.5, 0.5, 0.12};
  setup.plan_period_s = 1.0 / 30.0;
  setup.gravity_mps2 = 9.81;
  CameraSetup& camera = setup.cameras.emplace_back();
  camera.width_px = 160;
  camera.height_px = 120;
  // Half the width: a field of view of 90°. The centre lies between the two middle pixels, since
  // whole coordinates are pixel centres.
  camera.fx_px = camera.fy_px = 80.0;
  camera.cx_px = 79.5;
  camera.cy_px = 59.5;
  // From RDF (right, down, forward) to FLU (forward, left, up).
  camera.T_body_camera.linear() << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  // Place, rate, ranges, body and latency are those of the default sensor, vehicle and sweep.
  camera.T_body_camera.translation() << 0.2, 0.0, 0.05;
  camera.rate_hz = 30.0;
  camera.min_range_m = 0.1;
  camera.max_range_m = 15.0;
  camera.baseline_m = 0.1;
  LidarSetup& lidar = setup.lidars.emplace_back();
  lidar.T_body_lidar.translation() << 0.0, 0.0, 0.1;
  lidar.rate_hz = 10.0;
  lidar.min_range_m = 0.1;
  lidar.max_range_m = 15.0;
  lidar.lowest_elevation_rad = -math::kPi / 6;
  lidar.highest_elevation_rad = math::kPi / 6;
  lidar.shots = 936;
  return setup;
}

ConformanceFlight wall_flight() {
  const PlannerSetup setup = conformance_setup();
  ConformanceFlight flight;
  // Any seed: the rules only compare calls with each other.
  flight.mission.seed = 7;
  flight.mission.start_world = {0.0, 0.0, 2.0};
  flight.mission.goal_world = {12.0, 0.0, 2.0};
  flight.mission.goal_radius_m = 0.8;
  flight.mission.time_limit_s = 60.0;
  flight.mission.lowest_world = {-10.0, -20.0, 0.0};
  flight.mission.highest_world = {30.0, 20.0, 6.0};
  flight.mission.command_latency_s = 0.033;
  // Two thirds of a second at 30 Hz: a planner that maps has seen enough by then to give a command.
  for (int i = 0; i < 20; ++i) {
    Frame frame;
    frame.time_s = i * setup.plan_period_s;
    frame.velocity_world = {3.0, 0.0, 0.0};
    frame.position_world = flight.mission.start_world + frame.time_s * frame.velocity_world;
    const Eigen::Vector3d eye =
        frame.position_world + setup.cameras.front().T_body_camera.translation();
    frame.images.push_back(wall_image(setup.cameras.front(), eye));
    const LidarSetup& lidar = setup.lidars.front();
    const Eigen::Vector3d lidar_world = frame.position_world + lidar.T_body_lidar.translation();
    sweep_lidar(lidar, frame, [&](const Eigen::Vector3d& direction) {
      return wall_distance_m(lidar_world, direction);
    });
    // Somebody who comes toward it, 5 m away.
    frame.tracks.push_back({.id = 7,
                            .kind = AB_TRACK_PERSON,
                            .time_s = frame.time_s,
                            .center_world = frame.position_world + Eigen::Vector3d(5.0, 0.0, 0.0),
                            .velocity_world = {-1.0, 0.0, 0.0},
                            .size_m = {0.3, 0.5, 1.75}});
    flight.frames.push_back(std::move(frame));
  }
  return flight;
}

ConformanceFlight uniform_flight(float depth_m) {
  ConformanceFlight flight = wall_flight();
  for (Frame& frame : flight.frames) {
    for (std::vector<float>& image : frame.images) std::fill(image.begin(), image.end(), depth_m);
    sweep_lidar(conformance_setup().lidars.front(), frame,
                [depth_m](const Eigen::Vector3d&) { return static_cast<double>(depth_m); });
  }
  return flight;
}

bool equal(const Reply& a, const Reply& b) {
  const auto same_points = [&] {
    return a.points.size() == b.points.size() &&
           (a.points.empty() ||
            std::memcmp(a.points.data(), b.points.data(), a.points.size() * sizeof(ab_point)) == 0);
  };
  if (a.status != b.status) return false;
  if (a.status != AB_OK) return true;
  // Of a command that is none nothing is flown, so what else it holds may differ.
  // NOLINTNEXTLINE(bugprone-suspicious-memory-comparison): bytes that were copied, padding too
  return std::memcmp(&a.command, &b.command, sizeof(ab_command)) == 0 && same_points();
}

std::string reply_place(std::size_t index) {
  return index == 0 ? "reset" : "call " + std::to_string(index);
}

std::string first_difference(const std::vector<Reply>& a, const std::vector<Reply>& b) {
  if (a.size() != b.size() || a.empty()) return "create fails";
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (!equal(a[i], b[i])) return reply_place(i) + " gives another answer";
  }
  return "";
}

std::string reply_problem(const Reply& reply, const ab_planner& table) {
  if (!reply.escaped.empty()) return "an exception crossed the interface: " + reply.escaped;
  if (!reply.changed.empty()) return reply.changed;
  if (reply.status < AB_ERROR || reply.status > AB_GIVE_UP) {
    return "it returned " + std::to_string(reply.status) + ", which is no status";
  }
  if (reply.status == AB_ERROR && reply.error.empty()) {
    return "it returned AB_ERROR without a text for set_error";
  }
  if (reply.status != AB_OK || !reply.is_plan) return "";
  // The reply keeps no pointer into the planner's memory; the check needs one to its own copy.
  ab_command command = reply.command;
  command.points = reply.points.empty() ? nullptr : reply.points.data();
  return command_problem(command, table.commands);
}

Probe::Probe(const ab_planner& table, const std::vector<ParameterValue>& values, bool poisoned,
             Looking looking, const PlannerSetup& setup)
    : table_(&table),
      poisoned_(poisoned),
      is_asking_(looking == Looking::asking),
      setup_(setup),
      host_(looking != Looking::impossible, table.needs) {
  host_.want_drawings(looking == Looking::somebody);
  SetupBuffers buffers(setup_, values, table.needs);
  const std::string escaped =
      escaped_exception([&] { instance_ = table_->create(&host_.table(), &buffers.setup()); });
  if (poisoned_) buffers.poison();
  const std::string error = host_.take_error();
  if (!escaped.empty()) {
    problem_ = "an exception crossed create: " + escaped;
  } else if (instance_ == nullptr) {
    problem_ = error.empty() ? "create returned null without a text for set_error"
                             : "create failed: " + error;
  }
}

Probe::~Probe() {
  // What destroy() throws has no place to be told; it must not end the host either.
  if (instance_ != nullptr) escaped_exception([this] { table_->destroy(instance_); });
}

Reply Probe::reset(const PlannerMission& mission) {
  mission_ = mission;
  call_count_ = 0;
  // Goals that are overwritten after the call.
  PlannerMission lent = mission;
  lent.goals_world = goals_of(mission);
  ab_mission given = to_mission(lent);
  const ab_mission before = given;
  host_.show_world(
      {.distance_m = distance_to_wall_flight_m, .shortest_path_world = [mission](double radius_m) {
         return path_through_gap(mission, radius_m);
       }});
  Reply reply;
  reply.escaped = escaped_exception([&] { reply.status = table_->reset(instance_, &given); });
  // NOLINTNEXTLINE(bugprone-suspicious-memory-comparison): bytes that were copied, padding too
  bool is_same = std::memcmp(&given, &before, sizeof given) == 0;
  const std::vector<Eigen::Vector3d> goals = goals_of(mission);
  for (std::size_t i = 0; i < goals.size(); ++i) {
    const std::size_t bytes = sizeof(Eigen::Vector3d);
    // NOLINTNEXTLINE(bugprone-suspicious-memory-comparison): the same bits, whatever they mean
    is_same = is_same && std::memcmp(lent.goals_world[i].data(), goals[i].data(), bytes) == 0;
    // Rubbish, not zeros: a start at the origin is zeros, too.
    if (poisoned_) std::memset(lent.goals_world[i].data(), 0xA7, bytes);
  }
  if (!is_same) reply.changed = "it wrote into the mission";
  if (poisoned_) std::memset(&given, 0xA7, sizeof given);
  reply.error = host_.take_error();
  return reply;
}

/// Its pixels and points lie in buffers of the probe's, until the next one.
PlannerView Probe::view_of(const Frame& frame) {
  // Not freed: a late read must find what was overwritten, not a crash.
  std::move(pixels_.begin(), pixels_.end(), std::back_inserter(old_pixels_));
  pixels_.clear();
  for (const std::vector<float>& image : frame.images) pixels_.push_back(fenced(image));
  PlannerView view;
  view.time_s = view.call_time_s = frame.time_s;
  view.position_world = frame.position_world;
  view.velocity_world = frame.velocity_world;
  // Level and without rotation, as the pictures are drawn.
  view.rates_body.setZero();
  view.q_world_body.setIdentity();
  grey_.clear();
  rgb_.clear();
  for (const std::vector<float>& image : frame.images) {
    grey_.push_back(painted(image, 1));
    rgb_.push_back(painted(image, 3));
  }
  for (std::size_t i = 0; i < pixels_.size(); ++i) {
    const std::uint32_t camera = frame.camera_of(i);
    const Eigen::Isometry3d T_world_camera =
        Eigen::Translation3d(frame.position_world) * setup_.cameras[camera].T_body_camera;
    const auto depth_m =
        std::span<const float>(pixels_[i]).subspan(kFenceLength, frame.images[i].size());
    view.depth.push_back({frame.time_s, T_world_camera, camera, depth_m});
    view.stereo.push_back({frame.time_s, T_world_camera, camera, grey_[i], grey_[i]});
    view.color.push_back({frame.time_s, T_world_camera, camera, rgb_[i]});
  }
  view.states.push_back(static_cast<const StateView&>(view));
  view.reference = ReferenceView{.position_world = frame.position_world,
                                 .velocity_world = frame.velocity_world,
                                 .acceleration_world = Eigen::Vector3d::Zero(),
                                 .jerk_world = Eigen::Vector3d::Zero()};
  view.goal = frame.goal.value_or(GoalView{.index = 0, .place_world = mission_.goal_world});
  view.tracks = frame.tracks;
  // Specific force at rest: what an accelerometer measures is up, against gravity.
  view.imu.push_back({frame.time_s, Eigen::Vector3d::Zero(), {0.0, 0.0, 9.81}});
  points_ = frame.points;
  misses_lidar_ = frame.misses_lidar;
  for (int sweep = 0; sweep < frame.sweep_count; ++sweep) {
    for (std::size_t i = 0; i < setup_.lidars.size(); ++i) {
      view.clouds.push_back({.time_s = frame.time_s - sweep / setup_.lidars[i].rate_hz,
                             .T_world_lidar = Eigen::Translation3d(frame.position_world) *
                                              setup_.lidars[i].T_body_lidar,
                             .lidar = static_cast<std::uint32_t>(i),
                             .points = points_,
                             .misses_lidar = misses_lidar_});
    }
  }
  return view;
}

Reply Probe::plan(const Frame& frame) {
  const PlannerView view = view_of(frame);
  // The observation holds pointers alone, so what it points to is compared apart.
  const PlanResult wanted =
      frame.wanted.value_or(wanted_in_turn(frame, table_->commands, call_count_++));
  const ab_observation& observation =
      observation_.fill(view, setup_.cameras, table_->needs, {}, &wanted);
  const ab_observation before = observation;
  const ab_state state_before = *observation.state;
  const std::vector<ab_track> tracks_before(observation.tracks,
                                            observation.tracks + observation.track_count);
  std::vector<ab_command> wanted_before;  // one or none
  if (observation.wanted != nullptr) wanted_before.push_back(*observation.wanted);

  Reply reply;
  reply.is_plan = true;
  reply.command.struct_size = static_cast<std::uint32_t>(sizeof(ab_command));
  const double wall_before_s = clock_s(CLOCK_MONOTONIC);
  const double cpu_before_s = used_cpu_s(*table_, instance_);
  reply.escaped = escaped_exception(
      [&] { reply.status = table_->plan(instance_, &observation, &reply.command); });
  reply.cpu_time_s = used_cpu_s(*table_, instance_) - cpu_before_s;
  reply.wall_time_s = clock_s(CLOCK_MONOTONIC) - wall_before_s;
  // NOLINTBEGIN(bugprone-suspicious-memory-comparison): bytes that were copied, padding too
  const bool same = std::memcmp(&before, &observation, sizeof before) == 0 &&
                    std::memcmp(&state_before, observation.state, sizeof state_before) == 0;
  // NOLINTEND(bugprone-suspicious-memory-comparison)
  if (!same) reply.changed = "it wrote into the observation or the state";
  for (std::size_t i = 0; i < pixels_.size() && reply.changed.empty(); ++i) {
    reply.changed = change_in(pixels_[i], frame.images[i]);
  }
  if (reply.changed.empty() &&
      (has_changed(points_.data(), frame.points) || misses_lidar_ != frame.misses_lidar)) {
    reply.changed = "it wrote into a lidar's sweep";
  }
  if (reply.changed.empty() && has_changed(observation.tracks, tracks_before)) {
    reply.changed = "it wrote into the tracks";
  }
  if (reply.changed.empty() && !wanted_before.empty() &&
      (has_changed(observation.wanted, wanted_before) ||
       has_changed(wanted_before.front().points, wanted.points))) {
    reply.changed = "it wrote into the wanted command";
  }
  // A count that can't be true is not followed: reply_problem() names it, reading would crash.
  const bool has_points = reply.status == AB_OK && reply.command.kind == AB_COMMAND_TRAJECTORY &&
                          reply.command.points != nullptr &&
                          reply.command.point_count <= kMostTrajectoryPoints;
  if (has_points) {
    reply.points.assign(reply.command.points, reply.command.points + reply.command.point_count);
  }
  // Two instances' arrays lie elsewhere, so equal replies must not differ by their addresses.
  reply.command.points = nullptr;
  reply.error = host_.take_error();
  if (poisoned_) {
    observation_.poison();
    // A wall at 1 cm; the rubbish of the other buffers would be no depth (-5e-15).
    for (std::vector<float>& image : pixels_) std::fill(image.begin(), image.end(), 0.01F);
    std::fill(points_.begin(), points_.end(), ab_lidar_point{{0.01F, 0.0F, 0.0F}, 0.0F, 0.0F});
    for (Eigen::Vector3f& miss : misses_lidar_) miss = {-1.0F, 0.0F, 0.0F};
  }
  return reply;
}

std::string Probe::ask_map(const Eigen::Vector3d& around_world) {
  if (table_->get_extension == nullptr) return "";
  std::string problem;
  const std::string escaped = escaped_exception([&] {
    const auto* map =
        static_cast<const ab_map*>(table_->get_extension(instance_, AB_MAP_EXTENSION));
    if (map == nullptr) return;
    if (map->struct_size < sizeof(ab_map) || map->look_up == nullptr) {
      problem = "its " AB_MAP_EXTENSION " is shorter than that, or has no look_up";
      return;
    }
    std::vector<double> points;
    // Behind, beside and before it, and as far as no map goes.
    for (const double way_m : {-1.0, 0.0, 0.5, 1.0, 2.0, 4.0, 1e6}) {
      const Eigen::Vector3d place = around_world + Eigen::Vector3d(way_m, 0.1 * way_m, 0.0);
      points.insert(points.end(), {place.x(), place.y(), place.z()});
    }
    const std::size_t count = points.size() / 3;
    constexpr std::uint8_t kNoAnswer = 0xA7;
    // One more than asked for: what lies behind is not the planner's.
    std::vector<std::uint8_t> places(count + 1, kNoAnswer);
    const ab_status status =
        map->look_up(instance_, points.data(), static_cast<std::uint32_t>(count), places.data());
    host_.take_error();
    if (status == AB_ERROR) return;  // it can't say
    if (status != AB_OK) problem = "look_up returned " + std::to_string(status);
    if (places.back() != kNoAnswer) problem = "look_up wrote past the places";
    places.pop_back();
    if (*std::max_element(places.begin(), places.end()) > AB_PLACE_OCCUPIED) {
      problem = "look_up gave a place that is no AB_PLACE_…";
    }
  });
  return escaped.empty() ? problem : "an exception crossed look_up: " + escaped;
}

std::vector<Reply> Probe::fly(const ConformanceFlight& flight) {
  std::vector<Reply> replies;
  replies.push_back(reset(flight.mission));
  if (is_asking_) replies.back().map_problem = ask_map(flight.mission.start_world);
  for (const Frame& frame : flight.frames) {
    replies.push_back(plan(frame));
    if (is_asking_) replies.back().map_problem = ask_map(frame.position_world);
  }
  return replies;
}

}  // namespace avoidbench
