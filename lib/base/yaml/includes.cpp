#include "yaml/includes.hpp"

#include <algorithm>

namespace avoidbench {
namespace {

namespace fs = std::filesystem;

/// Nested, each within the one before. Files that two others include are no circle, but n levels of
/// such pairs are read 2^n times.
constexpr std::size_t kMostIncludes = 8;
constexpr std::size_t kMostFiles = 64;

using Kind = YamlNode::Kind;

/// A value of an axis, `{from, to, count}`, and no block of keys: it is replaced as a whole.
bool is_range(const YamlNode& node) { return node.find("from") != nullptr; }

/// Lays `over` on `under`, which stays where `over` says nothing.
/// Recursive, key by key. A key is taken over with its value so that messages point to where the
/// value that counts was given. Only at the top (`is_top`) does a name stand for a block of fields.
void merge(YamlNode& under, YamlNode over, bool is_top) {
  if (over.kind != Kind::mapping || under.kind != Kind::mapping || is_range(over)) {
    under = std::move(over);
    return;
  }
  for (std::size_t i = 0; i < over.keys.size(); ++i) {
    const std::string& key = over.keys[i].scalar;
    const std::size_t below = under.index_of(key);
    if (below == under.keys.size()) {
      under.keys.push_back(over.keys[i]);
      under.items.push_back(std::move(over.items[i]));
    } else if (over.items[i].kind == Kind::null) {
      // `~` takes the key out.
      under.erase(below);
    } else {
      // A name below, fields above: the name becomes the block's preset.
      const bool is_named = is_top && (key == "vehicle" || key == "sensor");
      if (is_named && over.items[i].kind == Kind::mapping &&
          under.items[below].kind == Kind::scalar) {
        under.items[below] = mapping_at(under.items[below], "preset", under.items[below]);
      }
      under.keys[below] = over.keys[i];
      merge(under.items[below], std::move(over.items[i]), false);
    }
  }
  // The merged mapping stands where the last file has it: what lacks a key is said there.
  under.source = over.source;
  under.line = over.line;
  under.column = over.column;
}

/// Reads a file and what it includes, depth first: the included ones in their order, each over the
/// ones before it, and the file itself over all of them.
struct Reader {
  std::vector<fs::path> open;  ///< canonical paths of the files being read, outermost first
  std::vector<std::string> included;

  YamlNode read(const fs::path& file) {
    YamlNode root = read_yaml(file);
    const YamlNode* include = root.find("include");
    if (include == nullptr) return root;
    // A copy, since the key is taken out of the tree that holds it.
    const YamlNode named = *include;
    // The key is spent here: for readers of the tree `include` is unknown.
    root.erase(root.index_of("include"));
    YamlNode merged = node_at({}, Kind::mapping);
    std::vector<InputProblem> problems;
    // All included files are read even if one fails, so that each can say what is wrong with it.
    for (const YamlNode& name : names(named)) {
      try {
        merge(merged, read_included(name), true);
      } catch (const InputError& failed) {
        problems.insert(problems.end(), failed.problems().begin(), failed.problems().end());
      }
    }
    if (!problems.empty()) throw InputError(std::move(problems));
    merge(merged, std::move(root), true);
    return merged;
  }

 private:
  [[noreturn]] static void fail(const YamlNode& place, const std::string& message) {
    throw InputError(problem_at(place, "include: " + message));
  }

  static std::vector<YamlNode> names(const YamlNode& include) {
    const bool is_list = include.kind == Kind::list;
    const std::vector<YamlNode> names = is_list ? include.items : std::vector<YamlNode>{include};
    if (names.empty()) fail(include, "expected a file or a list of files, found an empty list");
    for (const YamlNode& name : names) {
      if (name.kind == Kind::scalar && !name.scalar.empty()) continue;
      fail(name, "expected a file or a list of files, found " + found_text(name));
    }
    return names;
  }

