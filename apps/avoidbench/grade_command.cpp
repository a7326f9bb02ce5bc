#include <chrono>
#include <filesystem>
#include <iostream>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "base/output_file.hpp"
#include "base/words.hpp"
#include "commands.hpp"
#include "output.hpp"
#include "page_output.hpp"
#include "report/table_rows.hpp"
#include "suite.hpp"
#include "suite/suite_board.hpp"
#include "sweep/sweep_rows.hpp"

namespace avoidbench {
namespace {

namespace fs = std::filesystem;

struct GradeOptions {
  std::string submissions;
  SuiteOptions suite;
  double budget_min = 60.0;
  OutputOptions output;
};

/// A planner that was handed in.
struct Submission {
  std::string name;
  fs::path planner;     ///< .py or .so
  std::string problem;  ///< why it is not graded
};

bool is_planner_file(const fs::directory_entry& entry) {
  const fs::path ending = entry.path().extension();
  return entry.is_regular_file() && (ending == ".py" || ending == ".so");
}

/// Of a folder: its only planner file, or of several the one of the folder's name.
Submission submission_in(const fs::path& folder) {
  Submission found{.name = folder.filename().string(), .planner = {}, .problem = {}};
  std::vector<fs::path> files;
  std::error_code error;
  for (fs::directory_iterator at(folder, error), end; !error && at != end; at.increment(error)) {
    if (is_planner_file(*at)) files.push_back(at->path());
  }
  for (const fs::path& file : files) {
    if (files.size() == 1 || file.stem() == found.name) found.planner = file;
  }
  if (error) {
    found.problem = "can't be read: " + error.message();
  } else if (found.planner.empty()) {
    found.problem = "has " + std::to_string(files.size()) +
                    " .py or .so files, expected one, or one named " + found.name;
  }
  return found;
}

/// What an entry of the folder of submissions holds; nothing for files that are no planners.
std::optional<Submission> submission_of(const fs::directory_entry& entry) {
  const fs::path& path = entry.path();
  if (path.filename() == "__pycache__" || path.filename().string().front() == '.') return {};
  if (!entry.is_directory() && !is_planner_file(entry)) return {};
  Submission found = entry.is_directory()
                         ? submission_in(path)
                         : Submission{.name = path.stem().string(), .planner = path, .problem = {}};
  // A link may lead to somebody else's planner.
  const bool is_link = entry.is_symlink() || fs::is_symlink(found.planner);
  if (is_link) found.problem = "is a link, not a file";
  return found;
}

/// By name; no two would be written into the same folder.
std::vector<Submission> submissions_of(const std::string& folder) {
  if (!fs::is_directory(folder)) throw InputError(folder + ": not a folder of submissions");
  std::map<std::string, Submission> by_folder;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    std::optional<Submission> found = submission_of(entry);
    if (!found) continue;
    const auto [other, is_new] = by_folder.try_emplace(safe_file_name(found->name), *found);
    if (!is_new) {
      throw InputError(folder + ": two submissions would share a folder: " + other->second.name +
                       " and " + found->name);
    }
  }
  if (by_folder.empty()) {
    throw InputError(folder + ": no submission: no folder, .py or .so in it");
  }
  std::vector<Submission> all;
  for (auto& [name, submission] : by_folder) all.push_back(std::move(submission));
  return all;
}

/// Flies one submission into its folder; says in `problem` why it can't be graded.
void grade_one(const GradeOptions& options, const SuiteMaps& maps, const std::string& folder,
               Submission& submission) {
  SuiteOptions one = options.suite;
  one.planner = submission.planner.string();
  one.label = submission.name;
  one.folder = folder;
  const auto begun = std::chrono::steady_clock::now();
  one.before_sweep = [&](const PlannerChoice& planner) {
    const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - begun;
    if (planner_row(planner).is_privileged) throw InputError("it asks for the map");
    if (spent.count() < 60.0 * options.budget_min) return;
    throw InputError("it took longer than " + fixed_digits(options.budget_min, 0) +
                     " min (--budget)");
  };
  try {
    fly_suite(maps, one);
  } catch (const CLI::RuntimeError& stop) {
    if (stop.get_exit_code() != kExitUnflown) throw;
    submission.problem = "trials have no result: their worker was killed";
  } catch (const InputError& error) {
    submission.problem = error.problems().front().message;
  }
}

/// A row a submission: the graded ones by score, then the others with what is wrong.
Table grade_table(const std::vector<Board>& boards, const std::vector<Submission>& submissions) {
  Table table = make_table(
      "grades", "",
      {{.name = "submission", .place = Place::key},
       {.name = "score_mps", .header = "score", .unit = "m/s", .decimals = 2, .has_interval = true},
       {.name = "missions"},
       {.name = "success_rate", .header = "success", .decimals = 3},
       {.name = "problem", .place = Place::words}});
  for (const Board& board : boards) {
    for (const BoardEntry& entry : board.entries) {
      const double missions = static_cast<double>(entry.score.all.trial_count);
      table.rows.push_back(make_row(entry.result.label, entry.score.score.value,
                                    entry.score.score.interval, entry.score.all.trial_count,
                                    static_cast<double>(entry.score.success_count) / missions, ""));
    }
  }
  for (const Submission& submission : submissions) {
    if (submission.problem.empty()) continue;
    table.rows.push_back(
        make_row(submission.name, Row(5), submission.problem));  // no score, missions, success
  }
  return table;
}

void grade(const GradeOptions& options) {
  check_output(options.output.output, text(options.output.format));
  std::vector<Submission> submissions = submissions_of(options.submissions);
  const SuiteMaps maps = suite_maps(options.suite);
  const fs::path folder = made_folder(options.suite.folder);
  std::vector<std::string> graded;
  for (Submission& submission : submissions) {
    std::cerr << "submission " << &submission - submissions.data() + 1 << " of "
              << submissions.size() << ": " << submission.name << '\n';
    const std::string own_folder = (folder / safe_file_name(submission.name)).string();
    if (submission.problem.empty()) grade_one(options, maps, own_folder, submission);
    if (submission.problem.empty()) graded.push_back(own_folder);
  }
  const std::vector<Board> boards = boards_of(graded, options.suite.track);
  write_table(grade_table(boards, submissions), options.output);
  write_page(board_page(boards, page_origin(), folder), (folder / "board.html").string());
}

}  // namespace

