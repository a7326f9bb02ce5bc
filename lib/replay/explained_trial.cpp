#include "replay/explained_trial.hpp"

#include <nlohmann/json.hpp>
#include <optional>

#include "base/input_error.hpp"
#include "explain/explain.hpp"
#include "process/isolated_run.hpp"

namespace avoidbench {
namespace {

FailedFlight failed_flight(const StoredTrial& stored, const World& world) {
  return {.spec = stored.spec,
          .world = world,
          .mission = stored.mission,
          .record = stored.row.record,
          .reference_length_m = stored.reference_length_m};
}

/// Of what is stored, without the planner.
CauseFound unwatched(const StoredTrial& stored, const ReplayFiles& files) {
  const StoredTrial whole = with_files(stored, files);
  const World world = make_world(whole.spec.map, whole.spec.map_seed);
  const auto patch = struck_patch(world, whole.row.record);
  return explained(failed_flight(whole, world), patch ? &*patch : nullptr, nullptr);
}

/// Flies it again under watch; nothing where it flies otherwise now.
std::optional<CauseFound> watched(const StoredTrial& stored, const ReplayFiles& files,
                                  std::vector<std::string>& warnings) {
  const Replay replay(stored, files);
  const TrialRecord& record = replay.stored().row.record;
  const auto patch = struck_patch(replay.world(), record);
  if (!patch) return std::nullopt;
  FlightWatch watch(replay.stored().spec, record.samples, *patch);
  TrialObserver observer;
  observer.planned = [&](const PlanStep& step) { watch.planned(step); };
  std::vector<std::string> log;
  const std::vector<std::string> found = differences(record, replay.fly(observer, log));
  if (found.empty()) {
    return explained(failed_flight(replay.stored(), replay.world()), &*patch, &watch);
  }
  warnings.push_back("flown again it differs from the stored trial: " + found.front());
  for (const std::string& warning : replay.warnings()) warnings.push_back(warning);
  return std::nullopt;
}

}  // namespace

ExplainedTrial explain_trial(const StoredTrial& stored, const ReplayFiles& files) {
  ExplainedTrial told;
  if (needs_watch(stored.row.record)) {
    try {
      if (const auto found = watched(stored, files, told.warnings)) {
        told.explanation = *found;
        return told;
      }
    } catch (const InputError& error) {
      told.warnings.push_back(std::string("it can't be flown again: ") + error.what());
    }
  }
  told.explanation = unwatched(stored, files);
  return told;
}

ExplainedTrial explain_trial_apart(const StoredTrial& stored, const ReplayFiles& files) {
  constexpr double kMostTime_s = 3600.0;  // as a trial of a run
  const IsolatedEnd end = run_isolated(
      [&](IsolatedOutput& output) {
        nlohmann::json told = nlohmann::json::object();
        try {
          const ExplainedTrial found = explain_trial(stored, files);
          told["cause"] = std::string(text(found.explanation.cause));
          told["facts"] = facts_json(found.explanation.facts);
          told["warnings"] = found.warnings;
        } catch (const InputError& error) {
          told["error"] = error.what();
        }
        output.write(told.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace));
      },
      kMostTime_s);
  ExplainedTrial found;
  const nlohmann::json told = nlohmann::json::parse(end.output, nullptr, false);
  if (!end.problem.empty() || !told.is_object()) {
    found.warnings.push_back("flown again it " +
                             (end.problem.empty() ? "says nothing" : end.problem));
    return found;
  }
  if (told.contains("error")) throw InputError(told.at("error").get<std::string>());
  const auto cause = enum_from_text<Cause>(told.at("cause").get<std::string>());
  if (cause) found.explanation.cause = *cause;
  found.explanation.facts = facts_from_json(told.at("facts").get<std::string>());
  found.warnings = told.at("warnings").get<std::vector<std::string>>();
  return found;
}

}  // namespace avoidbench
