#include "custom_metrics/computed_metrics.hpp"

#include <sqlite3.h>

#include <algorithm>
#include <bit>
#include <chrono>
#include <cstdint>
#include <memory>
#include <sstream>

#include "base/input_error.hpp"
#include "base/math.hpp"
#include "store/schema_check.hpp"

namespace avoidbench {
namespace {

using math::kNaN;

/// For SQLite: statements may read, and nothing else.
int only_reading(void* /*unused*/, int action, const char* /*unused*/, const char* /*unused*/,
                 const char* /*unused*/, const char* /*unused*/) {
  // load_extension() stays off unless a program turns it on; ATTACH and PRAGMA are other actions.
  const bool is_reading = action == SQLITE_SELECT || action == SQLITE_READ ||
                          action == SQLITE_FUNCTION || action == SQLITE_RECURSIVE;
  return is_reading ? SQLITE_OK : SQLITE_DENY;
}

/// For as long as it lives.
class OnlyReading {
 public:
  explicit OnlyReading(sqlite3* handle) : handle_(handle) {
    sqlite3_set_authorizer(handle_, only_reading, nullptr);
  }
  ~OnlyReading() { sqlite3_set_authorizer(handle_, nullptr, nullptr); }
  OnlyReading(const OnlyReading&) = delete;
  OnlyReading& operator=(const OnlyReading&) = delete;

 private:
  sqlite3* handle_;
};

/// Interrupts statements at the deadline, for as long as it lives: SQL can go on for ever.
class Deadline {
 public:
  Deadline(sqlite3* handle, double limit_s)
      : handle_(handle),
        end_(Clock::now() +
             std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(limit_s))) {
    constexpr int kInstructions = 100'000;  // about a millisecond
    sqlite3_progress_handler(handle_, kInstructions, is_over, this);
  }
  ~Deadline() { sqlite3_progress_handler(handle_, 0, nullptr, nullptr); }
  Deadline(const Deadline&) = delete;
  Deadline& operator=(const Deadline&) = delete;

 private:
  using Clock = std::chrono::steady_clock;
  static int is_over(void* self) { return Clock::now() >= static_cast<Deadline*>(self)->end_; }

  sqlite3* handle_;
  Clock::time_point end_;
};

struct Finalize {
  void operator()(sqlite3_stmt* statement) const { sqlite3_finalize(statement); }
};
using Prepared = std::unique_ptr<sqlite3_stmt, Finalize>;

/// Of trials in the database.
std::size_t trial_count(sqlite3* handle) {
  sqlite3_stmt* statement = nullptr;
  sqlite3_prepare_v2(handle, "SELECT count(*) FROM trials", -1, &statement, nullptr);
  const Prepared count(statement);
  return sqlite3_step(statement) == SQLITE_ROW
             ? static_cast<std::size_t>(sqlite3_column_int64(statement, 0))
             : 0;
}

/// The one statement that a metric's file may hold.
Prepared prepare(sqlite3* handle, const std::string& sql) {
  sqlite3_stmt* statement = nullptr;
  const char* rest = nullptr;
  const int code =
      // Preparing alone runs nothing, and the authorizer refuses here what would write.
      sqlite3_prepare_v2(handle, sql.data(), static_cast<int>(sql.size()), &statement, &rest);
  Prepared prepared(statement);
  if (code != SQLITE_OK) throw InputError(sqlite3_errmsg(handle));
  // Comments and blanks alone make no statement, and no error either.
  if (!prepared) throw InputError("holds no SELECT");
  // What follows may be comments and blanks only.
  sqlite3_stmt* next = nullptr;
  const auto left = static_cast<int>(sql.data() + sql.size() - rest);
  const bool has_more = sqlite3_prepare_v2(handle, rest, left, &next, nullptr) != SQLITE_OK || next;
  sqlite3_finalize(next);
  if (has_more) throw InputError("holds more than one statement");
  return prepared;
}

/// The descriptions of `-- NAME: description`, by name.
std::map<std::string, std::string> descriptions(const std::string& sql) {
  std::map<std::string, std::string> found;
  std::istringstream lines(sql);
  for (std::string line; std::getline(lines, line);) {
    const std::size_t colon = line.find(": ");
    if (!line.starts_with("-- ") || colon == std::string::npos) continue;
    found.emplace(line.substr(3, colon - 3), line.substr(colon + 2));
  }
  return found;
}

double number_at(sqlite3_stmt* row, int column) {
  switch (sqlite3_column_type(row, column)) {
    // A trial that the metric does not speak of.
    case SQLITE_NULL:
      return kNaN;
    case SQLITE_INTEGER:
    case SQLITE_FLOAT:
      return sqlite3_column_double(row, column);
    default:
      throw InputError("column " + std::string(sqlite3_column_name(row, column)) +
                       " has a value that is not a number");
  }
}

/// By bits, so that NaN is equal to itself.
bool are_equal(const std::vector<double>& a, const std::vector<double>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](double x, double y) {
    return std::bit_cast<std::uint64_t>(x) == std::bit_cast<std::uint64_t>(y);
  });
}

}  // namespace

