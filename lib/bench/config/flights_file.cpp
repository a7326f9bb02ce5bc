#include "config/flights_file.hpp"

#include "config/field_reader.hpp"
#include "config/given_values.hpp"
#include "config/sweep_keys.hpp"
#include "yaml/overrides.hpp"
#include "yaml/yaml_values.hpp"

namespace avoidbench {
namespace {

namespace fs = std::filesystem;

/// What the file says beside `sweep`.
struct FlightsSpec {
  std::string name;
  AlignmentSpec alignment;
  SmoothingSpec smoothing;
  std::vector<RealFlightSpec> recordings;
};

template <class Visitor, ConstOr<FlightsSpec> Spec>
void visit(Visitor& v, Spec& s) {
  v.field("flights", s.name, "Name of the result set: A-Z a-z 0-9 _ . -");
  v.field("alignment", s.alignment, "How the logs' frame lies in the map's; the same without it.");
  v.field("smoothing", s.smoothing, "How positions become a path with velocity and acceleration.");
  v.field("recordings", s.recordings, "The flights, each with its log.");
}

/// Keys that each flight needs, and places of three numbers.
void check_flight(const GivenValue& given, const RealFlightSpec& flight) {
  const auto require = [&](const char* key, bool is_there, const char* what) {
    if (!is_there && given.node.find(key) == nullptr) {
      given.add_problem("lacks '" + std::string(key) + "': " + what);
    }
  };
  require("log", !flight.log.empty(), "the file that was recorded");
  require("planner", !flight.planner.empty(), "what reports call the planner that flew");
  require("goal", !flight.goal.empty(), "[x, y, z] in the map's frame, metres");
  for (const char* key : {"start", "goal"}) {
    const YamlNode* node = given.node.find(key);
    const bool is_goal = std::string_view(key) == "goal";
    const std::size_t count = (is_goal ? flight.goal : flight.start).size();
    const bool may_be_empty = !is_goal && count == 0;
    if (node != nullptr && count != 3 && !may_be_empty) {
      given.at(*node, key).add_problem("expected [x, y, z] in metres");
    }
  }
  if (flight.end_s != 0.0 && flight.end_s <= flight.begin_s) {
    const YamlNode* node = given.node.find("end_s");
    given.at(node != nullptr ? *node : given.node, "end_s").add_problem("is not after begin_s");
  }
}

void check_alignment(const GivenValue& root, const AlignmentSpec& alignment) {
  const YamlNode* node = root.node.find("alignment");
  if (node == nullptr) return;
  const GivenValue given = root.at(*node, "alignment");
  const bool is_moved = node->find("translation_m") != nullptr || node->find("yaw_deg") != nullptr;
  if (node->find("points") == nullptr) return;
  if (alignment.points.size() < 3) given.add_problem("expected at least three points");
  if (is_moved) given.add_problem("give points, or translation_m and yaw_deg");
}

/// `name` of the file that `node` stands in, as a path from here.
std::string path_from(const YamlNode& node, const std::string& name, const fs::path& folder) {
  const fs::path path = name;
  if (name.empty() || path.is_absolute()) return name;
  return (folder_of(node, folder) / path).lexically_normal().string();
}

/// The block `sweep` as a document of its own. Its problems keep their places in the file.
Document sweep_block(const Document& document, Reading& reading) {
  Document sweep{.root = {}, .file = document.file, .included = document.included};
  const YamlNode* block = document.root.find("sweep");
  if (block == nullptr || block->kind != YamlNode::Kind::mapping) {
    const GivenValue root{document.root, "", reading};
    const YamlNode& place = block == nullptr ? document.root : *block;
    root.at(place, "sweep")
        .add_problem("expected a mapping: the place, the vehicle and the rules as in a sweep file");
    return sweep;
  }
  sweep.root = *block;
  for (const char* of_flights : {"sweep", "trials", "axes", "until"}) {
    if (const YamlNode* key = block->find(of_flights)) {
      reading.problems.push_back(problem_at(
          *key, "sweep." + std::string(of_flights) + ": is not for real flights; take it out"));
    }
  }
  if (const YamlNode* mission = block->find("mission")) {
    for (const char* listed : {"list", "file"}) {
      if (const YamlNode* key = mission->find(listed)) {
        reading.problems.push_back(
            problem_at(*key, "sweep.mission." + std::string(listed) +
                                 ": missions are those of the recordings; take it out"));
      }
    }
  }
  return sweep;
}

void set_key(YamlNode& mapping, const std::string& key, YamlNode value) {
  const std::size_t index = mapping.index_of(key);
  if (index < mapping.keys.size()) mapping.erase(index);
  mapping.keys.push_back(node_at({}, YamlNode::Kind::scalar, key));
  mapping.items.push_back(std::move(value));
}

YamlNode number_node(double value) {
  return node_at({}, YamlNode::Kind::scalar, number_text(value));
}

YamlNode place_node(const std::array<double, 3>& place_m) {
  YamlNode list = node_at({}, YamlNode::Kind::list);
  for (const double value : place_m) list.items.push_back(number_node(value));
  return list;
}

}  // namespace

InputProblem ReadRealFlight::problem(std::string_view key, std::string message) const {
  const YamlNode* given = node.find(key);
  return problem_at(given != nullptr ? *given : node, std::move(message));
}

const FieldTree& flights_tree() {
  static const FieldTree tree =
      field_tree("flights", FlightsSpec{}, "Real flights at one place, and their logs.");
  return tree;
}

FlightsFile read_flights(const fs::path& file, const std::vector<std::string>& overrides) {
  FlightsFile read;
  read.document = read_document(file);
  apply_overrides(read.document.root, overrides);
  Reading reading;
  if (file.has_parent_path()) reading.folder = file.parent_path();
  const GivenValue root{read.document.root, "", reading};
  MappingReader mapping(root);
  nlohmann::json keys = preset_json(flights_tree());
  for (const FieldTree& field : flights_tree().fields) read_key(mapping, field, keys);
  mapping.take("sweep");
  mapping.take("include");
  mapping.finish();
  auto spec = spec_from_json<FlightsSpec>(keys);
  check_name(root, "flights", spec.name);
  check_alignment(root, spec.alignment);
  const Document sweep = sweep_block(read.document, reading);
  const YamlNode* recordings = read.document.root.find("recordings");
  if (spec.recordings.empty()) root.add_problem("lacks 'recordings', the list of flights");
  for (std::size_t i = 0; i < spec.recordings.size(); ++i) {
    const YamlNode& node = recordings->items[i];
    RealFlightSpec& flight = spec.recordings[i];
    check_flight(root.at(node, "recordings[" + std::to_string(i) + "]"), flight);
    const auto from = [&](const char* key) {
      const YamlNode* name = node.find(key);
      return name == nullptr ? node : *name;
    };
    flight.log = path_from(from("log"), flight.log, reading.folder);
    flight.calls = path_from(from("calls"), flight.calls, reading.folder);
    read.flights.push_back({std::move(flight), node});
  }
  if (sweep.root.kind == YamlNode::Kind::mapping) {
    try {
      read.place = map_of_document(sweep);
    } catch (const InputError& error) {
      reading.problems.insert(reading.problems.end(), error.problems().begin(),
                              error.problems().end());
    }
  }
  if (!reading.problems.empty()) throw_problems(std::move(reading.problems), file.string());
  read.name = std::move(spec.name);
  read.alignment = std::move(spec.alignment);
  read.smoothing = spec.smoothing;
  const YamlNode* alignment = read.document.root.find("alignment");
  read.alignment_place = problem_at(alignment == nullptr ? read.document.root : *alignment, "");
  return read;
}

Document twin_document(const FlightsFile& flights, const std::vector<TwinMission>& missions) {
  Document twin{.root = *flights.document.root.find("sweep"),
                .file = flights.document.file,
                .included = flights.document.included};
  YamlNode list = node_at({}, YamlNode::Kind::list);
  for (const TwinMission& mission : missions) {
    YamlNode entry = node_at({}, YamlNode::Kind::mapping);
    set_key(entry, "start", place_node(mission.start_m));
    set_key(entry, "goal", place_node(mission.goal_m));
    set_key(entry, "yaw_deg", number_node(mission.yaw_deg));
    list.items.push_back(std::move(entry));
  }
  const YamlNode* given = twin.root.find("mission");
  YamlNode rules = given != nullptr ? *given : node_at({}, YamlNode::Kind::mapping);
  set_key(rules, "list", std::move(list));
  set_key(twin.root, "mission", std::move(rules));
  YamlNode name = node_at({}, YamlNode::Kind::scalar, flights.name + "_twin");
  twin.root.keys.insert(twin.root.keys.begin(), node_at({}, YamlNode::Kind::scalar, "sweep"));
  twin.root.items.insert(twin.root.items.begin(), std::move(name));
  return twin;
}

}  // namespace avoidbench
