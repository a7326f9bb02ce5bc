#include "config/json_schema.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "config/flights_file.hpp"
#include "config/sweep_keys.hpp"
#include "plugin/planner_table.hpp"
#include "yaml/yaml_values.hpp"

namespace avoidbench {
namespace {

/// Ordered, so that a schema reads in the order of the fields.
using Schema = nlohmann::ordered_json;

// -------------------------------------------------------------------------------------------------
// values

/// Whole numbers without a point, as people write them.
Schema number_json(double value) {
  constexpr double kLargestExact = 9007199254740992.0;  // 2^53
  if (std::floor(value) == value && std::abs(value) <= kLargestExact) {
    return static_cast<std::int64_t>(value);
  }
  return value;
}

Schema preset_of(const nlohmann::json& preset) {
  if (preset.is_number_float()) return number_json(preset.get<double>());
  // Ordered and plain JSON are two types: by way of text.
  if (!preset.is_array()) return Schema::parse(preset.dump());
  Schema list = Schema::array();
  for (const nlohmann::json& element : preset) list.push_back(preset_of(element));
  return list;
}

void add_range(Range range, Schema& schema) {
  if (std::isfinite(range.lowest)) schema["minimum"] = number_json(range.lowest);
  if (std::isfinite(range.highest)) schema["maximum"] = number_json(range.highest);
}

/// Schema of one value of a field that is no block and no variant, nor a list of blocks.
Schema value_schema(const FieldTree& field) {
  Schema schema = Schema::object();
  switch (field.kind) {
    case FieldKind::truth:
      schema["type"] = "boolean";
      break;
    case FieldKind::whole:
    case FieldKind::number:
      schema["type"] = field.kind == FieldKind::whole ? "integer" : "number";
      add_range(field.range, schema);
      break;
    case FieldKind::choice:
    case FieldKind::variant:
      schema["enum"] = field.choices;
      break;
    case FieldKind::list:
      schema["type"] = "array";
      schema["items"] = value_schema(field.fields.front());
      if (field.count) {
        schema["minItems"] = *field.count;
        schema["maxItems"] = *field.count;
      }
      break;
    default:  // 24 and true are texts where a text is wanted
      schema["type"] = {"string", "number", "boolean"};
  }
  return schema;
}

/// With doc and preset.
Schema described(const FieldTree& field, Schema schema) {
  if (!field.doc.empty()) schema["description"] = field.doc;
  const bool has_preset = !field.preset.is_null() && field.preset != "";
  if (has_preset) schema["default"] = preset_of(field.preset);
  return schema;
}

/// A list of different values, at least one.
void add_values(const Schema& value, Schema& schema) {
  schema["items"] = value;
  schema["minItems"] = 1;
  schema["uniqueItems"] = true;
}

/// {from, to, count} or {from, to, step}.
void add_range_keys(Range range, Schema& schema) {
  // As many as the reader of ranges takes.
  constexpr int kMostValues = 10000;
  Schema ends = Schema::object();
  add_range(range, ends);
  Schema from{{"type", "number"}, {"description", "First value."}};
  from.update(ends);
  schema["properties"] = {{"from", from},
                          {"to", {{"type", "number"}, {"description", "Last value."}}},
                          {"count",
                           {{"type", "integer"},
                            {"minimum", 1},
                            {"maximum", kMostValues},
                            {"description", "How many values, both ends included."}}},
                          {"step",
                           {{"type", "number"},
                            {"not", {{"const", 0}}},
                            {"description", "From one value to the next."}}}};
  schema["additionalProperties"] = false;
  schema["required"] = {"from", "to"};
  Schema one_of = Schema::array({{{"required", {"count"}}}, {{"required", {"step"}}}});
  schema["dependentSchemas"]["from"] = {{"oneOf", std::move(one_of)}};
  if (!ends.empty()) {  // steps need not reach `to`
    schema["dependentSchemas"]["count"]["properties"]["to"] = ends;
  }
}

/// The value, a list of values, or for numbers a range. The keywords of one type do not touch the
/// others, which makes for better messages than anyOf does.
Schema scalar_axis(const FieldTree& field, const Schema& value) {
  // A choice is an enum, which has no type that a list could be added to.
  if (field.kind == FieldKind::choice) {
    Schema list{{"type", "array"}};
    add_values(value, list);
    return {{"anyOf", {value, list}}};
  }
  Schema schema = value;
  const Schema& types = value.at("type");
  schema["type"] = types.is_array() ? types : Schema::array({types});
  schema["type"].push_back("array");
  add_values(value, schema);
  if (!is_number(field)) return schema;
  schema["type"].push_back("object");
  add_range_keys(field.range, schema);
  return schema;
}

/// A field for which several values may stand: a list of them, or a range of numbers. A list of
/// values may stand for one value, except under `axes`.
Schema several_schema(const FieldTree& field, const Schema& value, bool under_axes) {
  if (field.kind != FieldKind::list) return scalar_axis(field, value);
  Schema list = Schema::object();
  add_values(value, list);
  if (under_axes) {
    list["type"] = "array";
    return list;
  }
  // [1, 2, 3] is one value of a list; [[1, 2, 3], [4, 5, 6]] are two.
  return {{"if", {{"type", "array"}, {"contains", {{"type", "array"}}}}},
          {"then", list},
          {"else", value}};
}

// -------------------------------------------------------------------------------------------------
// mappings

Schema reference(const std::string& definition) { return {{"$ref", "#/$defs/" + definition}}; }

/// A name, better one of `known`.
Schema name_schema(const std::vector<std::string>& known) {
  Schema options = Schema::array();
  if (!known.empty()) options.push_back({{"enum", known}});
  options.push_back({{"type", "string"}});
  return {{"anyOf", options}};
}

/// A name, or what `mapping` says.
Schema name_or(const Schema& mapping, const std::vector<std::string>& known) {
  return {{"if", {{"type", "object"}}}, {"then", mapping}, {"else", name_schema(known)}};
}

/// Adds a property, or another form of one that is there, as of a field that several kinds have.
void add_property(const std::string& name, Schema schema, Schema& properties) {
  Schema& first = properties[name];
  if (first.is_null()) first = schema;
  if (first == schema) return;
  const bool is_union = first.size() == 1 && first.contains("anyOf");
  // The second form makes a union of it, further ones join that.
  if (!is_union) first = Schema{{"anyOf", Schema::array({first})}};
  Schema& options = first["anyOf"];
  if (std::find(options.begin(), options.end(), schema) == options.end()) {
    options.push_back(std::move(schema));
  }
}

/// A variant whose kinds' fields are not among its neighbours yet.
bool is_open(const FieldTree& field) {
  return field.kind == FieldKind::variant && !field.fields.empty();
}

/// How many seeds, or a list or range of them.
Schema seeds_schema(const FieldTree& field) {
  constexpr int kMostSeeds = 10000;
  Schema schema = several_schema(field, value_schema(field), false);
  schema["minimum"] = 1;
  schema["maximum"] = kMostSeeds;
  return described(field, std::move(schema));
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
  return described(key, std::move(schema));
}

/// The fields with one more kind's fields, its word a plain one.
std::vector<FieldTree> with_kind(std::vector<FieldTree> fields, std::size_t variant,
                                 const std::vector<FieldTree>& of_kind) {
  fields[variant].fields.clear();
  fields.insert(fields.end(), of_kind.begin(), of_kind.end());
  return fields;
}

/// Makes the schemas of mappings, and the definitions that they share.
class SchemaWriter {
 public:
  /// `is_over`: of files that are laid over others, which may say a variant's kind; then the fields
  /// of every kind are let through where it is not said here.
  SchemaWriter(bool lists_are_axes, bool is_over)
      : lists_are_axes_(lists_are_axes), is_over_(is_over) {}

