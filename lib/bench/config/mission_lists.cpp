#include "config/mission_lists.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <set>
#include <utility>

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
  Place start = {};
  std::vector<Place> goals = {};
  std::optional<double> yaw_deg = {};
  std::string map = {};
};

/// With the heading toward the first goal where none was written.
void add(const WrittenMission& written, SweepSpec& sweep) {
  const bool is_whole = written.start && !written.goals.empty() &&
                        std::all_of(written.goals.begin(), written.goals.end(),
                                    [](const Place& goal) { return goal.has_value(); });
  if (!is_whole) return;  // a problem was added
  Mission mission{.start_world = *written.start, .goal_world = *written.goals.back()};
  for (std::size_t i = 0; i + 1 < written.goals.size(); ++i) {
    mission.waypoints_world.push_back(*written.goals[i]);
  }
  mission.start_yaw_rad = written.yaw_deg
                              ? *written.yaw_deg * math::kDegree
                              : yaw_toward_goal_rad(*written.start, *written.goals.front());
  sweep.missions.push_back({.map = written.map,
                            .mission = std::move(mission),
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

/// `goals`: places in the order in which they are to be reached.
std::vector<Place> read_goals(const GivenValue& given) {
  std::vector<Place> goals;
  if (!check_list(given)) return goals;
  for (const GivenValue& element : given.elements()) goals.push_back(read_place(element));
  if (goals.empty()) given.add_problem("expected at least one place, [x, y, z] in metres");
  if (goals.size() > kMostGoals) {
    given.add_problem("more than " + std::to_string(kMostGoals) + " goals");
  }
  return goals;
}

void read_entry(const GivenValue& given, SweepSpec& sweep) {
  MappingReader mapping(given);
  // The reader has told what it is instead.
  if (given.node.kind != YamlNode::Kind::mapping) return;
  WrittenMission written{.node = given.node};
  const auto lacks = [&](const char* name) {
    given.add_problem(std::string("lacks '") + name + "': [x, y, z] in metres");
  };
  if (const auto start = mapping.take("start")) {
    written.start = read_place(*start);
  } else {
    lacks("start");
  }
  const auto goal = mapping.take("goal");
  const auto goals = mapping.take("goals");
  if (goal && goals) goals->add_problem("'goal' is given too");
  if (goals) {
    written.goals = read_goals(*goals);
  } else if (goal) {
    written.goals = {read_place(*goal)};
  } else {
    lacks("goal");
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

/// Of goal 2 and so on.
std::array<std::string, 3> goal_columns(std::size_t number) {
  const std::string goal = "goal" + std::to_string(number);
  return {goal + "_x_m", goal + "_y_m", goal + "_z_m"};
}

/// How many goals the columns have places for: as many as follow each other without a gap.
std::size_t goal_count(const std::vector<YamlNode>& columns) {
  std::set<std::string> names;
  for (const YamlNode& column : columns) names.insert(column.scalar);
  std::size_t count = 1;
  while (count < kMostGoals && names.contains(goal_columns(count + 1).front())) ++count;
  return count;
}

/// The columns may stand in any order; the places' six are needed, and those of further goals in
/// threes.
void check_header(const std::vector<YamlNode>& columns, std::vector<InputProblem>& problems) {
  std::vector<std::string> needed(kPlaceColumns.begin(), kPlaceColumns.end());
  for (std::size_t number = 2; number <= goal_count(columns); ++number) {
    for (const std::string& name : goal_columns(number)) needed.push_back(name);
  }
  std::vector<std::string> known = needed;
  known.insert(known.end(), {"yaw_deg", "map"});
  // What spreadsheets of some countries write.
  if (columns.size() == 1 && columns[0].scalar.find_first_of(";\t") != std::string::npos) {
    problems.push_back(problem_at(columns[0], "columns must be separated by commas"));
    return;
  }
  std::set<std::string> seen;
  for (const YamlNode& column : columns) {
    const std::string& name = column.scalar;
    const bool is_new = seen.insert(name).second;
    if (std::find(known.begin(), known.end(), name) == known.end()) {
      const std::string hint = did_you_mean(name, known);
      problems.push_back(problem_at(
          column, "unknown column '" + name + "'" + hint + "; columns are " + joined(known) +
                      ", and of further goals " + joined(goal_columns(goal_count(columns) + 1))));
    } else if (!is_new) {
      problems.push_back(problem_at(column, "a second column '" + name + "'"));
    }
  }
  for (const std::string& name : needed) {
    if (seen.contains(name)) continue;
    problems.push_back(problem_at(columns[0], "lacks the column '" + name + "'"));
  }
}

/// A mapping from the columns' names to the fields of a line.
void read_row(const GivenValue& row, SweepSpec& sweep) {
  const YamlNode& node = row.node;
  if (node.items.size() != node.keys.size()) {
    row.add_problem(counted(node.items.size(), "field") + ", but " +
                    counted(node.keys.size(), "column"));
    return;
  }
  WrittenMission written{.node = node};
  const auto number_in = [&](const std::string& column, Range range) {
    return read_number(row.at(*node.find(column), column), range);
  };
  const auto place_in = [&](const std::string& of) -> Place {
    const auto x = number_in(of + "_x_m", kPlaces_m);
    const auto y = number_in(of + "_y_m", kPlaces_m);
    const auto z = number_in(of + "_z_m", kPlaces_m);
    return x && y && z ? Place({*x, *y, *z}) : std::nullopt;
  };
  written.start = place_in("start");
  written.goals = {place_in("goal")};
  const std::size_t most = goal_count(node.keys);
  // Fewer goals than another row has: the rest is empty.
  const auto is_empty = [&](std::size_t number) {
    const auto names = goal_columns(number);
    return std::all_of(names.begin(), names.end(),
                       [&](const std::string& name) { return node.find(name)->scalar.empty(); });
  };
  std::size_t count = most;
  while (count > 1 && is_empty(count)) --count;
  for (std::size_t number = 2; number <= count; ++number) {
    written.goals.push_back(place_in("goal" + std::to_string(number)));
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
    GivenValue{*file, "mission.file", reading}.add_problem("mission.list is given too");
  } else if (file != nullptr) {
    read_file({*file, "mission.file", reading}, sweep);
  } else if (list != nullptr) {
    read_list({*list, "mission.list", reading}, sweep);
  }
}

void settle_missions(const YamlNode& root, SweepSpec& sweep, Reading& reading) {
  if (sweep.missions.empty()) return;
  bool has_waypoints = false;
  for_each_combination(sweep, [&](const TrialSpec& trial) {
    has_waypoints = has_waypoints || trial.mission.waypoints > 0;
  });
  if (has_waypoints) {
    reading.at("mission.waypoints")
        .add_problem("has no effect on listed missions: list their goals");
  }
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
                                     " missions that are listed; without it, all are flown");
  }
}

}  // namespace avoidbench
