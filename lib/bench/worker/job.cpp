#include "worker/job.hpp"

#include <sys/random.h>

#include <array>
#include <cerrno>
#include <span>
#include <string_view>

#include "base/check.hpp"
#include "base/input_error.hpp"
#include "base/spec_json.hpp"
#include "metrics/metric_table.hpp"
#include "store/record_format.hpp"
#include "trial/periods.hpp"

/// A list of three numbers.
template <>
struct avoidbench::detail::IsSequence<Eigen::Vector3d> : std::true_type {};

namespace avoidbench {

// Between parent and worker only: no person reads these names, so they have no docs.
template <class Visitor, ConstOr<Mission> M>
void visit(Visitor& v, M& m) {
  v.field("start_world", m.start_world);
  v.field("goal_world", m.goal_world);
  v.field("start_yaw_rad", m.start_yaw_rad);
  v.field("waypoints_world", m.waypoints_world);
}

template <class Visitor, ConstOr<MissionDifficulty> M>
void visit(Visitor& v, M& m) {
  v.field("traversability_obstruction", m.traversability_obstruction);
  v.field("view_occlusion", m.view_occlusion);
  v.field("angle_over_length_1pm", m.angle_over_length_1pm);
}

template <class Visitor, ConstOr<MissionRecord> M>
void visit(Visitor& v, M& m) {
  v.field("index", m.index);
  v.field("mission", m.mission);
  v.field("reference_length_m", m.reference_length_m);
  v.field("leg_lengths_m", m.leg_lengths_m);
  v.field("difficulty", m.difficulty);
  v.field("is_valid", m.is_valid);
  v.field("invalid_reason", m.invalid_reason);
}

/// Without its key: who asked for the map knows it.
template <class Visitor, ConstOr<MapRecord> M>
void visit(Visitor& v, M& m) {
  v.field("world_digest", m.world_digest);
  v.field("obstacle_count", m.obstacle_count);
  v.field("triangle_count", m.triangle_count);
  v.field("traversability", m.traversability);
  v.field("traversability_normalized_ratio", m.traversability_normalized_ratio);
  v.field("relative_gap_size", m.relative_gap_size);
  v.field("obstacle_density_1pm2", m.obstacle_density_1pm2);
  v.field("free_volume_ratio", m.free_volume_ratio);
  v.field("missions", m.missions);
}

template <class Visitor, ConstOr<Collision> C>
void visit(Visitor& v, C& c) {
  v.field("time_s", c.time_s);
  v.field("speed_mps", c.speed_mps);
  v.field("obstacle", c.obstacle);
  v.field("kind", c.kind);
}

/// Without samples and calls: see trial_json().
template <class Visitor, ConstOr<TrialRecord> R>
void visit(Visitor& v, R& r) {
  v.field("outcome", r.outcome);
  v.field("reason", r.reason);
  v.field("end_time_s", r.end_time_s);
  v.field("collisions", r.collisions);
}

template <class Visitor, ConstOr<FlightChange> C>
void visit(Visitor& v, C& c) {
  v.field("tracks_perfectly", c.tracks_perfectly);
  v.field("still_at_s", c.still_at_s);
}

/// Bytes go beside.
template <class Visitor, ConstOr<LookoutJob> L>
void visit(Visitor& v, L& l) {
  v.field("kind", l.kind);
  v.field("wanted", l.wanted.json);
  v.field("most_bytes", l.most_bytes);
  v.field("has_flight", l.has_flight);
  v.field("has_pieces", l.has_pieces);
}

template <class Visitor, ConstOr<Job> J>
void visit(Visitor& v, J& j) {
  v.field("token", j.token);
  v.field("spec", j.spec);
  v.field("mission_count", j.mission_count);
  v.field("listed_missions", j.listed_missions);
  v.field("mission", j.mission);
  v.field("recorded_latency_s", j.recorded_latency_s);
  v.field("change", j.change);
  v.field("lookout", j.lookout);
}

/// Without flight and report, part of which goes as bytes.
template <class Visitor, ConstOr<JobResult> R>
void visit(Visitor& v, R& r) {
  v.field("token", r.token);
  v.field("map", r.map);
  v.field("metrics", r.metrics);
  v.field("world_digest", r.world_digest);
  v.field("wall_time_s", r.wall_time_s);
  v.field("error", r.error);
  v.field("is_out_of_memory", r.is_out_of_memory);
}

namespace {

using nlohmann::json;

/// Samples go as bytes beside the JSON, calls as their stored text: as fields they would take
/// several times as much and long to read.
json trial_json(const TrialRecord& record) {
  json trial = spec_to_json(record);
  trial["plan_calls"] = plan_calls_json(record.plan_calls);
  return trial;
}

TrialRecord trial_from(const json& trial, std::span<const std::byte> samples) {
  auto record = spec_from_json<TrialRecord>(trial, true);
  record.plan_calls = plan_calls_from_json(trial.at("plan_calls").get<std::string>());
  // The last sample is cut off.
  if (samples.size() % kSampleBytes != 0) throw InputError("half a sample");
  record.samples = samples_from_bytes(samples);
  return record;
}

/// Whether the answer has what the job asks for, and as much of it.
bool answers(const JobResult& result, const Job& job) {
  // Else it is another job's answer, or none of the worker's own.
  if (result.token != job.token) return false;
  // An error is an answer, whatever else is missing.
  if (!result.error.empty()) return true;
  if (job.lookout && !result.reported) return false;
  if (job.lookout && !job.lookout->has_flight) return true;
  if (job.mission) return result.trial && result.metrics.size() == metric_table().size();
  const auto count = static_cast<std::size_t>(job.mission_count);
  if (!result.map || result.map->missions.size() != count) return false;
  // Missions are looked up by their place: it has to be their index.
  for (std::size_t i = 0; i < count; ++i) {
    if (result.map->missions[i].index != static_cast<std::int64_t>(i)) return false;
  }
  return true;
}

/// Throws what nlohmann::json throws at the first part that is missing or of another type.
JobResult parsed(const Message& message) {
  auto result = spec_from_json<JobResult>(message.json, true);
  std::span<const std::byte> samples = message.bytes;
  if (message.json.contains("reported")) {
    const auto begin = message.json.at("reported_from").get<std::size_t>();
    if (begin > samples.size()) throw InputError("the report lies outside the message");
    const std::span<const std::byte> reported = samples.subspan(begin);
    samples = samples.first(begin);
    result.reported = {.json = message.json.at("reported"),
                       .bytes = {reported.begin(), reported.end()}};
  }
  if (message.json.contains("trial")) {
    result.trial = trial_from(message.json.at("trial"), samples);
  }
  return result;
}

}  // namespace

Message piece_message(const std::string& token, Message piece) {
  piece.json["piece_of"] = token;
  return piece;
}

bool is_piece_of(const Message& message, const Job& job) {
  const auto of = message.json.find("piece_of");
  return job.lookout && job.lookout->has_pieces && of != message.json.end() && *of == job.token;
}

Message record_message(const TrialRecord& record) {
  return {.json = trial_json(record), .bytes = sample_bytes(record.samples)};
}

TrialRecord record_from(const Message& message) { return trial_from(message.json, message.bytes); }

Message job_message(const Job& job) {
  return {.json = spec_to_json(job),
          .bytes = job.lookout ? job.lookout->wanted.bytes : std::vector<std::byte>{}};
}

Job job_from(const Message& message) {
  Job job = spec_from_json<Job>(message.json, true);
  if (job.lookout) job.lookout->wanted.bytes = message.bytes;
  return job;
}

Message result_message(const JobResult& result) {
  Message message{.json = spec_to_json(result), .bytes = {}};
  if (result.trial) {
    message.json["trial"] = trial_json(*result.trial);
    message.bytes = sample_bytes(result.trial->samples);
  }
  if (result.reported) {
    message.json["reported"] = result.reported->json;
    message.json["reported_from"] = message.bytes.size();
    message.bytes.insert(message.bytes.end(), result.reported->bytes.begin(),
                         result.reported->bytes.end());
  }
  return message;
}

std::optional<JobResult> result_from(const Message& message, const Job& job) {
  try {
    JobResult result = parsed(message);
    if (answers(result, job)) return result;
  } catch (const nlohmann::json::exception&) {  // a part is missing or of another type
  } catch (const InputError&) {                 // samples or calls that can't be read
  }
  return std::nullopt;
}

std::size_t most_result_bytes(const Job& job) {
  constexpr double kRest = 16.0 * 1024 * 1024;  // reasons, collisions, a map
  constexpr double kMission = 2000.0, kPlanCall = 300.0, kSpare = 1.1;
  const double time_s = job.spec.mission.time_limit_s;
  const double of_flight =
      time_s * ((job.spec.rates.sample_hz + kJerkRate_hz) * static_cast<double>(kSampleBytes) +
                job.spec.rates.plan_hz * kPlanCall);
  const double of_map = static_cast<double>(job.mission_count) * kMission;
  const std::size_t of_lookout = job.lookout ? job.lookout->most_bytes : 0;
  return static_cast<std::size_t>(kRest + kSpare * (of_flight + of_map)) + of_lookout;
}

std::string make_token() {
  std::array<unsigned char, 16> drawn{};
  AB_CHECK(::getrandom(drawn.data(), drawn.size(), 0) == static_cast<ssize_t>(drawn.size()), errno);
  constexpr std::string_view kDigits = "0123456789abcdef";
  std::string token;
  for (const unsigned char byte : drawn) {
    token += kDigits[byte >> 4U];
    token += kDigits[byte & 15U];
  }
  return token;
}

}  // namespace avoidbench
