#pragma once

#include <string_view>

namespace avoidbench {

extern const std::string_view kSchemaSql;  ///< schema.sql
extern const std::string_view kViewsSql;   ///< views.sql

}  // namespace avoidbench
