#include "config/schema_blocks.hpp"

#include <algorithm>
#include <cmath>

#include "yaml/yaml_values.hpp"

namespace avoidbench {
namespace {

/// A variant whose kinds' fields are not among its neighbours yet.
bool is_open(const FieldTree& field) {
  return field.kind == FieldKind::variant && !field.fields.empty();
}

/// Whether a mapping has one of the keys.
Schema has_any(const std::vector<std::string>& keys) {
  Schema options = Schema::array();
  for (const std::string& key : keys) options.push_back({{"required", {key}}});
  return options.size() == 1 ? Schema(options.front()) : Schema{{"anyOf", options}};
}

/// How many seeds, or a list or range of them.
Schema seeds_schema(const FieldTree& field) {
  constexpr int kMostSeeds = 10000;
  Schema schema = several_schema(field, value_schema(field));
  schema["minimum"] = 1;
  schema["maximum"] = kMostSeeds;
  describe(field, schema);
  return schema;
}

/// The key `include`, or a name such as that of a preset.
Schema other_schema(const FieldTree& key) {
  Schema schema = name_schema(key.choices);
  if (key.name == "include") {
    schema = {{"type", {"string", "array"}},
              {"minLength", 1},
              {"items", {{"type", "string"}, {"minLength", 1}}},
              {"minItems", 1}};
  }
  describe(key, schema);
  return schema;
}

/// The fields with one more kind's fields, its word a plain one.
std::vector<FieldTree> with_kind(std::vector<FieldTree> fields, std::size_t variant,
                                 const std::vector<FieldTree>& of_kind) {
  fields[variant].fields.clear();
  fields.insert(fields.end(), of_kind.begin(), of_kind.end());
  return fields;
}

}  // namespace

bool has_variant(const std::vector<FieldTree>& fields) {
  return std::any_of(fields.begin(), fields.end(), [](const FieldTree& field) {
    return is_open(field) || has_variant(field.fields);
  });
}

Schema reference(const std::string& definition) { return {{"$ref", "#/$defs/" + definition}}; }

Schema name_schema(const std::vector<std::string>& known) {
  Schema options = Schema::array();
  if (!known.empty()) options.push_back({{"enum", known}});
  options.push_back({{"type", "string"}});
  return {{"anyOf", options}};
}

Schema name_or(const Schema& mapping, const std::vector<std::string>& known) {
  return {{"if", {{"type", "object"}}}, {"then", mapping}, {"else", name_schema(known)}};
}

void add_property(const std::string& name, Schema schema, Schema& properties) {
  if (!properties.contains(name)) {
    properties[name] = std::move(schema);
    return;
  }
  Schema& first = properties[name];
  if (first == schema) return;
  const bool is_union = first.size() == 1 && first.contains("anyOf");
  if (!is_union) {
    Schema options = Schema::array();
    options.push_back(std::move(first));
    first = Schema{{"anyOf", std::move(options)}};
  }
  Schema& options = first["anyOf"];
  if (std::find(options.begin(), options.end(), schema) == options.end()) {
    options.push_back(std::move(schema));
  }
}

Schema SchemaWriter::block(const std::vector<FieldTree>& fields, const std::string& name,
                           const Unsaid& unsaid) {
  const auto variant = std::find_if(fields.begin(), fields.end(), is_open);
  if (variant == fields.end()) return plain_block(fields, name, unsaid);
  const auto index = static_cast<std::size_t>(variant - fields.begin());
  Schema rules = Schema::array(), is_preset;
  std::vector<FieldTree> of_any;
  for (const FieldTree& kind : variant->fields) {
    const std::vector<FieldTree> all = with_kind(fields, index, kind.fields);
    const bool differs = unsaid.may_be_any && has_variant(all);
    const std::string definition = name + "." + kind.name + (differs ? ".any" : "");
    if (!definitions.contains(definition)) {
      Schema of_kind = block(all, definition, unsaid);
      if (!kind.doc.empty()) of_kind["description"] = kind.doc;
      definitions[definition] = std::move(of_kind);
    }
    Schema says_kind{{"properties", {{variant->name, {{"const", kind.name}}}}},
                     {"required", {variant->name}}};
    rules.push_back({{"if", std::move(says_kind)}, {"then", reference(definition)}});
    of_any.insert(of_any.end(), kind.fields.begin(), kind.fields.end());
    if (variant->preset == kind.name) is_preset = reference(definition);
  }
  Schema then = is_preset;
  if (unsaid.may_be_any || !unsaid.any_with.empty()) {
    const std::string definition = name + ".any_" + variant->name;
    if (!definitions.contains(definition)) {
      definitions[definition] =
          block(with_kind(fields, index, of_any), definition, Unsaid{true, {}});
    }
    then = reference(definition);
    if (!unsaid.may_be_any) {
      then = {{"if", has_any(unsaid.any_with)}, {"then", then}, {"else", is_preset}};
    }
  }
  rules.push_back({{"if", {{"not", has_any({variant->name})}}}, {"then", std::move(then)}});
  FieldTree word = *variant;
  word.fields.clear();
  Schema schema{{"type", "object"}};
  schema["properties"][word.name] = field(word, name, unsaid);
  schema["allOf"] = std::move(rules);
  return schema;
}

Schema SchemaWriter::value(const FieldTree& field, const std::string& name, const Unsaid& unsaid) {
  const std::string inner_name = name + "." + field.name;
  if (field.kind == FieldKind::block) {
    const bool may_be_any = unsaid.may_be_any || !unsaid.any_with.empty();
    return block(field.fields, inner_name + (may_be_any ? ".any" : ""), Unsaid{may_be_any, {}});
  }
  if (field.kind != FieldKind::list || field.fields.front().kind != FieldKind::block) {
    return value_schema(field);
  }
  SchemaWriter elements(false);  // an element has no path of its own
  Schema list{{"type", "array"}};
  list["items"] = elements.block(field.fields.front().fields, inner_name, {});
  if (field.count) list["minItems"] = list["maxItems"] = *field.count;
  definitions.update(elements.definitions);
  return list;
}

Schema SchemaWriter::field(const FieldTree& field, const std::string& name, const Unsaid& unsaid) {
  if (field.kind == FieldKind::other) return other_schema(field);
  const bool may_be_axis = lists_are_axes_ && field.kind != FieldKind::variant;
  if (may_be_axis && field.name == "seeds") return seeds_schema(field);
  Schema schema = value(field, name, unsaid);
  if (may_be_axis && field.kind != FieldKind::block) return several(field, schema, false);
  describe(field, schema);
  return schema;
}

Schema SchemaWriter::several(const FieldTree& field, const Schema& value, bool under_axes) {
  Schema schema;
  if (field.kind == FieldKind::number || field.kind == FieldKind::whole) {
    const auto end = [](double bound) { return std::isfinite(bound) ? number_text(bound) : "any"; };
    const std::string name = std::string(field.kind == FieldKind::number ? "numbers" : "wholes") +
                             "." + end(field.range.lowest) + ".to." + end(field.range.highest);
    if (!definitions.contains(name)) definitions[name] = several_schema(field, value);
    schema = reference(name);
  } else {
    schema = under_axes ? axis_schema(field, value) : several_schema(field, value);
  }
  describe(field, schema);
  return schema;
}

Schema SchemaWriter::plain_block(const std::vector<FieldTree>& fields, const std::string& name,
                                 const Unsaid& unsaid) {
  Schema properties = Schema::object();
  for (const FieldTree& each : fields) {
    add_property(each.name, field(each, name, unsaid), properties);
  }
  return {{"type", "object"}, {"properties", properties}, {"additionalProperties", false}};
}

}  // namespace avoidbench
