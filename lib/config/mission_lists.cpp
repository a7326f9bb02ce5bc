#include "config/mission_lists.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <set>

#include "base/input_file.hpp"
#include "base/math.hpp"
#include "config/sweep_axes.hpp"
#include "config/sweep_keys.hpp"
#include "sweep/listed_missions.hpp"
#include "yaml/includes.hpp"

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

Place read_place(const YamlNode& node, const std::string& path, Reading& reading) {
  if (!check_list(node, path, 3, reading.problems)) return std::nullopt;
  Eigen::Vector3d place;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto number = read_number(node.items[i], path + "[" + std::to_string(i) + "]", kPlaces_m,
                                    reading.problems);
    if (!number) return std::nullopt;
    place[static_cast<int>(i)] = *number;
  }
  return place;
}

void read_entry(const YamlNode& node, const std::string& path, SweepSpec& sweep, Reading& reading) {
  MappingReader mapping(node, path, reading);
  // The reader has told what it is instead.
  if (node.kind != YamlNode::Kind::mapping) return;
  WrittenMission written{.node = node, .start = {}, .goal = {}, .yaw_deg = {}, .map = {}};
  for (const auto& [name, place] :
       {std::pair("start", &written.start), std::pair("goal", &written.goal)}) {
    const YamlNode* given = mapping.take(name);
    if (given != nullptr) {
      *place = read_place(*given, path + "." + name, reading);
    } else {
      reading.add_problem(path, std::string("lacks '") + name + "': [x, y, z] in metres");
    }
  }
  if (const YamlNode* yaw = mapping.take("yaw_deg")) {
    written.yaw_deg = read_number(*yaw, path + ".yaw_deg", kYaw_deg, reading.problems);
  }
  if (const YamlNode* map = mapping.take("map")) {
    written.map = read_text(*map, path + ".map", reading.problems).value_or("");
  }
  mapping.finish();
  add(written, sweep);
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
    fields.push_back(row);
    fields.back().kind = YamlNode::Kind::scalar;
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

/// Where each column stands in the rows.
struct Columns {
  std::vector<std::string> names;

  const YamlNode* of(const std::vector<YamlNode>& fields, std::string_view name) const {
    const auto found = std::find(names.begin(), names.end(), name);
    if (found == names.end()) return nullptr;
    return &fields[static_cast<std::size_t>(found - names.begin())];
  }
};

/// The columns may stand in any order; the places' six are needed.
Columns read_header(const std::vector<YamlNode>& fields, std::vector<InputProblem>& problems) {
  std::vector<std::string> known(kPlaceColumns.begin(), kPlaceColumns.end());
  known.insert(known.end(), {"yaw_deg", "map"});
  Columns columns;
  // What spreadsheets of some countries write.
  if (fields.size() == 1 && fields[0].scalar.find_first_of(";\t") != std::string::npos) {
    problems.push_back(problem_at(fields[0], "columns must be parted by commas"));
    return columns;
  }
  for (const YamlNode& field : fields) {
    const std::string& name = field.scalar;
    const bool is_known = std::find(known.begin(), known.end(), name) != known.end();
    if (!is_known) {
      const std::string hint = did_you_mean(name, known);
      problems.push_back(problem_at(
          field, "unknown column '" + name + "'" + hint + "; columns are " + listed(known)));
    } else if (std::find(columns.names.begin(), columns.names.end(), name) != columns.names.end()) {
      problems.push_back(problem_at(field, "a second column '" + name + "'"));
    }
    // Also a wrong one, so that columns keep their numbers.
    columns.names.push_back(name);
  }
  for (const std::string& name : kPlaceColumns) {
    if (std::find(columns.names.begin(), columns.names.end(), name) != columns.names.end())
      continue;
    problems.push_back(problem_at(fields[0], "lacks the column '" + name + "'"));
  }
  return columns;
}

void read_row(const std::vector<YamlNode>& fields, const Columns& columns, SweepSpec& sweep,
              std::vector<InputProblem>& problems) {
  if (fields.size() != columns.names.size()) {
    problems.push_back(problem_at(fields[0], std::to_string(fields.size()) + " fields, but " +
                                                 std::to_string(columns.names.size()) +
                                                 " columns"));
    return;
  }
  WrittenMission written{.node = fields[0], .start = {}, .goal = {}, .yaw_deg = {}, .map = {}};
  for (std::size_t place = 0; place < 2; ++place) {
    std::array<std::optional<double>, 3> numbers;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::string& name = kPlaceColumns[3 * place + i];
      numbers[i] = read_number(*columns.of(fields, name), name, kPlaces_m, problems);
    }
    const bool is_whole = numbers[0] && numbers[1] && numbers[2];
    Place& of = place == 0 ? written.start : written.goal;
    if (is_whole) of = Eigen::Vector3d(*numbers[0], *numbers[1], *numbers[2]);
  }
  const YamlNode* yaw = columns.of(fields, "yaw_deg");
  if (yaw != nullptr && !yaw->scalar.empty()) {
    written.yaw_deg = read_number(*yaw, "yaw_deg", kYaw_deg, problems);
  }
  if (const YamlNode* map = columns.of(fields, "map")) written.map = map->scalar;
  add(written, sweep);
}

