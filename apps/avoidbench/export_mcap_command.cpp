#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>

#include "base/number_text.hpp"
#include "base/output_file.hpp"
#include "base/visible_text.hpp"
#include "commands.hpp"
#include "database_choice.hpp"
#include "export/export_mcap.hpp"
#include "export/flown_piece.hpp"
#include "export_choice.hpp"
#include "replay/stored_flight.hpp"
#include "replay_verify.hpp"
#include "trial/flown_world.hpp"
#include "trial/planner_view.hpp"
#include "version.hpp"

namespace avoidbench {
namespace {

struct McapOptions {
  std::vector<std::string> words;  // a database and trials
  std::string output;
  bool is_stored_only = false;
  FlightOptions flights;
};

std::string program() { return std::string("avoidbench ") + kVersion; }

/// The world of the stored trial; nothing, with a warning, where it can't be had any more.
std::optional<World> world_of(const StoredTrial& stored, const ReplayFiles& files) {
  try {
    const StoredTrial found = with_files(stored, files);
    World world = flown_world(found.spec, found.mission);
    if (world.digest == stored.world_digest) return world;
    std::cerr << "warning: the map differs from that of the stored trial: /map is left out\n";
  } catch (const InputError& error) {
    std::cerr << "warning: " << visible_line(error.what()) << ": /map is left out\n";
  }
  return std::nullopt;
}

/// A file that is being written.
struct Writing {
  Writing(const McapFlight& its_flight, const std::string& name) : flight(its_flight), file(name) {
    begin();
  }
  void begin() {
    file.restart();
    exported.emplace(flight, file.stream());
  }
  void finish(const std::string& name) {
    exported->finish();
    file.finish();
    std::cerr << name << ": " << exported->message_count() << " messages, "
              << fixed_digits(1e-6 * static_cast<double>(std::filesystem::file_size(name)), 1)
              << " MB\n";
    if (const std::size_t count = exported->left_out_triangles(); count > 0) {
      std::cerr << "of the map the " << kMostMcapTriangles << " triangles nearest to the path; "
                << count << " others are left out\n";
    }
  }

  McapFlight flight;
  WholeFile file;
  std::optional<McapExport> exported;
};

/// Flies the trial again; what it sees and commands goes to the file as it comes.
void fly_into(Writing& writing, StoredFlight& flight, const FleetOptions& fleet) {
  const TrialSpec& spec = flight.stored.spec;
  const PlannerSetup setup = planner_setup(spec);
  flight.job.job.lookout = pieces_job(spec);
  flight.job.on_piece = [&](const Message& message) {
    const FlownPiece piece = flown_piece_from(message, spec, setup);
    // A worker that was killed from outside flies it from the beginning.
    if (piece.number == 0) writing.begin();
    writing.exported->add(piece);
    writing.file.check();
  };
  const JobEnd end = fly_one(flight.job, fleet);
  if (!end.answer && !end.death) return;  // it was stopped
  const TrialRecord& stored = flight.stored.row.record;
  const std::vector<std::string> found =
      differences(stored, record_of(end, flight.job.job.spec.planner));
  for (const std::string& line : found) std::cerr << "warning: " << visible_line(line) << '\n';
  // When a planner dies may depend on the machine; until then it flew as it did.
  if (found.empty() || is_of_worker(stored.outcome)) return;
  std::cerr << "flown again it differs from the stored trial: no file is written; --stored-only "
               "writes what is stored\n";
  throw CLI::RuntimeError(kExitDiffers);
}

void write_flown(const Database& database, const TrialListing& trial, const std::string& file,
                 ReplayPlanners& planners, const FleetOptions& fleet) {
  StoredFlight flight;
  try {
    flight = stored_flight(possible_trial(database, trial.key), planners);
  } catch (const InputError&) {
    std::cerr << "it can't be flown again; --stored-only writes what is stored\n";
    throw;
  }
  for (const std::string& warning : flight.warnings) std::cerr << "warning: " << warning << '\n';
  const std::optional<World> world = world_of(flight.stored, planners.files());
  Writing writing({flight.stored, world ? &*world : nullptr, program()}, file);
  fly_into(writing, flight, fleet);
  if (fleet.stop_now != nullptr && fleet.stop_now->load()) return;
  writing.finish(file);
}

void write_stored(const Database& database, const TrialListing& trial, const std::string& file,
                  const ReplayFiles& files) {
  const StoredTrial stored = read_stored_trial(database, trial.key);
  const std::optional<World> world = world_of(stored, files);
  Writing writing({stored, world ? &*world : nullptr, program()}, file);
  writing.finish(file);
  std::cerr << "left out, since it is not stored: images, sweeps, IMU samples, commands, the "
               "planner's odometry and log\n";
}

void write_mcap(const McapOptions& options) {
  if (options.output == "-")
    throw InputError("an MCAP file can't go to standard output: name a file");
  const auto chosen = chosen_of(options.words);
  const Database& database = chosen.first;
  const std::string given = is_database(options.words.front()) ? options.words.front() : "";
  const ReplayFiles files = files_beside(given, database, options.flights);
  ReplayPlanners planners(files);
  const StopSignals& signals = watch_stop_signals();
  FleetOptions fleet = fleet_options(options.flights, 1, &signals);
  fleet.stop_now = &signals.stop;  // half a flight is no file
  write_files(chosen.second, options.output, "mcap",
              [&](const TrialListing& trial, const std::string& file) {
                if (options.is_stored_only) return write_stored(database, trial, file, files);
                write_flown(database, trial, file, planners, fleet);
                if (signals.stop) end_stopped(signals, "stopped: " + file + " is not written");
              });
}

}  // namespace

void add_export_mcap_command(CLI::App& app) {
  const auto [command, options] = add_command(
      app, "mcap",
      "Flights for Foxglove, Lichtblick and ROS 2: everything that was seen and commanded",
      write_mcap);
  command
      .add_option("TRIAL", options.words,
                  "Ids of trials or the beginnings of their keys, after an optional database "
                  "(default: the newest results/*.db)")
      ->required();
  add_typed(command, "--output", options.output, "FILE",
            "File to write, .mcap; for several trials a folder with one file each")
      ->required();
  command.add_flag("--stored-only", options.is_stored_only,
                   "Fly nothing and write what is stored: path, calls, contacts, goals, map");
  add_replay_options(command, options.flights);
  command.footer(
      "Images, sweeps and commands are not stored: the trial is flown again, bit for bit, to get "
      "them. Messages are those\n"
      "of ROS 2, with simulated time stamps; docs/exports.md has the topics.\n\n"
      "Example:\n"
      "  avoidbench export mcap results/quick.db 3 --output flight.mcap");
}

}  // namespace avoidbench
