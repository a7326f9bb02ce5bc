#include "yaml/yaml_reader.hpp"

#include <map>
#include <span>

#include "base/words.hpp"

namespace avoidbench {

void Reading::remember(const std::string& path, const YamlNode& node) {
  // Only the place is kept: a node may hold a whole subtree.
  places_.insert_or_assign(path, node_at(node, YamlNode::Kind::null));
}

/// Cuts `path` at its last dots until something is known. The outermost block, "", always is: the
/// reader of a document begins with it.
GivenValue Reading::at(const std::string& path) {
  std::string known = path;
  while (!known.empty() && !places_.contains(known)) {
    const std::size_t dot = known.rfind('.');
    known.resize(dot == std::string::npos ? 0 : dot);
  }
  return {places_.at(known), path, *this};
}

std::nullopt_t GivenValue::add_problem(const std::string& message) const {
  reading.problems.push_back(problem_at(node, path.empty() ? message : path + ": " + message));
  return std::nullopt;
}

std::nullopt_t GivenValue::add_expected(const std::string& what) const {
  return add_problem("expected " + what + ", found " + found_text(node));
}

std::nullopt_t GivenValue::add_problems(const InputError& error) const {
  for (const InputProblem& problem : error.problems()) add_problem(text(problem));
  return std::nullopt;
}

std::vector<GivenValue> GivenValue::elements() const {
  std::vector<GivenValue> all;
  for (const YamlNode& item : node.items) {
    all.push_back({item, path + "[" + std::to_string(all.size()) + "]", reading});
  }
  return all;
}

GivenValue GivenValue::at(const YamlNode& below, std::string_view name) const {
  return {below, (path.empty() ? "" : path + ".") + std::string(name), reading};
}

MappingReader::MappingReader(GivenValue mapping) : mapping_(std::move(mapping)) {
  mapping_.reading.remember(mapping_.path, mapping_.node);
  if (mapping_.node.kind != YamlNode::Kind::mapping) {
    mapping_.add_expected("a mapping (name: value)");
  }
}

std::optional<GivenValue> MappingReader::take(std::string_view name) {
  names_.emplace_back(name);
  const YamlNode* node = mapping_.node.find(name);
  if (node == nullptr) return std::nullopt;
  const GivenValue value = mapping_.at(*node, name);
  value.reading.remember(value.path, *node);
  return value;
}

/// Names that were asked for are those that exist, so a reader asks for all that it knows, also for
/// those that it goes on to ignore.
void MappingReader::finish(const std::string& kind,
                           const std::function<std::string(std::string_view)>& others) {
  std::map<std::string, std::vector<std::string>> keys_of;  // of each owner that is not asked for
  for (const YamlNode& key : mapping_.node.keys) {
    if (contains(names_, key.scalar)) continue;
    const std::string owner = others ? others(key.scalar) : "";
    if (!owner.empty()) keys_of[owner].push_back(key.scalar);
  }
  for (const YamlNode& key : mapping_.node.keys) {
    if (contains(names_, key.scalar)) continue;
    const std::string owner = others ? others(key.scalar) : "";
    std::string hint = did_you_mean(key.scalar, names_);
    if (!owner.empty()) {
      // Several keys of one owner have one reason: that the owner was not asked for.
      const std::vector<std::string>& keys = keys_of[owner];
      if (keys.front() != key.scalar) continue;
      hint = " (a key of " + owner +
             (keys.size() > 1 ? "; the same holds for " + joined(std::span(keys).subspan(1)) : "") +
             ")";
    }
    // A longer list hides the message; a likely name is offered in its place.
    constexpr std::size_t kMostListed = 12;
    if (hint.empty() && !names_.empty() && names_.size() <= kMostListed) {
      hint = " (known: " + joined(names_) + ")";
    }
    const std::string of_kind = kind.empty() ? "" : " for " + kind;
    mapping_.at(key, key.scalar).add_problem("unknown key" + of_kind + hint);
  }
}

}  // namespace avoidbench