/// Lines end with LF or CR LF; empty ones, and those that begin with #, are passed over.
void read_table(const std::filesystem::path& file, SweepSpec& sweep, Reading& reading) {
  constexpr std::uint64_t kMostBytes = 64U << 20U;
  // A table of a thousand wrong rows has said enough.
  constexpr std::size_t kMostProblems = 20;
  const std::string text = read_input_file(file, kMostBytes);
  std::string_view rest = text;
  if (rest.starts_with("\xEF\xBB\xBF")) rest.remove_prefix(3);  // as spreadsheets write it
  YamlNode row;
  row.source = std::make_shared<const std::string>(file.string());
  std::optional<Columns> columns;
  const std::size_t before = reading.problems.size(), listed_before = sweep.missions.size();
  while (!rest.empty() && reading.problems.size() < before + kMostProblems) {
    std::string_view line = rest.substr(0, rest.find('\n'));
    rest.remove_prefix(std::min(rest.size(), line.size() + 1));
    if (line.ends_with('\r')) line.remove_suffix(1);
    ++row.line;
    if (line.find_first_not_of(" \t") == std::string_view::npos || line.front() == '#') continue;
    const std::vector<YamlNode> fields = fields_of(line, row, reading.problems);
    if (columns) {
      read_row(fields, *columns, sweep, reading.problems);
      continue;
    }
    columns = read_header(fields, reading.problems);
    // Rows can't be read by wrong columns.
    if (reading.problems.size() > before) return;
  }
  if (sweep.missions.size() > listed_before || reading.problems.size() > before) return;
  reading.add_problem("mission.file", file.string() + " lists no mission");
}

void read_file(const YamlNode& node, SweepSpec& sweep, Reading& reading) {
  const auto name = read_text(node, "mission.file", reading.problems);
  if (!name) return;
  const std::filesystem::path given(*name);
  const std::filesystem::path file = given.is_absolute() ? given : folder_of(node, ".") / given;
  try {
    read_table(file.lexically_normal(), sweep, reading);
  } catch (const InputError& error) {
    for (const InputProblem& problem : error.problems()) {
      reading.add_problem("mission.file", text(problem));
    }
  }
}

}  // namespace

void read_missions(const YamlNode& root, SweepSpec& sweep, Reading& reading) {
  const YamlNode* block = root.find("mission");
  if (block == nullptr || block->kind != YamlNode::Kind::mapping) return;
  const YamlNode* list = said(*block, "list");
  const YamlNode* file = said(*block, "file");
  if (list != nullptr && file != nullptr) {
    reading.problems.push_back(problem_at(*file, "mission.file: there is mission.list too"));
  } else if (file != nullptr) {
    read_file(*file, sweep, reading);
  } else if (list != nullptr && check_list(*list, "mission.list", {}, reading.problems)) {
    if (list->items.empty()) {
      reading.problems.push_back(problem_at(*list, "mission.list: expected at least one mission"));
    }
    for (std::size_t i = 0; i < list->items.size(); ++i) {
      read_entry(list->items[i], "mission.list[" + std::to_string(i) + "]", sweep, reading);
    }
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
                      did_you_mean(mission.map, all) + "; it has " + listed(known);
    reading.problems.push_back(std::move(problem));
  }
  for (const std::string& map : empty_maps) {
    reading.add_problem("mission", "no mission is listed for map " + map);
  }
  if (said(root, "trials") == nullptr) {
    // Nothing said: all that are listed.
    sweep.trials = most;
  } else if (sweep.trials > most) {
    reading.add_problem("trials", std::to_string(sweep.trials) + " is more than the " +
                                      std::to_string(most) +
                                      " missions that are listed; left out, all are flown");
  }
}

}  // namespace avoidbench
