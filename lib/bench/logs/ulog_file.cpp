#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>

#include "base/number_text.hpp"
#include "base/words.hpp"
#include "logs/log_readers.hpp"
#include "logs/ulog_format.hpp"

// The format: https://docs.px4.io/main/en/dev_log/ulog_file_format.html. The file says itself what
// fields a topic's messages have, so that logs of all versions of PX4 are read.
namespace avoidbench {
namespace {

constexpr std::size_t kMostUlogSubscriptions = 10'000;
/// PX4 logs attitudes at 5 Hz and more. Where they are farther apart some are missing.
constexpr std::int64_t kMostAttitudeGap_ns = 500'000'000;

/// What can be read, the first that has messages where no topic is chosen.
const std::vector<std::string>& vehicle_topics() {
  static const std::vector<std::string> kTopics{"vehicle_local_position",
                                                "vehicle_odometry",
                                                "estimator_local_position",
                                                "estimator_odometry",
                                                "vehicle_visual_odometry",
                                                "vehicle_mocap_odometry",
                                                "vehicle_local_position_groundtruth"};
  return kTopics;
}

/// Of a topic of positions, the one that has its attitudes.
std::string attitude_topic(std::string_view position_topic) {
  return replaced(position_topic, std::array{std::pair{std::string_view("local_position"),
                                                       std::string_view("attitude")}});
}

/// Where the fields of one topic's messages stand, as far as they are there.
struct PoseFields {
  std::optional<UlogField> time, position, x, y, z, q, velocity, vx, vy, vz;
  std::optional<UlogField> frame, old_frame, velocity_frame;
  std::vector<UlogField> valid, velocity_valid, resets;
};

PoseFields pose_fields(const UlogFormats& formats, const std::string& type) {
  const auto field = [&](std::string_view name, std::size_t count = 1) {
    const std::optional<UlogField> found = formats.field(type, name);
    return found && found->count >= count ? found : std::nullopt;
  };
  const auto fields = [&](std::initializer_list<std::string_view> names) {
    std::vector<UlogField> found;
    for (const std::string_view name : names) {
      if (const auto one = field(name)) found.push_back(*one);
    }
    return found;
  };
  // Odometry had x, y, z before PX4 1.14 and has position since; positions still have x, y, z.
  return {.time = field("timestamp"),
          .position = field("position", 3),
          .x = field("x"),
          .y = field("y"),
          .z = field("z"),
          .q = field("q", 4),
          .velocity = field("velocity", 3),
          .vx = field("vx"),
          .vy = field("vy"),
          .vz = field("vz"),
          .frame = field("pose_frame"),
          .old_frame = field("local_frame"),
          .velocity_frame = field("velocity_frame"),
          .valid = fields({"xy_valid", "z_valid"}),
          .velocity_valid = fields({"v_xy_valid", "v_z_valid"}),
          .resets = fields({"reset_counter", "xy_reset_counter", "z_reset_counter"})};
}

std::optional<Eigen::Vector3d> vector_of(std::string_view data, const std::optional<UlogField>& all,
                                         const std::optional<UlogField>& x,
                                         const std::optional<UlogField>& y,
                                         const std::optional<UlogField>& z) {
  if (all) return Eigen::Vector3d(all->in(data, 0), all->in(data, 1), all->in(data, 2));
  if (x && y && z) return Eigen::Vector3d(x->in(data), y->in(data), z->in(data));
  return std::nullopt;
}

Eigen::Quaterniond attitude_of(std::string_view data, const UlogField& q) {
  return {q.in(data, 0), q.in(data, 1), q.in(data, 2), q.in(data, 3)};
}

std::int64_t time_of(std::string_view data, const PoseFields& fields) {
  constexpr double kMost_us = 9e15;  // 285 years, and exact as a double
  if (!fields.time) throw BadMessage("a topic without the field timestamp");
  const double time_us = fields.time->in(data);
  if (time_us > kMost_us) throw BadMessage("its time is beyond all bounds");
  return static_cast<std::int64_t>(time_us) * 1000;
}

bool all_set(std::string_view data, const std::vector<UlogField>& fields) {
  return std::all_of(fields.begin(), fields.end(),
                     [&](const UlogField& field) { return field.in(data) != 0.0; });
}

/// The pose of one message, in a frame with z up.
LoggedPose logged_pose(std::string_view data, const PoseFields& fields) {
  LoggedPose pose;
  pose.time_ns = time_of(data, fields);
  const auto position = vector_of(data, fields.position, fields.x, fields.y, fields.z);
  if (!position) throw BadMessage("a topic without a position");
  pose.position = *position;
  if (!all_set(data, fields.valid)) pose.position.setConstant(LoggedPose::kNone);
  if (fields.q) pose.q = attitude_of(data, *fields.q);
  pose.velocity = vector_of(data, fields.velocity, fields.vx, fields.vy, fields.vz);
  if (pose.velocity && !all_set(data, fields.velocity_valid)) {
    pose.velocity->setConstant(LoggedPose::kNone);
  }
  // pose_frame: 1 North-East-Down, 2 Forward-Right-Down; local_frame before PX4 1.14: 0 and 1.
  const bool is_frd = (fields.frame && fields.frame->in(data) == 2.0) ||
                      (fields.old_frame && fields.old_frame->in(data) == 1.0);
  const bool has_body_velocity = fields.velocity_frame && fields.velocity_frame->in(data) == 3.0;
  return with_z_up(pose, is_frd, has_body_velocity);
}

struct Attitude {
  std::int64_t time_ns = 0;
  Eigen::Quaterniond q;  ///< NED from FRD
};

/// Gives each pose the attitude at its time, between the two logged before and after it.
void join_attitudes(std::vector<RecordedPose>& poses, const std::vector<Attitude>& attitudes) {
  auto after = attitudes.begin();
  for (RecordedPose& pose : poses) {
    while (after != attitudes.end() && after->time_ns < pose.time_ns) ++after;
    if (after == attitudes.end()) break;
    if (after->time_ns == pose.time_ns) {
      pose.q = enu_from_flu(after->q);
    } else if (after != attitudes.begin()) {
      const Attitude& before = *std::prev(after);
      const std::int64_t gap_ns = after->time_ns - before.time_ns;
      if (gap_ns > kMostAttitudeGap_ns) continue;
      const double part =
          static_cast<double>(pose.time_ns - before.time_ns) / static_cast<double>(gap_ns);
      pose.q = enu_from_flu(before.q.slerp(part, after->q));
    }
  }
}

/// A topic as the log's messages refer to it.
struct Subscription {
  std::string topic;
  std::size_t index = 0;  ///< of the topic in the builder
  bool is_first = true;   ///< of several instances; the others are not read
  std::optional<PoseFields> fields;
  std::vector<double> resets;  ///< the counters of the last message
};

class UlogReader {
 public:
  UlogReader(ByteReader& in, FlightBuilder& flight) : in_(in), flight_(flight) {}

