#include "config/json_schema.hpp"

#include <cstring>

#include "config/schema_blocks.hpp"
#include "config/sweep_keys.hpp"

namespace avoidbench {
namespace {

/// Adds the paths below `prefix` that may stand under `axes`.
void add_axes(const FieldTree& block, const std::string& prefix, SchemaWriter& writer,
              Schema& properties) {
  for (const KindField& entry : all_fields(block)) {
    const FieldTree& field = *entry.field;
    const std::string path = prefix + field.name;
    if (field.kind == FieldKind::block) {
      add_axes(field, path + ".", writer, properties);
    } else if (field.kind != FieldKind::variant && field.kind != FieldKind::other) {
      const Schema value = writer.value(field, prefix + "axis", {});
      add_property(path, writer.several(field, value, true), properties);
    }
  }
}

/// A planner's own parameters, where it is one that is known.
Schema planner_rule(const PlannerDescription& planner, const std::string& name,
                    SchemaWriter& writer) {
  Schema parameters = Schema::object();
  for (const ParameterDef& parameter : planner.parameters) {
    const FieldTree field = parameter_tree(parameter);
    parameters[field.name] = writer.several(field, value_schema(field), false);
  }
  Schema of_planner = Schema::object();
  of_planner["max_speed_mps"] =
      parameters.contains("max_speed_mps") ? Schema(parameters["max_speed_mps"]) : Schema(false);
  of_planner["parameters"] = {{"type", {"object", "null"}},
                              {"description", planner.summary},
                              {"properties", std::move(parameters)},
                              {"additionalProperties", false}};
  return {{"if", {{"properties", {{"plugin", {{"const", name}}}}}, {"required", {"plugin"}}}},
          {"then", {{"properties", std::move(of_planner)}}}};
}

/// One entry of `planners`.
Schema planner_schema(const FieldTree& max_speed, const std::vector<PlannerDescription>& planners,
                      SchemaWriter& writer) {
  std::vector<std::string> names;
  Schema rules = Schema::array();
  for (const PlannerDescription& planner : planners) {
    names.push_back(planner.file.stem().string());
    rules.push_back(planner_rule(planner, names.back(), writer));
  }
  constexpr int kLongestLabel = 100;
  Schema properties = Schema::object();
  properties["plugin"] = name_schema(names);
  properties["plugin"]["description"] = "A planner's name, or its library as ./FILE.so.";
  properties["label"] = {{"type", {"string", "number", "boolean"}},
                         {"minLength", 1},
                         {"maxLength", kLongestLabel},
                         {"description", "What reports call it; its name where not given."}};
  properties["parameters"] = {
      {"type", {"object", "null"}},
      {"additionalProperties", {{"type", {"string", "number", "boolean", "array", "object"}}}},
      {"description",
       "Values by name; a list gives one planner for each. `avoidbench planners describe NAME` "
       "shows them."}};
  properties["max_speed_mps"] = writer.several(max_speed, value_schema(max_speed), false);
  Schema entry{{"type", "object"},
               {"properties", std::move(properties)},
               {"additionalProperties", false},
               {"required", {"plugin"}}};
  if (!rules.empty()) entry["allOf"] = std::move(rules);
  return name_or(entry, names);
}

Schema planners_schema(const FieldTree& key) {
  Schema list{{"type", "array"}, {"items", reference("planner")}, {"minItems", 1}};
  Schema schema{{"if", {{"type", "array"}}}, {"then", list}, {"else", reference("planner")}};
  describe(key, schema);
  return schema;
}

Schema name_of_sweep(const FieldTree& key) {
  Schema schema{{"type", {"string", "number", "boolean"}},
                {"pattern", "^[A-Za-z0-9_][A-Za-z0-9_.-]{0,99}$"}};
  describe(key, schema);
  return schema;
}

Schema document(const std::string& name, const std::string& doc) {
  return {{"$schema", "https://json-schema.org/draft/2020-12/schema"},
          {"$id", "urn:avoidbench:schema:" + name},
          {"title", "avoidbench " + name},
          {"description", doc}};
}

/// The schema of a mapping that is laid over an included one: any key may be empty, which takes out
/// what was included, and a range may say only what it changes. Its definitions are those of
/// `schema` with "over." before their names, planners aside, which are replaced as a whole.
Schema laid_over(const Schema& schema) {
  if (schema.is_array()) {
    Schema all = Schema::array();
    for (const Schema& element : schema) all.push_back(laid_over(element));
    return all;
  }
  if (!schema.is_object()) return schema;
  const bool is_range = schema.contains("properties") && schema["properties"].contains("step");
  Schema result = Schema::object();
  for (const auto& [key, value] : schema.items()) {
    if (is_range && (key == "required" || key == "dependentSchemas")) continue;
    if (key == "if" || key == "enum" || key == "default") {
      result[key] = value;
    } else if (key == "$ref" && value != "#/$defs/planner") {
      result[key] = "#/$defs/over." + value.get<std::string>().substr(std::strlen("#/$defs/"));
    } else if (key == "properties") {
      for (const auto& [name, property] : value.items()) {
        Schema filled = laid_over(property);
        Schema& or_empty = result[key][name];
        or_empty = {{"if", {{"type", "null"}}}};
        for (const char* note : {"description", "default"}) {
          if (filled.contains(note)) or_empty[note] = filled[note];
        }
        or_empty["else"] = std::move(filled);
      }
    } else {
      result[key] = laid_over(value);
    }
  }
  return result;
}

/// Adds `whole` and `over`, which holds where there is `include`, with what they define.
void add_forms(const std::string& name, Schema whole, SchemaWriter& of_whole, const Schema& over,
               const SchemaWriter& of_over, Schema& document) {
  document["type"] = "object";
  document["if"] = {{"required", {"include"}}};
  document["then"] = reference("over." + name + "_file");
  document["else"] = reference(name + "_file");
  Schema& definitions = document["$defs"];
  definitions = std::move(of_whole.definitions);
  definitions[name + "_file"] = std::move(whole);
  definitions["over." + name + "_file"] = laid_over(over);
  for (const auto& [key, value] : of_over.definitions.items()) {
    definitions["over." + key] = laid_over(value);
  }
}

Schema shelf_schema(const FieldTree& tree) {
  std::vector<FieldTree> fields{*sweep_tree().find("include")};
  fields.insert(fields.end(), tree.fields.begin(), tree.fields.end());
  SchemaWriter of_whole(false), of_over(false);
  Schema whole = of_whole.block(fields, tree.name, Unsaid{false, {"preset"}});
  const Schema over = of_over.block(fields, tree.name, Unsaid{true, {}});
  Schema schema = document(tree.name, tree.doc);
  add_forms(tree.name, std::move(whole), of_whole, over, of_over, schema);
  return schema;
}

/// What stands under the sweep's key `key`, where it is a block.
Schema block_of_sweep(const FieldTree& key, bool may_be_any, SchemaWriter& writer) {
  const FieldTree* preset = key.find("preset");
  Unsaid unsaid{may_be_any, {}};
  if (preset != nullptr && !may_be_any) unsaid.any_with = {"preset"};
  Schema schema = writer.block(key.fields, key.name, unsaid);
  if (preset != nullptr) schema = name_or(schema, preset->choices);
  describe(key, schema);
  writer.definitions[key.name] = std::move(schema);
  return reference(key.name);
}

/// The mapping of a sweep file's keys.
Schema sweep_keys(const FieldTree& sweep, bool may_be_any, SchemaWriter& writer) {
  Schema properties = Schema::object(), axes = Schema::object();
  for (const FieldTree& key : sweep.fields) {
    Schema& schema = properties[key.name];
    if (key.kind == FieldKind::block) {
      schema = block_of_sweep(key, may_be_any, writer);
      add_axes(key, key.name + ".", writer, axes);
    } else if (key.name == "sweep") {
      schema = name_of_sweep(key);
    } else if (key.name == "planners") {
      schema = planners_schema(key);
    } else if (key.name == "axes") {
      Schema map_alias{{"^map(\\.|_seed$)", {{"type", {"number", "array", "object"}}}}};
      schema = {{"type", {"object", "null"}},
                {"properties", axes},
                {"patternProperties", std::move(map_alias)},  // the paths of stored trials
                {"additionalProperties", false}};
      describe(key, schema);
    } else if (key.name == "trials") {
      schema = value_schema(key);
      describe(key, schema);
    } else {
      schema = writer.field(key, "", {});
      if (key.name == "seed") axes[key.name] = writer.several(key, value_schema(key), true);
    }
  }
  return {{"properties", std::move(properties)}, {"additionalProperties", false}};
}

}  // namespace

Schema sweep_schema(const std::vector<PlannerDescription>& planners, bool is_part) {
  const std::string name = is_part ? "part" : "sweep";
  const FieldTree sweep = sweep_tree();
  SchemaWriter of_whole(true), of_over(true);
  const Schema over = sweep_keys(sweep, true, of_over);
  Schema whole = is_part ? Schema(over) : sweep_keys(sweep, false, of_whole);
  if (is_part) {  // what it lacks, an including file has
    of_whole.definitions = of_over.definitions;
  } else {
    whole["required"] = {"sweep", "planners"};
  }
  of_whole.definitions["planner"] =
      planner_schema(*sweep.find("max_speed_mps"), planners, of_whole);
  Schema result = document(name, sweep.doc);
  add_forms(name, std::move(whole), of_whole, over, of_over, result);
  return result;
}

Schema vehicle_schema() { return shelf_schema(vehicle_tree()); }
Schema sensor_schema() { return shelf_schema(sensor_tree()); }

}  // namespace avoidbench
