#include "rewind.hpp"

#include <link.h>
#include <unistd.h>

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <new>
#include <string>

namespace ros_shim {

// Not of an unnamed namespace, since the operators below are outside of this one.
void* allocated(std::size_t size, std::size_t alignment);
void* allocated_or_throw(std::size_t size, std::size_t alignment);
void release(void* block);

namespace {

/// The blocks that a run ahead makes and frees. It lives on the heap of malloc(), so that what is
/// put back does not reach it.
struct Ledger {
  void** made = nullptr;
  std::size_t made_count = 0, made_room = 0;
  int pauses = 0;  ///< while the runtime itself makes and frees
};
Ledger* ledger = nullptr;

void note_made(void* block) {
  Ledger& book = *ledger;
  if (book.made_count == book.made_room) {
    book.made_room = std::max<std::size_t>(1024, 2 * book.made_room);
    void* larger = std::realloc(book.made, book.made_room * sizeof(void*));
    if (larger == nullptr) throw std::bad_alloc();
    book.made = static_cast<void**>(larger);
  }
  book.made[book.made_count++] = block;
}

/// Whether the block is of the run ahead, which then forgets it.
bool forget_made(void* block) {
  Ledger& book = *ledger;
  // From the back: most blocks are freed soon.
  for (std::size_t i = book.made_count; i-- > 0;) {
    if (book.made[i] != block) continue;
    book.made[i] = book.made[--book.made_count];
    return true;
  }
  return false;
}

/// memcpy() of memory that sanitizers guard: between variables, and below them on a stack.
void copy_raw(char* to, const char* from, std::size_t size) {
#if defined(__x86_64__)
  asm volatile("rep movsb" : "+D"(to), "+S"(from), "+c"(size) : : "memory");
#else
  std::memcpy(to, from, size);
#endif
}

struct Segment {
  char* from;
  std::size_t size;
};

/// The writable memory of the library that `inside` lies in, without what the loader makes
/// read-only.
std::vector<Segment> static_storage(const void* inside) {
  struct Search {
    std::uintptr_t inside;
    std::vector<Segment> found;
  } search{reinterpret_cast<std::uintptr_t>(inside), {}};
  const auto visit = [](dl_phdr_info* info, std::size_t, void* data) -> int {
    Search& wanted = *static_cast<Search*>(data);
    bool is_it = false;
    std::uintptr_t relro_end = 0;
    for (int i = 0; i < info->dlpi_phnum; ++i) {
      const ElfW(Phdr)& header = info->dlpi_phdr[i];
      const std::uintptr_t from = info->dlpi_addr + header.p_vaddr;
      if (header.p_type == PT_LOAD && wanted.inside >= from &&
          wanted.inside < from + header.p_memsz) {
        is_it = true;
      }
      if (header.p_type == PT_GNU_RELRO) relro_end = from + header.p_memsz;
    }
    if (!is_it) return 0;
    const auto page = static_cast<std::uintptr_t>(::sysconf(_SC_PAGESIZE));
    relro_end = relro_end / page * page;  // the loader protects whole pages
    for (int i = 0; i < info->dlpi_phnum; ++i) {
      const ElfW(Phdr)& header = info->dlpi_phdr[i];
      if (header.p_type != PT_LOAD || (header.p_flags & PF_W) == 0) continue;
      std::uintptr_t from = info->dlpi_addr + header.p_vaddr;
      const std::uintptr_t end = from + header.p_memsz;
      if (relro_end > from && relro_end <= end) from = relro_end;
      wanted.found.push_back({reinterpret_cast<char*>(from), end - from});
    }
    return 1;
  };
  ::dl_iterate_phdr(visit, &search);
  return search.found;
}

}  // namespace

/// All zero, as memory is that a process gets first: a member that nobody sets must not be what
/// another trial left there.
void* allocated(std::size_t size, std::size_t alignment) {
  void* block = nullptr;
  if (alignment <= alignof(std::max_align_t)) {
    block = std::calloc(1, size > 0 ? size : 1);
  } else if (::posix_memalign(&block, alignment, size) != 0) {
    block = nullptr;
  } else {
    std::memset(block, 0, size);
  }
  if (block != nullptr && ledger != nullptr && ledger->pauses == 0) note_made(block);
  return block;
}

void* allocated_or_throw(std::size_t size, std::size_t alignment) {
  void* block = allocated(size, alignment);
  if (block == nullptr) throw std::bad_alloc();
  return block;
}

/// Of a run ahead only its own blocks go: what is put back may point at the others.
void release(void* block) {
  if (block == nullptr) return;
  if (ledger == nullptr || forget_made(block) || ledger->pauses > 0) std::free(block);
}

Rewind::Rewind(Node& node)
    : node_(node),
      context_(node.fibre->context()),
      now_ns_(core().now_ns),
      wake_ns_(node.wake_ns),
      polled_ns_(node.polled_ns),
      takes_callbacks_(node.takes_callbacks),
      polls_(node.polls),
      next_order_(core().next_order),
      queue_(node.queue),
      timers_(core().timers) {
  for (const Segment& segment : static_storage(&ledger)) keep(segment.from, segment.size);
  const auto stack = node.fibre->used_stack();
  keep(stack.first, stack.second);
  // After the copies, in which it is null.
  void* memory = std::malloc(sizeof(Ledger));
  if (memory == nullptr) throw std::bad_alloc();
  ledger = new (memory) Ledger();
}

void Rewind::keep(char* at, std::size_t size) {
  pieces_.push_back({at, std::vector<char>(size)});
  copy_raw(pieces_.back().bytes.data(), at, size);
}

Rewind::~Rewind() {
  Core& core = ros_shim::core();
  Ledger* const book = ledger;
  ++book->pauses;
  // What the node put into the simulation goes first, while what it belongs to is alive.
  node_.queue = std::move(queue_);
  core.timers = std::move(timers_);
  ledger = nullptr;
  for (const Piece& piece : pieces_) copy_raw(piece.at, piece.bytes.data(), piece.bytes.size());
  for (std::size_t i = 0; i < book->made_count; ++i) std::free(book->made[i]);
  std::free(book->made);
  std::free(book);
  node_.fibre->set_context(context_);
  core.now_ns = now_ns_;
  core.next_order = next_order_;
  node_.wake_ns = wake_ns_;
  node_.polled_ns = polled_ns_;
  node_.takes_callbacks = takes_callbacks_;
  node_.polls = polls_;
}

LedgerPause::LedgerPause() : is_on_(ledger != nullptr) {
  if (is_on_) ++ledger->pauses;
}

LedgerPause::~LedgerPause() {
  if (is_on_) --ledger->pauses;
}

}  // namespace ros_shim

