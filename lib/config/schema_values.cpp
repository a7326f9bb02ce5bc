#include "config/schema_values.hpp"

#include <cmath>

namespace avoidbench {
namespace {

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
  if (!preset.is_array()) return Schema::parse(preset.dump());
  Schema list = Schema::array();
  for (const nlohmann::json& element : preset) list.push_back(preset_of(element));
  return list;
}

void add_range(Range range, Schema& schema) {
  if (std::isfinite(range.lowest)) schema["minimum"] = number_json(range.lowest);
  if (std::isfinite(range.highest)) schema["maximum"] = number_json(range.highest);
}

/// A list of different values, at least one.
void add_values(const Schema& value, Schema& schema) {
  schema["items"] = value;
  schema["minItems"] = 1;
  schema["uniqueItems"] = true;
}

bool is_number(const FieldTree& field) {
  return field.kind == FieldKind::number || field.kind == FieldKind::whole;
}

/// {from, to, count} or {from, to, step}.
void add_range_keys(Range range, Schema& schema) {
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

}  // namespace

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

void describe(const FieldTree& field, Schema& schema) {
  if (!field.doc.empty()) schema["description"] = field.doc;
  const bool has_preset = !field.preset.is_null() && field.preset != "";
  if (has_preset) schema["default"] = preset_of(field.preset);
}

Schema several_schema(const FieldTree& field, const Schema& value) {
  if (field.kind != FieldKind::list) return scalar_axis(field, value);
  Schema list = Schema::object();
  add_values(value, list);
  return {{"if", {{"type", "array"}, {"contains", {{"type", "array"}}}}},
          {"then", list},
          {"else", value}};
}

Schema axis_schema(const FieldTree& field, const Schema& value) {
  if (field.kind != FieldKind::list) return scalar_axis(field, value);
  Schema schema{{"type", "array"}};
  add_values(value, schema);
  return schema;
}

}  // namespace avoidbench
