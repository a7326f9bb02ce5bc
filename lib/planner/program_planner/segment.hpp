#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "avoidbench/process_protocol.h"

namespace avoidbench {

/// The memory that the host and one program share. The program can write to all of it at any
/// moment, but not make it smaller: what the host needs to know of it, it keeps elsewhere, and what
/// it reads, it reads once.
class Segment {
 public:
  static constexpr std::uint64_t kAnswerOffset = 4096;
  static constexpr std::uint64_t kAnswerBytes = std::uint64_t{4} << 20U;
  static constexpr std::uint64_t kRequestOffset = kAnswerOffset + kAnswerBytes;

  /// Throws InputError where the system gives no memory for it.
  Segment();
  ~Segment();
  Segment(const Segment&) = delete;
  Segment& operator=(const Segment&) = delete;

  int fd() const { return fd_; }

  /// Begins a request of this kind; what add() appended before is forgotten.
  void begin_request(std::uint32_t sequence, std::uint32_t kind);
  /// Appends to the request; returns the offset in the segment. The segment grows where it must.
  std::uint64_t add(const void* bytes, std::size_t count);
  template <class Struct>
  std::uint64_t add(const std::vector<Struct>& values) {
    return values.empty() ? 0 : add(values.data(), values.size() * sizeof(Struct));
  }
  void end_request(std::uint64_t body);
  /// What was added to the request until now, to be added to another one as it is.
  std::vector<std::byte> body_bytes() const;

  /// A copy of the answer, taken at once: `size` of its bytes are those that it says it has, within
  /// bounds. Nothing where it says something else.
  bool copy_answer(std::vector<std::byte>& answer) const;

 private:
  void grow(std::uint64_t bytes);
  void write_header();
  void write(std::uint64_t offset, const void* bytes, std::size_t count);

  int fd_ = -1;
  unsigned char* memory_ = nullptr;
  std::uint64_t bytes_ = 0;
  std::uint64_t used_ = 0;  ///< of the request
  ab_process_request request_{};
};

}  // namespace avoidbench
