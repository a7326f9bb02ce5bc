#include "replay/apart.hpp"

#include "base/input_error.hpp"
#include "plugin/planner_description.hpp"
#include "replay/apart_worker.hpp"
#include "sweep/recorded_latency.hpp"

namespace avoidbench {

Job stored_job(StoredTrial stored, const PlannerDescription& planner,
               std::vector<std::string>& warnings) {
  PlannerChoice& choice = stored.spec.planner;
  // Another library may have other parameters: it is given those that it takes.
  if (planner.file_digest != choice.file_digest) {
    warnings.push_back(other_library_warning(planner));
    const std::vector<ParameterValue> values = usable_values(choice, planner, warnings);
    choice.parameters.clear();
    for (std::size_t i = 0; i < values.size(); ++i) {
      const ParameterDef& def = planner.parameters[i];
      choice.parameters.push_back({.name = def.name,
                                   .number = values[i].number,
                                   .text = values[i].text,
                                   .is_text = def.kind == AB_TEXT || def.kind == AB_CHOICE});
    }
  }
  choice.file = planner.file.string();
  choice.file_digest = planner.file_digest;
  choice.files = planner.files;
  // The mission as it was stored: nothing is measured again.
  MissionRecord mission;
  mission.index = stored.spec.mission_index;
  mission.mission = stored.mission;
  return {.token = make_token(),
          .spec = stored.spec,
          .mission_count = 0,
          .mission = mission,
          .recorded_latency_s = recorded_latencies(stored.spec, stored.row.record)};
}

ApartFlight fly_apart(const StoredTrial& stored, const ReplayFiles& files,
                      const ApartOptions& options) {
  std::vector<std::string> warnings;
  const PlannerDescription planner = describe_planner(library_for(stored.spec.planner, files));
  Job job = stored_job(with_files(stored, files), planner, warnings);
  ApartWorker worker(options, planner.needs);
  worker.begin(std::move(job));
  std::optional<ApartFlight> flight;
  const ApartWorker* const only[] = {&worker};
  while (!flight) {
    wait_for_news(only);
    flight = worker.look();
  }
  flight->warnings = std::move(warnings);
  return std::move(*flight);
}

}  // namespace avoidbench
