#include "config/json_schema.hpp"

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
  Schema schema{{"type", {"string", "number", "boolean"}}, {"pattern", "^[A-Za-z0-9_.-]{1,100}$"}};
  describe(key, schema);
  return schema;
}

Schema document(const std::string& name, const std::string& doc) {
  return {{"$schema", "https://json-schema.org/draft/2020-12/schema"},
          {"$id", "urn:avoidbench:schema:" + name},
          {"title", "avoidbench " + name},
          {"description", doc}};
}

Schema shelf_schema(const FieldTree& tree) {
  SchemaWriter writer(false);
  std::vector<FieldTree> fields{*sweep_tree().find("include")};
  fields.insert(fields.end(), tree.fields.begin(), tree.fields.end());
  Schema schema = document(tree.name, tree.doc);
  schema.update(writer.block(fields, tree.name, Unsaid{false, {"preset", "include"}}));
  if (!writer.definitions.empty()) schema["$defs"] = std::move(writer.definitions);
  return schema;
}

/// Defines what stands under the sweep's key `key`, where it is a block.
void define_block(const FieldTree& key, const std::string& name, Unsaid unsaid,
                  SchemaWriter& writer) {
  const FieldTree* preset = key.find("preset");
  if (preset != nullptr && !unsaid.may_be_any) unsaid.any_with = {"preset"};
  Schema schema = writer.block(key.fields, key.name, unsaid);
  if (preset != nullptr) schema = name_or(schema, preset->choices);
  describe(key, schema);
  writer.definitions[name] = std::move(schema);
}

}  // namespace

Schema sweep_schema(const std::vector<PlannerDescription>& planners, bool is_part) {
  SchemaWriter writer(true);
  const FieldTree sweep = sweep_tree();
  Schema properties = Schema::object(), axes = Schema::object(), alone = Schema::object();
  for (const FieldTree& key : sweep.fields) {
    Schema& schema = properties[key.name];
    if (key.kind == FieldKind::block) {
      define_block(key, key.name, Unsaid{true, {}}, writer);
      schema = reference(key.name);
      add_axes(key, key.name + ".", writer, axes);
      if (is_part || !has_variant(key.fields)) continue;
      define_block(key, key.name + ".alone", Unsaid{}, writer);
      alone[key.name] = reference(key.name + ".alone");
    } else if (key.name == "sweep") {
      schema = name_of_sweep(key);
    } else if (key.name == "planners") {
      schema = planners_schema(key);
    } else if (key.name == "axes") {
      Schema map_alias{{"^map(\\.|_seed$)", {{"type", {"number", "array", "object"}}}}};
      schema = {{"type", {"object", "null"}},
                {"properties", std::move(axes)},
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
  writer.definitions["planner"] = planner_schema(*sweep.find("max_speed_mps"), planners, writer);
  Schema result = document(is_part ? "part" : "sweep", sweep.doc);
  result["type"] = "object";
  result["properties"] = std::move(properties);
  result["additionalProperties"] = false;
  if (!is_part) {  // what a file lacks, an included one may have
    Schema whole{{"required", {"sweep", "planners"}}, {"properties", std::move(alone)}};
    result["if"] = {{"not", {{"required", {"include"}}}}};
    result["then"] = std::move(whole);
  }
  result["$defs"] = std::move(writer.definitions);
  return result;
}

Schema vehicle_schema() { return shelf_schema(vehicle_tree()); }
Schema sensor_schema() { return shelf_schema(sensor_tree()); }

}  // namespace avoidbench
