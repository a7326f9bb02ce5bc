#include "config/mission_lists.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <set>

#include "base/input_file.hpp"
#include "base/math.hpp"
#include "base/words.hpp"
#include "config/sweep_axes.hpp"
#include "config/sweep_keys.hpp"
#include "sweep/listed_missions.hpp"
#include "yaml/includes.hpp"
#include "yaml/yaml_values.hpp"

namespace avoidbench {
namespace {

/// The value of a key; null also where it is empty, as by `--set mission.list=~`.
const YamlNode* said(const YamlNode& mapping, std::string_view key) {
  const YamlNode* node = mapping.find(key);
  return node != nullptr && node->kind != YamlNode::Kind::null ? node : nullptr;
}

using Place = std::optional<Eigen::Vector3d>;

constexpr Range kPlaces_m{-kFarthestPlace_m, kFarthestPlace_m};
constexpr Range kYaw_deg{-360, 360};

/// A mission as it is written, by a list's mapping or a table's row.
struct WrittenMission {
  const YamlNode& node;  ///< where it stands
  Place start, goal;
  std::optional<double> yaw_deg;
  std::string map;
};

/// With the heading toward the goal where none was written.
void add(const WrittenMission& written, SweepSpec& sweep) {
  if (!written.start || !written.goal) return;  // a problem was added
  const double yaw_rad = written.yaw_deg ? *written.yaw_deg * math::kDegree
                                         : yaw_toward_goal_rad(*written.start, *written.goal);
  sweep.missions.push_back({.map = written.map,
                            .mission = {.start_world = *written.start,
                                        .goal_world = *written.goal,
                                        .start_yaw_rad = yaw_rad},
                            // So that what is found wrong later, on the map itself, has its line.
                            .place = problem_at(written.node, "")});
}

// -------------------------------------------------------------------------------------------------
// a list

Place read_place(const GivenValue& given) {
  if (!check_list(given, 3)) return std::nullopt;
  std::vector<double> place;
  for (const GivenValue& element : given.elements()) {
    const auto number = read_number(element, kPlaces_m);
    if (!number) return std::nullopt;
    place.push_back(*number);
  }
  return Eigen::Vector3d(place[0], place[1], place[2]);
}

void read_entry(const GivenValue& given, SweepSpec& sweep) {
  MappingReader mapping(given);
  // The reader has told what it is instead.
  if (given.node.kind != YamlNode::Kind::mapping) return;
  WrittenMission written{.node = given.node, .start = {}, .goal = {}, .yaw_deg = {}, .map = {}};
  for (const auto& [name, place] :
       {std::pair("start", &written.start), std::pair("goal", &written.goal)}) {
    if (const auto value = mapping.take(name)) {
      *place = read_place(*value);
    } else {
      given.add_problem(std::string("lacks '") + name + "': [x, y, z] in metres");
    }
  }
  if (const auto yaw = mapping.take("yaw_deg")) written.yaw_deg = read_number(*yaw, kYaw_deg);
  if (const auto map = mapping.take("map")) written.map = read_text(*map).value_or("");
  mapping.finish();
  add(written, sweep);
}

void read_list(const GivenValue& given, SweepSpec& sweep) {
  if (!check_list(given)) return;
  const std::vector<GivenValue> elements = given.elements();
  if (elements.empty()) given.add_problem("expected at least one mission");
  for (const GivenValue& element : elements) read_entry(element, sweep);
}

// -------------------------------------------------------------------------------------------------
// a table

const std::array<std::string, 6> kPlaceColumns{"start_x_m", "start_y_m", "start_z_m",
                                               "goal_x_m",  "goal_y_m",  "goal_z_m"};

/// The fields of a line, each with its column; a quoted one is text.
std::vector<YamlNode> fields_of(std::string_view line, const YamlNode& row,
                                std::vector<InputProblem>& problems) {
  std::vector<YamlNode> fields;
  bool is_quoted = false;
  const auto begin_field = [&](std::size_t at) {
    // A node at the row's place: readers of YAML values then serve for tables too.
    fields.push_back(node_at(row, YamlNode::Kind::scalar));
    fields.back().column = static_cast<int>(at) + 1;
  };
  begin_field(0);
  for (std::size_t i = 0; i < line.size(); ++i) {
    std::string& field = fields.back().scalar;
    if (is_quoted && line.substr(i).starts_with("\"\"")) {
      // A doubled quote is one.
      field += line[i++];
    } else if (line[i] == '"') {
      is_quoted = !is_quoted;
    } else if (line[i] == ',' && !is_quoted) {
      begin_field(i + 1);
    } else if (!field.empty() || line[i] != ' ' || is_quoted) {  // blanks before a word
      field += line[i];
    }
  }
  if (is_quoted) problems.push_back(problem_at(fields.back(), "a quote is not closed"));
  for (YamlNode& field : fields) {
    while (field.scalar.ends_with(' ') || field.scalar.ends_with('\t')) field.scalar.pop_back();
  }
  return fields;
}

/// The columns may stand in any order; the places' six are needed.
void check_header(const std::vector<YamlNode>& columns, std::vector<InputProblem>& problems) {
  std::vector<std::string> known(kPlaceColumns.begin(), kPlaceColumns.end());
  known.insert(known.end(), {"yaw_deg", "map"});
  // What spreadsheets of some countries write.
  if (columns.size() == 1 && columns[0].scalar.find_first_of(";\t") != std::string::npos) {
    problems.push_back(problem_at(columns[0], "columns must be parted by commas"));
    return;
  }
  std::set<std::string> seen;
  for (const YamlNode& column : columns) {
    const std::string& name = column.scalar;
    const bool is_new = seen.insert(name).second;
    if (std::find(known.begin(), known.end(), name) == known.end()) {
      const std::string hint = did_you_mean(name, known);
      problems.push_back(problem_at(
          column, "unknown column '" + name + "'" + hint + "; columns are " + joined(known)));
    } else if (!is_new) {
      problems.push_back(problem_at(column, "a second column '" + name + "'"));
    }
  }
  for (const std::string& name : kPlaceColumns) {
    if (seen.contains(name)) continue;
    problems.push_back(problem_at(columns[0], "lacks the column '" + name + "'"));
  }
}

/// A mapping from the columns' names to the fields of a line.
void read_row(const GivenValue& row, SweepSpec& sweep) {
  const YamlNode& node = row.node;
  if (node.items.size() != node.keys.size()) {
    row.add_problem(std::to_string(node.items.size()) + " fields, but " +
                    std::to_string(node.keys.size()) + " columns");
    return;
  }
  WrittenMission written{.node = node, .start = {}, .goal = {}, .yaw_deg = {}, .map = {}};
  const auto number_in = [&](const std::string& column, Range range) {
    return read_number(row.at(*node.find(column), column), range);
  };
  for (const auto& [name, place] :
       {std::pair("start", &written.start), std::pair("goal", &written.goal)}) {
    const std::string of(name);
    const auto x = number_in(of + "_x_m", kPlaces_m);
    const auto y = number_in(of + "_y_m", kPlaces_m);
    const auto z = number_in(of + "_z_m", kPlaces_m);
    if (x && y && z) *place = Eigen::Vector3d(*x, *y, *z);
  }
  const YamlNode* yaw = node.find("yaw_deg");
  if (yaw != nullptr && !yaw->scalar.empty()) written.yaw_deg = number_in("yaw_deg", kYaw_deg);
  if (const YamlNode* map = node.find("map")) written.map = map->scalar;
  add(written, sweep);
}

/// Lines end with LF or CR LF; empty ones, and those that begin with #, are passed over.
void read_table(const std::filesystem::path& file, const GivenValue& given, SweepSpec& sweep) {
  constexpr std::uint64_t kMostBytes = 64U << 20U;
  // A table of a thousand wrong rows has said enough.
  constexpr std::size_t kMostProblems = 20;
  const std::string text = read_input_file(file, kMostBytes);
  std::string_view rest = text;
  if (rest.starts_with("\xEF\xBB\xBF")) rest.remove_prefix(3);  // as spreadsheets write it
  YamlNode row;
  row.kind = YamlNode::Kind::mapping;
  row.source = std::make_shared<const std::string>(file.string());
  row.column = 1;
  std::vector<InputProblem>& problems = given.reading.problems;
  const std::size_t before = problems.size(), listed_before = sweep.missions.size();
  while (!rest.empty() && problems.size() < before + kMostProblems) {
    std::string_view line = rest.substr(0, rest.find('\n'));
    rest.remove_prefix(std::min(rest.size(), line.size() + 1));
    if (line.ends_with('\r')) line.remove_suffix(1);
    ++row.line;
    if (line.find_first_not_of(" \t") == std::string_view::npos || line.front() == '#') continue;
    row.items = fields_of(line, row, problems);
    if (!row.keys.empty()) {
      read_row({row, "", given.reading}, sweep);
      continue;
    }
    row.keys = std::move(row.items);
    check_header(row.keys, problems);
    // Rows can't be read by wrong columns.
    if (problems.size() > before) return;
  }
  if (sweep.missions.size() > listed_before || problems.size() > before) return;
  given.add_problem(file.string() + " lists no mission");
}

void read_file(const GivenValue& given, SweepSpec& sweep) {
  const auto name = read_text(given);
  if (!name) return;
  try {
    read_table((folder_of(given.node, ".") / *name).lexically_normal(), given, sweep);
  } catch (const InputError& error) {
    given.add_problems(error);
  }
}

}  // namespace

void read_missions(const YamlNode& root, SweepSpec& sweep, Reading& reading) {
  const YamlNode* block = root.find("mission");
  if (block == nullptr) return;
  const YamlNode* list = said(*block, "list");
  const YamlNode* file = said(*block, "file");
  if (list != nullptr && file != nullptr) {
    GivenValue{*file, "mission.file", reading}.add_problem("there is mission.list too");
  } else if (file != nullptr) {
    read_file({*file, "mission.file", reading}, sweep);
  } else if (list != nullptr) {
    read_list({*list, "mission.list", reading}, sweep);
  }
}

void settle_missions(const YamlNode& root, SweepSpec& sweep, Reading& reading) {
  if (sweep.missions.empty()) return;
  std::set<std::string> names, maps, empty_maps;
  std::int64_t most = 0;
  // Which maps there are depends on the axes.
  for_each_combination(sweep, [&](const TrialSpec& trial) {
    const std::vector<std::string> of_map = map_names(trial);
    names.insert(of_map.begin(), of_map.end());
    maps.insert(of_map.front());
    const auto count = static_cast<std::int64_t>(missions_of(sweep.missions, trial).size());
    if (count == 0) empty_maps.insert(of_map.front());
    most = std::max(most, count);
  });
  for (const ListedMission& mission : sweep.missions) {
    if (mission.map.empty() || names.contains(mission.map)) continue;
    const std::vector<std::string> known(maps.begin(), maps.end()), all(names.begin(), names.end());
    InputProblem problem = mission.place;
    problem.message = "the sweep has no map '" + mission.map + "'" +
                      did_you_mean(mission.map, all) + "; it has " + joined(known);
    reading.problems.push_back(std::move(problem));
  }
  for (const std::string& map : empty_maps) {
    reading.at("mission").add_problem("no mission is listed for map " + map);
  }
  if (said(root, "trials") == nullptr) {
    // Nothing said: all that are listed.
    sweep.trials = most;
  } else if (sweep.trials > most) {
    reading.at("trials").add_problem(std::to_string(sweep.trials) + " is more than the " +
                                     std::to_string(most) +
                                     " missions that are listed; left out, all are flown");
  }
}

}  // namespace avoidbench
