#include "replay/explained_trial.hpp"

#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "base/input_error.hpp"
#include "explain/explain.hpp"

namespace avoidbench {
namespace {

// A job's spec does not hold it: it follows from the planner's file, which a worker may not have.
constexpr const char* kPlannerNeeds = "planner_needs";

/// What the lookout needs: the flight as it is stored, and where it is flown again what its planner
/// declares.
LookoutJob cause_wanted(const StoredTrial& stored, std::optional<std::uint32_t> planner_needs) {
  constexpr std::size_t kMostBytes = 1U << 20U;
  Message wanted = record_message(stored.row.record);
  if (planner_needs) wanted.json[kPlannerNeeds] = *planner_needs;
  return {.kind = kCauseLookout,
          .wanted = std::move(wanted),
          .most_bytes = kMostBytes,
          .has_flight = planner_needs.has_value()};
}

std::optional<std::uint32_t> planner_needs_of(const LookoutJob& job) {
  const auto needs = job.wanted.json.find(kPlannerNeeds);
  if (needs == job.wanted.json.end()) return std::nullopt;
  return needs->get<std::uint32_t>();
}

/// A flight as it is stored, and who watches it flown again; it stays at its address.
struct WatchedFlight {
  WatchedFlight(const Job& job, const World& flown_world)
      : spec(job.spec),
        mission(*job.mission),
        world(flown_world),
        record(record_from(job.lookout->wanted)),
        planner_needs(planner_needs_of(*job.lookout)),
        patch(struck_patch(world, record)) {
    if (job.lookout->has_flight && patch) watch.emplace(spec, record.samples, *patch);
  }
  WatchedFlight(const WatchedFlight&) = delete;
  WatchedFlight& operator=(const WatchedFlight&) = delete;

  Message report(const TrialRecord* flown) const {
    std::vector<std::string> found;
    if (flown != nullptr && watch) found = differences(record, *flown);
    const bool is_watched = flown != nullptr && watch && found.empty();
    const CauseFound cause = explained({.spec = spec,
                                        .world = world,
                                        .mission = mission.mission,
                                        .record = record,
                                        .reference_length_m = mission.reference_length_m,
                                        .planner_needs = planner_needs},
                                       patch ? &*patch : nullptr, is_watched ? &*watch : nullptr);
    nlohmann::json told{{"cause", std::string(text(cause.cause))},
                        {"facts", facts_json(cause.facts)}};
    if (!found.empty()) told["difference"] = found.front();
    return {.json = std::move(told), .bytes = {}};
  }

  const TrialSpec& spec;
  const MissionRecord& mission;
  const World& world;
  TrialRecord record;
  std::optional<std::uint32_t> planner_needs;
  std::optional<StruckPatch> patch;
  std::optional<FlightWatch> watch;
};

/// A worker's answer, whose memory its planner shares.
ExplainedTrial explanation_from(const Message& told, const std::vector<std::string>& notes) {
  ExplainedTrial found;
  try {
    const auto cause = enum_from_text<Cause>(told.json.at("cause").get<std::string>());
    found.explanation.facts = facts_from_json(told.json.at("facts").get<std::string>());
    found.explanation.cause = cause.value();
    if (told.json.contains("difference")) {
      found.warnings.push_back("flown again it differs from the stored trial: " +
                               told.json.at("difference").get<std::string>());
      found.warnings.insert(found.warnings.end(), notes.begin(), notes.end());
    }
  } catch (const std::exception& error) {
    found = {.explanation = {},
             .warnings = {std::string("its worker's answer can't be read: ") + error.what()}};
  }
  return found;
}

}  // namespace

Lookout cause_lookout(const Job& job, const World& world) {
  const auto flight = std::make_shared<WatchedFlight>(job, world);
  Lookout lookout;
  if (flight->watch) {
    lookout.observer.planned = [flight](const PlanStep& step) { flight->watch->planned(step); };
  }
  lookout.report = [flight](const TrialRecord* flown) { return flight->report(flown); };
  return lookout;
}

CauseJob cause_job(StoredTrial stored, ReplayPlanners& planners) {
  if (!needs_watch(stored.row.record)) {
    return cause_job_without_flight(std::move(stored), planners.files());
  }
  StoredFlight flight = stored_flight(std::move(stored), planners);
  CauseJob cause{.job = std::move(flight.job),
                 .stored = std::move(flight.stored),
                 .notes = std::move(flight.warnings)};
  cause.job.job.lookout = cause_wanted(cause.stored, needs_of(cause.job.job.spec.planner));
  return cause;
}

CauseJob cause_job_without_flight(StoredTrial stored, const ReplayFiles& files) {
  CauseJob cause{.job = {}, .stored = with_files(std::move(stored), files), .notes = {}};
  Job& job = cause.job.job;
  job.token = make_token();
  job.spec = cause.stored.spec;
  job.mission = mission_of(cause.stored);
  job.lookout = cause_wanted(cause.stored, std::nullopt);
  return cause;
}

ExplainedTrial explanation_of(const CauseJob& job, const JobEnd& end) {
  ExplainedTrial found;
  if (!end.killed_by.empty()) {
    found.warnings = {"its workers were killed, by " + end.killed_by};
  } else if (end.death) {
    found.warnings = {"flown again it ends differently: " +
                      record_of(end, job.job.job.spec.planner).reason};
  } else if (!end.answer->error.empty()) {
    throw InputError(end.answer->error);
  } else {
    std::vector<std::string> notes = job.notes;
    if (const std::string map = other_map_warning(job.stored, end); !map.empty()) {
      notes.push_back(map);
    }
    found = explanation_from(*end.answer->reported, notes);
  }
  return found;
}

}  // namespace avoidbench
