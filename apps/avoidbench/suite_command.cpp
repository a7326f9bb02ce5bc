#include <algorithm>
#include <iostream>

#include "base/option_error.hpp"
#include "base/words.hpp"
#include "commands.hpp"
#include "output.hpp"
#include "page_output.hpp"
#include "report/table_rows.hpp"
#include "suite.hpp"
#include "suite/suite_board.hpp"
#include "suite/suite_maps.hpp"

namespace avoidbench {
namespace {

constexpr int kChanged = 1;

struct ListOptions {
  OutputOptions output;
};

void list_suites(const ListOptions& options) {
  Table table = make_list({"track", "cells", "dev", "public", "doc"});
  for (const SuiteSpec& suite : built_in_suites()) {
    for (std::size_t i = 0; i < suite.tracks.size(); ++i) {
      const SuiteSpec of_track = track_of(suite, suite.tracks[i]).suite;
      Row& row = table.rows.emplace_back();
      append(row, suite.name + "/" + suite.tracks[i]);
      append(row, of_track.cells.size());
      append(row, mission_count(of_track, Split::dev));
      append(row, mission_count(of_track, Split::open));
      append(row, suite.track_docs[i]);
    }
  }
  write_table(table, options.output);
}

struct CheckOptions {
  std::string track;
  std::vector<std::string> cells;
};

/// Makes the maps of a track, and says where they are not those that were frozen.
void check_suite(const CheckOptions& options) {
  const SuiteTrack chosen = suite_track(options.track);
  const SuitePlanner planner = suite_planner("straight_line", "", {});
  std::size_t map_count = 0;
  std::vector<std::string> problems;
  for (const SuiteCell& cell : chosen.suite.cells) {
    if (!options.cells.empty() && !contains(options.cells, cell.name)) continue;
    for (const SuiteSweep& sweep : cell.sweeps) {
      for (const Split split : {Split::dev, Split::open}) {
        const SweepSeeds seeds = seeds_of(chosen.suite, cell, sweep, split, "");
        const std::string problem =
            maps_problem(sweep, split, made_maps(suite_sweep(chosen, sweep, seeds, planner)));
        map_count += seeds.map_seeds.size();
        if (!problem.empty()) std::cout << problem << '\n' << std::flush;
        if (!problem.empty()) problems.push_back(problem);
      }
    }
    std::cerr << counted(map_count, "map") << ", " << cell.name << " done\n";
  }
  std::vector<std::string> cells;
  for (const SuiteCell& cell : chosen.suite.cells) cells.push_back(cell.name);
  if (map_count == 0) {
    throw InputError("--cells: " + options.track + " has none of these; its cells are " +
                     joined(cells));
  }
  std::cout << options.track << ": " << counted(map_count, "map") << " generated with missions, "
            << (problems.empty() ? "all equal to the frozen ones" : "not equal to the frozen ones")
            << '\n';
  if (!problems.empty()) throw CLI::RuntimeError(kChanged);
}

struct BoardOptions {
  std::vector<std::string> folders;
  std::string suite, page;
  bool shows_agreement = false;
  OutputOptions output;
};

void show_board(const BoardOptions& options) {
  check_output(options.output.output, text(options.output.format));
  if (!options.page.empty()) check_page(options.page);
  const std::vector<Board> boards = boards_of(options.folders, options.suite);
  std::vector<Section> sections;
  for (const Board& board : boards) {
    sections.push_back({.name = board.title, .title = board.title, .tables = board.tables()});
  }
  if (Table agreement = agreement_table(boards); options.shows_agreement) {
    if (agreement.rows.empty()) {
      throw OptionError("needs at least three results of one track and split", "agreement");
    }
    sections = {{.name = "agreement", .title = "Agreement of rankings"}};
    sections.front().tables.push_back(std::move(agreement));
  }
  write_sections(sections, options.output);
  if (options.page.empty()) return;
  write_page(board_page(boards, page_origin(), std::filesystem::path(options.page).parent_path()),
             options.page);
}

void add_run_suite(CLI::App& suite) {
  const auto [command, options] = add_command(
      suite, "run", "Fly a track of a suite with one planner, and write the folder of its result",
      run_suite);
  add_typed(command, "track", options.track, "SUITE/TRACK",
            "Track, as avoidbench-1/depth (`suite list` lists them), or FOLDER/TRACK")
      ->required();
  add_typed(command, "--planner", options.planner, "NAME|FILE",
            "Planner: its name, library or program; or a planner.yaml with settings, licence and "
            "source (docs/submit.md)")
      ->required();
  add_typed(command, "--label", options.label, "TEXT", "Its label in tables [its name]");
  add_repeatable(command, "--parameter", options.parameters, "NAME=VALUE",
                 "Value of one of its parameters, as max_speed_mps=3; repeatable");
  CLI::Option* split = add_choice(command, "--split", options.split, {"dev", "public"},
                                  "Maps: dev, for tuning; or public, for results to publish");
  add_typed(command, "--sealed", options.sealed, "KEYFILE",
            "Fly the sealed maps, whose seeds follow from the key in this file")
      ->excludes(split);
  add_typed(command, "--folder", options.folder, "FOLDER",
            "Folder of the result [results/suites/SUITE/TRACK/SPLIT/LABEL]");
  command.add_flag("--no-causes", options.no_causes,
                   "Do not fly failures again to find their causes");
  add_suite_flying(command, options.run);
  command.footer(
      "The same command resumes where it was stopped. docs/suite.md\n\n"
      "Examples:\n"
      "  avoidbench suite run avoidbench-1/depth --planner ./mine.so --split dev\n"
      "  avoidbench suite run avoidbench-1/depth --planner ego --parameter max_speed_mps=5 "
      "--label ego-5");
}

void add_verify_suite(CLI::App& suite) {
  const auto [command, options] = add_command(
      suite, "verify",
      "Check a result's folder, fly a sample of its flights again, and compare them", verify_suite);
  add_typed(command, "folder", options.folder, "FOLDER", "Folder of a result")->required();
  command.add_option("--sample", options.sample,
                     "Share of the flights to fly again, such as 1% or 100%; at least one");
  add_typed(command, "--salt", options.salt, "TEXT",
            "Text that chooses the sample, together with the flights' keys, such as the commit "
            "that added the result [the digest of trials.csv]");
  add_typed(command, "--planner", options.planner, "NAME|FILE",
            "The planner, if it does not come with avoidbench: your own copy of its library or "
            "program, or your planner.yaml; a file that only the result names is not started");
  add_typed(command, "--suite", options.track, "FOLDER/TRACK",
            "Track of your own suite that was flown");
  add_typed(command, "--sealed", options.sealed, "KEYFILE", "Key of the sealed maps");
  add_suite_flying(command, options.run);
  command.footer("Exit codes: 0 verified, 1 refused, 2 usage or input");
}

}  // namespace

void add_suite_flying(CLI::App& command, RunCommand& options) {
  add_number(command, "-j,--jobs", options.jobs, CLI::Range(0, 1024),
             "Worker processes; 0: one per allowed CPU");
  command.add_flag("--no-sandbox", options.no_sandbox,
                   "Let planners write files, start programs and use the network (docs/trust.md)");
  command.add_flag("-q,--quiet", options.quiet, "No progress on stderr");
  add_limit_options(command, options);
}

void add_suite_command(CLI::App& app) {
  CLI::App& suite = *app.add_subcommand(
      "suite", "Frozen maps shared by all: fly a suite, verify results, compare them on a board");
  const auto [list, list_options] =
      add_command(suite, "list", "The tracks of suites that come with avoidbench", list_suites);
  add_output_options(list, list_options.output);
  add_run_suite(suite);
  add_verify_suite(suite);
  const auto [board, board_options] = add_command(
      suite, "board", "Results side by side: scores, and which of them differ", show_board);
  board.add_option("FOLDER", board_options.folders, "Folders of results")->required();
  add_typed(board, "--suite", board_options.suite, "FOLDER/TRACK",
            "Track of your own suite that was flown");
  board.add_flag("--agreement", board_options.shows_agreement,
                 "Show instead how far rankings agree: Kendall's tau of the score with each "
                 "cell, and between splits and tracks");
  add_typed(board, "--page", board_options.page, "FILE",
            "Also write a page: one HTML file with S(v) of all results and links to their flights");
  add_output_options(board, board_options.output);
  const auto [check, check_options] =
      add_command(suite, "check",
                  "Generate a track's maps and check that they equal the frozen ones", check_suite);
  add_typed(check, "track", check_options.track, "SUITE/TRACK", "Track")->required();
  add_list(check, "--cells", check_options.cells, "Only these cells, separated by commas");
}

}  // namespace avoidbench
