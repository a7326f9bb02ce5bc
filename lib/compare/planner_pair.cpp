#include <algorithm>

#include "base/option_error.hpp"
#include "compare/trial_table.hpp"
#include "text/words.hpp"

namespace avoidbench {
namespace {

std::vector<std::string> labels_of(const TrialTable& table) {
  std::vector<std::string> labels;  // trials are in order of their identities: equal labels adjoin
  for (const TableTrial& trial : table.trials) {
    if (labels.empty() || labels.back() != trial.identity.planner) {
      labels.push_back(trial.identity.planner);
    }
  }
  return labels;
}

bool has(const std::vector<std::string>& labels, const std::string& label) {
  return std::find(labels.begin(), labels.end(), label) != labels.end();
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
    if (has(base, labels.first) && has(now, labels.second)) return labels;
  }
  if (has(base, wanted) && has(now, wanted)) return {wanted, wanted};
  // Nothing fits: keep() says which label of the last split a side lacks.
  return labels;
}

/// Both sides' trials get one label, so that their identities pair.
void keep(TrialTable& table, const std::vector<std::string>& labels, const std::string& label,
          const std::string& shown) {
  if (!has(labels, label)) {
    throw OptionError(label + ": " + table.source + " has no such planner" +
                          did_you_mean(label, labels) + "; there are: " + joined(labels),
                      "planner");
  }
  std::erase_if(table.trials,
                [&](const TableTrial& trial) { return trial.identity.planner != label; });
  for (TableTrial& trial : table.trials) trial.identity.planner = shown;
}

}  // namespace

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
