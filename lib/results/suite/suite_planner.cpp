#include "suite/suite_planner.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "base/input_error.hpp"
#include "base/option_error.hpp"
#include "config/sweep_file.hpp"
#include "yaml/yaml_reader.hpp"
#include "yaml/yaml_values.hpp"

namespace avoidbench {
namespace {

/// A list of one element at the place of that.
YamlNode list_of(const YamlNode& element) {
  YamlNode list = node_at(element, YamlNode::Kind::list);
  list.items.push_back(element);
  return list;
}

void set_key(YamlNode& mapping, const std::string& name, YamlNode value) {
  const std::size_t index = mapping.index_of(name);
  if (index < mapping.keys.size()) {
    mapping.items[index] = std::move(value);
    return;
  }
  mapping.keys.push_back(node_at(value, YamlNode::Kind::scalar, name));
  mapping.items.push_back(std::move(value));
}

std::string in_quotes(const std::string& text) { return nlohmann::json(text).dump(); }

std::string seed_list(const std::vector<std::uint64_t>& seeds) {
  std::string list;
  for (const std::uint64_t seed : seeds) list += (list.empty() ? "" : ", ") + std::to_string(seed);
  return "[" + list + "]";
}

}  // namespace

SuitePlanner read_suite_planner(const std::filesystem::path& file) {
  const YamlNode root = read_yaml(file);
  Reading reading;
  const GivenValue given{root, "", reading};
  SuitePlanner planner;
  const YamlNode* entry = root.find("planner");
  if (entry == nullptr) {
    given.add_problem("lacks 'planner', as {plugin: ./mine.so, label: mine}");
  } else {
    planner.entry = *entry;
  }
  const auto take = [&](std::string_view name, std::string& text) {
    const YamlNode* node = root.find(name);
    if (node != nullptr) text = read_text(given.at(*node, name)).value_or("");
  };
  take("licence", planner.licence);
  take("source", planner.source);
  take("tuned_on", planner.tuned_on);
  if (!reading.problems.empty()) throw InputError(std::move(reading.problems));
  return planner;
}

SuitePlanner suite_planner(const std::string& plugin, const std::string& label,
                           const std::vector<std::string>& parameters) {
  std::string text = "{plugin: " + in_quotes(plugin);
  if (!label.empty()) text += ", label: " + in_quotes(label);
  if (!parameters.empty()) {
    std::string values;
    for (const std::string& parameter : parameters) {
      const std::size_t equals = parameter.find('=');
      const std::string name = parameter.substr(0, equals);
      if (equals == std::string::npos || !is_name(name)) {
        throw OptionError("'" + parameter + "': expected NAME=VALUE, as max_speed_mps=3",
                          "parameter");
      }
      values += (values.empty() ? "" : ", ") + name + ": " + parameter.substr(equals + 1);
    }
    text += ", parameters: {" + values + "}";
  }
  SuitePlanner planner;
  planner.entry = parse_yaml(text + "}", "--planner");
  return planner;
}

SweepSpec suite_sweep(const SuiteTrack& chosen, const SuiteSweep& sweep, const SweepSeeds& seeds,
                      const SuitePlanner& planner) {
  Document document =
      read_sweep_document(frozen_file(chosen, sweep), {"seed=" + std::to_string(seeds.seed),
                                                       "maps.seeds=" + seed_list(seeds.map_seeds),
                                                       "trials=" + std::to_string(seeds.missions)});
  set_key(document.root, "planners", list_of(planner.entry));
  return sweep_of_document(document);
}

std::string flow_text(const YamlNode& node) {
  if (node.kind == YamlNode::Kind::null) return "~";
  if (node.kind == YamlNode::Kind::scalar) {
    // Plain words and numbers as they are; what else YAML might read otherwise in quotes.
    const bool is_plain = !node.is_quoted && is_name(node.scalar);
    return is_plain ? node.scalar : in_quotes(node.scalar);
  }
  const bool is_list = node.kind == YamlNode::Kind::list;
  std::string text;
  for (std::size_t i = 0; i < node.items.size(); ++i) {
    if (i > 0) text += ", ";
    if (!is_list) text += flow_text(node.keys[i]) + ": ";
    text += flow_text(node.items[i]);
  }
  return is_list ? "[" + text + "]" : "{" + text + "}";
}

}  // namespace avoidbench