void add_grade_command(CLI::App& app) {
  const auto [command, options] = add_command(
      app, "grade", "Fly many planners on a suite: one table, and a page for each", grade);
  options.suite.track = "avoidbench-1/depth";
  options.suite.folder = "grades";
  options.suite.split = "dev";
  options.suite.run.trial_timeout_s = 300.0;
  add_typed(command, "submissions", options.submissions, "SUBMISSIONS",
            "Folder of submissions: each a .py, a .so, or a folder with one")
      ->required();
  add_typed(command, "--suite", options.suite.track, "SUITE/TRACK",
            "Track, as avoidbench-1/depth, or FOLDER/TRACK");
  CLI::Option* split = add_choice(command, "--split", options.suite.split, {"dev", "public"},
                                  "Maps: those that everybody knows");
  add_typed(
      command, "--sealed", options.suite.sealed, "KEYFILE",
      "Fly the sealed maps, whose seeds follow from the key in this file; /dev/stdin for none "
      "on the disk")
      ->excludes(split);
  add_typed(command, "--folder", options.suite.folder, "FOLDER", "Where results go, a folder each");
  command
      .add_option("--budget", options.budget_min,
                  "Wall time of one submission, checked before each sweep, min")
      ->check(CLI::PositiveNumber);
  command.add_flag("--no-causes", options.suite.no_causes,
                   "Do not fly failures again to find their causes");
  add_suite_flying(command, options.suite.run);
  add_output_options(command, options.output);
  command.footer(
      "A submission that can't be graded is reported and costs the others nothing. The same "
      "command "
      "resumes. docs/tutorial_course.md\n\n"
      "Examples:\n"
      "  avoidbench grade submissions/ --format csv --output grades.csv\n"
      "  gpg -d key.gpg | avoidbench grade submissions/ --sealed /dev/stdin");
}

}  // namespace avoidbench
