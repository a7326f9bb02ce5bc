#include "conformance/shifted_clock.hpp"

#include <dlfcn.h>
#include <elf.h>
#include <link.h>
#include <sys/mman.h>
#include <sys/time.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <ctime>
#include <string_view>
#include <vector>

namespace avoidbench {
namespace {

std::atomic<std::int64_t> looks{0};

/// Where each function was called from first.
enum Clock { kGetTime, kTimeOfDay, kTime, kCpuClock, kTimespec, kSteady, kSystem, kClockCount };
std::atomic<void*> callers[kClockCount];

/// Seconds that have gone by for the library beyond the clock's own.
std::int64_t seconds_gone(Clock clock, void* caller) {
  void* none = nullptr;
  callers[clock].compare_exchange_strong(none, caller);
  return ++looks;
}

// The library calls these in place of the functions that they are named after.

int shifted_clock_gettime(clockid_t clock, timespec* time) {
  const int status = ::clock_gettime(clock, time);
  if (status == 0) time->tv_sec += seconds_gone(kGetTime, __builtin_return_address(0));
  return status;
}

int shifted_gettimeofday(timeval* time, void* zone) {
  const int status = ::gettimeofday(time, zone);
  if (status == 0 && time != nullptr)
    time->tv_sec += seconds_gone(kTimeOfDay, __builtin_return_address(0));
  return status;
}

std::time_t shifted_time(std::time_t* time) {
  const std::time_t now = std::time(nullptr) + seconds_gone(kTime, __builtin_return_address(0));
  if (time != nullptr) *time = now;
  return now;
}

std::clock_t shifted_clock() {
  return std::clock() + seconds_gone(kCpuClock, __builtin_return_address(0)) * CLOCKS_PER_SEC;
}

int shifted_timespec_get(timespec* time, int base) {
  const int status = std::timespec_get(time, base);
  if (status == base) time->tv_sec += seconds_gone(kTimespec, __builtin_return_address(0));
  return status;
}

std::chrono::steady_clock::time_point shifted_steady_now() {
  return std::chrono::steady_clock::now() +
         std::chrono::seconds(seconds_gone(kSteady, __builtin_return_address(0)));
}

std::chrono::system_clock::time_point shifted_system_now() {
  return std::chrono::system_clock::now() +
         std::chrono::seconds(seconds_gone(kSystem, __builtin_return_address(0)));
}

struct Hook {
  std::string_view symbol;
  const char* name;  ///< for people
  void* function;
};

const Hook kHooks[kClockCount] = {
    {"clock_gettime", "clock_gettime", reinterpret_cast<void*>(&shifted_clock_gettime)},
    {"gettimeofday", "gettimeofday", reinterpret_cast<void*>(&shifted_gettimeofday)},
    {"time", "time", reinterpret_cast<void*>(&shifted_time)},
    {"clock", "clock", reinterpret_cast<void*>(&shifted_clock)},
    {"timespec_get", "timespec_get", reinterpret_cast<void*>(&shifted_timespec_get)},
    {"_ZNSt6chrono3_V212steady_clock3nowEv", "steady_clock::now",
     reinterpret_cast<void*>(&shifted_steady_now)},
    {"_ZNSt6chrono3_V212system_clock3nowEv", "system_clock::now",
     reinterpret_cast<void*>(&shifted_system_now)},
};

/// What a loaded library's dynamic section says, as addresses.
struct Tables {
  const Elf64_Sym* symbols = nullptr;
  const char* strings = nullptr;
  const Elf64_Rela* relocations = nullptr;
  std::size_t relocations_size = 0;
  const Elf64_Rela* jumps = nullptr;
  std::size_t jumps_size = 0;
  std::vector<std::uint64_t> needed;  ///< offsets into the strings
};

Tables tables_of(const link_map& library) {
  Tables tables;
  for (const Elf64_Dyn* entry = library.l_ld; entry->d_tag != DT_NULL; ++entry) {
    // NOLINTNEXTLINE(performance-no-int-to-ptr): the linker has made addresses of these
    const auto* const address = reinterpret_cast<const void*>(entry->d_un.d_ptr);
    switch (entry->d_tag) {
      case DT_SYMTAB:
        tables.symbols = static_cast<const Elf64_Sym*>(address);
        break;
      case DT_STRTAB:
        tables.strings = static_cast<const char*>(address);
        break;
      case DT_RELA:
        tables.relocations = static_cast<const Elf64_Rela*>(address);
        break;
      case DT_RELASZ:
        tables.relocations_size = entry->d_un.d_val;
        break;
      case DT_JMPREL:
        tables.jumps = static_cast<const Elf64_Rela*>(address);
        break;
      case DT_PLTRELSZ:
        tables.jumps_size = entry->d_un.d_val;
        break;
      case DT_NEEDED:
        tables.needed.push_back(entry->d_un.d_val);
        break;
      default:
        break;
    }
  }
  return tables;
}

void write_pointer(std::uint64_t address, void* value) {
  const auto page = static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
  // NOLINTNEXTLINE(performance-no-int-to-ptr)
  void* const begin = reinterpret_cast<void*>(address / page * page);
  // Read-only since the library was linked (RELRO). A pointer lies in one page: it is aligned.
  if (::mprotect(begin, page, PROT_READ | PROT_WRITE) != 0) return;
  // NOLINTNEXTLINE(performance-no-int-to-ptr)
  *reinterpret_cast<void**>(address) = value;
}

void redirect(const link_map& library, const Tables& tables, const Elf64_Rela* relocations,
              std::size_t size) {
  for (const Elf64_Rela* entry = relocations; entry != relocations + size / sizeof *entry;
       ++entry) {
    const auto type = ELF64_R_TYPE(entry->r_info);
    // A call through the table of jumps, a call without it, and an address in data.
    if (type != R_X86_64_JUMP_SLOT && type != R_X86_64_GLOB_DAT && type != R_X86_64_64) continue;
    const Elf64_Sym& symbol = tables.symbols[ELF64_R_SYM(entry->r_info)];
    const std::string_view name = tables.strings + symbol.st_name;
    // A library that brings its own clock (statically linked) reaches the C library's below it.
    if (symbol.st_shndx != SHN_UNDEF) continue;
    const auto* const hook = std::find_if(std::begin(kHooks), std::end(kHooks),
                                          [&](const Hook& one) { return one.symbol == name; });
    if (hook != std::end(kHooks)) write_pointer(library.l_addr + entry->r_offset, hook->function);
  }
}

std::string_view file_name(std::string_view path) { return path.substr(path.rfind('/') + 1); }

/// What every program has: its time is the host's, too.
bool is_runtime(std::string_view name) {
  constexpr std::string_view kRuntimes[] = {"libc.so",   "libm.so",       "libstdc++.so",
                                            "libgcc_s.", "libpthread.so", "libdl.so",
                                            "librt.so",  "ld-linux",      "libc++"};
  return std::any_of(std::begin(kRuntimes), std::end(kRuntimes),
                     [&](std::string_view runtime) { return name.starts_with(runtime); });
}

const link_map* loaded_as(const link_map* any, std::string_view name) {
  while (any->l_prev != nullptr) any = any->l_prev;
  for (; any != nullptr; any = any->l_next) {
    if (file_name(any->l_name) == name) return any;
  }
  return nullptr;
}

}  // namespace

bool shift_clocks(const std::filesystem::path& file) {
  const std::string path = std::filesystem::absolute(file).string();
  void* const handle = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL | RTLD_NOLOAD);
  link_map* library = nullptr;
  if (handle == nullptr || dlinfo(handle, RTLD_DI_LINKMAP, &library) != 0) return false;
  std::vector<const link_map*> found{library};
  for (std::size_t i = 0; i < found.size(); ++i) {
    const Tables tables = tables_of(*found[i]);
    redirect(*found[i], tables, tables.relocations, tables.relocations_size);
    redirect(*found[i], tables, tables.jumps, tables.jumps_size);
    for (const std::uint64_t offset : tables.needed) {
      const std::string_view name = tables.strings + offset;
      const link_map* const needed = is_runtime(name) ? nullptr : loaded_as(library, name);
      const bool is_new = std::find(found.begin(), found.end(), needed) == found.end();
      if (needed != nullptr && is_new) found.push_back(needed);
    }
  }
  return true;
}

std::string clocks_looked_at() {
  std::string text;
  for (std::size_t i = 0; i < kClockCount; ++i) {
    void* const caller = callers[i];
    if (caller == nullptr) continue;
    Dl_info where{};
    const bool is_known = dladdr(caller, &where) != 0 && where.dli_fname != nullptr;
    text += (text.empty() ? "" : ", ") + std::string(kHooks[i].name);
    if (is_known) text += " (" + std::string(file_name(where.dli_fname)) + ")";
  }
  return text;
}

}  // namespace avoidbench
