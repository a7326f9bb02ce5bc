#include <filesystem>
#include <iostream>

#include "base/number_text.hpp"
#include "base/output_file.hpp"
#include "base/words.hpp"
#include "command_options.hpp"
#include "commands.hpp"
#include "metrics/metric_table.hpp"
#include "output.hpp"
#include "real_flights/import_flights.hpp"
#include "replay/provenance.hpp"
#include "report/table_rows.hpp"
#include "table/table_text.hpp"
#include "version.hpp"

namespace avoidbench {
namespace {

namespace fs = std::filesystem;

struct ImportCommand {
  std::string file, database, twin, beside;
  std::vector<std::string> overrides;
  OutputOptions output;
};

/// A row a flight.
Table flights_table(const ImportedFlights& imported) {
  Table table =
      make_table("flights", "Real flights",
                 {planner_column(),
                  {.name = "mission_index", .header = "mission", .place = Place::key},
                  {.name = "outcome"},
                  {.name = "end_time_s", .header = "T, s"},
                  {.name = "reference_length_m", .header = "d_min, m", .doc = "shortest path"},
                  {.name = "path_length_m", .header = "L, m", .doc = "flown path"},
                  {.name = "min_clearance_m", .header = "clearance, m", .doc = "least"},
                  {.name = "rate_hz", .header = "poses, Hz"},
                  {.name = "residual_m",
                   .header = "residual, m",
                   .doc = "of the poses to the smoothed path, RMS per axis"}});
  const auto metric = [](const ImportedFlight& flight, std::string_view name) {
    const std::span<const MetricDef> all = metric_table();
    for (std::size_t m = 0; m < all.size(); ++m) {
      if (all[m].name == name) return flight.row.metrics[m];
    }
    return 0.0;
  };
  for (const ImportedFlight& flight : imported.flights) {
    table.rows.push_back(make_row(
        flight.row.planner_label, flight.row.mission_index,
        std::string(text(flight.row.record.outcome)), fixed_digits(flight.row.record.end_time_s, 2),
        fixed_digits(flight.reference_length_m, 2),
        fixed_digits(metric(flight, "path_length_m"), 2),
        fixed_digits(metric(flight, "min_clearance_m"), 2), fixed_digits(flight.rate_hz, 1),
        significant_digits(flight.residual_m, 2)));
  }
  return table;
}

std::string twin_text(const FlightsFile& file, const ImportedFlights& imported) {
  return "# The twin of the real flights in " + file.document.file.filename().string() +
         ": the same place, vehicle, starts and goals.\n" +
         "# Mission k is flight k of the real ones. Written by `avoidbench import --twin`.\n" +
         document_text(twin_document(file, imported.missions));
}

/// Its files are named from the folder of the flights' file.
void check_twin_place(const ImportCommand& command) {
  if (command.twin.empty()) return;
  std::error_code error;
  const auto folder = [&](const std::string& file) {
    const fs::path parent = fs::path(file).parent_path();
    return fs::weakly_canonical(parent.empty() ? "." : parent, error);
  };
  if (folder(command.twin) != folder(command.file)) {
    throw OptionError(command.twin + ": expected a file in the folder of " + command.file +
                          ", from which the files that it names are found",
                      "", "twin");
  }
}

void import(const ImportCommand& command) {
  check_output(command.output.output, text(command.output.format));
  if (!command.twin.empty()) check_output(command.twin, "yaml");
  check_twin_place(command);
  const FlightsFile file = read_flights(command.file, command.overrides);
  const std::string path =
      command.database.empty() ? "results/" + file.name + ".db" : command.database;
  const ImportedFlights imported = import_flights(file);
  for (const std::string& warning : file.place.warnings)
    std::cerr << "warning: " << warning << '\n';
  for (const std::string& warning : imported.warnings) std::cerr << "warning: " << warning << '\n';
  if (!command.twin.empty()) {
    const Document twin = twin_document(file, imported.missions);
    sweep_of_document(twin);  // what `run` would refuse is refused here
    write_text(twin_text(file, imported), command.twin);
    std::cerr << "wrote " << command.twin << ": avoidbench run " << command.twin << '\n';
  }
  if (fs::path(path).has_parent_path()) fs::create_directories(fs::path(path).parent_path());
  Database database = Database::open_for_run(path, metric_table());
  RunRow run = run_on_this_host();
  run.program_version = kVersion;
  run.git_hash = kGitHash;
  run.compiler = kCompiler;
  run.flags = kCompilerFlags;
  const std::size_t added = store_flights(imported, run, command.beside, database);
  database.close();
  write_table(flights_table(imported), command.output);
  for (const ImportedFlight& flight : imported.flights) {
    const TrialRecord& record = flight.row.record;
    if (record.outcome == Outcome::reached_goal) continue;
    std::cerr << "flight " << flight.row.mission_index << ": " << text(record.outcome) << ": "
              << record.reason << '\n';
  }
  if (!file.alignment.points.empty()) {
    std::cerr << "alignment: " << significant_digits(imported.alignment_residual_m, 3)
              << " m from the map's points (RMS)\n";
  }
  std::cerr << path << ": " << counted(added, "flight") << " added";
  if (added < imported.flights.size()) {
    std::cerr << ", " << imported.flights.size() - added << " there before";
  }
  std::cerr << "\nnot in the logs (NULL): " << joined(lacking_metrics(imported)) << '\n';
}

}  // namespace

void add_import_command(CLI::App& app) {
  const auto [command, options] =
      add_command(app, "import", "Import real flights from logs, as trials", import);
  add_typed(command, "FLIGHTS", options.file, "FILE",
            "File of flights (YAML): the place, and each flight's log, planner and goal")
      ->required();
  add_typed(command, "--db", options.database, "FILE",
            "Database to write (default: results/NAME.db)");
  add_typed(command, "--twin", options.twin, "FILE",
            "Also write the sweep of the same place, starts and goals, for `avoidbench run`; must "
            "be in the folder of FLIGHTS");
  add_typed(command, "--beside", options.beside, "SWEEP",
            "Also add the flights to this sweep of the database, the flown twin: reports and pages "
            "then show both");
  add_overrides(command, options.overrides, "smoothing.position_noise_m=0.03");
  add_output_options(command, options.output);
  command.footer(
      "Logs: ROS 1 .bag, rosbag2 .db3 and .mcap, PX4 .ulg, TUM, EuRoC CSV. Maps: as in sweeps, "
      "including point\n"
      "clouds (PCD, PLY, LAS, OctoMap). The same code computes all metrics; what a log lacks is "
      "NULL. docs/real_flights.md\n\n"
      "Examples:\n"
      "  avoidbench import wood.yaml --twin wood_twin.yaml\n"
      "  avoidbench run wood_twin.yaml\n"
      "  avoidbench compare --real wood wood_twin\n"
      "  avoidbench import wood.yaml --db results/wood_twin.db --beside wood_twin\n"
      "  avoidbench report wood_twin --page wood.html");
}

}  // namespace avoidbench
