#pragma once

#include <ucontext.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <utility>

namespace ros_shim {

/// A function with a stack of its own, which stops where it calls yield() and goes on where it is
/// resumed: a node's main() runs up to ros::spin() in one, on the thread of the caller and in an
/// order that the caller decides.
class Fibre {
 public:
  explicit Fibre(std::function<void()> body);
  ~Fibre();
  Fibre(const Fibre&) = delete;
  Fibre& operator=(const Fibre&) = delete;

  /// Runs it until it yields or ends. Its body must let no exception out.
  void resume();
  /// Back to who resumed it. Only from within.
  void yield();
  bool is_done() const { return is_done_; }

 private:
  static void enter(unsigned high, unsigned low);
  void switch_to(ucontext_t& from, ucontext_t& to, bool into);

  std::function<void()> body_;
  char* stack_ = nullptr;
  ucontext_t own_{}, caller_{};
  /// What the C++ library keeps of exceptions in flight, by stack: see __cxa_get_globals.
  struct Exceptions {
    void* caught = nullptr;
    unsigned uncaught = 0;
  } exceptions_;
  // for the address sanitizer
  [[maybe_unused]] void* sanitizer_stack_ = nullptr;
  [[maybe_unused]] const void* caller_stack_ = nullptr;
  [[maybe_unused]] std::size_t caller_size_ = 0;
  bool is_started_ = false, is_done_ = false;
};

}  // namespace ros_shim
