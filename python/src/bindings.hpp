#pragma once

#include <nanobind/nanobind.h>

/// What each source of this folder adds to the module avoidbench._core. The Python files of the
/// package are what users see: they check shapes, and say in their docstrings what these take.
namespace avoidbench::python {

void bind_errors(nanobind::module_& m);
void bind_world(nanobind::module_& m);
void bind_env(nanobind::module_& m);
/// What Python does at its end with threads that are in this module.
void bind_interpreter();

/// While it lives the thread does not hold the interpreter's lock. Python's end waits for it; one
/// that is made after that keeps the lock.
class Released {
 public:
  Released();
  ~Released();
  Released(const Released&) = delete;
  Released& operator=(const Released&) = delete;

 private:
  PyThreadState* thread_ = nullptr;
};

/// Throws what Python's handlers of signals raise, such as KeyboardInterrupt, and at Python's end
/// SystemExit: for long calls, every millisecond or so. The caller has released the lock.
void check_signals();

/// Throws SystemExit, which ends a thread without a word; the caller holds the interpreter's lock.
[[noreturn]] void end_thread();

/// Ends the threads of all that makes flights; the caller holds the interpreter's lock.
void close_all_flights();

}  // namespace avoidbench::python
