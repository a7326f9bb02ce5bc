#include <pthread.h>

#include <atomic>
#include <chrono>
#include <thread>

#include "bindings.hpp"

namespace nb = nanobind;

namespace avoidbench::python {
namespace {

/// A thread that wants the interpreter's lock after its end is ended by pthread_exit(), and the
/// process with it where that meets a destructor of ours. So the end waits for all that are in our
/// code without the lock, and none gives it away after that.
std::atomic<bool> is_ending{false};
std::atomic<int> calls_without_lock{0};

/// Called by Python before its end, in its main thread.
void end_calls() {
  is_ending = true;
  {
    // Not counted: it is what waits.
    const nb::gil_scoped_release released;
    while (calls_without_lock > 0) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  close_all_flights();
  // What daemon threads hold until the process ends is no leak.
  nb::set_leak_warnings(false);
}

}  // namespace

void end_thread() {
  PyErr_SetString(PyExc_SystemExit, "Python is ending");
  throw nb::python_error();
}

Released::Released() {
  if (is_ending) return;
  ++calls_without_lock;
  thread_ = PyEval_SaveThread();
}

Released::~Released() {
  if (thread_ == nullptr) return;
  PyEval_RestoreThread(thread_);
  --calls_without_lock;
}

void check_signals() {
  const nb::gil_scoped_acquire held;
  if (is_ending) end_thread();
  if (PyErr_CheckSignals() != 0) throw nb::python_error();
}

void bind_interpreter() {
  nb::module_::import_("atexit").attr("register")(nb::cpp_function(&end_calls));
  // A fork takes the calling thread alone.
  ::pthread_atfork(nullptr, nullptr, [] { calls_without_lock = 0; });
}

}  // namespace avoidbench::python