  Schema definitions = Schema::object();

  /// Schema of a mapping of these fields. `name` is that of its definitions. The kinds of a variant
  /// are told apart by if and then: messages name the key that is wrong, and editors offer only
  /// the keys of the kind that is chosen.
  Schema block(const std::vector<FieldTree>& fields, const std::string& name) {
    // One variant after the other: the definition of a kind is the block with its fields, in which
    // the next variant is looked for.
    const auto variant = std::find_if(fields.begin(), fields.end(), is_open);
    if (variant == fields.end()) {
      Schema properties = Schema::object();
      for (const FieldTree& each : fields) add_property(each.name, field(each, name), properties);
      return {{"type", "object"}, {"properties", properties}, {"additionalProperties", false}};
    }
    const auto index = static_cast<std::size_t>(variant - fields.begin());
    const auto define = [&](const std::string& ending, const std::vector<FieldTree>& of_kind) {
      const std::string definition = name + "." + ending;
      if (!definitions.contains(definition)) {
        definitions[definition] = block(with_kind(fields, index, of_kind), definition);
      }
      return reference(definition);
    };
    Schema rules = Schema::array(), unsaid;
    std::vector<FieldTree> of_any;
    for (const FieldTree& kind : variant->fields) {
      Schema of_kind = define(kind.name, kind.fields);
      if (!kind.doc.empty()) definitions[name + "." + kind.name]["description"] = kind.doc;
      if (variant->preset == kind.name) unsaid = of_kind;
      Schema says_kind{{"properties", {{variant->name, {{"const", kind.name}}}}},
                       {"required", {variant->name}}};
      rules.push_back({{"if", std::move(says_kind)}, {"then", std::move(of_kind)}});
      of_any.insert(of_any.end(), kind.fields.begin(), kind.fields.end());
    }
    const bool has_preset = std::any_of(fields.begin(), fields.end(), [](const FieldTree& other) {
      return other.name == "preset";
    });
    // The kind may be said elsewhere: every kind's fields are let through.
    if (is_over_) unsaid = define("any_" + variant->name, of_any);
    // A preset says the kind, too.
    if (has_preset && !is_over_) {
      unsaid = {{"if", {{"required", {"preset"}}}},
                {"then", define("any_" + variant->name, of_any)},
                {"else", unsaid}};
    }
    Schema says_none{{"not", {{"required", {variant->name}}}}};
    rules.push_back({{"if", std::move(says_none)}, {"then", std::move(unsaid)}});
    FieldTree word = *variant;
    word.fields.clear();
    Schema schema{{"type", "object"}};
    schema["properties"][word.name] = field(word, name);
    schema["allOf"] = std::move(rules);
    return schema;
  }

