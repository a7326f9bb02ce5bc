#include "yaml/yaml_reader.hpp"

#include <algorithm>

namespace avoidbench {

SpecReader::SpecReader(const YamlNode& node, std::string path, Reading& reading)
    : node_(node), path_(std::move(path)), reading_(reading) {
  if (node.kind == YamlNode::Kind::mapping) return;
  const std::string name = path_.empty() ? "" : path_ + ": ";
  reading_.problems.push_back(
      problem_at(node, name + "expected a mapping (name: value), found " + found_text(node)));
}

const YamlNode* SpecReader::take(std::string_view name) {
  names_.emplace_back(name);
  return node_.find(name);
}

void SpecReader::finish() {
  for (const YamlNode& key : node_.keys) {
    if (std::find(names_.begin(), names_.end(), key.scalar) != names_.end()) continue;
    std::string message = path_of(key.scalar) + ": unknown key";
    if (!kind_.empty()) message += " for " + kind_;
    std::string hint = did_you_mean(key.scalar, names_);
    constexpr std::size_t kMostListed = 12;
    if (hint.empty() && names_.size() <= kMostListed) {
      for (const std::string& name : names_) hint += (hint.empty() ? " (known: " : ", ") + name;
      if (!hint.empty()) hint += ")";
    }
    reading_.problems.push_back(problem_at(key, message + hint));
  }
}

std::string SpecReader::path_of(std::string_view name) const {
  return path_.empty() ? std::string(name) : path_ + "." + std::string(name);
}

}  // namespace avoidbench
