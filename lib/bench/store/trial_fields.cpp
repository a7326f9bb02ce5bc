#include "store/trial_fields.hpp"

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <utility>

#include "base/check.hpp"
#include "base/input_error.hpp"
#include "base/json_path.hpp"
#include "base/words.hpp"
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
    {"flight_digest", "t.flight_digest"},
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

constexpr std::string_view kMapPrefix = "map.", kParameterPrefix = "planner.",
                           kFilterPrefix = "filter.";
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

/// Of two parts or more. SQLite takes no path with an empty part.
bool is_dotted(std::string_view path) {
  const std::vector<std::string_view> parts = parts_of_path(path);
  return parts.size() > 1 && !contains(parts, "");
}

/// What the JSON in the column says at this path.
std::string extracted(std::string_view column, std::string_view path) {
  return "json_extract(" + std::string(column) + ", " + in_quotes(sql_json_path(path), '\'') + ")";
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
    std::string name = field.substr(kParameterPrefix.size());
    const bool of_filter = name.starts_with(kFilterPrefix);
    if (of_filter) name.erase(0, kFilterPrefix.size());
    if (std::find(std::begin(kOwnOfPlanner), std::end(kOwnOfPlanner), name) ==
        std::end(kOwnOfPlanner)) {
      // Parameters are a list of {name, number, text, is_text} in the spec.
      return "(SELECT CASE WHEN json_extract(value, '$.is_text') THEN json_extract(value, "
             "'$.text') ELSE json_extract(value, '$.number') END FROM json_each(t.spec_json, "
             "'$.planner." +
             std::string(of_filter ? kFilterPrefix : "") +
             "parameters') WHERE json_extract(value, '$.name') = " + in_quotes(name, '\'') + ")";
    }
  }
  if (is_dotted(field)) {
    // The map's own row has the same, and is shorter than a trial's by far.
    if (!field.starts_with(kMapPrefix)) return extracted("t.spec_json", field);
    return extracted("m.spec_json", std::string_view(field).substr(kMapPrefix.size()));
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
    const auto add_parameters = [&paths](const nlohmann::json& plugin, const std::string& prefix) {
      for (const auto& parameter : plugin.value("parameters", nlohmann::json::array())) {
        paths.push_back(prefix + parameter.value("name", ""));
      }
    };
    const std::string prefix(kParameterPrefix);
    add_parameters(spec["planner"], prefix);
    if (spec["planner"].contains("filter")) {
      add_parameters(spec["planner"]["filter"], prefix + std::string(kFilterPrefix));
    }
  } catch (const nlohmann::json::exception&) {
    s.damaged("spec_json is not the spec of a trial");
  } catch (const BadText& bad) {
    s.damaged(std::string("spec_json is ") + bad.what());
  }
  return paths;
}

/// Whether it is a field by its looks: what a file says here may be anybody's, and becomes SQL.
bool is_path(const std::string& text) {
  constexpr std::size_t kMostLetters = 200;
  const bool is_plain = std::all_of(text.begin(), text.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
           c == '.';
  });
  return is_plain && text.size() <= kMostLetters &&
         (is_dotted(text) || text == kSeedField || text == "seed");
}

/// The elements of an object's array; none where it has no such array.
nlohmann::json elements(const nlohmann::json& object, const char* name) {
  if (!object.is_object() || !object.contains(name)) return nlohmann::json::array();
  return object[name].is_array() ? object[name] : nlohmann::json::array();
}

/// The parameters to which a sweep's planners of one plugin give several values, as fields.
std::vector<std::string> varied_parameters(const nlohmann::json& sweep) {
  std::vector<std::string> fields;
  std::map<std::pair<std::string, std::string>, nlohmann::json> first;  // by plugin and name
  for (const nlohmann::json& planner : elements(sweep, "planners")) {
    for (const nlohmann::json& parameter : elements(planner, "parameters")) {
      const auto plugin = planner.find("plugin");
      if (plugin == planner.end() || !plugin->is_string() || !parameter.is_object()) continue;
      const auto name = parameter.find("name");
      if (name == parameter.end() || !name->is_string()) continue;
      const auto word = name->get<std::string>();
      const auto known = first.try_emplace({plugin->get<std::string>(), word}, parameter).first;
      const std::string field = std::string(kParameterPrefix) + word;
      if (known->second != parameter && !contains(fields, field)) fields.push_back(field);
    }
  }
  return fields;
}

}  // namespace

