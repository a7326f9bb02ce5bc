#pragma once

#include "store/rows.hpp"

namespace avoidbench {

/// A run that begins now in this process: when, on which host and processor, by which command line.
/// The program adds what it was built from.
RunRow run_on_this_host();

}  // namespace avoidbench
