#include "yaml/yaml_tree.hpp"

#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/exceptions.h>
#include <yaml-cpp/parser.h>

#include <algorithm>
#include <map>
#include <optional>
#include <sstream>

#include "base/input_file.hpp"
#include "base/utf8.hpp"
#include "base/visible_text.hpp"
#include "yaml/syntax_hint.hpp"

namespace avoidbench {
namespace {

/// Against documents that are small as files and huge as trees: each alias is a copy, and ten
/// levels of ten aliases each are ten thousand million values.
constexpr std::size_t kMostValues = 100'000;
constexpr std::size_t kMostLevels = 64;
constexpr std::size_t kMostLetters = 20'000'000;  ///< of texts, aliases expanded

/// Of a node with all keys and values below it.
struct Size {
  std::size_t values = 1, letters = 0, levels = 1;
};

Size size_of(const YamlNode& node) {
  Size size{.values = 1 + node.keys.size(), .letters = node.scalar.size()};
  for (const YamlNode& key : node.keys) size.letters += key.scalar.size();
  for (const YamlNode& item : node.items) {
    const Size below = size_of(item);
    size.values += below.values;
    size.letters += below.letters;
    size.levels = std::max(size.levels, below.levels + 1);
  }
  return size;
}

/// Builds the tree from the parser's events.
/// From events, not from the library's own tree, so that the limits above hold while a document is
/// read and not only after it.
class TreeBuilder : public YAML::EventHandler {
 public:
  explicit TreeBuilder(const std::string& source)
      : source_(std::make_shared<const std::string>(source)) {}

  std::optional<YamlNode> root;

  void OnDocumentStart(const YAML::Mark&) override {}
  void OnDocumentEnd() override {}

  void OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    finish(make(YamlNode::Kind::null, mark), anchor);
  }

  void OnAlias(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    const auto found = anchored_.find(anchor);
    YamlNode place = make(YamlNode::Kind::null, mark);
    // An anchor is known when its node is complete, so only an alias within that node is unknown
    // here; the parser itself refuses names that were never given.
    if (found == anchored_.end()) fail(place, "an alias within its own anchor");
    const Size size = size_of(found->second);
    charge(place, size);
    if (open_.size() + size.levels > kMostLevels) fail_levels(place);
    // The copy stands where the alias does; what it holds keeps the places of the original.
    YamlNode copy = found->second;
    copy.line = place.line;
    copy.column = place.column;
    finish(std::move(copy), 0);
  }

  void OnScalar(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                const std::string& value) override {
    YamlNode node = make(YamlNode::Kind::scalar, mark);
    node.scalar = value;
    // The parser gives scalars in quotes and blocks of text (| and >) the tag "!", plain ones "?".
    node.is_quoted = tag == "!" || tag == "tag:yaml.org,2002:str";
    const bool is_plain_null = !node.is_quoted && (value == "~" || value == "null");
    if (is_plain_null) node.kind = YamlNode::Kind::null;
    finish(std::move(node), anchor);
  }