MetricRow described_metric(const std::string& name, std::string doc) {
  if (!is_column_name(name)) {
    throw InputError("'" + name + "' can't be the name of a metric: use a-z, 0-9 and _");
  }
  MetricRow metric;
  metric.name = name;
  metric.version = 1;
  // "[m/s]" anywhere in the description is the unit, and is taken out with a blank before it.
  const std::size_t open = doc.find('['), close = doc.find(']', open);
  if (close != std::string::npos) {
    metric.unit = doc.substr(open + 1, close - open - 1);
    const std::size_t blank = open > 0 && doc[open - 1] == ' ' ? 1 : 0;
    doc.erase(open - blank, close - open + 1 + blank);
  }
  for (const Better better : {Better::less, Better::more}) {
    const std::string phrase =
        "; " + std::string(avoidbench::text(better)) + " is better";  // reports say it
    const std::size_t at = doc.find(phrase);
    if (at == std::string::npos) continue;
    metric.better = better;
    doc.erase(at, phrase.size());
  }
  metric.doc = doc;
  return metric;
}

ComputedMetrics query_metrics(const Database& database, const std::string& sql, double limit_s) {
  const std::size_t most_trials = trial_count(database.handle());
  const OnlyReading only_reading(database.handle());
  const Deadline deadline(database.handle(), limit_s);
  const Prepared statement = prepare(database.handle(), sql);
  const std::map<std::string, std::string> docs = descriptions(sql);
  ComputedMetrics computed;
  int key_column = -1;
  std::vector<int> columns;
  for (int i = 0; i < sqlite3_column_count(statement.get()); ++i) {
    const std::string name = sqlite3_column_name(statement.get(), i);
    if (name == "trial_key") {
      key_column = i;
      continue;
    }
    const auto doc = docs.find(name);
    computed.metrics.push_back(described_metric(name, doc == docs.end() ? "" : doc->second));
    computed.metrics.back().formula = "a column of its SELECT";
    columns.push_back(i);
  }
  if (key_column < 0) throw InputError("the SELECT has no column trial_key");
  if (columns.empty()) throw InputError("the SELECT has no column except trial_key");
  int code = SQLITE_ROW;
  while ((code = sqlite3_step(statement.get())) == SQLITE_ROW) {
    // SQLite converts numbers to text here; a key is text anyway.
    const unsigned char* key = sqlite3_column_text(statement.get(), key_column);
    if (key == nullptr) throw InputError("the SELECT has a row without trial_key");
    std::vector<double> values;
    for (const int column : columns) values.push_back(number_at(statement.get(), column));
    const std::string trial = reinterpret_cast<const char*>(key);
    // Joins may repeat a row; equal values are no contradiction.
    const auto [there, is_new] = computed.values.emplace(trial, values);
    if (computed.values.size() > most_trials) {
      throw InputError("the SELECT has more trial_keys than there are trials");
    }
    if (!is_new && !are_equal(there->second, values)) {
      throw InputError("the SELECT has two rows of trial " + trial.substr(0, 12) +
                       " with different values");
    }
  }
  if (code == SQLITE_INTERRUPT) {
    throw InputError(
        "the SELECT did not finish within " + shortest(limit_s) +
        " s, the limit: look for a join without its condition or a recursion without an end");
  }
  if (code != SQLITE_DONE) throw InputError(sqlite3_errmsg(database.handle()));
  return computed;
}

void add_metrics(const ComputedMetrics& computed, SweepResult& result) {
  // Two metrics of one name could not be told apart in reports.
  for (const MetricRow& metric : computed.metrics) {
    for (const MetricRow& there : result.metrics) {
      if (there.name == metric.name) {
        throw InputError("a metric " + metric.name + " already exists: choose another name");
      }
    }
    result.metrics.push_back(metric);
  }
  for (TrialSummary& trial : result.trials) {
    const auto found = computed.values.find(trial.key);
    if (found != computed.values.end()) {
      trial.metrics.insert(trial.metrics.end(), found->second.begin(), found->second.end());
    } else {
      trial.metrics.insert(trial.metrics.end(), computed.metrics.size(), kNaN);
    }
  }
}

}  // namespace avoidbench
