#include "page/flight_reading.hpp"

#include <algorithm>
#include <deque>
#include <utility>

#include "base/check.hpp"
#include "base/input_error.hpp"
#include "explain/paragraph.hpp"
#include "page/flight_data.hpp"

namespace avoidbench {
namespace {

constexpr std::size_t kMostReaders = 8;

/// A thread's own handle of a database.
struct Source {
  explicit Source(const std::filesystem::path& file)
      : database(Database::open_for_reading(file)), trials(database) {}

  Database database;
  StoredTrialReader trials;
};

PackedFlight packed_flight(const std::string& key, std::deque<Source>& sources) {
  PackedFlight flight;
  flight.problem = "none of the databases has it";
  for (std::size_t i = 0; i < sources.size() && !flight.stored; ++i) {
    try {
      flight.stored = sources[i].trials.read(key);
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

/// Why the flight failed: what was measured, by name, and in sentences.
void add_explanation(const ExplanationRow& row, PackedFlight& flight) {
  CauseFound found;
  try {
    found = {.cause = enum_from_text<Cause>(row.cause).value(),
             .facts = facts_from_json(row.facts_json)};
  } catch (const std::exception&) {
    throw InputError("trial " + row.trial_key + ": its explanation is not as it was written");
  }
  const TrialRecord& record = flight.stored->row.record;
  (*flight.json)["facts"] = nlohmann::ordered_json::parse(facts_json(found.facts));
  (*flight.json)["explanation"] = paragraph(found, record.outcome, record.reason);
}

}  // namespace

std::size_t bytes_in_page(const nlohmann::ordered_json& packed) {
  constexpr std::size_t kBeside_bytes = 400;  // start, goal, touches, names of all that
  constexpr std::size_t kExplanation_bytes = 1500;
  return packed["data"].get_ref<const std::string&>().size() + kBeside_bytes +
         (packed.contains("facts") ? kExplanation_bytes : 0);
}

FlightReader::FlightReader(std::span<const PageDatabase> databases, std::vector<std::string> keys,
                           std::size_t ahead_bytes)
    : keys_(std::move(keys)), ahead_bytes_(ahead_bytes), flights_(keys_.size()) {
  for (const PageDatabase& one : databases) {
    files_.push_back(one.database->path());
    for (ExplanationRow& row : one.database->read_explanations()) {
      std::string key = row.trial_key;
      explanations_.emplace(std::move(key), std::move(row));
    }
  }
  const std::size_t count =
      std::clamp<std::size_t>(std::thread::hardware_concurrency(), 1, kMostReaders);
  for (std::size_t i = 0; i < std::min(count, keys_.size()); ++i) {
    threads_.emplace_back([this] { work(); });
  }
}

FlightReader::~FlightReader() {
  {
    const std::lock_guard lock(mutex_);
    is_stopped_ = true;
  }
  changed_.notify_all();
  for (std::thread& thread : threads_) thread.join();
}

/// The next flight to be read, when it is its turn; nothing where there is no more to do.
std::optional<std::size_t> FlightReader::claimed() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] {
    return is_stopped_ || claimed_count_ == keys_.size() || claimed_count_ < asked_count_ ||
           bytes_ < ahead_bytes_;
  });
  if (is_stopped_ || claimed_count_ == keys_.size()) return std::nullopt;
  return claimed_count_++;
}

void FlightReader::work() {
  try {
    std::deque<Source> sources;  // neither moves
    for (const std::filesystem::path& file : files_) sources.emplace_back(file);
    while (const std::optional<std::size_t> at = claimed()) {
      auto flight = std::make_unique<PackedFlight>(packed_flight(keys_[*at], sources));
      const auto row = explanations_.find(keys_[*at]);
      if (row != explanations_.end() && flight->json != nullptr)
        add_explanation(row->second, *flight);
      const std::lock_guard lock(mutex_);
      if (flight->json != nullptr) bytes_ += bytes_in_page(*flight->json);
      flights_[*at] = std::move(flight);
      changed_.notify_all();
    }
  } catch (...) {
    const std::lock_guard lock(mutex_);
    problem_ = std::current_exception();
    changed_.notify_all();
  }
}

PackedFlight FlightReader::next() {
  std::unique_lock lock(mutex_);
  AB_CHECK(asked_count_ < keys_.size());
  std::unique_ptr<PackedFlight>& flight = flights_[asked_count_++];
  changed_.notify_all();
  changed_.wait(lock, [&] { return flight != nullptr || problem_ != nullptr; });
  if (problem_) std::rethrow_exception(problem_);
  return std::move(*std::exchange(flight, nullptr));
}

}  // namespace avoidbench
