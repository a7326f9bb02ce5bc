#include "page_output.hpp"

#include <algorithm>
#include <iostream>

#include "export/trial_list.hpp"
#include "output.hpp"
#include "page/flight_choice.hpp"
#include "page_program.hpp"
#include "store/trial_table.hpp"
#include "text/number_text.hpp"
#include "version.hpp"

namespace avoidbench {
namespace {

/// The command as it was typed; words with anything but plain letters in quotes.
std::string own_command() {
  std::ifstream file("/proc/self/cmdline", std::ios::binary);
  const std::string all((std::istreambuf_iterator<char>(file)), {});
  std::string command;
  for (std::size_t from = 0; from < all.size();) {
    const std::size_t end = std::min(all.find('\0', from), all.size());
    std::string word = all.substr(from, end - from);
    // Not where this program lies.
    if (from == 0) word = std::filesystem::path(word).filename().string();
    const bool is_plain =
        !word.empty() && word.find_first_not_of(
                             "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789"
                             "_-./=,:@%+") == std::string::npos;
    command += (from == 0 ? "" : " ") + (is_plain ? word : "'" + word + "'");
    from = end + 1;
  }
  return command;
}

}  // namespace

void check_page(const std::string& file) {
  require(page_program());
  check_output(file, "html");
}

PageOrigin page_origin() {
  return {
      .version = kVersion, .git_hash = kGitHash, .compiler = kCompiler, .command = own_command()};
}

void write_page(const nlohmann::ordered_json& data, const std::string& file) {
  const std::string text = page_text(page_program(), data.at("title").get<std::string>(), data);
  write_text(text, file);
  if (file == "-") return;
  std::cerr << "wrote " << file << " (" << fixed_digits(static_cast<double>(text.size()) / 1e6, 1)
            << " MB): open it in a browser\n";
  for (const auto& warning : data.at("scene_warnings")) {
    std::cerr << "warning: " << file << ": " << warning.get<std::string>() << '\n';
  }
}

void write_flight_page(const std::filesystem::path& database, const StoredTrial& stored,
                       const World& world, const TrialRecord& flown, const SeenRecorder& seen,
                       const TrialListing& listing, const std::string& file) {
  const Database own = Database::open_for_reading(database);
  write_page(
      flight_page(own, stored, world, flown, seen, listing, trial_text(listing), page_origin()),
      file);
}

std::size_t page_bytes(double limit_mb, std::size_t trial_count) {
  const PageProgram program = page_program();
  const std::size_t own = program.head.size() + program.body.size() + program.tail.size();
  const std::size_t wanted =
      limit_mb > 0.0 ? static_cast<std::size_t>(1e6 * limit_mb) : usual_page_bytes(trial_count);
  return wanted > own ? wanted - own : 0;
}

std::vector<RunRow> runs_of(const Database& database, const SweepInfo& sweep) {
  std::vector<RunRow> runs;
  for (const MapFlights& map : read_map_flights(database, sweep)) {
    const bool is_there = std::any_of(runs.begin(), runs.end(), [&](const RunRow& run) {
      return run.started_at == map.first_run.started_at &&
             run.command_line == map.first_run.command_line;
    });
    if (!is_there) runs.push_back(map.first_run);
  }
  std::sort(runs.begin(), runs.end(),
            [](const RunRow& a, const RunRow& b) { return a.started_at < b.started_at; });
  return runs;
}

}  // namespace avoidbench
