#include "yaml/yaml_reader.hpp"

#include <algorithm>

namespace avoidbench {

void Reading::remember(const std::string& path, const YamlNode& node) {
  // Only the place is kept: a node may hold a whole subtree.
  YamlNode place;
  place.source = node.source;
  place.line = node.line;
  place.column = node.column;
  places_.insert_or_assign(path, std::move(place));
}

/// Cuts `path` at its last dots until something is known. The outermost block, "", always is: the
/// reader of a document begins with it.
const YamlNode& Reading::place(std::string path) const {
  while (true) {
    const auto found = places_.find(path);
    if (found != places_.end()) return found->second;
    const std::size_t dot = path.rfind('.');
    path.resize(dot == std::string::npos ? 0 : dot);
    if (path.empty()) break;
  }
  return places_.at("");
}

void Reading::add_problem(const std::string& path, const std::string& message) {
  problems.push_back(problem_at(place(path), path + ": " + message));
}

MappingReader::MappingReader(const YamlNode& node, std::string path, Reading& reading)
    : node_(node), path_(std::move(path)), reading_(reading) {
  reading_.remember(path_, node);
  if (node.kind == YamlNode::Kind::mapping) return;
  const std::string name = path_.empty() ? "" : path_ + ": ";
  reading_.problems.push_back(
      problem_at(node, name + "expected a mapping (name: value), found " + found_text(node)));
}

const YamlNode* MappingReader::take(std::string_view name) {
  names_.emplace_back(name);
  const YamlNode* node = node_.find(name);
  if (node != nullptr) reading_.remember(path_of(name), *node);
  return node;
}

/// Names that were asked for are those that exist, so a reader asks for all that it knows, also for
/// those that it goes on to ignore.
void MappingReader::finish(const std::string& kind) {
  for (const YamlNode& key : node_.keys) {
    if (std::find(names_.begin(), names_.end(), key.scalar) != names_.end()) continue;
    std::string message = path_of(key.scalar) + ": unknown key";
    if (!kind.empty()) message += " for " + kind;
    std::string hint = did_you_mean(key.scalar, names_);
    // A longer list hides the message; a likely name is offered in its place.
    constexpr std::size_t kMostListed = 12;
    if (hint.empty() && names_.size() <= kMostListed) {
      for (const std::string& name : names_) hint += (hint.empty() ? " (known: " : ", ") + name;
      if (!hint.empty()) hint += ")";
    }
    reading_.problems.push_back(problem_at(key, message + hint));
  }
}

std::string MappingReader::path_of(std::string_view name) const {
  return path_.empty() ? std::string(name) : path_ + "." + std::string(name);
}

}  // namespace avoidbench
