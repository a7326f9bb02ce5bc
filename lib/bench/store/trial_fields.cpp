#include "store/trial_fields.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "base/input_error.hpp"
#include "store/schema_check.hpp"
#include "store/statement.hpp"
#include "store/stored_text.hpp"
#include "store/trial_table.hpp"

namespace avoidbench {
namespace {

struct NamedField {
  std::string_view name, sql;
};

/// Aliases: t trials, p planners, m maps, i missions, r runs.
constexpr NamedField kNamedFields[] = {
    {"planner", "p.label"},
    {"planner_name", "p.name"},
    {"planner_version", "p.version"},
    {"is_privileged", "p.is_privileged"},
    {"generator", "m.generator"},
    {"map_seed", "m.map_seed"},
    {"poisson_radius_m", "json_extract(m.spec_json, '$.poisson_radius_m')"},
    {"obstacle_count", "m.obstacle_count"},
    {"traversability", "m.traversability"},
    {"traversability_normalized_ratio", "m.traversability_normalized_ratio"},
    {"relative_gap_size", "m.relative_gap_size"},
    {"obstacle_density_1pm2", "m.obstacle_density_1pm2"},
    {"free_volume_ratio", "m.free_volume_ratio"},
    {"seed", "json_extract(t.spec_json, '$.seed')"},
    {"mission_index", "t.mission_index"},
    {"reference_length_m", "i.reference_length_m"},
    {"traversability_obstruction", "i.traversability_obstruction"},
    {"view_occlusion", "i.view_occlusion"},
    {"angle_over_length_1pm", "i.angle_over_length_1pm"},
    {"outcome", "t.outcome"},
    {"is_finished", "t.outcome = 'reached_goal'"},
    {"reason", "t.reason"},
    {"cause", "(SELECT cause FROM explanations e WHERE e.trial_key = t.trial_key)"},
    {"end_time_s", "t.end_time_s"},
    {"attempt", "t.attempt"},
    {"program_version", "r.program_version"},
    {"git_hash", "r.git_hash"},
    {"host", "r.host"},
    {"cpu", "r.cpu"},
    {"sensor", "json_extract(t.spec_json, '$.sensor.name')"},
    {"vehicle", "json_extract(t.spec_json, '$.vehicle.name')"},
};

constexpr std::string_view kParameterPrefix = "planner.";
/// No parameters, though "planner." stands before them: fields of the choice itself.
constexpr std::string_view kOwnOfPlanner[] = {"label", "plugin", "file_digest"};

/// Text in quotes for SQL or a JSON path: quotes within are doubled.
std::string in_quotes(std::string_view text, char quote) {
  std::string out(1, quote);
  for (const char c : text) {
    if (c == quote) out += quote;
    out += c;
  }
  return out + quote;
}

/// `$."a"[0]."b"` for a.0.b, as a literal of SQL.
std::string json_path(std::string_view dotted) {
  std::string path = "$";
  while (!dotted.empty()) {
    const std::size_t dot = dotted.find('.');
    std::string part(dotted.substr(0, dot));
    std::erase(part, '"');  // which no key of ours has
    const bool is_index =
        !part.empty() && part.find_first_not_of("0123456789") == std::string::npos;
    path += is_index ? "[" + part + "]" : ".\"" + part + "\"";
    dotted.remove_prefix(dot == std::string_view::npos ? dotted.size() : dot + 1);
  }
  return in_quotes(path, '\'');
}

/// Named fields first, then metrics, then a planner's parameters, then any path of the spec. The
/// text is safe in SQL: names are known, or quoted.
std::string sql_of(const Database& db, const std::string& field) {
  for (const NamedField& named : kNamedFields) {
    if (named.name == field) return std::string(named.sql);
  }
  for (const MetricRow& metric : db.metrics()) {
    if (metric.name == field) return "t." + sql_name(field);
  }
  if (field.starts_with(kParameterPrefix)) {
    const std::string name = field.substr(kParameterPrefix.size());
    if (std::find(std::begin(kOwnOfPlanner), std::end(kOwnOfPlanner), name) ==
        std::end(kOwnOfPlanner)) {
      // Parameters are a list of {name, number, text, is_text} in the spec.
      return "(SELECT CASE WHEN json_extract(value, '$.is_text') THEN json_extract(value, "
             "'$.text') ELSE json_extract(value, '$.number') END FROM json_each(t.spec_json, "
             "'$.planner.parameters') WHERE json_extract(value, '$.name') = " +
             in_quotes(name, '\'') + ")";
    }
  }
  if (field.find('.') != std::string::npos) {
    return "json_extract(t.spec_json, " + json_path(field) + ")";
  }
  std::vector<std::string> known;
  for (const NamedField& named : kNamedFields) known.emplace_back(named.name);
  for (const MetricRow& metric : db.metrics()) known.push_back(metric.name);
  throw InputError("trials have no field " + field + did_you_mean(field, known) +
                   "; a field is a column of the view trial_table, a metric, or a path such as "
                   "map.poisson_radius_m or sensor.kind");
}

void append_paths(const nlohmann::json& object, const std::string& prefix,
                  std::vector<std::string>& paths) {
  for (const auto& [key, value] : object.items()) {
    if (value.is_object()) {
      append_paths(value, prefix + key + ".", paths);
    } else if (value.is_primitive()) {
      paths.push_back(prefix + key);
    }
  }
}

/// Every path of a trial's spec and its planner's parameters.
std::vector<std::string> paths_of(const Database& db, const std::string& trial_key) {
  Statement s(db.handle(), db.path(),
              "SELECT spec_json, trial_key FROM trials WHERE trial_key = ?");
  s.rows_of("trials", 1).bind_text(trial_key);
  std::vector<std::string> paths;
  if (!s.step()) return paths;
  try {
    const nlohmann::json spec = stored_object(s.text(0));
    append_paths(spec, "", paths);
    if (!spec.contains("planner")) return paths;
    for (const auto& parameter : spec["planner"].value("parameters", nlohmann::json::array())) {
      paths.push_back(std::string(kParameterPrefix) + parameter.value("name", ""));
    }
  } catch (const nlohmann::json::exception&) {
    s.damaged("spec_json is no spec of a trial");
  } catch (const BadText& bad) {
    s.damaged(std::string("spec_json is ") + bad.what());
  }
  return paths;
}

/// Whether it is a field by its looks: what a file says here may be anybody's.
bool is_path(const std::string& text) {
  const bool is_plain = std::all_of(text.begin(), text.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
           c == '.';
  });
  return is_plain && (text.find('.') != std::string::npos || text == "map_seed" || text == "seed");
}

}  // namespace