  void read() {
    in_.skip(16);  // magic, version, when it began
    try {
      while (!in_.at_end()) read_ulog_record();
    } catch (const CutOff&) {
      finish();
      throw;
    }
    finish();
  }

 private:
  void read_ulog_record() {
    const std::uint64_t position = in_.position();
    // Where a log goes on that was closed before it was whole: what stands before may be cut off.
    if (appended_position_ > position && appended_position_ < position + 3) return go_to_appended();
    const auto size = in_.number<std::uint16_t>();
    const auto kind = in_.number<char>();
    if (size == 0 && kind == 0) in_.damaged_unless_zeros(position, "a message of the kind 0");
    constexpr std::string_view kKinds = "BFIMPQARDLCSO";
    if (kKinds.find(kind) == kKinds.npos) {
      in_.damaged(position, "a message of an unknown kind");
    }
    if (appended_position_ > position && in_.position() + size > appended_position_) {
      return go_to_appended();
    }
    if (std::string_view("BFADO").find(kind) == std::string_view::npos) return in_.skip(size);
    const std::string data = in_.text(size);
    try {
      read_ulog_message(kind, data);
    } catch (const BadMessage& bad) {
      in_.damaged(position, bad.what());
    }
  }

  void go_to_appended() {
    in_.skip(appended_position_ - in_.position());
    appended_position_ = 0;
  }

  void read_ulog_message(char kind, std::string_view data) {
    switch (kind) {
      case 'B':
        return read_flags(data);
      case 'F':
        return formats_.add(data);
      case 'A':
        return subscribe(data);
      case 'O':
        if (data.size() < 2) throw BadMessage("a gap without its length");
        lost_ms_ += load_ulog<std::uint16_t>(data, 0);
        ++lost_count_;
        return;
      default:
        return read_data(data);
    }
  }

  void read_flags(std::string_view data) {
    constexpr std::size_t kBytes = 8 + 8 + 3 * 8, kIncompatible = 8, kAppended = 16;
    if (data.size() < kBytes) throw BadMessage("the log's flags are too short");
    const auto incompatible = load_ulog<std::uint64_t>(data, kIncompatible);
    // The first means that there are appended data.
    if (incompatible > 1) throw BadMessage("the log uses features that this program does not know");
    if (incompatible == 1) appended_position_ = load_ulog<std::uint64_t>(data, kAppended);
  }

