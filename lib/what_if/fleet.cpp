#include "what_if/fleet.hpp"

#include <chrono>
#include <memory>
#include <set>
#include <utility>

#include "process/process_tree.hpp"
#include "replay/apart_worker.hpp"

namespace avoidbench {
namespace {

using Clock = std::chrono::steady_clock;

bool is_set(const std::atomic<bool>* flag) { return flag != nullptr && flag->load(); }

/// A worker, what it flies, and which planner it has in memory.
struct FleetSeat {
  std::unique_ptr<ApartWorker> worker;  ///< none: one is started with the next flight
  std::optional<FleetFlight> flight;
  std::string planner_digest;
  bool is_second_try = false;
};

class Fleet {
 public:
  Fleet(const std::function<std::optional<FleetFlight>()>& next,
        const std::function<void(std::size_t, ApartFlight)>& ended, const FleetOptions& options)
      : next_(next), ended_(ended), options_(options) {
    adopt_orphans();
    for (int i = 0; i < options.jobs; ++i) seats_.emplace_back();
  }
  ~Fleet() {
    for (FleetSeat& seat : seats_) seat.worker.reset();
    end_left_behind();
  }
  Fleet(const Fleet&) = delete;
  Fleet& operator=(const Fleet&) = delete;

  bool fly() {
    std::optional<Clock::time_point> stopped;
    while (!is_set(options_.stop_now)) {
      const bool is_stopping = is_set(options_.stop);
      if (!is_stopping) hand_out();
      const std::vector<const ApartWorker*> busy = busy_workers();
      if (busy.empty()) return !is_stopping || is_all_begun_;
      if (is_stopping && !stopped) stopped = Clock::now();
      const std::chrono::duration<double> grace(options_.grace_s);
      if (stopped && Clock::now() - *stopped > grace) return false;
      wait_for_news(busy);
      for (FleetSeat& seat : seats_) {
        if (seat.flight) take_news(seat);
      }
    }
    return false;
  }

 private:
  void hand_out() {
    for (FleetSeat& seat : seats_) {
      if (seat.flight || is_all_begun_) continue;
      std::optional<FleetFlight> flight = next_();
      is_all_begun_ = !flight;
      if (flight) begin(seat, std::move(*flight), false);
    }
  }

  void begin(FleetSeat& seat, FleetFlight flight, bool is_second_try) {
    const std::string& planner = flight.job.spec.planner.file_digest;
    const bool may_stay = seat.worker && !seat.worker->is_over() && !is_second_try &&
                          seat.planner_digest == planner && (flight.needs & AB_USES_GLOBALS) == 0;
    if (!may_stay) {
      if (seat.worker) {
        seat.worker.reset();
        end_left_behind();
      }
      seat.worker = std::make_unique<ApartWorker>(options_.apart, flight.needs);
    }
    seat.planner_digest = planner;
    seat.is_second_try = is_second_try;
    seat.flight = std::move(flight);
    // Sent as a copy: one that is killed from outside is flown again.
    seat.worker->begin(seat.flight->job);
  }

  void take_news(FleetSeat& seat) {
    std::optional<ApartFlight> result = seat.worker->look();
    if (!result) return;
    FleetFlight flight = std::move(*std::exchange(seat.flight, std::nullopt));
    if (!result->killed_by.empty() && !seat.is_second_try) {
      begin(seat, std::move(flight), true);
    } else {
      ended_(flight.index, std::move(*result));
    }
  }

  std::vector<const ApartWorker*> busy_workers() const {
    std::vector<const ApartWorker*> busy;
    for (const FleetSeat& seat : seats_) {
      if (seat.flight) busy.push_back(seat.worker.get());
    }
    return busy;
  }

  /// Ends what planners detached, now that its worker is gone.
  void end_left_behind() const {
    std::set<pid_t> spared = others_;
    for (const FleetSeat& seat : seats_) {
      if (seat.worker) spared.insert(seat.worker->pid());
    }
    end_orphans(spared);
  }

  const std::function<std::optional<FleetFlight>()>& next_;
  const std::function<void(std::size_t, ApartFlight)>& ended_;
  const FleetOptions& options_;
  const std::set<pid_t> others_ = own_children();  ///< of before: not ours to end
  std::vector<FleetSeat> seats_;
  bool is_all_begun_ = false;
};

}  // namespace

bool fly_fleet(const std::function<std::optional<FleetFlight>()>& next,
               const std::function<void(std::size_t, ApartFlight)>& ended,
               const FleetOptions& options) {
  return Fleet(next, ended, options).fly();
}

}  // namespace avoidbench