Outcome outcome_of(const Statement& row, int column) {
  const std::string name = row.text(column);
  const auto outcome = enum_from_text<Outcome>(name);
  if (!outcome)
    row.damaged("outcome '" + name.substr(0, 40) + "' is none that this avoidbench knows");
  return *outcome;
}

std::string metric_columns(const Database& db) {
  std::string columns;
  for (const MetricRow& metric : db.metrics()) columns += ", t." + sql_name(metric.name);
  return columns;
}

std::vector<double> metrics_of(const Database& db, const Statement& row, int first_column) {
  std::vector<double> values;
  values.reserve(db.metrics().size());
  for (std::size_t i = 0; i < db.metrics().size(); ++i) {
    values.push_back(row.real(first_column + static_cast<int>(i)));
  }
  return values;
}

std::string field_columns(const Database& db, const std::vector<std::string>& fields) {
  std::string columns;
  for (const std::string& field : fields) columns += ", " + sql_of(db, field);
  return columns;
}

std::vector<std::string> axis_fields(std::span<const SweepInfo> sweeps) {
  std::vector<std::string> fields;
  for (const SweepInfo& sweep : sweeps) {
    for (const std::string& path : axis_paths(sweep.spec_json)) {
      const bool is_new = std::find(fields.begin(), fields.end(), path) == fields.end();
      if (is_new && is_path(path)) fields.push_back(path);
    }
  }
  return fields;
}

/// A path is not known until a trial is looked at: where no trial has it, it is likely misspelt.
void refuse_empty_field(const Database& db, const SweepResult& result, std::size_t field) {
  const std::string& name = result.fields[field];
  if (name.find('.') == std::string::npos || result.trials.empty()) return;
  const bool is_there =
      std::any_of(result.trials.begin(), result.trials.end(), [&](const TrialSummary& trial) {
        return !std::holds_alternative<std::monostate>(trial.fields[field]);
      });
  if (is_there) return;
  throw InputError("no trial of sweep " + result.name + " has a value at " + name +
                   did_you_mean(name, paths_of(db, result.trials.front().key)));
}

}  // namespace avoidbench
