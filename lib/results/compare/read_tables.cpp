#include <limits>
#include <optional>
#include <set>
#include <utility>

#include "base/input_error.hpp"
#include "base/input_file.hpp"
#include "base/option_error.hpp"
#include "base/words.hpp"
#include "compare/trial_table.hpp"
#include "store/row_digest.hpp"
#include "store/trial_table.hpp"

namespace avoidbench {
namespace {

/// One file, opened: a database with its sweeps, or the table of a CSV.
struct Source {
  std::string file;
  std::optional<Database> database = {};
  std::vector<SweepInfo> sweeps = {};  ///< with trials, the latest revision of a name last
  TrialTable table = {};
};

/// Whether the file begins as databases do, or is too short for a table.
/// What is too short for a table is opened as a database, whose reader says what is wrong with it.
bool may_be_database(const std::filesystem::path& path) {
  InputFile file(path, std::numeric_limits<std::uint64_t>::max());
  std::string start(16, '\0');
  const std::size_t count = file.read(start);
  return count < start.size() || start.starts_with("SQLite format 3");
}

/// Sweeps without a finished trial are left out: nothing of them can be compared.
Source open_source(const std::filesystem::path& path) {
  Source source{.file = path.string()};
  if (may_be_database(path)) {
    source.database = Database::open_for_reading(path);
    check_digests(*source.database, false);
    for (SweepInfo& sweep : source.database->read_sweeps()) {
      if (sweep.trial_count > 0) source.sweeps.push_back(std::move(sweep));
    }
    if (source.sweeps.empty()) refuse_file(path, "has no finished trial");
    return source;
  }
  constexpr std::uint64_t kMostBytes = 2'000'000'000;
  source.table = table_of_csv(read_input_file(path, kMostBytes), source.file);
  return source;
}

/// The names of its sweeps, each once.
std::vector<std::string> names_of(const Source& source) {
  std::vector<std::string> names;
  if (!source.database) names.push_back(source.table.sweep);
  for (const SweepInfo& sweep : source.sweeps) {
    // Revisions of a name adjoin.
    if (names.empty() || names.back() != sweep.name) names.push_back(sweep.name);
  }
  return names;
}

/// The sweep that NAME or NAME@REVISION means in a database, the latest revision where it says
/// none.
const SweepInfo& sweep_of(const Source& source, const std::string& wanted) {
  const SweepInfo* found = nullptr;
  for (const SweepInfo& sweep : source.sweeps) {
    const bool is_wanted =
        wanted == sweep.name || wanted == sweep.name + "@" + std::to_string(sweep.revision);
    // The last match: without a revision, the latest.
    if (is_wanted) found = &sweep;
  }
  if (found == nullptr) {
    const std::vector<std::string> names = names_of(source);
    refuse_file(source.file, "has no trials of a sweep " + wanted + did_you_mean(wanted, names) +
                                 "; there are: " + joined(names));
  }
  return *found;
}

/// The table of sweep `wanted`, whose trials are told apart by `axes` too.
TrialTable take(Source& source, const std::string& wanted, const std::vector<std::string>& axes) {
  if (source.database) {
    TrialTable table = table_of_sweep(*source.database, sweep_of(source, wanted), axes);
    return table;
  }
  // A table in CSV is of one revision, which it does not name.
  const bool is_wanted = wanted == source.table.sweep || wanted == source.table.sweep + "@1";
  if (!is_wanted) {
    refuse_file(source.file, "is a table of sweep " + source.table.sweep + ", not of " + wanted);
  }
  // A CSV has one table, which is taken once.
  return std::move(source.table);
}

std::vector<std::string> axes_of(const Source& source, const std::string& wanted) {
  return source.database ? axis_paths(sweep_of(source, wanted).spec_json) : source.table.axes;
}

/// The names of the sweeps to compare, where none was asked for.
/// The one sweep of each file, whatever they are called, or the one name that both have.
std::pair<std::string, std::string> only_sweeps(const Source& base, const Source& now) {
  const std::vector<std::string> names = names_of(base), others = names_of(now);
  if (names.size() == 1 && others.size() == 1) return {names.front(), others.front()};
  std::vector<std::string> common;
  for (const std::string& name : names) {
    if (contains(others, name)) common.push_back(name);
  }
  if (common.size() == 1) return {common.front(), common.front()};
  throw OptionError("which sweep? " + base.file + " has " + joined(names) + "; " + now.file +
                        " has " + joined(others) + ": name one of both, or BASE:NEW",
                    "", "sweep");
}

std::vector<std::string> labels_of(const TrialTable& table) {
  std::set<std::string> labels;
  for (const TableTrial& trial : table.trials) labels.insert(trial.identity.planner);
  return {labels.begin(), labels.end()};
}

/// The two labels. A label may have a colon itself: splits are tried from the last colon on, and
/// the first that fits both sides counts.
std::pair<std::string, std::string> split(const std::string& wanted,
                                          const std::vector<std::string>& base,
                                          const std::vector<std::string>& now) {
  std::pair<std::string, std::string> labels{wanted, wanted};
  for (std::size_t at = wanted.rfind(':'); at != std::string::npos && at > 0;
       at = wanted.rfind(':', at - 1)) {
    labels = {wanted.substr(0, at), wanted.substr(at + 1)};
    if (contains(base, labels.first) && contains(now, labels.second)) return labels;
  }
  if (contains(base, wanted) && contains(now, wanted)) return {wanted, wanted};
  // Nothing fits: keep() says which label of the last split a side lacks.
  return labels;
}

/// Both sides' trials get one label, so that their identities pair.
void keep(TrialTable& table, const std::vector<std::string>& labels, const std::string& label,
          const std::string& shown) {
  if (!contains(labels, label)) {
    throw OptionError(label + ": " + table.source + " has no such planner" +
                          did_you_mean(label, labels) + "; there are: " + joined(labels),
                      "planner");
  }
  std::erase_if(table.trials,
                [&](const TableTrial& trial) { return trial.identity.planner != label; });
  for (TableTrial& trial : table.trials) trial.identity.planner = shown;
}

}  // namespace

TablePair read_tables(const std::filesystem::path& base, const std::filesystem::path& now,
                      const std::string& sweep) {
  Source first = open_source(base), second = open_source(now);
  std::pair<std::string, std::string> wanted{sweep, sweep};
  if (sweep.empty()) {
    wanted = only_sweeps(first, second);
  } else if (const std::size_t colon = sweep.find(':'); colon != std::string::npos) {
    wanted = {sweep.substr(0, colon), sweep.substr(colon + 1)};
  }
  // What is an axis in one of them tells trials apart in both.
  std::vector<std::string> axes = axes_of(first, wanted.first);
  // In both tables, so that identities have the same parts; table_of_sweep() takes each once.
  for (std::string& path : axes_of(second, wanted.second)) axes.push_back(std::move(path));
  return {.base = take(first, wanted.first, axes), .now = take(second, wanted.second, axes)};
}

TrialTable read_table(const std::filesystem::path& file, const std::string& sweep) {
  Source source = open_source(file);
  const std::vector<std::string> names = names_of(source);
  if (sweep.empty() && names.size() > 1) {
    throw OptionError("which sweep? " + source.file + " has " + joined(names) + ": name one", "",
                      "sweep");
  }
  const std::string wanted = sweep.empty() ? names.front() : sweep;
  const std::vector<std::string> axes = axes_of(source, wanted);
  return take(source, wanted, axes);
}

TablePair of_planners(TablePair tables, const std::string& wanted) {
  const std::vector<std::string> of_base = labels_of(tables.base), of_now = labels_of(tables.now);
  const auto [base, now] = split(wanted, of_base, of_now);
  const std::string shown = base == now ? base : base + " → " + now;
  keep(tables.base, of_base, base, shown);
  keep(tables.now, of_now, now, shown);
  if (base != now) {
    tables.base.source = base + " of " + tables.base.source;
    tables.now.source = now + " of " + tables.now.source;
  }
  return tables;
}

}  // namespace avoidbench
