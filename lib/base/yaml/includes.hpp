#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "yaml/yaml_tree.hpp"

namespace avoidbench {

/// A document with the files that it includes put in.
struct Document {
  YamlNode root;
  std::filesystem::path file;         ///< where it stands, as problems name it
  std::vector<std::string> included;  ///< files, in the order of reading
};

/// As read_yaml, with the files that the document's key `include` names, a path or a list of them,
/// each relative to the folder of the file that names it. Later files win over earlier ones and the
/// including file over all: mappings merge key by key, other values and ranges are replaced, and an
/// empty value (`key: ~`) takes out what was included. Every value keeps its own file and line.
/// Throws InputError at the include line for circles, files that can't be read, and too many of
/// them.
Document read_document(const std::filesystem::path& file);

/// Throws InputError unless a file that another one names is a mapping of names to values. Says the
/// line, but quotes nothing: it may be any file that the user can read.
void check_is_part(const YamlNode& root);

/// The folder of the file that `node` stands in; `otherwise` where it stands in none.
std::filesystem::path folder_of(const YamlNode& node, const std::filesystem::path& otherwise);

/// The document as YAML, each value with its file and line as a comment.
std::string document_text(const Document& document);

}  // namespace avoidbench