Outcome outcome_of(const Statement& row, int column) {
  const std::string name = row.text(column);
  const auto outcome = enum_from_text<Outcome>(name);
  if (!outcome) row.damaged("outcome '" + name.substr(0, 40) + "' is unknown to this avoidbench");
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

std::string sql_json_path(std::string_view field) {
  std::string path = "$";
  for (const std::string_view text : parts_of_path(field)) {
    std::string part(text);
    std::erase(part, '"');  // which no key of ours has
    const bool is_index =
        !part.empty() && part.find_first_not_of("0123456789") == std::string::npos;
    path += is_index ? "[" + part + "]" : ".\"" + part + "\"";
  }
  return path;
}

std::vector<std::string> axis_fields(std::span<const SweepInfo> sweeps) {
  // SQLite has 2,000 columns at most, and people look at far fewer.
  constexpr std::size_t kMostFields = 200;
  std::vector<std::string> fields;
  for (const SweepInfo& sweep : sweeps) {
    std::vector<std::string> paths = axis_paths(sweep.spec_json);
    const auto spec = nlohmann::json::parse(sweep.spec_json, nullptr, false);
    for (std::string& parameter : varied_parameters(spec)) paths.push_back(std::move(parameter));
    for (const std::string& path : paths) {
      if (fields.size() == kMostFields) return fields;
      if (is_path(path) && !contains(fields, path)) fields.push_back(path);
    }
  }
  return fields;
}

std::string axis_columns(const Database& db, const std::vector<std::string>& axes) {
  std::string columns;
  for (const std::string& axis : axes) {
    if (axis != kSeedField) columns += field_columns(db, {axis}) + " AS " + sql_name(axis);
  }
  return columns;
}

std::string setting_text(const std::vector<std::string>& fields,
                         const std::vector<TableValue>& values,
                         const std::vector<std::string>& axes) {
  AB_CHECK(fields.size() == values.size(), fields.size(), values.size());
  std::string text;
  for (std::size_t i = 0; i < fields.size(); ++i) {
    const std::string& field = fields[i];
    // Planners are told apart by their labels.
    const bool is_shown = contains(axes, field) && field != kSeedField &&
                          !field.starts_with(kParameterPrefix) && !text_of(values[i]).empty();
    if (!is_shown) continue;
    text += (text.empty() ? "" : ", ") + short_name(field, axes) + " " + text_of(values[i]);
  }
  return text;
}

namespace {

/// A path is not known until a trial is looked at: where no trial has it, it is likely misspelt.
template <class Trial>
void refuse_empty(const Database& db, const std::vector<Trial>& trials, std::size_t field,
                  const std::string& name, const std::string& of_what) {
  if (name.find('.') == std::string::npos || trials.empty()) return;
  const bool is_there = std::any_of(trials.begin(), trials.end(), [&](const Trial& trial) {
    return !std::holds_alternative<std::monostate>(trial.fields[field]);
  });
  if (is_there) return;
  throw InputError("no trial" + of_what + " has a value at " + name +
                   did_you_mean(name, paths_of(db, trials.front().key)));
}

}  // namespace

void refuse_empty_field(const Database& db, const SweepResult& result, std::size_t field) {
  refuse_empty(db, result.trials, field, result.fields[field], " of sweep " + result.name);
}

void refuse_empty_field(const Database& db, const std::vector<TrialListing>& trials,
                        std::size_t field, const std::string& name) {
  refuse_empty(db, trials, field, name, "");
}

}  // namespace avoidbench