  void subscribe(std::string_view data) {
    if (data.size() < 3) throw BadMessage("a subscription that is too short");
    if (subscriptions_.size() >= kMostUlogSubscriptions) {
      throw BadMessage("more than 10000 subscriptions");
    }
    const auto instance = load_ulog<std::uint8_t>(data, 0);
    const auto id = load_ulog<std::uint16_t>(data, 1);
    const std::string topic(data.substr(3));
    Subscription& its = subscriptions_[id];
    its = {.topic = topic,
           .index = flight_.topic(topic, ""),
           .is_first = instance == 0,
           .fields = {},
           .resets = {}};
    const auto& topics = vehicle_topics();
    const bool is_attitude = std::any_of(topics.begin(), topics.end(), [&](const auto& name) {
      return name != topic && attitude_topic(name) == topic;
    });
    if (its.is_first && (is_attitude || contains(topics, topic))) {
      its.fields = pose_fields(formats_, topic);
    }
  }

  void read_data(std::string_view data) {
    if (data.size() < 2) throw BadMessage("a message without its topic");
    const auto place = subscriptions_.find(load_ulog<std::uint16_t>(data, 0));
    if (place == subscriptions_.end()) throw BadMessage("a message of a topic that is not known");
    Subscription& its = place->second;
    if (!its.is_first) return;
    const bool is_wanted = flight_.wants_message(its.index);
    if (!its.fields) return;
    data.remove_prefix(2);
    if (is_wanted) {
      flight_.add(logged_pose(data, *its.fields));
      count_resets(data, its);
    } else if (!contains(vehicle_topics(), its.topic) && its.fields->q) {
      add_attitude(its.topic, {time_of(data, *its.fields), attitude_of(data, *its.fields->q)});
    }
  }

  void add_attitude(const std::string& topic, const Attitude& attitude) {
    constexpr std::size_t kMostAttitudes = 2'000'000, kFewAttitudes = std::size_t{1} << 16U;
    std::vector<Attitude>& all = attitudes_[topic];
    if (!is_attitude(attitude.q) || (!all.empty() && attitude.time_ns <= all.back().time_ns))
      return;
    if (++attitude_count_ > kMostAttitudes) throw BadMessage("more than 2000000 attitudes");
    if (all.size() == kFewAttitudes) all.reserve(kMostAttitudes);  // as FlightBuilder::add() does
    all.push_back(attitude);
  }

  void count_resets(std::string_view data, Subscription& its) {
    std::vector<double> counters;
    for (const UlogField& counter : its.fields->resets) counters.push_back(counter.in(data));
    reset_counts_[its.topic] += !its.resets.empty() && its.resets != counters ? 1 : 0;
    its.resets = std::move(counters);
  }

  void finish() {
    const std::string topic(flight_.chosen_topic());
    if (const std::string attitude = attitude_topic(topic); attitude != topic) {
      join_attitudes(flight_.poses(), attitudes_[attitude]);
      if (attitudes_[attitude].empty() && !topic.empty()) {
        flight_.warn("the log has no " + attitude + ": the flight is without attitudes");
      }
    }
    if (const std::int64_t count = reset_counts_[topic]; count > 0) {
      flight_.warn("the estimate jumped " + counted(count, "time") + " (" + topic +
                   " counts its resets): the path jumps there, too");
    }
    if (lost_count_ > 0) {
      flight_.warn("the logger lost data " + counted(lost_count_, "time") + ", " +
                   fixed_digits(static_cast<double>(lost_ms_) * 1e-3, 3) + " s in all");
    }
  }

  ByteReader& in_;
  FlightBuilder& flight_;
  UlogFormats formats_;
  std::map<std::uint16_t, Subscription> subscriptions_;
  std::map<std::string, std::vector<Attitude>> attitudes_;  ///< by topic
  std::uint64_t appended_position_ = 0;                     ///< 0: nothing was appended
  std::size_t attitude_count_ = 0;                          ///< of all topics
  std::int64_t lost_count_ = 0, lost_ms_ = 0;
  std::map<std::string, std::int64_t> reset_counts_;  ///< of the estimate, by topic
};

}  // namespace

void read_ulog(ByteReader& in, FlightBuilder& flight) {
  flight.set_format("ULog");
  flight.prefer(vehicle_topics());
  UlogReader(in, flight).read();
}

}  // namespace avoidbench
