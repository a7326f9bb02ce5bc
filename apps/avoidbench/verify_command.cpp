#include <CLI/CLI.hpp>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <memory>
#include <set>

#include "base/input_error.hpp"
#include "commands.hpp"
#include "database_choice.hpp"
#include "replay/replay.hpp"
#include "store/database.hpp"
#include "text/visible_text.hpp"
#include "worker/worker_process.hpp"

namespace avoidbench {
namespace {

constexpr int kExitDiffers = 1;

struct VerifyCommand {
  std::string database_file;
  std::string sample = "100%";
  std::string planner, library;
};

/// A share from "1%", "0.01" or "1".
double share_from(const std::string& text) {
  double share = -1.0;
  const char* const last = text.data() + text.size();
  const auto [end, error] = std::from_chars(text.data(), last, share);
  const std::string_view rest(end, static_cast<std::size_t>(last - end));
  if (rest == "%") share /= 100.0;
  const bool is_number = error == std::errc() && (rest.empty() || rest == "%");
  if (!is_number || !(share > 0.0 && share <= 1.0)) {
    throw InputError("--sample " + text + ": expected a share such as 1% or 0.01");
  }
  return share;
}

/// Whether the sample has this trial: by the first 32 bits of its key, so that a larger sample has
/// all trials of a smaller one.
bool is_sampled(const std::string& key, double share) {
  const auto number = static_cast<double>(std::stoul(key.substr(0, 8), nullptr, 16));
  return number < share * 4294967296.0;
}

/// Whether the end was a worker's, which a flight in this process can't have.
bool ended_worker(Outcome outcome) {
  return outcome == Outcome::planner_crashed || outcome == Outcome::planner_hung;
}

/// Flies it again; whether it is the same.
bool is_repeated(const Database& database, const TrialListing& listing,
                 const std::string& library) {
  const std::filesystem::path folder = database.path().parent_path();
  ReplayFiles files;
  files.folders = {".", folder};
  files.planner = library;
  const Replay replay(possible_trial(database, listing.key), files);
  std::vector<std::string> log;
  const TrialRecord flown = replay.fly({}, log);
  const std::vector<std::string> found = differences(replay.stored().row.record, flown);
  if (found.empty()) return true;
  std::cout << "trial " << listing.id << " (" << listing.key.substr(0, 8) << ", "
            << visible_line(listing.planner_label) << ") differs:\n";
  for (const std::string& line : found) std::cout << "  " << visible_line(line) << '\n';
  for (const std::string& line : replay.warnings()) std::cout << "  note: " << line << '\n';
  return false;
}

void check_planner(const VerifyCommand& command, const std::vector<TrialListing>& trials) {
  std::set<std::string> labels;
  for (const TrialListing& trial : trials) labels.insert(trial.planner_label);
  const std::vector<std::string> known(labels.begin(), labels.end());
  if (!command.planner.empty() && !labels.contains(command.planner)) {
    throw InputError("--planner " + command.planner + ": no trial has it" +
                     did_you_mean(command.planner, known));
  }
  if (!command.library.empty() && command.planner.empty() && labels.size() > 1) {
    throw InputError("--library " + command.library +
                     ": the trials are of several planners: choose one by --planner");
  }
}

void verify(const VerifyCommand& command) {
  enter_worker_environment();
  const double share = share_from(command.sample);
  const Database database = Database::open_for_reading(command.database_file);
  std::int64_t flown = 0, different = 0, passed_over = 0;
  const std::vector<TrialListing> trials = database.list_trials();
  check_planner(command, trials);
  for (const TrialListing& trial : trials) {
    if (!command.planner.empty() && trial.planner_label != command.planner) continue;
    if (!is_sampled(trial.key, share)) continue;
    if (ended_worker(trial.outcome)) {
      ++passed_over;
      continue;
    }
    ++flown;
    different += is_repeated(database, trial, command.library) ? 0 : 1;
  }
  std::cout << flown << " trials flown again, " << different << " different\n";
  if (passed_over > 0) {
    std::cout << passed_over << " crashed or hung and were not flown: see avoidbench run --rerun\n";
  }
  if (flown == 0 && passed_over == 0) std::cerr << "the sample has no trial: make it larger\n";
  if (different > 0) throw CLI::RuntimeError(kExitDiffers);
}

}  // namespace

void add_verify_command(CLI::App& app) {
  const auto options = std::make_shared<VerifyCommand>();
  CLI::App* command =
      app.add_subcommand("verify", "Fly stored trials again and compare them bit for bit");
  command->add_option("DB", options->database_file, "Database")->required();
  command->add_option("--sample", options->sample, "Share of the trials, chosen by their keys")
      ->capture_default_str();
  command->add_option("--planner", options->planner, "Only trials of this planner, by its label");
  command
      ->add_option("--library", options->library,
                   "Fly this planner library, also where it is another file than the trials'")
      ->type_name("NAME|FILE");
  command->footer(
      "Exit code 1 where a flight differs from the stored one. Planners and map files are looked "
      "for as `avoidbench\n"
      "replay` does.\n\n"
      "Example:\n  avoidbench verify results/quick.db --sample 10%");
  command->callback([options] { verify(*options); });
}

}  // namespace avoidbench
