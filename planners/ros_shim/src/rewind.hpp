#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core.hpp"

namespace ros_shim {

/// What a node that is run ahead changes, to put it back afterwards: the static storage of this
/// copy of the library (globals and static variables of the planner's sources), the node's stack,
/// its queue and its timers. What it frees meanwhile with operator delete stays until then, what it
/// makes goes. Not put back: objects that live on the heap, and memory of malloc().
class Rewind {
 public:
  explicit Rewind(Node& node);
  ~Rewind();
  Rewind(const Rewind&) = delete;
  Rewind& operator=(const Rewind&) = delete;

 private:
  struct Piece {
    char* at;
    std::vector<char> bytes;
  };
  void keep(char* at, std::size_t size);

  Node& node_;
  std::vector<Piece> pieces_;
  ucontext_t context_{};
  std::int64_t now_ns_, wake_ns_, polled_ns_;
  bool takes_callbacks_;
  int polls_;
  std::uint64_t next_order_;
  std::deque<Waiting> queue_;
  std::vector<Timer> timers_;
};

/// While the runtime itself makes and frees memory that outlives a run ahead.
class LedgerPause {
 public:
  LedgerPause();
  ~LedgerPause();
  LedgerPause(const LedgerPause&) = delete;
  LedgerPause& operator=(const LedgerPause&) = delete;

 private:
  bool is_on_;
};

}  // namespace ros_shim
