#pragma once

#include "page/page_text.hpp"

namespace avoidbench {

/// The page's program, as build.mjs bundled it.
PageProgram page_program();

}  // namespace avoidbench