  YamlNode read_included(const YamlNode& name) {
    // Relative to the file that names it; an absolute path replaces the folder.
    const fs::path file = (folder_of(name, ".") / name.scalar).lexically_normal();
    std::error_code error;
    const fs::path canonical = fs::weakly_canonical(file, error);
    // Only files that are still open make a circle: two files may include the same third one.
    if (std::find(open.begin(), open.end(), canonical) != open.end()) {
      std::string circle;
      for (const fs::path& outer : open) circle += outer.filename().string() + " → ";
      fail(name, "includes itself: " + circle + file.filename().string());
    }
    if (open.size() > kMostIncludes) {
      fail(name, "nested deeper than " + std::to_string(kMostIncludes) + " files");
    }
    if (included.size() >= kMostFiles) {
      fail(name, "more than " + std::to_string(kMostFiles) + " included files");
    }
    included.push_back(file.string());
    const std::size_t level = open.size();
    open.push_back(canonical);
    try {
      YamlNode root = read(file);
      open.resize(level);
      check_is_part(root);
      return root;
    } catch (const InputError& failed) {
      open.resize(level);
      std::vector<InputProblem> problems = failed.problems();
      for (InputProblem& problem : problems) {  // of the file as a whole: said where it is named
        if (problem.line == 0) problem = problem_at(name, "include: " + text(problem));
      }
      throw InputError(std::move(problems));
    }
  }
};

/// The scalar as YAML that reads back as the same: what is not certainly plain goes in quotes.
std::string scalar_text(const YamlNode& node) {
  if (node.kind == Kind::null) return "~";
  const auto is_plain = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
           c == '.' || c == '/' || c == '+' || c == '-';
  };
  const bool needs_quotes = node.is_quoted || node.scalar.empty() || node.scalar == "-" ||
                            !std::all_of(node.scalar.begin(), node.scalar.end(), is_plain);
  if (!needs_quotes) return node.scalar;
  // In single quotes nothing has a meaning but the quote, which is doubled.
  std::string quoted = "'";
  for (const char c : node.scalar) {
    quoted += c;
    if (c == '\'') quoted += c;
  }
  return quoted + "'";
}

/// On one line: [1, 2], {a: b}.
std::string flow_text(const YamlNode& node) {
  if (node.kind == Kind::scalar || node.kind == Kind::null) return scalar_text(node);
  const bool is_list = node.kind == Kind::list;
  std::string all;
  for (std::size_t i = 0; i < node.items.size(); ++i) {
    all += all.empty() ? "" : ", ";
    if (!is_list) all += scalar_text(node.keys[i]) + ": ";
    all += flow_text(node.items[i]);
  }
  return is_list ? "[" + all + "]" : "{" + all + "}";
}

/// Adds a line and, from one column on where it fits, the place that it is from.
void add_line(const std::string& content, const YamlNode& place, std::string& text) {
  constexpr std::size_t kCommentColumn = 44;
  if (!place.source) {  // the program's own
    text += content + "\n";
    return;
  }
  std::string padded = content;
  padded.resize(std::max(padded.size() + 2, kCommentColumn), ' ');
  text += padded + "# " + *place.source;
  if (place.line > 0) text += ":" + std::to_string(place.line);
  text += "\n";
}

/// Blocks down to where a value stands alone; each such value gets its line with its place. A list
/// of mappings has a line per element, since elements may be from different files.
void add_mapping(const YamlNode& mapping, const std::string& indent, std::string& text) {
  for (std::size_t i = 0; i < mapping.keys.size(); ++i) {
    const YamlNode& item = mapping.items[i];
    const std::string key = indent + scalar_text(mapping.keys[i]) + ":";
    const bool holds_mappings = std::any_of(item.items.begin(), item.items.end(),
                                            [](const auto& n) { return !n.items.empty(); });
    if (item.kind == Kind::mapping && !item.items.empty() && !is_range(item)) {
      text += key + "\n";
      add_mapping(item, indent + "  ", text);
    } else if (item.kind == Kind::list && holds_mappings) {
      text += key + "\n";
      for (const YamlNode& element : item.items) {
        add_line(indent + "  - " + flow_text(element), element, text);
      }
    } else {
      add_line(key + " " + flow_text(item), item, text);
    }
  }
}

}  // namespace

Document read_document(const fs::path& file) {
  std::error_code error;
  Reader reader{.open = {fs::weakly_canonical(file, error)}, .included = {}};
  Document document;
  document.root = reader.read(file);
  document.file = file;
  document.included = std::move(reader.included);
  return document;
}

void check_is_part(const YamlNode& root) {
  const std::string expected = "expected a mapping (name: value), found ";
  if (root.kind != Kind::mapping) {
    const bool is_text = root.kind == Kind::scalar;
    throw InputError(problem_at(root, expected + (is_text ? "text" : found_text(root))));
  }
  for (const YamlNode& key : root.keys) {
    if (!is_name(key.scalar))
      throw InputError(problem_at(key, expected + "a key that is not a name"));
  }
}

fs::path folder_of(const YamlNode& node, const fs::path& otherwise) {
  // What the command line gave has a source too, its option, which is no file: it has no line.
  if (!node.source || node.line == 0) return otherwise;
  const fs::path folder = fs::path(*node.source).parent_path();
  return folder.empty() ? fs::path(".") : folder;
}

std::string document_text(const Document& document) {
  std::string text;
  add_mapping(document.root, "", text);
  return text;
}

}  // namespace avoidbench
