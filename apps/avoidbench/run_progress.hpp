#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "sweep/run_sweep.hpp"

namespace avoidbench {

enum class ProgressStyle { none, line, json };

/// Tells how far a run is: on stderr, one live line on a terminal, else a line each tenth of the
/// way (each minute where nobody knows yet how many trials there will be), or JSON, an object a
/// line every second at most; and in a heartbeat file, the same object written anew every five
/// seconds, so that whoever watches sees that the run lives.
class RunProgress {
 public:
  /// `heartbeat` empty: no such file. Throws InputError where it can't be written.
  RunProgress(ProgressStyle style, std::filesystem::path heartbeat);

  void show(const Progress& progress);

 private:
  void draw_line(const Progress& progress);
  void print_json(const Progress& progress);
  void beat(const Progress& progress);
  std::filesystem::path fresh_heartbeat() const;

  using Clock = std::chrono::steady_clock;
  ProgressStyle style_;
  std::filesystem::path heartbeat_;
  bool is_live_ = false, is_finished_ = false;
  Clock::time_point began_ = Clock::now(), shown_{}, beaten_{};
  std::int64_t tenth_ = -1;
};

/// What the heartbeat says. `left_s` is an estimate, null while there is none.
nlohmann::json progress_json(const Progress& progress, double elapsed_s);

/// "5 s", "12 min 05 s", "3 h 20 min".
std::string duration_text(double duration_s);

}  // namespace avoidbench
