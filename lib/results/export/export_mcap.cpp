#include "export/export_mcap.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

#include "base/number_text.hpp"
#include "export/cdr_writer.hpp"
#include "export/flight_messages.hpp"
#include "export/ros2_schema.hpp"
#include "plugin/command_check.hpp"
#include "sweep/sweep_spec.hpp"
#include "trial/goals.hpp"
#include "trial/planner_view.hpp"
#include "worker/byte_transfer.hpp"

namespace avoidbench {
namespace {

/// How often the poses of movers are written.
constexpr double kMoving_hz = 20.0;

/// rcl_interfaces/msg/Log.
constexpr std::uint8_t kInfo = 20, kWarning = 30, kError = 40;

std::string status_text(const PlanCall& call) {
  switch (call.status) {
    case AB_OK:
      return command_kind_text(call.command_kind);
    case AB_NO_PLAN:
      return "no_plan";
    case AB_GIVE_UP:
      return "gave_up";
    default:
      return "error";
  }
}

/// The last sample not after `time`; the first where all are.
const Sample& sample_at(const std::vector<Sample>& samples, McapTime time) {
  const auto after = std::upper_bound(
      samples.begin(), samples.end(), time,
      [](McapTime t, const Sample& sample) { return t < mcap_time(sample.time_s); });
  return after == samples.begin() ? *after : *std::prev(after);
}

/// A yaw, or a yaw rate, as twists and accelerations have it: the rate about z.
RosVector3 turning(const ab_command& command) {
  const bool is_rate = (command.flags & AB_YAW_IS_RATE) != 0;
  return {.x = 0.0, .y = 0.0, .z = is_rate ? command.yaw_rate_radps : 0.0};
}

double longest_delay_s(const TrialSpec& spec) {
  double delay_ms = spec.odometry.delay_ms;
  for (const CameraSpec& camera : camera_kinds(spec.sensor)) {
    delay_ms = std::max(delay_ms, camera.delay_ms);
  }
  for (const LidarSpec& lidar : spec.sensor.lidars) delay_ms = std::max(delay_ms, lidar.delay_ms);
  return 1e-3 * delay_ms;
}

McapTexts metadata_of(const McapFlight& flight) {
  const TrialRow& row = flight.stored.row;
  const TrialSpec& spec = flight.stored.spec;
  return {{"trial_key", row.key},
          {"sweep", row.sweep},
          {"planner", row.planner_label},
          {"planner_digest", row.planner_file_digest},
          {"vehicle", spec.vehicle.name},
          {"sensor", spec.sensor.name},
          {"world_digest", flight.stored.world_digest},
          {"map_seed", std::to_string(spec.map_seed)},
          {"mission", std::to_string(row.mission_index)},
          {"outcome", std::string(text(row.record.outcome))},
          {"reason", row.record.reason},
          {"end_time_s", shortest(row.record.end_time_s)},
          {"result_version", std::to_string(kResultVersion)},
          {"program", flight.program},
          {"time_base", "simulated, 0 at the start of the flight"}};
}

}  // namespace

McapExport::McapExport(const McapFlight& flight, std::ostream& stream)
    : flight_(flight),
      setup_(planner_setup(flight.stored.spec)),
      writer_(stream, "ros2", flight.program),
      moments_(),
      goal_times_s_(goal_times_s(flight.stored.spec.mission, flight.stored.mission,
                                 flight.stored.row.record)),
      longest_delay_(mcap_time(longest_delay_s(flight.stored.spec))) {
  moments_ = stored_moments();
  writer_.write_metadata("avoidbench", metadata_of(flight_));
}

std::vector<McapExport::Moment> McapExport::stored_moments() const {
  const TrialRecord& record = flight_.stored.row.record;
  std::vector<Moment> moments{{0, Stored::begin, 0}, {0, Stored::goal, 0}};
  McapTime last = 0;
  const auto add = [&](double time_s, Stored kind, std::size_t index) {
    if (!std::isfinite(time_s)) return;
    moments.push_back({mcap_time(time_s), kind, index});
    last = std::max(last, moments.back().time);
  };
  for (std::size_t i = 0; i < record.samples.size(); ++i) {
    add(record.samples[i].time_s, Stored::sample, i);
  }
  for (std::size_t i = 0; i < record.plan_calls.size(); ++i) {
    add(record.plan_calls[i].time_s, Stored::call, i);
  }
  for (std::size_t i = 0; i < record.collisions.size(); ++i) {
    add(record.collisions[i].time_s, Stored::contact, i);
  }
  for (std::size_t i = 0; i < goal_times_s_.size(); ++i) {
    add(goal_times_s_[i], Stored::goal, i + 1);
  }
  // Where the end is not known it is that of what is.
  add(record.end_time_s, Stored::end, 0);
  if (!std::isfinite(record.end_time_s)) moments.push_back({last, Stored::end, 0});
  const bool moves = (flight_.world != nullptr && !flight_.world->motions.empty()) ||
                     flight_.stored.spec.mission.goal_motion.path != GoalPath::none;
  for (std::size_t i = 0; moves; ++i) {
    const double time_s = static_cast<double>(i) / kMoving_hz;
    if (mcap_time(time_s) > last) break;
    moments.push_back({mcap_time(time_s), Stored::tick, i});
  }
  std::sort(moments.begin(), moments.end(), [](const Moment& a, const Moment& b) {
    return std::tie(a.time, a.kind, a.index) < std::tie(b.time, b.kind, b.index);
  });
  return moments;
}

template <class Message>
std::uint16_t McapExport::channel(const std::string& topic) {
  const auto known = channels_.find(topic);
  if (known != channels_.end()) return known->second;
  const McapSchema schema{Message::kName, "ros2msg", ros2_definition<Message>()};
  return channels_[topic] = writer_.add_channel(topic, schema, "cdr");
}

template <class Message>
void McapExport::write(const std::string& topic, McapTime time, const Message& message) {
  writer_.write(channel<Message>(topic), time, cdr_bytes(message));
}

template <class Message>
void McapExport::keep(const std::string& topic, double time_s, const Message& message) {
  const McapTime time = mcap_time(time_s);
  // Nothing of a call is older than the longest delay, and the calls come in their order.
  TransferReader::require(time >= written_until_);
  waiting_.emplace(time, Waiting{channel<Message>(topic), cdr_bytes(message)});
}

void McapExport::add(const FlownPiece& piece) {
  const bool is_next = last_piece_ ? piece.number == *last_piece_ + 1 : piece.number == 0;
  // Views and answers by turns; else there could be any number of them.
  const bool is_in_turn = (piece.kind == PieceKind::view) == (piece.number % 2 == 0);
  const bool is_in_time = piece.kind == PieceKind::view && last_piece_
                              ? piece.time_s > last_call_s_
                              : piece.time_s >= last_call_s_;
  TransferReader::require(is_next && is_in_turn && is_in_time);
  last_piece_ = piece.number;
  last_call_s_ = piece.time_s;
  if (piece.kind == PieceKind::view) {
    add_view(piece);
  } else {
    add_answer(piece);
    const McapTime now = mcap_time(piece.time_s);
    if (now > longest_delay_) write_until(now - longest_delay_ - 1);
  }
}

void McapExport::finish() {
  write_until(std::numeric_limits<McapTime>::max());
  writer_.finish();
}

/// Everything up to this moment, itself included, in order of time; of the same time first what is
/// stored.
void McapExport::write_until(McapTime time) {
  written_until_ = time;
  while (true) {
    const bool has_stored = next_moment_ < moments_.size() && moments_[next_moment_].time <= time;
    const auto waiting = waiting_.begin();
    const bool has_waiting = waiting != waiting_.end() && waiting->first <= time;
    if (!has_stored && !has_waiting) return;
    if (has_stored && (!has_waiting || moments_[next_moment_].time <= waiting->first)) {
      write_stored(moments_[next_moment_++]);
    } else {
      writer_.write(waiting->second.channel, waiting->first, waiting->second.data);
      waiting_.erase(waiting);
    }
  }
}

void McapExport::write_stored(const Moment& moment) {
  const TrialRecord& record = flight_.stored.row.record;
  switch (moment.kind) {
    case Stored::begin:
      return write_begin(moment.time);
    case Stored::sample:
      return write_sample(record.samples[moment.index], moment.time);
    case Stored::call:
      return write_call(record.plan_calls[moment.index], moment.time);
    case Stored::contact:
      return write_contact(record.collisions[moment.index], moment.time);
    case Stored::goal:
      return write_goal(moment.index, moment.time);
    case Stored::tick:
      return write_tick(moment.time);
    case Stored::end:
      return write_end(moment.time);
  }
}

void McapExport::write_begin(McapTime time) {
  const TrialRecord& record = flight_.stored.row.record;
  RosTransforms mountings;
  const auto add_mounting = [&](const std::string& frame, const Pose& T_body_sensor) {
    mountings.transforms.push_back(ros_transform(kBodyFrame, frame, time,
                                                 T_body_sensor.translation(),
                                                 Eigen::Quaterniond(T_body_sensor.linear())));
  };
  for (std::size_t i = 0; i < setup_.cameras.size(); ++i) {
    add_mounting(camera_frame(i), setup_.cameras[i].T_body_camera);
  }
  for (std::size_t i = 0; i < setup_.lidars.size(); ++i) {
    add_mounting(lidar_frame(i), setup_.lidars[i].T_body_lidar);
  }
  write("/tf_static", time, mountings);
  RosMarker body = ros_marker(kBodyFrame, time, "vehicle", 0, MarkerType::cube);
  body.scale = ros_vector(setup_.body_size_m);
  body.color = {.r = 0.10F, .g = 0.40F, .b = 0.90F, .a = 1.0F};
  write("/vehicle", time, body);
  RosPath path = ros_path(record.samples);
  path.header = ros_header(kMapFrame, time);
  write("/path", time, path);
  if (flight_.world == nullptr) return;
  write("/map", time,
        ros_map(*flight_.world, time, record.samples, kMostMcapTriangles, left_out_triangles_));
  if (!flight_.world->motions.empty()) write("/movers", time, ros_movers(*flight_.world, time));
}

void McapExport::write_sample(const Sample& sample, McapTime time) {
  write("/tf", time,
        RosTransforms{{ros_transform(kMapFrame, kBodyFrame, time, sample.position_world,
                                     sample.q_world_body)}});
  write("/odometry", time,
        ros_odometry(time, sample.position_world, sample.q_world_body, sample.velocity_world,
                     sample.rates_body_radps));
  RosAccelStamped acceleration{.header = ros_header(kMapFrame, time)};
  acceleration.accel.linear = ros_vector(sample.acceleration_world);
  write("/acceleration", time, acceleration);
  write("/clearance_m", time, RosFloat64{sample.clearance_m});
  write("/rotor_power_w", time, RosFloat64{sample.rotor_power_w});
  if (!sample.reference_world.allFinite()) return;
  write("/reference", time,
        RosPointStamped{ros_header(kMapFrame, time), ros_point(sample.reference_world)});
}

void McapExport::write_call(const PlanCall& call, McapTime time) {
  write("/planner/status", time, RosString{status_text(call)});
  write("/planner/cpu_time_s", time, RosFloat64{call.cpu_time_s});
}

void McapExport::write_contact(const Collision& contact, McapTime time) {
  write_event(time, kWarning, "contact",
              contact.kind + " (obstacle " + std::to_string(contact.obstacle) + ") touched at " +
                  fixed_digits(contact.speed_mps, 2) + " m/s");
  const std::vector<Sample>& samples = flight_.stored.row.record.samples;
  if (samples.empty()) return;
  RosMarker marker = ros_marker(kMapFrame, time, "contact", 0, MarkerType::sphere);
  marker.pose.position = ros_point(sample_at(samples, time).position_world);
  marker.scale = ros_vector(Eigen::Vector3d::Constant(1.5 * setup_.body_size_m.maxCoeff()));
  marker.color = {.r = 1.0F, .g = 0.1F, .b = 0.1F, .a = 0.6F};
  write("/contacts", time, marker);
}

/// `index` goals are reached; the next one is the goal.
void McapExport::write_goal(std::size_t index, McapTime time) {
  const std::size_t count = flight_.stored.mission.waypoints_world.size() + 1;
  if (index > 0) {
    write_event(time, kInfo, "goal",
                "goal " + std::to_string(index) + " of " + std::to_string(count) + " reached");
  }
  if (index == count) return;
  RosPoseStamped goal{.header = ros_header(kMapFrame, time)};
  goal.pose.position = ros_point(goal_place(flight_.stored.spec.mission, flight_.stored.mission,
                                            index, 1e-9 * static_cast<double>(time)));
  write("/goal", time, goal);
}

void McapExport::write_tick(McapTime time) {
  const StoredTrial& stored = flight_.stored;
  if (stored.spec.mission.goal_motion.path != GoalPath::none) {
    const auto reached = static_cast<std::size_t>(
        std::count_if(goal_times_s_.begin(), goal_times_s_.end(),
                      [time](double time_s) { return mcap_time(time_s) <= time; }));
    const std::size_t last = stored.mission.waypoints_world.size();
    RosPoseStamped goal{.header = ros_header(kMapFrame, time)};
    goal.pose.position =
        ros_point(goal_place(stored.spec.mission, stored.mission, std::min(reached, last),
                             1e-9 * static_cast<double>(time)));
    write("/goal", time, goal);
  }
  if (flight_.world == nullptr || flight_.world->motions.empty()) return;
  write("/tf", time, RosTransforms{ros_mover_transforms(*flight_.world, time)});
}

void McapExport::write_end(McapTime time) {
  const TrialRecord& record = flight_.stored.row.record;
  const bool is_reached = record.outcome == Outcome::reached_goal;
  write_event(time, is_reached ? kInfo : kError, std::string(text(record.outcome)), record.reason);
}

void McapExport::write_event(McapTime time, std::uint8_t level, const std::string& name,
                             const std::string& text) {
  write("/events", time,
        RosLog{.stamp = ros_time(time), .level = level, .name = name, .msg = text});
}

void McapExport::add_view(const FlownPiece& piece) {
  const StateView& state = piece.state;
  keep("/planner/odometry", state.time_s,
       ros_odometry(mcap_time(state.time_s), state.position_world, state.q_world_body,
                    state.velocity_world, state.rates_body));
  for (const SeenImu& sample : piece.imu) keep("/imu", sample.time_s, ros_imu(sample));
  for (const SeenPicture& picture : piece.pictures) add_picture(picture);
  for (const SeenCloud& cloud : piece.clouds) {
    keep("/" + lidar_frame(cloud.lidar) + "/points", cloud.time_s, ros_sweep(cloud));
  }
}

void McapExport::add_picture(const SeenPicture& picture) {
  constexpr std::array<const char*, 4> kNames{"depth", "left", "right", "color"};
  const CameraSetup& camera = setup_.cameras[picture.camera];
  const std::string topic = "/camera_" + std::to_string(picture.camera) + '/' +
                            kNames[static_cast<std::size_t>(picture.kind)];
  keep(topic + "/image", picture.time_s, ros_image(picture, camera));
  keep(topic + "/camera_info", picture.time_s, ros_camera_info(picture, camera));
  if (picture.kind != PictureKind::depth) return;
  keep(topic + "/points", picture.time_s, ros_depth_points(picture, camera));
}

void McapExport::add_answer(const FlownPiece& piece) {
  const RosTime stamp = ros_time(mcap_time(piece.time_s));
  for (const std::string& line : piece.log) {
    keep("/planner/log", piece.time_s,
         RosLog{.stamp = stamp, .level = kInfo, .name = "planner", .msg = line});
  }
  if (piece.status == PlanStatus::command) add_command(piece);
}

void McapExport::add_command(const FlownPiece& piece) {
  const ab_command& command = piece.command;
  const double time_s = piece.time_s;
  const RosHeader in_map = ros_header(kMapFrame, mcap_time(time_s));
  const RosHeader in_body = ros_header(kBodyFrame, mcap_time(time_s));
  switch (command.kind) {
    case AB_COMMAND_POSITION:
      return keep("/command/position", time_s,
                  RosPoseStamped{in_map,
                                 {ros_point(to_vector(command.position_world_m)),
                                  ros_quaternion(yaw_rotation(command.yaw_rad))}});
    case AB_COMMAND_VELOCITY:
      return keep(
          "/command/velocity", time_s,
          RosTwistStamped{in_map,
                          {ros_vector(to_vector(command.velocity_world_mps)), turning(command)}});
    case AB_COMMAND_ACCELERATION:
      return keep(
          "/command/acceleration", time_s,
          RosAccelStamped{in_map, {ros_vector(to_vector(command.acceleration_world_mps2)), {}}});
    case AB_COMMAND_TRAJECTORY:
      keep("/command/path", time_s, ros_command_path(piece));
      return keep("/command/trajectory", time_s, ros_command_trajectory(piece));
    case AB_COMMAND_RATES:
      keep("/command/rates", time_s,
           RosTwistStamped{in_body, {{}, ros_vector(to_vector(command.rates_body_radps))}});
      return keep("/command/thrust", time_s,
                  RosAccelStamped{in_body, {{.z = command.thrust_mps2}, {}}});
    default:
      return TransferReader::require(false);
  }
}

}  // namespace avoidbench
