#include "replay/stored_flight.hpp"

#include <utility>

#include "base/input_error.hpp"
#include "plugin/planner_table.hpp"
#include "sweep/recorded_latency.hpp"
#include "sweep/sweep_spec.hpp"
#include "trial/goals.hpp"

namespace avoidbench {
namespace {

/// Makes the stored choice that of what was found.
void find_again(PluginChoice& choice, const PlannerDescription& planner,
                std::vector<std::string>& warnings) {
  if (planner.file_digest != choice.file_digest) warnings.push_back(other_library_warning(planner));
  // Another library may have other parameters: it is given those that it takes.
  const std::vector<ParameterValue> values = usable_values(choice, planner, warnings);
  choice.parameters.clear();
  for (std::size_t i = 0; i < values.size(); ++i) {
    const ParameterDef& def = planner.parameters[i];
    choice.parameters.push_back({.name = def.name,
                                 .number = values[i].number,
                                 .text = values[i].text,
                                 .is_text = def.kind == AB_TEXT || def.kind == AB_CHOICE});
  }
  choice.file = planner.file.string();
  choice.file_digest = planner.file_digest;
  choice.files = planner.files;
  choice.command = planner.command;  // of what was found, never of the database
  choice.needs = planner.needs;
}

}  // namespace

const ReplayPlanner& ReplayPlanners::of(const PlannerChoice& choice) {
  std::string key;
  for (const PluginChoice* plugin : plugins_of(choice)) {
    key += plugin->plugin + '\n' + plugin->file_digest + '\n';
    for (const std::string& word : plugin->command) key += word + '\n';
    key += '\n';
  }
  const auto known = planners_.find(key);
  if (known != planners_.end()) return known->second;
  const FoundPlanner found = planner_for(choice, files_);
  ReplayPlanner planner{.description = describe_planner(found.source), .is_kept = found.is_kept};
  if (choice.filter) {
    const FoundPlanner filter = plugin_for(*choice.filter, files_);
    planner.filter = describe_planner(filter.source);
    planner.is_kept = planner.is_kept || filter.is_kept;
  }
  return planners_.emplace(key, std::move(planner)).first->second;
}

MissionRecord mission_of(const StoredTrial& stored) {
  MissionRecord mission;
  mission.index = stored.spec.mission_index;
  mission.mission = stored.mission;
  mission.reference_length_m = stored.reference_length_m;
  mission.leg_lengths_m = stored.leg_lengths_m;
  return mission;
}

Job stored_job(StoredTrial stored, const ReplayPlanner& planner,
               std::vector<std::string>& warnings) {
  PlannerChoice& choice = stored.spec.planner;
  const PlannerDescription& own = planner.description;
  const std::string goals = goals_demand(stored.spec.mission, stored.mission);
  if (const std::string problem = filter_alone_problem(own); !problem.empty()) {
    throw InputError(problem);
  }
  if (!goals.empty() && (own.needs & AB_INPUT_GOALS) == 0) {
    throw InputError(own.name + " can't fly this mission: it has " + goals +
                     ", and the planner does not declare AB_INPUT_GOALS");
  }
  find_again(choice, own, warnings);
  if (choice.filter) find_again(*choice.filter, planner.filter.value(), warnings);
  return {.token = make_token(),
          .spec = stored.spec,
          .mission_count = 0,
          .mission = mission_of(stored),
          .recorded_latency_s = recorded_latencies(stored.spec, stored.row.record)};
}

FleetJob fleet_job(std::size_t index, Job job) {
  const std::string label = job.spec.planner.label;
  const std::uint32_t needs = needs_of(job.spec.planner);
  return {.index = index,
          .job = std::move(job),
          .planner_label = label,
          .rules = sandbox_rules(needs),
          .needs_new_process = (needs & AB_USES_GLOBALS) != 0};
}

StoredFlight stored_flight(StoredTrial stored, ReplayPlanners& planners) {
  const ReplayPlanner& planner = planners.of(stored.spec.planner);
  StoredFlight flight{.stored = with_files(std::move(stored), planners.files()),
                      .job = {},
                      .warnings = {},
                      .is_with_kept_planner = planner.is_kept};
  // The key holds the result version: another key of the same spec is another version.
  if (trial_key(flight.stored.spec) != flight.stored.row.key) {
    flight.warnings.emplace_back(
        "the trial was flown by a program whose results differ: see CHANGELOG.md, Results change");
  }
  flight.job = fleet_job(0, stored_job(flight.stored, planner, flight.warnings));
  return flight;
}

std::string other_map_warning(const StoredTrial& stored, const JobEnd& end) {
  const bool is_same = !end.answer || end.answer->world_digest.empty() ||
                       end.answer->world_digest == stored.world_digest;
  return is_same ? "" : "the map differs from that of the stored trial";
}

TrialRecord record_of(const JobEnd& end, const PlannerChoice& planner) {
  if (end.answer && end.answer->trial) return *end.answer->trial;
  TrialRecord record;
  if (!end.death) return record;
  if (end.death->flown) record = *end.death->flown;
  record.outcome = end.death->outcome;
  record.reason = under_flown_name(end.death->reason, planner);
  return record;
}

std::string under_flown_name(std::string text, const PlannerChoice& planner) {
  for (const PluginChoice* plugin : plugins_of(planner)) {
    const std::filesystem::path file = plugin->file;
    // Then it was loaded under its own name.
    if (file.stem() != plugin->file_digest) continue;
    const std::string kept = file.filename().string();
    const std::string flown = std::filesystem::path(plugin->plugin).stem().string() + ".so";
    for (std::size_t at = 0; (at = text.find(kept, at)) != std::string::npos; at += flown.size()) {
      text.replace(at, kept.size(), flown);
    }
  }
  return text;
}

JobEnd fly_one(const FleetJob& job, const FleetOptions& options) {
  JobEnd end;
  bool is_begun = false;
  const auto next = [&](const Memory&) -> std::optional<FleetJob> {
    if (std::exchange(is_begun, true)) return std::nullopt;
    return job;
  };
  fly(
      next, [&](const FleetJob&, JobEnd its_end) { end = std::move(its_end); }, options);
  if (!end.killed_by.empty()) {
    throw InputError("the worker that flew it was killed " + std::to_string(kMostTries) +
                     " times, by " + end.killed_by +
                     ": run the same command again when memory is not short");
  }
  if (end.answer && !end.answer->error.empty()) throw InputError(end.answer->error);
  return end;
}

}  // namespace avoidbench