  /// Schema of one value, whatever it is.
  Schema value(const FieldTree& field, const std::string& name) {
    const std::string inner_name = name + "." + field.name;
    if (field.kind == FieldKind::block) return block(field.fields, inner_name);
    if (field.fields.empty() || field.fields.front().kind != FieldKind::block) {
      return value_schema(field);
    }
    SchemaWriter elements(false, false);  // an element has no path of its own
    Schema list{{"type", "array"}};
    const FieldTree& element = field.fields.front();
    list["items"] = elements.block(element.fields, inner_name);
    if (const FieldTree* preset = element.find("preset")) {
      list["items"] = name_or(list["items"], preset->choices);
    }
    if (field.count) list["minItems"] = list["maxItems"] = *field.count;
    definitions.update(elements.definitions);
    return list;
  }

  /// The same with doc and preset, and with several values where lists are axes.
  Schema field(const FieldTree& field, const std::string& name) {
    const bool is_other = field.kind == FieldKind::other;
    const bool may_be_axis = lists_are_axes_ && !is_other && field.kind != FieldKind::variant;
    if (is_other && field.fields.empty()) return other_schema(field);
    if (may_be_axis && field.name == "seeds") return seeds_schema(field);
    Schema schema = value(field, name);
    if (may_be_axis && field.kind != FieldKind::block) return several(field, schema, false);
    if (is_other) {  // mission.list
      schema["items"]["required"] = {"start"};
      schema["items"]["oneOf"] = {{{"required", {"goal"}}}, {{"required", {"goals"}}}};
      schema["minItems"] = 1;
    }
    return described(field, std::move(schema));
  }

  /// The same for one that may have several values, in place or `under_axes`. Numbers of one range
  /// share a definition.
  Schema several(const FieldTree& field, const Schema& value, bool under_axes) {
    if (!is_number(field)) {
      return described(field, several_schema(field, value, under_axes));
    }
    // "numbers.0.to.any": one definition for each range, shared by all fields that have it.
    const auto end = [](double bound) { return std::isfinite(bound) ? number_text(bound) : "any"; };
    const std::string name = std::string(field.kind == FieldKind::number ? "numbers" : "wholes") +
                             "." + end(field.range.lowest) + ".to." + end(field.range.highest);
    if (!definitions.contains(name)) definitions[name] = several_schema(field, value, false);
    return described(field, reference(name));
  }

