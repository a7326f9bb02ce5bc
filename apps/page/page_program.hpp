#pragma once

#include "page/page_text.hpp"

namespace avoidbench {

/// The page that was built into this program, or why there is none.
PageProgram page_program();

}  // namespace avoidbench
