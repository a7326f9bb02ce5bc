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

namespace avoidbench {
namespace {

using nlohmann::json;

json vector_to_json(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

Eigen::Vector3d vector_from_json(const json& v) {
  return {v.at(0).get<double>(), v.at(1).get<double>(), v.at(2).get<double>()};
}

json places_to_json(const Mission& mission) {
  return {{"start", vector_to_json(mission.start_world)},
          {"goal", vector_to_json(mission.goal_world)},
          {"start_yaw_rad", mission.start_yaw_rad}};
}

Mission places_from_json(const json& from) {
  return {.start_world = vector_from_json(from.at("start")),
          .goal_world = vector_from_json(from.at("goal")),
          .start_yaw_rad = from.at("start_yaw_rad")};
}

json mission_to_json(const MissionRecord& record) {
  json mission{
      {"index", record.index},
      // Of a mission that is not valid, these are NaN, for which JSON has no number.
      {"reference_length_m", number_to_json(record.reference_length_m)},
      {"traversability_obstruction", number_to_json(record.difficulty.traversability_obstruction)},
      {"view_occlusion", number_to_json(record.difficulty.view_occlusion)},
      {"angle_over_length_1pm", number_to_json(record.difficulty.angle_over_length_1pm)},
      {"is_valid", record.is_valid},
      {"invalid_reason", record.invalid_reason}};
  mission.update(places_to_json(record.mission));
  return mission;
}

MissionRecord mission_from_json(const json& from) {
  return {
      .index = from.at("index"),
      .mission = places_from_json(from),
      .reference_length_m = number_from_json(from.at("reference_length_m")),
      .difficulty = {.traversability_obstruction =
                         number_from_json(from.at("traversability_obstruction")),
                     .view_occlusion = number_from_json(from.at("view_occlusion")),
                     .angle_over_length_1pm = number_from_json(from.at("angle_over_length_1pm"))},
      .is_valid = from.at("is_valid"),
      .invalid_reason = from.at("invalid_reason")};
}

json map_to_json(const MapRecord& map) {
  json missions = json::array();
  for (const MissionRecord& mission : map.missions) missions.push_back(mission_to_json(mission));
  return {{"world_digest", map.world_digest},
          {"obstacle_count", map.obstacle_count},
          {"triangle_count", map.triangle_count},
          {"traversability", map.traversability},
          {"traversability_normalized_ratio", map.traversability_normalized_ratio},
          // NaN where no Poisson radius keeps the obstacles apart.
          {"relative_gap_size", number_to_json(map.relative_gap_size)},
          {"obstacle_density_1pm2", map.obstacle_density_1pm2},
          {"free_volume_ratio", map.free_volume_ratio},
          {"missions", missions}};
}

MapRecord map_from_json(const json& from) {
  // The worker knows no keys: who asked gives the map its own.
  MapRecord map{.key = {},
                .world_digest = from.at("world_digest"),
                .obstacle_count = from.at("obstacle_count"),
                .triangle_count = from.at("triangle_count"),
                .traversability = from.at("traversability"),
                .traversability_normalized_ratio = from.at("traversability_normalized_ratio"),
                .relative_gap_size = number_from_json(from.at("relative_gap_size")),
                .obstacle_density_1pm2 = from.at("obstacle_density_1pm2"),
                .free_volume_ratio = from.at("free_volume_ratio"),
                .missions = {}};
  for (const json& mission : from.at("missions"))
    map.missions.push_back(mission_from_json(mission));
  return map;
}

/// Samples go as bytes beside the JSON, which would take several times as much and long to read.
json trial_to_json(const TrialRecord& record) {
  json collisions = json::array();
  for (const Collision& collision : record.collisions) {
    // By position, not by name: trial_from_json() reads them in this order.
    collisions.push_back(
        {collision.time_s, collision.speed_mps, collision.obstacle, collision.kind});
  }
  return {{"outcome", std::string(text(record.outcome))},
          {"reason", record.reason},
          {"end_time_s", record.end_time_s},
          {"plan_calls", plan_calls_json(record.plan_calls)},
          {"collisions", collisions}};
}

TrialRecord trial_from_json(const json& from) {
  const auto outcome = enum_from_text<Outcome>(from.at("outcome").get<std::string>());
  TrialRecord record{.outcome = outcome.value(),
                     .reason = from.at("reason"),
                     .end_time_s = from.at("end_time_s"),
                     .samples = {},
                     .plan_calls = plan_calls_from_json(from.at("plan_calls").get<std::string>()),
                     .collisions = {}};
  for (const json& collision : from.at("collisions")) {
    record.collisions.push_back({.time_s = collision.at(0),
                                 .speed_mps = collision.at(1),
                                 .obstacle = collision.at(2),
                                 .kind = collision.at(3)});
  }
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
  JobResult result;
  result.token = message.json.at("token");
  result.error = message.json.at("error");
  result.wall_time_s = message.json.at("wall_time_s");
  result.is_out_of_memory = message.json.at("is_out_of_memory");
  result.world_digest = message.json.at("world_digest");
  std::span<const std::byte> samples = message.bytes;
  if (message.json.contains("reported")) {
    const auto begin = message.json.at("reported_from").get<std::size_t>();
    if (begin > samples.size()) throw InputError("the report lies outside the message");
    const std::span<const std::byte> reported = samples.subspan(begin);
    samples = samples.first(begin);
    result.reported = {.json = message.json.at("reported"),
                       .bytes = {reported.begin(), reported.end()}};
  }
  // The last sample is cut off.
  if (samples.size() % kSampleBytes != 0) throw InputError("half a sample");
  if (message.json.contains("map")) result.map = map_from_json(message.json.at("map"));
  if (message.json.contains("trial")) {
    result.trial = trial_from_json(message.json.at("trial"));
    result.trial->samples = samples_from_bytes(samples);
    for (const json& value : message.json.at("metrics")) {
      result.metrics.push_back(number_from_json(value));
    }
  }
  return result;
}

}  // namespace

Message record_message(const TrialRecord& record) {
  Message message{.json = trial_to_json(record), .bytes = sample_bytes(record.samples)};
  // NaN where a worker died.
  message.json["end_time_s"] = number_to_json(record.end_time_s);
  return message;
}

TrialRecord record_from(const Message& message) {
  json trial = message.json;
  const double end_time_s = number_from_json(trial.at("end_time_s"));
  trial["end_time_s"] = 0.0;
  TrialRecord record = trial_from_json(trial);
  record.end_time_s = end_time_s;
  record.samples = samples_from_bytes(message.bytes);
  return record;
}

Message job_message(const Job& job) {
  Message message;
  message.json["token"] = job.token;
  message.json["spec"] = spec_to_json(job.spec);
  message.json["mission_count"] = job.mission_count;
  json listed = json::array();
  for (const Mission& mission : job.listed_missions) listed.push_back(places_to_json(mission));
  message.json["listed_missions"] = listed;
  if (job.mission) message.json["mission"] = mission_to_json(*job.mission);
  if (job.recorded_latency_s) message.json["recorded_latency_s"] = *job.recorded_latency_s;
  if (job.change.tracks_perfectly) message.json["tracks_perfectly"] = true;
  if (job.change.still_at_s) message.json["still_at_s"] = *job.change.still_at_s;
  if (job.lookout) {
    message.json["lookout"] = {{"kind", job.lookout->kind},
                               {"wanted", job.lookout->wanted.json},
                               {"most_bytes", job.lookout->most_bytes},
                               {"has_flight", job.lookout->has_flight}};
    message.bytes = job.lookout->wanted.bytes;
  }
  return message;
}

Job job_from(const Message& message) {
  Job job{.token = message.json.at("token"),
          .spec = spec_from_json<TrialSpec>(message.json.at("spec")),
          .mission_count = message.json.at("mission_count"),
          .listed_missions = {},
          .mission = std::nullopt,
          .recorded_latency_s = std::nullopt,
          .change = {},
          .lookout = {}};
  if (const auto recorded = message.json.find("recorded_latency_s"); recorded != message.json.end())
    job.recorded_latency_s = recorded->get<std::vector<double>>();
  job.change.tracks_perfectly = message.json.value("tracks_perfectly", false);
  if (const auto still = message.json.find("still_at_s"); still != message.json.end())
    job.change.still_at_s = still->get<double>();
  if (const auto lookout = message.json.find("lookout"); lookout != message.json.end()) {
    job.lookout = {.kind = lookout->at("kind"),
                   .wanted = {.json = lookout->at("wanted"), .bytes = message.bytes},
                   .most_bytes = lookout->at("most_bytes"),
                   .has_flight = lookout->at("has_flight")};
  }
  for (const json& mission : message.json.at("listed_missions"))
    job.listed_missions.push_back(places_from_json(mission));
  if (message.json.contains("mission")) job.mission = mission_from_json(message.json.at("mission"));
  return job;
}

Message result_message(const JobResult& result) {
  Message message;
  message.json["token"] = result.token;
  message.json["error"] = result.error;
  message.json["wall_time_s"] = result.wall_time_s;
  message.json["is_out_of_memory"] = result.is_out_of_memory;
  message.json["world_digest"] = result.world_digest;
  if (result.map) message.json["map"] = map_to_json(*result.map);
  if (result.trial) {
    message.json["trial"] = trial_to_json(*result.trial);
    json metrics = json::array();
    for (const double value : result.metrics) metrics.push_back(number_to_json(value));
    message.json["metrics"] = metrics;
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
  } catch (const std::bad_optional_access&) {   // no outcome of ours
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
