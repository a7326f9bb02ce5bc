#pragma once

#include <nlohmann/json.hpp>

#include "config/field_tree.hpp"

namespace avoidbench {

/// Ordered, so that a schema reads in the order of the fields.
using Schema = nlohmann::ordered_json;

/// Schema of one value of a field that is no block and no variant, nor a list of blocks.
Schema value_schema(const FieldTree& field);

/// Schema of a field for which several values may stand: a list of them, or a range of numbers.
Schema several_schema(const FieldTree& field, const Schema& value);

/// Schema of the values of a field under `axes`.
Schema axis_schema(const FieldTree& field, const Schema& value);

/// Adds doc and preset.
void describe(const FieldTree& field, Schema& schema);

}  // namespace avoidbench