  void OnSequenceStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t anchor,
                       YAML::EmitterStyle::value) override {
    begin(make(YamlNode::Kind::list, mark), anchor);
  }
  void OnMapStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t anchor,
                  YAML::EmitterStyle::value) override {
    begin(make(YamlNode::Kind::mapping, mark), anchor);
  }
  void OnSequenceEnd() override { end(); }
  void OnMapEnd() override { end(); }

 private:
  struct Open {
    YamlNode node;
    YAML::anchor_t anchor = 0;
  };

  [[noreturn]] static void fail(const YamlNode& place, const std::string& message) {
    throw InputError(problem_at(place, message));
  }
  [[noreturn]] static void fail_levels(const YamlNode& place) {
    fail(place, "nested deeper than " + std::to_string(kMostLevels) + " levels");
  }

  YamlNode make(YamlNode::Kind kind, const YAML::Mark& mark) const {
    YamlNode node;
    node.kind = kind;
    node.source = source_;
    // The parser counts from 0.
    node.line = mark.is_null() ? 0 : mark.line + 1;
    node.column = mark.is_null() ? 0 : mark.column + 1;
    return node;
  }

  void charge(const YamlNode& place, const Size& size) {
    values_ += size.values;
    letters_ += size.letters;
    if (values_ > kMostValues) {
      fail(place, "more than " + std::to_string(kMostValues) + " values, aliases expanded");
    }
    if (letters_ > kMostLetters) fail(place, "more than 20 MB of text, aliases expanded");
  }

  // Trees are counted, copied and destroyed by recursion, so what is too deep would overflow the
  // call stack: it is refused before it is there.
  void begin(YamlNode node, YAML::anchor_t anchor) {
    if (open_.size() >= kMostLevels) fail_levels(node);
    open_.push_back({std::move(node), anchor});
  }

  void end() {
    Open closed = std::move(open_.back());
    open_.pop_back();
    if (closed.node.kind == YamlNode::Kind::mapping) expand_merge_key(closed.node);
    finish(std::move(closed.node), closed.anchor);
  }

  // A node is complete: it is counted, kept if it has an anchor, and put into the one around it.
  void finish(YamlNode node, YAML::anchor_t anchor) {
    charge(node, Size{});
    // The copy that later aliases are made of takes memory too.
    if (anchor != 0) {
      charge(node, size_of(node));
      anchored_[anchor] = node;
    }
    if (open_.empty()) {
      root = std::move(node);
      return;
    }
    YamlNode& parent = open_.back().node;
    // Keys and values come in turns.
    const bool is_key =
        parent.kind == YamlNode::Kind::mapping && parent.keys.size() == parent.items.size();
    if (is_key) {
      add_key(parent, std::move(node));
    } else {
      parent.items.push_back(std::move(node));
    }
  }

  /// Puts what `<<: *anchor` (or a list of them, the first wins) stands for beside the mapping's
  /// own keys, which win.
  static void expand_merge_key(YamlNode& mapping) {
    const std::size_t at = mapping.index_of("<<");
    // `"<<"` in quotes is a key like any other.
    if (at == mapping.keys.size() || mapping.keys[at].is_quoted) return;
    const YamlNode merged = std::move(mapping.items[at]);
    mapping.erase(at);
    const bool is_list = merged.kind == YamlNode::Kind::list;
    const std::vector<YamlNode> parts = is_list ? merged.items : std::vector<YamlNode>{merged};
    for (const YamlNode& part : parts) {
      if (part.kind != YamlNode::Kind::mapping) {
        fail(part, "<<: expected a mapping, as in `<<: *anchor`, found " + found_text(part));
      }
      for (std::size_t i = 0; i < part.keys.size(); ++i) {
        // The mapping's own keys are there already, and so are those of earlier parts: both win.
        if (mapping.find(part.keys[i].scalar) != nullptr) continue;
        mapping.keys.push_back(part.keys[i]);
        mapping.items.push_back(part.items[i]);
      }
    }
  }

  // YAML wants keys to differ, but its libraries keep the first or the last of equal ones in
  // silence.
  static void add_key(YamlNode& mapping, YamlNode key) {
    if (key.kind != YamlNode::Kind::scalar)
      fail(key, "a key must be text, found " + found_text(key));
    for (const YamlNode& other : mapping.keys) {
      if (other.scalar != key.scalar) continue;
      const std::string where =
          other.line > 0 ? ", first in line " + std::to_string(other.line) : "";
      // Of a file that is no YAML keys are whole lines, which are nobody's business.
      fail(key, (is_name(key.scalar) ? key.scalar + ": " : "") + "this key is given twice" + where);
    }
    mapping.keys.push_back(std::move(key));
  }

  std::shared_ptr<const std::string> source_;
  std::vector<Open> open_;
  std::map<YAML::anchor_t, YamlNode> anchored_;
  std::size_t values_ = 0, letters_ = 0;
};

}  // namespace

