#pragma once

#include <string>
#include <vector>

#include "config/schema_values.hpp"

namespace avoidbench {

/// Which kind of a variant it is where a file does not say it: the preset, or one that only
/// another file knows, so that the fields of every kind are let through.
struct Unsaid {
  bool may_be_any = false;
  std::vector<std::string> any_with;  ///< keys with which it may be any: preset, include
};

/// Whether there is a variant anywhere in the fields.
bool has_variant(const std::vector<FieldTree>& fields);

/// {"$ref": …}
Schema reference(const std::string& definition);

/// A name, better one of `known`.
Schema name_schema(const std::vector<std::string>& known);

/// A name, or what `mapping` says.
Schema name_or(const Schema& mapping, const std::vector<std::string>& known);

/// Adds a property, or another form of one that is there, as of a field that several kinds have.
void add_property(const std::string& name, Schema schema, Schema& properties);

/// Makes the schemas of mappings, and the definitions that they share.
class SchemaWriter {
 public:
  explicit SchemaWriter(bool lists_are_axes) : lists_are_axes_(lists_are_axes) {}

  Schema definitions = Schema::object();

  /// Schema of a mapping of these fields. `name` is that of its definitions. The kinds of a variant
  /// are told apart by if and then: messages name the key that is wrong, and editors offer only
  /// the keys of the kind that is chosen.
  Schema block(const std::vector<FieldTree>& fields, const std::string& name, const Unsaid& unsaid);

  /// Schema of one value, whatever it is.
  Schema value(const FieldTree& field, const std::string& name, const Unsaid& unsaid);

  /// The same with doc and preset, and with several values where lists are axes.
  Schema field(const FieldTree& field, const std::string& name, const Unsaid& unsaid);

  /// The same for one that may have several values, in place or `under_axes`. Numbers of one range
  /// share a definition.
  Schema several(const FieldTree& field, const Schema& value, bool under_axes);

 private:
  Schema plain_block(const std::vector<FieldTree>& fields, const std::string& name,
                     const Unsaid& unsaid);

  bool lists_are_axes_;
};

}  // namespace avoidbench