 private:
  bool lists_are_axes_, is_over_;
};

// -------------------------------------------------------------------------------------------------
// files

/// Adds the paths below the sweep's key `key` that may stand under `axes`.
void add_axes(const FieldTree& key, SchemaWriter& writer, Schema& properties) {
  for (const KindField& entry : all_fields(key)) {
    const FieldTree& field = *entry.field;
    const bool is_axis = field.kind != FieldKind::block && field.kind != FieldKind::variant &&
                         field.kind != FieldKind::other;
    if (!is_axis) continue;
    const std::string path = key.name + "." + entry.path;
    const Schema value = writer.value(field, path.substr(0, path.rfind('.') + 1) + "axis");
    add_property(path, writer.several(field, value, true), properties);
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
      // A planner without this parameter can't be given it: no value fits.
      parameters.contains("max_speed_mps") ? Schema(parameters["max_speed_mps"]) : Schema(false);
  of_planner["parameters"] = {{"type", {"object", "null"}},
                              {"description", planner.summary},
                              {"properties", std::move(parameters)},
                              {"additionalProperties", false}};
  return {{"if", {{"properties", {{"plugin", {{"const", name}}}}}, {"required", {"plugin"}}}},
          {"then", {{"properties", std::move(of_planner)}}}};
}

/// What only a planner's entry has.
void add_planner_keys(const FieldTree& max_speed, SchemaWriter& writer, Schema& properties) {
  properties["camera"] = {
      {"type", "integer"},
      {"minimum", 0},
      {"description",
       "The one camera that the planner sees, if the sensor has several; default: all."}};
  properties["filter"] = reference("filter");
  properties["filter"]["description"] =
      "A filter that the planner's commands pass through: a name, or what differs from it.";
  properties["max_speed_mps"] = writer.several(max_speed, value_schema(max_speed), false);
}

/// One entry of `planners`, or what stands under `filter` in one.
Schema planner_schema(const FieldTree& max_speed, const std::vector<PlannerDescription>& planners,
                      bool of_filters, SchemaWriter& writer) {
  std::vector<std::string> names;
  Schema rules = Schema::array();
  for (const PlannerDescription& planner : planners) {
    if (is_filter(planner) != of_filters) continue;
    const bool is_script = planner.file.extension() == ".py";
    names.push_back((is_script ? planner.file.filename() : planner.file.stem()).string());
    rules.push_back(planner_rule(planner, names.back(), writer));
  }
  // As read_label() has it.
  constexpr int kLongestLabel = 100;
  Schema properties = Schema::object();
  properties["plugin"] = name_schema(names);
  properties["plugin"]["description"] =
      "A planner's name, its library or program as ./FILE, or `process` with parameters.command.";
  properties["label"] = {{"type", {"string", "number", "boolean"}},
                         {"minLength", 1},
                         {"maxLength", kLongestLabel},
                         {"description", "Its label in reports; default: its name."}};
  properties["parameters"] = {
      {"type", {"object", "null"}},
      {"additionalProperties", {{"type", {"string", "number", "boolean", "array", "object"}}}},
      {"description",
       "Values by name; a list gives one planner for each. `avoidbench planners describe NAME` "
       "shows them."}};
  if (!of_filters) add_planner_keys(max_speed, writer, properties);
  Schema entry{{"type", "object"},
               {"properties", std::move(properties)},
               {"additionalProperties", false},
               {"required", {"plugin"}}};
  if (!rules.empty()) entry["allOf"] = std::move(rules);
  return name_or(entry, names);
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
  // A range's keys may be given in two files: that all are there can't be asked of one.
  const bool is_range = schema.contains("properties") && schema["properties"].contains("step");
  Schema result = Schema::object();
  for (const auto& [key, value] : schema.items()) {
    if (is_range && (key == "required" || key == "dependentSchemas")) continue;
    // Conditions and words are not values that could be empty.
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

/// A file's schema: `whole`, or `over` where there is `include`, with what they define.
Schema file_schema(const std::string& name, const std::string& doc, Schema whole,
                   SchemaWriter& of_whole, const Schema& over, const SchemaWriter& of_over) {
  Schema& definitions = of_whole.definitions;
  definitions[name + "_file"] = std::move(whole);
  definitions["over." + name + "_file"] = laid_over(over);
  for (const auto& [key, value] : of_over.definitions.items()) {
    definitions["over." + key] = laid_over(value);
  }
  return {{"$schema", "https://json-schema.org/draft/2020-12/schema"},
          {"$id", "urn:avoidbench:schema:" + name},
          {"title", "avoidbench " + name},
          {"description", doc},
          {"type", "object"},
          {"if", {{"required", {"include"}}}},
          {"then", reference("over." + name + "_file")},
          {"else", reference(name + "_file")},
          {"$defs", std::move(definitions)}};
}

/// Of a file that describes one vehicle or sensor, whole or laid over another: lists are no axes
/// there.
Schema shelf_schema(const FieldTree& tree) {
  std::vector<FieldTree> fields{*sweep_tree().find("include")};
  fields.insert(fields.end(), tree.fields.begin(), tree.fields.end());
  SchemaWriter of_whole(false, false), of_over(false, true);
  Schema whole = of_whole.block(fields, tree.name);
  const Schema over = of_over.block(fields, tree.name);
  return file_schema(tree.name, tree.doc, std::move(whole), of_whole, over, of_over);
}

/// What stands under the sweep's key `key`, where it is a block.
Schema block_of_sweep(const FieldTree& key, SchemaWriter& writer) {
  const FieldTree* preset = key.find("preset");
  Schema schema = writer.block(key.fields, key.name);
  if (preset != nullptr) schema = name_or(schema, preset->choices);
  writer.definitions[key.name] = described(key, std::move(schema));
  return reference(key.name);
}

/// The mapping of a sweep file's keys.
Schema sweep_keys(const FieldTree& sweep, SchemaWriter& writer) {
  Schema properties = Schema::object(), axes = Schema::object();
  for (const FieldTree& key : sweep.fields) {
    Schema& schema = properties[key.name];
    if (key.kind == FieldKind::block) {
      schema = block_of_sweep(key, writer);
      add_axes(key, writer, axes);
      continue;
    }
    if (key.name == "sweep") {
      // YAML reads names such as 2026 and true as other types; the pattern is of texts alone.
      schema = {{"type", {"string", "number", "boolean"}},
                {"pattern", "^[A-Za-z0-9_][A-Za-z0-9_.-]{0,99}$"}};
    } else if (key.name == "planners") {
      // One planner stands for a list of one.
      Schema list{{"type", "array"}, {"items", reference("planner")}, {"minItems", 1}};
      schema = {{"if", {{"type", "array"}}}, {"then", list}, {"else", reference("planner")}};
    } else if (key.name == "axes") {
      Schema map_alias{{"^map(\\.|_seed$)", {{"type", {"number", "array", "object"}}}}};
      schema = {{"type", {"object", "null"}},
                {"properties", axes},
                {"patternProperties", std::move(map_alias)},  // the paths of stored trials
                {"additionalProperties", false}};
    } else if (key.name == "trials") {
      schema = value_schema(key);
    } else {
      schema = writer.field(key, "");
      if (key.name == "seed") axes[key.name] = writer.several(key, value_schema(key), true);
    }
    schema = described(key, std::move(schema));
  }
  return {{"properties", std::move(properties)}, {"additionalProperties", false}};
}

}  // namespace

Schema sweep_schema(const std::vector<PlannerDescription>& planners, bool is_part) {
  const std::string name = is_part ? "part" : "sweep";
  const FieldTree& sweep = sweep_tree();
  SchemaWriter of_over(true, true);
  const Schema over = sweep_keys(sweep, of_over);
  // What a part lacks, an including file has.
  SchemaWriter of_whole = is_part ? of_over : SchemaWriter(true, false);
  Schema whole = is_part ? over : sweep_keys(sweep, of_whole);
  if (!is_part) whole["required"] = {"sweep", "planners"};
  for (const bool of_filters : {false, true}) {
    of_whole.definitions[of_filters ? "filter" : "planner"] =
        planner_schema(*sweep.find("max_speed_mps"), planners, of_filters, of_whole);
  }
  return file_schema(name, sweep.doc, std::move(whole), of_whole, over, of_over);
}

Schema flights_schema(const std::vector<PlannerDescription>& planners) {
  // The block `sweep` is what sweeps include: it need not be whole.
  const Schema part = sweep_schema(planners, true);
  SchemaWriter writer(false, false);
  writer.definitions = part["$defs"];
  Schema schema = writer.block(flights_tree().fields, "flights");
  Schema& properties = schema["properties"];
  properties["flights"] = {{"type", {"string", "number", "boolean"}},
                           {"pattern", "^[A-Za-z0-9_][A-Za-z0-9_.-]{0,99}$"},
                           {"description", flights_tree().find("flights")->doc}};
  properties["include"] = other_schema(*sweep_tree().find("include"));
  properties["sweep"] = reference("part_file");
  properties["sweep"]["type"] = "object";
  properties["recordings"]["minItems"] = 1;
  properties["recordings"]["items"]["required"] = {"log", "planner", "goal"};
  Schema file{{"$schema", "https://json-schema.org/draft/2020-12/schema"},
              {"$id", "urn:avoidbench:schema:flights"},
              {"title", "avoidbench flights"},
              {"description", flights_tree().doc}};
  file.update(schema);
  // An including file need not be whole.
  file["if"] = {{"not", {{"required", {"include"}}}}};
  file["then"]["required"] = {"flights", "sweep", "recordings"};
  file["$defs"] = std::move(writer.definitions);
  return file;
}

Schema vehicle_schema() { return shelf_schema(vehicle_tree()); }
Schema sensor_schema() { return shelf_schema(sensor_tree()); }

}  // namespace avoidbench
