#include "worker/flight_journal.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <utility>

#include "store/record_format.hpp"

namespace avoidbench {
namespace {

/// What an entry holds.
enum What : std::uint32_t { sample_entry = 1, plan_call_entry, collision_entry };

struct EntryHead {
  std::uint32_t what = 0, size = 0;
};

struct PlanCallEntry {
  double time_s, cpu_time_s, wall_time_s, latency_s;
  std::int32_t status;
  std::uint32_t command_kind;
};

struct CollisionEntry {
  double time_s, speed_mps;
  std::int64_t obstacle;
  // A longer one is cut.
  char kind[48];
};

template <class Entry>
std::optional<Entry> entry_of(std::span<const std::byte> bytes) {
  if (bytes.size() != sizeof(Entry)) return std::nullopt;
  Entry entry;
  std::memcpy(&entry, bytes.data(), sizeof entry);
  return entry;
}

/// Adds an entry to the record; false where it is none.
bool take(TrialRecord& record, std::uint32_t what, std::span<const std::byte> bytes) {
  if (what == sample_entry && bytes.size() == kSampleBytes) {
    record.samples.push_back(samples_from_bytes(bytes).front());
    return true;
  }
  if (what == plan_call_entry) {
    const auto call = entry_of<PlanCallEntry>(bytes);
    if (!call) return false;
    record.plan_calls.push_back({.time_s = call->time_s,
                                 .cpu_time_s = call->cpu_time_s,
                                 .wall_time_s = call->wall_time_s,
                                 .status = call->status,
                                 .command_kind = call->command_kind,
                                 .latency_s = call->latency_s});
    return true;
  }
  const auto collision = entry_of<CollisionEntry>(bytes);
  if (what != collision_entry || !collision) return false;
  // The kind may fill its room without a zero at the end.
  const std::size_t length = ::strnlen(collision->kind, sizeof collision->kind);
  record.collisions.push_back({.time_s = collision->time_s,
                               .speed_mps = collision->speed_mps,
                               .obstacle = collision->obstacle,
                               .kind = std::string(collision->kind, length)});
  return true;
}

}  // namespace

/// At the beginning of the memory; entries follow, each with its head.
struct FlightJournal::Header {
  std::uint64_t used = 0;  ///< bytes of entries
  double time_s = 0.0;     ///< of the last call; NaN: none yet
};

FlightJournal::FlightJournal() {
  // Memory without a name in any folder; null where the system has none, and then a dead worker's
  // flight is not known.
  fd_ = ::memfd_create("avoidbench_flight", MFD_CLOEXEC | MFD_ALLOW_SEALING);
  if (fd_ < 0) return;
  // Its size is fixed: who maps it can't be made to read beyond its end.
  const bool is_sized = ::ftruncate(fd_, static_cast<off_t>(kBytes)) == 0 &&
                        ::fcntl(fd_, F_ADD_SEALS, F_SEAL_GROW | F_SEAL_SHRINK | F_SEAL_SEAL) == 0;
  void* memory =
      is_sized ? ::mmap(nullptr, kBytes, PROT_READ | PROT_WRITE, MAP_SHARED, fd_, 0) : MAP_FAILED;
  if (memory == MAP_FAILED) {
    ::close(std::exchange(fd_, -1));
    return;
  }
  memory_ = static_cast<std::byte*>(memory);
  restart();
}

FlightJournal::FlightJournal(int fd) : is_of_worker_(true) {
  struct stat file {};
  const bool is_one = ::fstat(fd, &file) == 0 && file.st_size == static_cast<off_t>(kBytes);
  // Closed until something is added: what runs in between is the planner's.
  void* memory = is_one ? ::mmap(nullptr, kBytes, PROT_NONE, MAP_SHARED, fd, 0) : MAP_FAILED;
  if (fd >= 0) ::close(fd);  // no way leads to it but this memory
  if (memory == MAP_FAILED) return;
  ::madvise(memory, kBytes, MADV_DONTFORK);  // nor for a planner's children
  memory_ = static_cast<std::byte*>(memory);
}

FlightJournal::~FlightJournal() {
  if (memory_ != nullptr) ::munmap(memory_, kBytes);
  if (fd_ >= 0) ::close(fd_);
}

FlightJournal::FlightJournal(FlightJournal&& other) noexcept
    : fd_(std::exchange(other.fd_, -1)),
      memory_(std::exchange(other.memory_, nullptr)),
      is_of_worker_(other.is_of_worker_),
      samples_(other.samples_),
      plan_calls_(other.plan_calls_),
      collisions_(other.collisions_) {}

FlightJournal& FlightJournal::operator=(FlightJournal&& other) noexcept {
  std::swap(fd_, other.fd_);
  std::swap(memory_, other.memory_);
  std::swap(is_of_worker_, other.is_of_worker_);
  std::swap(samples_, other.samples_);
  std::swap(plan_calls_, other.plan_calls_);
  std::swap(collisions_, other.collisions_);
  return *this;
}

void FlightJournal::open_pages() {
  if (is_of_worker_) ::mprotect(memory_, kBytes, PROT_READ | PROT_WRITE);
}

void FlightJournal::close_pages() {
  if (is_of_worker_) ::mprotect(memory_, kBytes, PROT_NONE);
}

void FlightJournal::restart() {
  if (memory_ == nullptr) return;
  samples_ = plan_calls_ = collisions_ = 0;
  open_pages();
  const Header empty{.used = 0, .time_s = std::nan("")};
  std::memcpy(memory_, &empty, sizeof empty);
  close_pages();
}

/// Entry first, then how much is used: a worker killed in between leaves whole entries only.
void FlightJournal::append(int what, const void* bytes, std::size_t size) {
  Header header;
  std::memcpy(&header, memory_, sizeof header);
  const EntryHead head{.what = static_cast<std::uint32_t>(what),
                       .size = static_cast<std::uint32_t>(size)};
  // Longer flights keep their beginning.
  if (header.used + sizeof head + size > kBytes - sizeof header) return;
  std::byte* place = memory_ + sizeof header + header.used;
  std::memcpy(place, &head, sizeof head);
  std::memcpy(place + sizeof head, bytes, size);
  header.used += sizeof head + size;
  std::memcpy(memory_, &header, sizeof header);
}

void FlightJournal::add(const TrialRecord& record, double time_s) {
  if (memory_ == nullptr) return;
  open_pages();
  for (; samples_ < record.samples.size(); ++samples_) {
    const std::vector<std::byte> bytes = sample_bytes({&record.samples[samples_], 1});
    append(sample_entry, bytes.data(), bytes.size());
  }
  // Each kind goes on where the last call left it.
  for (; plan_calls_ < record.plan_calls.size(); ++plan_calls_) {
    const PlanCall& call = record.plan_calls[plan_calls_];
    const PlanCallEntry entry{call.time_s,    call.cpu_time_s, call.wall_time_s,
                              call.latency_s, call.status,     call.command_kind};
    append(plan_call_entry, &entry, sizeof entry);
  }
  for (; collisions_ < record.collisions.size(); ++collisions_) {
    const Collision& collision = record.collisions[collisions_];
    CollisionEntry entry{collision.time_s, collision.speed_mps, collision.obstacle, {}};
    collision.kind.copy(entry.kind, sizeof entry.kind);
    append(collision_entry, &entry, sizeof entry);
  }
  // Last: up to this time the entries are whole.
  std::memcpy(memory_ + offsetof(Header, time_s), &time_s, sizeof time_s);
  close_pages();
}

std::optional<TrialRecord> FlightJournal::flown() const {
  if (memory_ == nullptr || is_of_worker_) return std::nullopt;
  Header header;
  std::memcpy(&header, memory_, sizeof header);
  // The worker's planner may have written anything: sizes are checked before they are used.
  const bool is_sane =
      std::isfinite(header.time_s) && header.time_s >= 0.0 && header.used <= kBytes - sizeof header;
  if (!is_sane) return std::nullopt;
  TrialRecord record;
  record.end_time_s = header.time_s;
  std::span<const std::byte> rest(memory_ + sizeof header, header.used);
  while (rest.size() >= sizeof(EntryHead)) {
    EntryHead head;
    std::memcpy(&head, rest.data(), sizeof head);
    rest = rest.subspan(sizeof head);
    if (head.size > rest.size() || !take(record, head.what, rest.first(head.size))) {
      return std::nullopt;
    }
    rest = rest.subspan(head.size);
  }
  return record;
}

}  // namespace avoidbench
