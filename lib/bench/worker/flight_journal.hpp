#pragma once

#include <cstddef>
#include <optional>

#include "trial/trial_record.hpp"

namespace avoidbench {

/// How far a worker's flight has come, in memory that its parent shares: what is left of it when
/// the worker dies in a call of the planner. The worker's pages are closed except while it writes,
/// so that a stray write of the planner's crashes instead of changing them.
class FlightJournal {
 public:
  /// Room for an hour of flight at 100 samples per second; pages that are not used take no memory.
  static constexpr std::size_t kBytes = std::size_t{96} << 20U;

  /// In the parent: a new one. Where the system gives no memory for it (a limit on the size of
  /// files counts here, too), nothing is written and flown() is nothing.
  FlightJournal();
  /// In the worker: the parent's, behind `fd`, which is closed. Nothing is written if `fd` is none.
  explicit FlightJournal(int fd);
  ~FlightJournal();
  FlightJournal(FlightJournal&& other) noexcept;
  FlightJournal& operator=(FlightJournal&& other) noexcept;

  int fd() const { return fd_; }  ///< to be passed on; -1 in the worker

  /// A new trial begins.
  void restart();
  /// The planner is about to be called at `time_s`: adds what `record` has since the last call.
  void add(const TrialRecord& record, double time_s);

  /// Samples, calls and collisions up to the last call, and as its end that call's time; nothing
  /// where no call was reached, or the memory makes no sense.
  std::optional<TrialRecord> flown() const;

 private:
  struct Header;

  void open_pages();
  void close_pages();
  void append(int what, const void* bytes, std::size_t size);

  int fd_ = -1;
  std::byte* memory_ = nullptr;
  bool is_of_worker_ = false;
  std::size_t samples_ = 0, plan_calls_ = 0, collisions_ = 0;  ///< written
};

}  // namespace avoidbench
