#include "fibre.hpp"

#include <cxxabi.h>
#include <sys/mman.h>
#include <unistd.h>

#include <new>
#include <utility>

#if defined(__SANITIZE_ADDRESS__)
#define ROS_SHIM_ASAN 1
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
#define ROS_SHIM_ASAN 1
#endif
#endif
#ifdef ROS_SHIM_ASAN
#include <sanitizer/common_interface_defs.h>
#endif

namespace ros_shim {
namespace {

// As a thread's; pages that are never touched cost nothing. Below it one page that nobody may
// touch.
constexpr std::size_t kStack = std::size_t{8} << 20U;

std::size_t page_size() { return static_cast<std::size_t>(::sysconf(_SC_PAGESIZE)); }

}  // namespace

Fibre::Fibre(std::function<void()> body) : body_(std::move(body)) {
  void* memory = ::mmap(nullptr, kStack, PROT_READ | PROT_WRITE,
                        MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  if (memory == MAP_FAILED) throw std::bad_alloc();
  stack_ = static_cast<char*>(memory);
  ::mprotect(stack_, page_size(), PROT_NONE);
  ::getcontext(&own_);
  own_.uc_stack.ss_sp = stack_;
  own_.uc_stack.ss_size = kStack;
  own_.uc_link = nullptr;
  const auto self = reinterpret_cast<std::uintptr_t>(this);
  // makecontext passes ints only.
  ::makecontext(&own_, reinterpret_cast<void (*)()>(&Fibre::enter), 2,
                static_cast<unsigned>(self >> 32U), static_cast<unsigned>(self & 0xffffffffU));
}

Fibre::~Fibre() { ::munmap(stack_, kStack); }

void Fibre::enter(unsigned high, unsigned low) {
  auto* self = reinterpret_cast<Fibre*>((static_cast<std::uintptr_t>(high) << 32U) | low);
#ifdef ROS_SHIM_ASAN
  __sanitizer_finish_switch_fiber(nullptr, &self->caller_stack_, &self->caller_size_);
#endif
  self->body_();
  self->is_done_ = true;
  self->yield();
}

/// Not inlined: a compiler may keep addresses of thread-local variables over a call that it sees
/// into, and the fibre may go on in another thread.
__attribute__((noinline)) void Fibre::switch_to(ucontext_t& from, ucontext_t& to, bool into) {
  Exceptions& current = *reinterpret_cast<Exceptions*>(abi::__cxa_get_globals());
  std::swap(current, exceptions_);
#ifdef ROS_SHIM_ASAN
  void* fake = nullptr;
  if (into) {
    __sanitizer_start_switch_fiber(&fake, stack_, kStack);
  } else {
    __sanitizer_start_switch_fiber(is_done_ ? nullptr : &sanitizer_stack_, caller_stack_,
                                   caller_size_);
  }
#endif
  ::swapcontext(&from, &to);
#ifdef ROS_SHIM_ASAN
  if (into) {
    __sanitizer_finish_switch_fiber(fake, nullptr, nullptr);
  } else {
    __sanitizer_finish_switch_fiber(sanitizer_stack_, &caller_stack_, &caller_size_);
  }
#else
  static_cast<void>(into);
#endif
}

void Fibre::resume() {
  if (is_done_) return;
  is_started_ = true;
  switch_to(caller_, own_, true);
}

void Fibre::yield() { switch_to(own_, caller_, false); }

}  // namespace ros_shim
