#include "program_planner/segment.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "avoidbench/planner.h"
#include "base/input_error.hpp"

namespace avoidbench {
namespace {

// Room for images of 320 × 240. Where it grows the program has to map it anew: in large steps.
constexpr std::uint64_t kFirstBytes = Segment::kRequestOffset + (std::uint64_t{1} << 20U);
constexpr std::uint64_t kStep = std::uint64_t{1} << 20U;

[[noreturn]] void no_memory(const char* what, int error) {
  throw InputError(std::string("no memory to share with a planner's program: ") + what + ": " +
                   std::strerror(error));
}

}  // namespace

Segment::Segment() {
  // The program gets a copy of the descriptor; what else is started does not.
  fd_ = ::memfd_create("avoidbench_planner", MFD_CLOEXEC | MFD_ALLOW_SEALING);
  if (fd_ < 0) no_memory("memfd_create", errno);
  grow(kFirstBytes);
  write_header();
  // A program that made it smaller would end the host at its next look.
  // The last seal: one of the program's own could forbid the host to write, or to grow it.
  ::fcntl(fd_, F_ADD_SEALS, F_SEAL_SHRINK | F_SEAL_SEAL);
}

Segment::~Segment() {
  if (memory_ != nullptr) ::munmap(memory_, bytes_);
  if (fd_ >= 0) ::close(fd_);
}

void Segment::grow(std::uint64_t bytes) {
  // Pages that nobody has written to cost nothing.
  struct stat found {};
  // The program may have made it larger itself.
  const bool is_large =
      ::fstat(fd_, &found) == 0 && static_cast<std::uint64_t>(found.st_size) >= bytes;
  if (!is_large && ::ftruncate(fd_, static_cast<off_t>(bytes)) != 0) no_memory("ftruncate", errno);
  void* moved = memory_ == nullptr
                    ? ::mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_SHARED, fd_, 0)
                    : ::mremap(memory_, bytes_, bytes, MREMAP_MAYMOVE);
  if (moved == MAP_FAILED) no_memory("mmap", errno);
  memory_ = static_cast<unsigned char*>(moved);
  bytes_ = bytes;
}

void Segment::write(std::uint64_t offset, const void* bytes, std::size_t count) {
  std::memcpy(memory_ + offset, bytes, count);
}

void Segment::begin_request(std::uint32_t sequence, std::uint32_t kind) {
  request_ = ab_process_request{};
  request_.sequence = sequence;
  request_.kind = kind;
  used_ = sizeof request_;
}

std::uint64_t Segment::add(const void* bytes, std::size_t count) {
  // Structs begin at multiples of 8 (process_protocol.h).
  const std::uint64_t at = (used_ + 7U) & ~std::uint64_t{7};
  const std::uint64_t end = kRequestOffset + at + count;
  // A quarter more than is needed, so that images that differ a little don't move it each time.
  if (end > bytes_) grow((end + end / 4 + kStep) / kStep * kStep);
  write(kRequestOffset + at, bytes, count);
  used_ = at + count;
  return kRequestOffset + at;
}

void Segment::end_request(std::uint64_t body) {
  request_.bytes = used_;
  request_.body = body;
  write(kRequestOffset, &request_, sizeof request_);
  write_header();  // anew, since the program may have written over it
}

void Segment::write_header() {
  ab_process_header header{};
  std::memcpy(header.magic, AB_PROCESS_MAGIC, sizeof header.magic);
  header.protocol = AB_PROCESS_PROTOCOL;
  header.abi_version = AVOIDBENCH_ABI_VERSION;
  header.segment_bytes = bytes_;
  header.answer_offset = kAnswerOffset;
  header.answer_bytes = kAnswerBytes;
  header.request_offset = kRequestOffset;
  write(0, &header, sizeof header);
}

std::vector<std::byte> Segment::body_bytes() const {
  const auto* begin = reinterpret_cast<const std::byte*>(memory_ + kRequestOffset);
  return {begin + sizeof request_, begin + used_};
}

bool Segment::copy_answer(std::vector<std::byte>& answer) const {
  // Read once: the program may write another size at any moment.
  constexpr std::uint64_t kSizeOffset = kAnswerOffset + offsetof(ab_process_answer, bytes);
  const std::uint64_t bytes =
      *reinterpret_cast<const volatile std::uint64_t*>(memory_ + kSizeOffset);
  if (bytes < sizeof(ab_process_answer) || bytes > kAnswerBytes) return false;
  answer.resize(bytes);
  std::memcpy(answer.data(), memory_ + kAnswerOffset, bytes);
  return true;
}

}  // namespace avoidbench
