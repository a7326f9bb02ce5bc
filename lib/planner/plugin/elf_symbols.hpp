#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace avoidbench {

/// Why `file` is no shared library of this machine, e.g. "is not a shared library (no ELF header)";
/// empty when it is one.
std::string shared_library_problem(const std::filesystem::path& file);

/// Whether `file` is an ELF program of this machine, to be started rather than loaded: one that the
/// system's linker has to prepare, or one that is bound to its addresses.
bool is_elf_program(const std::filesystem::path& file);

/// Names of the symbols that the shared library at `file` defines for others, in the order of its
/// dynamic symbol table. Empty when the file has no such table or is damaged: read as data, never
/// loaded.
std::vector<std::string> exported_symbols(const std::filesystem::path& file);

/// Names of the symbols that it takes from others, in the same order; empty as above.
std::vector<std::string> imported_symbols(const std::filesystem::path& file);

/// The libraries that it names as needed (DT_NEEDED), such as "libnlopt.so.0"; empty as above.
std::vector<std::string> needed_libraries(const std::filesystem::path& file);

/// The function of the library at `file` that has this address, relative to where the library is
/// loaded, as "mangled_name+0x1b"; also of functions that it keeps to itself. "" where the file
/// says nothing of it (stripped) or is damaged.
std::string function_at(const std::filesystem::path& file, std::uint64_t address);

/// The address of what the library at `file` defines for others by this mangled name, relative to
/// where the library is loaded; 0 where there is none.
std::uint64_t address_of(const std::filesystem::path& file, std::string_view symbol);

}  // namespace avoidbench
