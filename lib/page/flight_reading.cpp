#include "page/flight_reading.hpp"

#include <algorithm>
#include <atomic>
#include <exception>
#include <thread>

#include "base/input_error.hpp"
#include "page/flight_data.hpp"

namespace avoidbench {
namespace {

constexpr std::size_t kMostReaders = 8;

PackedFlight packed_flight(const std::string& key, const std::vector<Database>& databases) {
  PackedFlight flight;
  flight.problem = "it is in none of the databases";
  for (std::size_t i = 0; i < databases.size() && !flight.stored; ++i) {
    try {
      flight.stored = read_stored_trial(databases[i], key);
      flight.database = i;
    } catch (const InputError& error) {
      flight.problem = error.what();
    }
  }
  if (!flight.stored) return flight;
  TrialRecord& record = flight.stored->row.record;
  if (!record.samples.empty()) {
    flight.json = std::make_unique<nlohmann::ordered_json>(flight_json(record, kPageSamples_hz));
  }
  // Many wait at a time: only what is shown stays in memory.
  record.samples = {};
  record.plan_calls = {};
  return flight;
}

}  // namespace

FlightReader::FlightReader(std::span<const PageDatabase> databases) {
  const std::size_t count =
      std::clamp<std::size_t>(std::thread::hardware_concurrency(), 1, kMostReaders);
  for (std::size_t i = 0; i < count; ++i) {
    std::vector<Database>& own = handles_.emplace_back();
    for (const PageDatabase& one : databases) {
      own.push_back(Database::open_for_reading(one.database->path()));
    }
  }
}

std::vector<PackedFlight> FlightReader::read(std::span<const std::string> keys) {
  std::vector<PackedFlight> flights(keys.size());
  std::vector<std::exception_ptr> problems(handles_.size());
  std::atomic<std::size_t> next = 0;
  const auto work = [&](std::size_t reader) {
    try {
      for (std::size_t i = next++; i < keys.size(); i = next++) {
        flights[i] = packed_flight(keys[i], handles_[reader]);
      }
    } catch (...) {
      problems[reader] = std::current_exception();
    }
  };
  std::vector<std::thread> threads;
  for (std::size_t i = 1; i < handles_.size(); ++i) threads.emplace_back(work, i);
  work(0);
  for (std::thread& thread : threads) thread.join();
  for (const std::exception_ptr& problem : problems) {
    if (problem) std::rethrow_exception(problem);
  }
  return flights;
}

}  // namespace avoidbench
