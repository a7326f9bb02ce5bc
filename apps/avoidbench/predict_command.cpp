#include "predict/predict.hpp"

#include <iostream>
#include <optional>

#include "base/number_text.hpp"
#include "base/option_error.hpp"
#include "base/words.hpp"
#include "command_options.hpp"
#include "commands.hpp"
#include "config/sweep_file.hpp"
#include "database_choice.hpp"
#include "metrics/map_record.hpp"
#include "output.hpp"
#include "report/selection.hpp"
#include "report/summary.hpp"
#include "sweep/listed_missions.hpp"
#include "trial/map_scene.hpp"

namespace avoidbench {
namespace {

namespace fs = std::filesystem;

struct PredictOptions {
  std::vector<std::string> flown, judged_by, where, overrides;
  std::string sweep, map, suite;
  std::optional<std::uint64_t> map_seed;
  std::optional<double> traversability, distance_m;
  std::int64_t mission_count = 30;
  double confidence = 0.9;
  bool must_leave_kinds_out = false;
  OutputOptions output;
};

/// Databases, and folders of results of suites.
FlownSet flown_set(const std::vector<std::string>& given, const PredictOptions& options) {
  std::vector<Condition> conditions;
  for (const std::string& condition : options.where) {
    conditions.push_back(parse_condition(condition));
  }
  std::vector<SuiteResult> results;
  std::vector<std::string> files;
  for (const std::string& one : given) {
    if (fs::is_directory(one)) results.push_back(read_result(one));
    if (!fs::is_directory(one)) files.push_back(one);
  }
  if (!conditions.empty() && !results.empty()) {
    throw OptionError(
        "chooses trials of databases, and " + given.front() + " is a folder of results", "where");
  }
  FlownSet set;
  add_suite_results(set, results, options.suite);
  if (files.empty() && !results.empty()) return set;
  const std::vector<Database> databases = opened(files, "predict");
  const auto sweeps = chosen_sweeps(databases, options.sweep);
  std::vector<SweepResult> parts;
  for (std::size_t i = 0; i < databases.size(); ++i) {
    for (const SweepInfo& sweep : sweeps[i]) {
      std::vector<std::string> fields = setting_fields(sweep);
      for (const Condition& condition : conditions) {
        if (!contains(fields, condition.field)) fields.push_back(condition.field);
      }
      SweepResult part = databases[i].read_sweep(sweep.name, sweep.revision, fields);
      parts.push_back(selected(std::move(part), conditions));
    }
  }
  add_sweeps(set, parts);
  return set;
}

/// The map that was named, made and measured.
MapQuestion question_of_map(const PredictOptions& options) {
  MapChoice choice = read_map(options.map, options.overrides);
  if (options.map_seed) choice.trial.map_seed = *options.map_seed;
  const MapScene map(choice.trial);
  const std::vector<Mission> listed = missions_of(choice.missions, choice.trial);
  const auto most = static_cast<std::int64_t>(listed.size());
  const std::int64_t count =
      listed.empty() ? options.mission_count : std::min(options.mission_count, most);
  const MapRecord record = make_map_record(choice.trial, map.scene, count, listed);
  MapQuestion question{.name = options.map, .kind = std::string(kind(choice.trial.map))};
  question.traversability = record.traversability_normalized_ratio;
  double sum_m = 0.0;
  for (const MissionRecord& mission : record.missions) {
    if (!mission.is_valid) continue;
    question.lengths_m.push_back(mission.reference_length_m);
    sum_m += mission.reference_length_m;
  }
  if (question.lengths_m.empty()) {
    throw InputError(options.map + ": none of its missions can be flown: " +
                     record.missions.front().invalid_reason);
  }
  const auto missions = static_cast<double>(question.lengths_m.size());
  question.name += ": traversability " + significant_digits(question.traversability, 3) + ", " +
                   counted(question.lengths_m.size(), "mission") + " of " +
                   significant_digits(sum_m / missions, 3) + " m on average";
  return question;
}

MapQuestion question_of(const PredictOptions& options) {
  if (!options.map.empty()) return question_of_map(options);
  if (!options.traversability || !options.distance_m) {
    throw InputError(
        "predict what? --map MAP, or --traversability T with --distance D; or judge predictions: "
        "--leave-kinds-out, --judged-by FLOWN");
  }
  MapQuestion question{.traversability = *options.traversability};
  question.lengths_m.assign(static_cast<std::size_t>(options.mission_count), *options.distance_m);
  question.name = "maps of traversability " + significant_digits(*options.traversability, 3) +
                  ", missions of " + significant_digits(*options.distance_m, 3) + " m";
  return question;
}

void predict(const PredictOptions& options) {
  check_output(options.output.output, text(options.output.format));
  const bool is_judging = options.must_leave_kinds_out || !options.judged_by.empty();
  // The question first: it may be wrong, and fits take their time.
  const std::optional<MapQuestion> question =
      is_judging ? std::nullopt : std::optional(question_of(options));
  const FlownSet set = flown_set(options.flown, options);
  std::vector<Section> sections;
  if (question) {
    sections.push_back(prediction_section(planner_models(set), *question, options.confidence));
  }
  if (options.must_leave_kinds_out) {
    sections.push_back(judgement_section(leave_kinds_out(set, options.confidence),
                                         "Each kind of map predicted from the others",
                                         options.confidence));
  }
  if (!options.judged_by.empty()) {
    const FlownSet flown = flown_set(options.judged_by, options);
    sections.push_back(judgement_section(judged_by(set, flown, options.confidence),
                                         "Maps predicted from those flown before",
                                         options.confidence));
  }
  write_sections(sections, options.output);
}

}  // namespace

void add_predict_command(CLI::App& app) {
  const auto [command, options] = add_command<PredictOptions>(
      app, "predict", "Predict planners' success on a map that has not been flown", predict);
  command.add_option("FLOWN", options.flown,
                     "Databases and folders of results of suites to predict from (default: the "
                     "newest results/*.db)");
  CLI::Option* map = add_typed(command, "--map", options.map, "MAP",
                               "Map to predict, as for maps info: a generator, or a file with a "
                               "map's fields; it is generated and measured");
  add_overrides(command, options.overrides, "poisson_radius_m=3");
  command.add_option("--seed", options.map_seed, "Seed of the map")->needs(map);
  CLI::Option* traversability =
      add_number(command, "--traversability", options.traversability, CLI::PositiveNumber,
                 "Normalised traversability of maps to predict, as printed by maps info")
          ->excludes(map);
  add_number(command, "--distance", options.distance_m, CLI::PositiveNumber,
             "Length of their missions' shortest paths, m")
      ->needs(traversability);
  add_number(command, "--missions", options.mission_count, CLI::Range(1, 10'000),
             "Missions on the map; the interval is for their share of successes");
  add_number(command, "--confidence", options.confidence, CLI::Range(0.5, 0.999),
             "Confidence level of the intervals");
  command.add_flag("--leave-kinds-out", options.must_leave_kinds_out,
                   "Judge predictions: each kind of map (generator) predicted from the flights on "
                   "all others");
  add_repeatable(command, "--judged-by", options.judged_by, "FLOWN",
                 "Judge predictions with the flights of this database or folder, for planners of "
                 "the same label; repeatable");
  add_typed(command, "--suite", options.suite, "FOLDER/TRACK",
            "The suite of the folders (default: the one that comes with this program)");
  add_sweep_choice(command, options.sweep);
  add_where(command, options.where);
  add_output_options(command, options.output);
  command.footer(
      "The model: failures per metre depend on the map's traversability and differ from map to map "
      "(docs/predict.md).\n\n"
      "Examples:\n"
      "  avoidbench predict results/forest_small.db --traversability 0.6 --distance 30\n"
      "  avoidbench predict results/forest_small.db --map hall --missions 30\n"
      "  avoidbench predict results/suites/avoidbench-1/depth/dev/* --leave-kinds-out");
}

}  // namespace avoidbench