const YamlNode* YamlNode::find(std::string_view key) const {
  const std::size_t index = index_of(key);
  return index < keys.size() ? &items[index] : nullptr;
}

std::size_t YamlNode::index_of(std::string_view key) const {
  const auto found = std::find_if(keys.begin(), keys.end(),
                                  [&](const YamlNode& other) { return other.scalar == key; });
  return static_cast<std::size_t>(found - keys.begin());
}

void YamlNode::erase(std::size_t index) {
  const auto offset = static_cast<std::ptrdiff_t>(index);
  keys.erase(keys.begin() + offset);
  items.erase(items.begin() + offset);
}

YamlNode node_at(const YamlNode& place, YamlNode::Kind kind, std::string scalar) {
  YamlNode node;
  node.kind = kind;
  node.source = place.source;
  node.line = place.line;
  node.column = place.column;
  node.scalar = std::move(scalar);
  node.is_quoted = place.is_quoted;
  return node;
}

YamlNode mapping_at(const YamlNode& place, std::string key, YamlNode value) {
  YamlNode mapping = node_at(place, YamlNode::Kind::mapping);
  mapping.keys.push_back(node_at(place, YamlNode::Kind::scalar, std::move(key)));
  mapping.items.push_back(std::move(value));
  return mapping;
}

bool is_name(std::string_view key) {
  return !key.empty() && std::all_of(key.begin(), key.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
           c == '.' || c == '-';
  });
}

InputProblem problem_at(const YamlNode& node, std::string message) {
  return {node.source ? *node.source : "", node.line, node.column, std::move(message)};
}

std::string found_text(const YamlNode& node) {
  switch (node.kind) {
    case YamlNode::Kind::null:
      return "nothing";
    case YamlNode::Kind::list:
      return node.items.empty() ? "an empty list" : "a list";
    case YamlNode::Kind::mapping:
      return "a mapping";
    case YamlNode::Kind::scalar:
      break;
  }
  constexpr std::size_t kMostShown = 40;
  if (node.scalar.size() <= kMostShown) return '"' + visible_line(node.scalar) + '"';
  const std::string_view start = std::string_view(node.scalar).substr(0, kMostShown);
  // Not in the middle of a letter.
  return '"' + visible_line(start.substr(0, kMostShown - unfinished_bytes(start))) + "…\"";
}

YamlNode parse_yaml(const std::string& text, const std::string& source) {
  check_utf8(text, source);
  TreeBuilder builder(source);
  try {
    std::istringstream stream(text);
    YAML::Parser parser(stream);
    if (!parser.HandleNextDocument(builder) || !builder.root) {
      throw InputError(InputProblem{source, 0, 0, "the document is empty"});
    }
    YamlNode root = std::move(*builder.root);
    builder.root.reset();
    // root is set again only by a second document that holds something.
    if (parser.HandleNextDocument(builder) && builder.root) {
      throw InputError(problem_at(*builder.root, "a second document; one is expected"));
    }
    return root;
  } catch (const YAML::Exception& error) {
    // The library's place is where it gave up; a hint's is where the mistake was made.
    if (auto hint = syntax_hint(text, source)) throw InputError(std::move(*hint));
    const bool has_place = !error.mark.is_null();
    throw InputError(InputProblem{source, has_place ? error.mark.line + 1 : 0,
                                  has_place ? error.mark.column + 1 : 0,
                                  "not valid YAML: " + error.msg});
  }
}

YamlNode read_yaml(const std::filesystem::path& file) {
  constexpr std::uint64_t kMostBytes = 4'000'000;
  if (file == "-") return parse_yaml(read_standard_input(kMostBytes), "standard input");
  return parse_yaml(read_input_file(file, kMostBytes), file.string());
}

}  // namespace avoidbench
