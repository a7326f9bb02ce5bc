#pragma once

#include <nanobind/nanobind.h>

/// What each source of this folder adds to the module avoidbench._core. The Python files of the
/// package are what users see: they check shapes, and say in their docstrings what these take.
namespace avoidbench::python {

void bind_errors(nanobind::module_& m);
void bind_world(nanobind::module_& m);
void bind_env(nanobind::module_& m);
void bind_planner(nanobind::module_& m);

/// Throws what Python's handlers of signals raise, such as KeyboardInterrupt: for long calls, every
/// millisecond or so. The caller does not hold the interpreter's lock.
void check_signals();

}  // namespace avoidbench::python
