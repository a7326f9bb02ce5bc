#include "store/visit_trials.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "store/schema_check.hpp"
#include "store/statement.hpp"
#include "store/trial_fields.hpp"

namespace avoidbench {
namespace {

/// SQLite's way to write a dotted path: `$.cameras[0].fov_x_deg`.
std::string sqlite_path(std::string_view path) {
  std::string result = "$";
  while (!path.empty()) {
    const std::string_view part = path.substr(0, path.find('.'));
    path.remove_prefix(std::min(path.size(), part.size() + 1));
    const bool is_index = !part.empty() && std::all_of(part.begin(), part.end(),
                                                       [](char c) { return c >= '0' && c <= '9'; });
    result += is_index ? "[" + std::string(part) + "]" : "." + std::string(part);
  }
  return result;
}

}  // namespace

std::vector<std::string> axis_paths(std::string_view sweep_spec_json) {
  std::vector<std::string> paths;
  // From a file of anybody's: what is no spec has no axes.
  const auto spec = nlohmann::json::parse(sweep_spec_json, nullptr, false);
  if (!spec.is_object() || !spec.contains("axes") || !spec["axes"].is_array()) return paths;
  for (const nlohmann::json& axis : spec["axes"]) {
    if (axis.contains("path") && axis["path"].is_string()) paths.push_back(axis["path"]);
  }
  return paths;
}

void visit_trials(const Database& database, std::string_view sweep, std::int64_t revision,
                  std::span<const std::string> paths,
                  const std::function<void(VisitedTrial)>& visit) {
  // Rows are found by key, all over the file: pages that several share are to stay in memory.
  execute(database.handle(), database.path(), "PRAGMA cache_size = -65536");  // KiB
  std::string columns;
  // As JSON text, so that 1 and "1" differ.
  for (std::size_t i = 0; i < paths.size(); ++i) columns += ", t.spec_json -> ?";
  for (const MetricRow& metric : database.metrics()) columns += ", t." + sql_name(metric.name);
  Statement s(
      database.handle(), database.path(),
      "SELECT t.planner_key, t.map_key, t.mission_index, t.outcome" + columns +
          ", t.trial_key, (SELECT cause FROM explanations e WHERE e.trial_key = "
          "t.trial_key) FROM sweep_trials s JOIN trials t USING (trial_key) WHERE s.sweep = ? AND "
          "s.revision = ?");
  s.rows_of("trials", 4 + static_cast<int>(paths.size() + database.metrics().size()));
  for (const std::string& path : paths) s.bind_text(sqlite_path(path));
  s.bind_text(sweep).bind_integer(revision);
  while (s.step()) {
    VisitedTrial trial;
    trial.planner_key = s.text(0);
    trial.map_key = s.text(1);
    trial.mission_index = s.integer(2);
    trial.outcome = outcome_of(s, 3);
    int column = 4;
    for (std::size_t i = 0; i < paths.size(); ++i) trial.settings.push_back(s.free_text(column++));
    trial.metrics.reserve(database.metrics().size());
    for (std::size_t i = 0; i < database.metrics().size(); ++i) {
      trial.metrics.push_back(s.real(column++));
    }
    trial.cause = s.free_text(column + 1);  // behind the key
    visit(std::move(trial));
  }
}

}  // namespace avoidbench
