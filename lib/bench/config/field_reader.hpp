#pragma once

#include "config/field_tree.hpp"
#include "yaml/yaml_reader.hpp"

namespace avoidbench {

/// Reads the value of one field into `value`, which is as spec_to_json() gives it. Where lists are
/// axes, several values may stand for one. A problem leaves the value as it was.
void read_field(const GivenValue& given, const FieldTree& field, nlohmann::json& value);

/// Reads the key `field` of a mapping, if it is there; of a variant the keys of its kind, too.
/// Returns the kind for messages, "generator forest"; "" for other fields.
std::string read_key(MappingReader& mapping, const FieldTree& field, nlohmann::json& block);

/// Reads a mapping. Keys that are not given leave their fields as they are. A block that has the
/// key `preset` begins from what that names, and a name may stand for all of it. A name is looked
/// up as NAME.yaml in vehicles/ (of the block `vehicle`) and ../vehicles/ of the folder of the file
/// that it stands in, then among the built-in ones; with a slash or .yaml it is a file, relative to
/// that folder.
void read_block(const GivenValue& given, const FieldTree& block, nlohmann::json& value);

/// What is wrong with a field that stands beside `field`, of `block`, from which it follows.
std::string follows_text(const FieldTree& field, const nlohmann::json& block);

}  // namespace avoidbench