// The library's own, for all code in it: they end in malloc() and free(), as everybody else's do.
namespace shim = ros_shim;
constexpr std::size_t kUsual = alignof(std::max_align_t);
static std::size_t bytes_of(std::align_val_t alignment) {
  return static_cast<std::size_t>(alignment);
}

void* operator new(std::size_t size) { return shim::allocated_or_throw(size, kUsual); }
void* operator new[](std::size_t size) { return shim::allocated_or_throw(size, kUsual); }
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  return shim::allocated(size, kUsual);
}
void* operator new[](std::size_t size, const std::nothrow_t&) noexcept {
  return shim::allocated(size, kUsual);
}
void* operator new(std::size_t size, std::align_val_t alignment) {
  return shim::allocated_or_throw(size, bytes_of(alignment));
}
void* operator new[](std::size_t size, std::align_val_t alignment) {
  return shim::allocated_or_throw(size, bytes_of(alignment));
}
void operator delete(void* block) noexcept { shim::release(block); }
void operator delete[](void* block) noexcept { shim::release(block); }
void operator delete(void* block, std::size_t) noexcept { shim::release(block); }
void operator delete[](void* block, std::size_t) noexcept { shim::release(block); }
void operator delete(void* block, const std::nothrow_t&) noexcept { shim::release(block); }
void operator delete[](void* block, const std::nothrow_t&) noexcept { shim::release(block); }
void operator delete(void* block, std::align_val_t) noexcept { shim::release(block); }
void operator delete[](void* block, std::align_val_t) noexcept { shim::release(block); }
void operator delete(void* block, std::size_t, std::align_val_t) noexcept { shim::release(block); }
void operator delete[](void* block, std::size_t, std::align_val_t) noexcept {
  shim::release(block);
}

// The library's own too: that of the C++ library gets and frees with the operators of the host, and
// a string that grew during a run ahead would be put back to memory that is gone.
template class std::basic_string<char>;
