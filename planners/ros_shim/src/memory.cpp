#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <new>
#include <string>

// The library's own new, for all code in it: its memory is all zero, as memory is that a process
// gets first. A member that nobody sets must not be what another trial left there. It ends in
// malloc() and free(), as everybody else's does.
namespace {

void* allocated(std::size_t size, std::align_val_t alignment) noexcept {
  const auto bytes = static_cast<std::size_t>(alignment);
  if (bytes <= alignof(std::max_align_t)) return std::calloc(1, size > 0 ? size : 1);
  void* block = nullptr;
  if (::posix_memalign(&block, bytes, size) != 0) return nullptr;
  return std::memset(block, 0, size);
}

void* allocated_or_throw(std::size_t size, std::align_val_t alignment) {
  void* block = allocated(size, alignment);
  if (block == nullptr) throw std::bad_alloc();
  return block;
}

constexpr std::align_val_t kUsual{alignof(std::max_align_t)};

}  // namespace

void* operator new(std::size_t size) { return allocated_or_throw(size, kUsual); }
void* operator new[](std::size_t size) { return allocated_or_throw(size, kUsual); }
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  return allocated(size, kUsual);
}
void* operator new[](std::size_t size, const std::nothrow_t&) noexcept {
  return allocated(size, kUsual);
}
void* operator new(std::size_t size, std::align_val_t alignment) {
  return allocated_or_throw(size, alignment);
}
void* operator new[](std::size_t size, std::align_val_t alignment) {
  return allocated_or_throw(size, alignment);
}
void operator delete(void* block) noexcept { std::free(block); }
void operator delete[](void* block) noexcept { std::free(block); }
void operator delete(void* block, std::size_t) noexcept { std::free(block); }
void operator delete[](void* block, std::size_t) noexcept { std::free(block); }
void operator delete(void* block, const std::nothrow_t&) noexcept { std::free(block); }
void operator delete[](void* block, const std::nothrow_t&) noexcept { std::free(block); }
void operator delete(void* block, std::align_val_t) noexcept { std::free(block); }
void operator delete[](void* block, std::align_val_t) noexcept { std::free(block); }
void operator delete(void* block, std::size_t, std::align_val_t) noexcept { std::free(block); }
void operator delete[](void* block, std::size_t, std::align_val_t) noexcept { std::free(block); }

// Strings of the library's own, too: those of the C++ library get their memory by the host's
// operators, and what is freed in here ends in free(), which sanitizers do not let mix.
template class std::basic_string<char>;
