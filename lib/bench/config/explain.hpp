#pragma once

#include <string>
#include <utility>
#include <vector>

#include "plugin/planner_library.hpp"

namespace avoidbench {

/// What a key of a sweep file means.
struct Explanation {
  std::string title;                                       ///< "maps.bush_ratio: what it is"
  std::vector<std::pair<std::string, std::string>> facts;  ///< "default", "0.4"
  std::vector<std::string> columns;                        ///< of `keys`; "" where there are none
  std::vector<std::vector<std::string>> keys;              ///< of a block: its keys
};

/// What `key`, a dotted path of a sweep file, means; several where kinds differ, as two generators'
/// fields of one name. "": all top keys. A kind's name may stand for a key (maps.hall), and a
/// planner or its parameter (reactive.margin_m). Throws InputError with suggestions where there is
/// no such key. Examples are good lines of a sweep file.
std::vector<Explanation> explain(const std::string& key,
                                 const std::vector<PlannerDescription>& planners);

}  // namespace avoidbench
