#include "run_progress.hpp"

#include <unistd.h>

#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>
#include <utility>

#include "base/output_file.hpp"
#include "base/visible_text.hpp"
#include "base/words.hpp"
#include "visible_streams.hpp"

namespace avoidbench {
namespace {

std::int64_t due_of(const Progress& progress) { return progress.total - progress.invalid_missions; }

bool is_done(const Progress& progress) {
  return !progress.is_open && progress.done >= due_of(progress);
}

/// Wall time until the end at this run's rate; negative while nothing was flown, or while nobody
/// knows how many trials follow.
double left_s(const Progress& progress, double elapsed_s) {
  const auto flown = static_cast<double>(progress.done - progress.done_before);
  if (flown <= 0.0 || progress.is_open) return -1.0;
  return elapsed_s / flown * static_cast<double>(due_of(progress) - progress.done);
}

/// "12/30 trials", and of an open number "12 trials so far, 4 more in this round".
std::string trials_text(const Progress& progress) {
  const std::int64_t due = due_of(progress), done = progress.done;
  if (!progress.is_open) return std::to_string(done) + "/" + counted(due, "trial");
  std::string text = counted(done, "trial") + " so far";
  if (done < due) text += ", " + std::to_string(due - done) + " more in this round";
  return text;
}

}  // namespace

nlohmann::json progress_json(const Progress& progress, double elapsed_s) {
  nlohmann::json planners = nlohmann::json::object();
  for (const auto& [label, planner] : progress.planners) {
    planners[label] = {{"flown", planner.flown}, {"reached_goal", planner.reached_goal}};
  }
  const double left = left_s(progress, elapsed_s);
  return {{"total", due_of(progress)},
          {"done", progress.done},
          {"done_before", progress.done_before},
          {"invalid_missions", progress.invalid_missions},
          {"is_open", progress.is_open},
          {"elapsed_s", elapsed_s},
          {"left_s", left >= 0.0 ? nlohmann::json(left) : nlohmann::json(nullptr)},
          {"planners", planners}};
}

std::string duration_text(double duration_s) {
  char text[32];
  const int whole_s = static_cast<int>(duration_s);
  if (whole_s >= 3600) {
    std::snprintf(text, sizeof text, "%d h %02d min", whole_s / 3600, whole_s / 60 % 60);
  } else if (whole_s >= 60) {
    std::snprintf(text, sizeof text, "%d min %02d s", whole_s / 60, whole_s % 60);
  } else {
    std::snprintf(text, sizeof text, "%.0f s", duration_s);
  }
  return text;
}

RunProgress::RunProgress(ProgressStyle style, std::filesystem::path heartbeat)
    : style_(style),
      heartbeat_(std::move(heartbeat)),
      is_live_(style == ProgressStyle::line && ::isatty(STDERR_FILENO) == 1) {
  if (heartbeat_.empty()) return;
  check_output_file(fresh_heartbeat());
  open_output(heartbeat_);
}

/// What the heartbeat is written to first.
std::filesystem::path RunProgress::fresh_heartbeat() const { return heartbeat_.string() + ".new"; }

void RunProgress::show(const Progress& progress) {
  if (is_finished_) return;
  is_finished_ = is_done(progress);
  beat(progress);
  if (style_ == ProgressStyle::line) draw_line(progress);
  if (style_ == ProgressStyle::json) print_json(progress);
}

void RunProgress::draw_line(const Progress& progress) {
  const std::int64_t due = due_of(progress);
  const auto now = Clock::now();
  const std::int64_t tenth = due > 0 ? 10 * progress.done / due : 10;
  // An open number has no tenths.
  const auto least_pause = is_live_ ? std::chrono::milliseconds(200) : std::chrono::minutes(1);
  const bool is_due =
      is_live_ || progress.is_open ? is_finished_ || now - shown_ > least_pause : tenth > tenth_;
  if (!is_due) return;
  shown_ = now;
  if (!progress.is_open) tenth_ = tenth;
  const double elapsed_s = std::chrono::duration<double>(now - began_).count();
  std::string line = trials_text(progress);
  if (is_finished_) {
    line += " in " + duration_text(elapsed_s);
  } else if (const double left = left_s(progress, elapsed_s); left >= 0.0) {
    line += ", " + duration_text(left) + " left";
  }
  for (const auto& [label, planner] : progress.planners) {
    line += " | " + visible_line(label) + " " + std::to_string(planner.reached_goal) + "/" +
            std::to_string(planner.flown);
  }
  show_at_once((is_live_ ? "\r\033[K" : "") + line + (is_live_ && !is_finished_ ? "" : "\n"));
}

void RunProgress::print_json(const Progress& progress) {
  const auto now = Clock::now();
  if (!is_finished_ && now - shown_ < std::chrono::seconds(1)) return;
  shown_ = now;
  const double elapsed_s = std::chrono::duration<double>(now - began_).count();
  show_at_once(progress_json(progress, elapsed_s).dump() + "\n");
}

void RunProgress::beat(const Progress& progress) {
  const auto now = Clock::now();
  if (heartbeat_.empty() || (!is_finished_ && now - beaten_ < std::chrono::seconds(5))) return;
  beaten_ = now;
  const double elapsed_s = std::chrono::duration<double>(now - began_).count();
  // Moved into place, so that nobody reads half of it; a full disk does not end the run.
  const std::filesystem::path fresh = fresh_heartbeat();
  std::ofstream(fresh) << progress_json(progress, elapsed_s).dump() << '\n';
  std::error_code error;
  std::filesystem::rename(fresh, heartbeat_, error);
}

}  // namespace avoidbench
