#include "run_page.hpp"

#include <ctime>
#include <iostream>
#include <utility>

#include "base/data_folder.hpp"
#include "base/input_error.hpp"
#include "base/output_file.hpp"
#include "page_output.hpp"
#include "run_progress.hpp"

namespace avoidbench {
namespace {

/// What a symbolic link leads to, there or not: the link itself is not replaced.
std::filesystem::path behind_links(std::filesystem::path file) {
  constexpr int kMostLinks = 40;  // as Linux follows them
  std::error_code error;
  for (int i = 0; i < kMostLinks && std::filesystem::is_symlink(file, error); ++i) {
    file = file.parent_path() / std::filesystem::read_symlink(file, error);
  }
  return file;
}

}  // namespace

void check_run_page(const std::string& file) {
  check_page(file);
  check_output_file(file + ".part");  // as it is called while it is written
  std::error_code error;
  const bool is_there = std::filesystem::exists(file, error);
  if (file == "-" || (is_there && !std::filesystem::is_regular_file(file, error))) {
    throw InputError("--page " + file + ": expected a file, which is replaced as the run goes on");
  }
}

nlohmann::ordered_json write_run_page(const std::filesystem::path& file,
                                      const std::string& database, const std::string& sweep,
                                      std::int64_t revision, const PageOrigin& origin,
                                      nlohmann::ordered_json run) {
  nlohmann::ordered_json page;
  if (run.at("done") > 0) {
    const std::string exact = revision == 0 ? sweep : sweep + "@" + std::to_string(revision);
    page = page_of_run(database, exact, origin, std::move(run));
  } else {
    page = sweeps_page({}, {}, origin, page_room({}, 0));
    page["title"] = sweep;
    page["run"] = std::move(run);
  }
  replace_page(page, file);
  return page;
}

RunPage::RunPage(const std::string& file, const std::filesystem::path& database, std::string sweep)
    : file_(behind_links(file)), database_(database.string()), sweep_(std::move(sweep)) {
  const PageOrigin origin = page_origin();
  nlohmann::ordered_json nothing_yet = run(RunState::running);
  nothing_yet["written_s"] = std::time(nullptr);
  write_run_page(file_, database_, sweep_, 0, origin, std::move(nothing_yet));
  writer_.emplace(std::vector<std::string>{program_file().string(), "run-page", "--command",
                                           origin.command, "--", file_.string(), database_,
                                           sweep_});
  std::cerr << "open " << file << " in a browser: it follows the run\n";
}

void RunPage::set_revision(std::int64_t revision) { revision_ = revision; }

nlohmann::ordered_json RunPage::run(RunState state) const {
  const double elapsed_s = std::chrono::duration<double>(Clock::now() - began_).count();
  const nlohmann::json progress = progress_json(progress_, elapsed_s);
  nlohmann::ordered_json run{{"state", text(state)}};
  for (const char* const name : {"total", "done", "is_open", "left_s"}) run[name] = progress[name];
  // The last page depends on the results alone.
  if (state != RunState::running) run.erase("left_s");
  return run;
}

void RunPage::show(const Progress& progress) {
  constexpr std::chrono::seconds kPause(1);
  progress_ = progress;
  const auto now = Clock::now();
  if (now - offered_ < kPause) return;
  offered_ = now;
  nlohmann::ordered_json message = run(RunState::running);
  message["revision"] = revision_;
  writer_->offer(message.dump() + "\n");
}

void RunPage::finish(RunState state) {
  // A writer that could not write has said so and ended.
  const bool has_warned = !writer_->offer("\n");
  writer_.reset();
  try {
    say_written(write_run_page(file_, database_, sweep_, revision_, page_origin(), run(state)),
                file_);
  } catch (const InputError& error) {
    if (!has_warned) std::cerr << "warning: " << error.what() << '\n';
  }
}

}  // namespace avoidbench
