#include "plugin/elf_symbols.hpp"

#include <elf.h>

#include <cstdio>
#include <cstring>
#include <optional>

#include "base/input_error.hpp"
#include "base/input_file.hpp"

namespace avoidbench {
namespace {

constexpr std::uint64_t kMostLibraryBytes = 4'000'000'000;  ///< of a library

/// The struct at `offset`, or nothing where the file ends before.
template <class Struct>
std::optional<Struct> struct_at(const std::string& bytes, std::uint64_t offset) {
  // In this order, so that no sum can overflow: offsets come from the file.
  if (offset > bytes.size() || bytes.size() - offset < sizeof(Struct)) return std::nullopt;
  Struct value;
  std::memcpy(&value, bytes.data() + offset, sizeof(Struct));
  return value;
}

/// The text that begins `index` bytes into the string table, or "" outside of it.
std::string text_at(const std::string& bytes, const Elf64_Shdr& table, std::uint64_t index) {
  if (table.sh_offset > bytes.size() || table.sh_size > bytes.size() - table.sh_offset) return "";
  if (index >= table.sh_size) return "";
  const char* begin = bytes.data() + table.sh_offset + index;
  return {begin, strnlen(begin, table.sh_size - index)};
}

/// As the dynamic linker sees it: defined here, neither local nor hidden.
bool is_exported(const Elf64_Sym& symbol) {
  const unsigned binding = ELF64_ST_BIND(symbol.st_info);
  const unsigned visibility = ELF64_ST_VISIBILITY(symbol.st_other);
  const bool seen = visibility == STV_DEFAULT || visibility == STV_PROTECTED;
  return symbol.st_shndx != SHN_UNDEF && binding != STB_LOCAL && seen;
}

/// Calls `visit` with each entry of the sections of this type, and the text that `text_index` says
/// belongs to it. Nothing where the file is no library or is damaged.
template <class Entry, class Visit>
void visit_entries(const std::filesystem::path& file, std::uint32_t type,
                   std::uint64_t (*text_index)(const Entry&), Visit&& visit) {
  if (!shared_library_problem(file).empty()) return;
  const std::string bytes = read_input_file(file, kMostLibraryBytes);
  const auto header = struct_at<Elf64_Ehdr>(bytes, 0);
  if (!header) return;
  const auto section = [&](std::uint64_t index) {
    // A damaged offset may wrap around; what lies outside is refused all the same.
    return struct_at<Elf64_Shdr>(bytes, header->e_shoff + index * sizeof(Elf64_Shdr));
  };
  for (std::uint64_t i = 0; i < header->e_shnum; ++i) {
    const auto entries = section(i);
    // The file is cut off; what was found until here stands.
    if (!entries) break;
    if (entries->sh_type != type) continue;
    const auto strings = section(entries->sh_link);
    if (!strings) break;
    for (std::uint64_t at = 0; at + sizeof(Entry) <= entries->sh_size; at += sizeof(Entry)) {
      const auto entry = struct_at<Entry>(bytes, entries->sh_offset + at);
      if (!entry) break;
      visit(*entry, text_at(bytes, *strings, text_index(*entry)));
    }
  }
}

/// The symbols of the tables of this type, and their names.
template <class Visit>
void visit_symbols(const std::filesystem::path& file, std::uint32_t type, Visit&& visit) {
  visit_entries<Elf64_Sym>(
      file, type, [](const Elf64_Sym& symbol) { return std::uint64_t{symbol.st_name}; }, visit);
}

/// Whether a file's dynamic section has the flag of position-independent programs.
bool says_program(const std::string& bytes, const Elf64_Phdr& dynamic) {
  for (std::uint64_t at = 0; at + sizeof(Elf64_Dyn) <= dynamic.p_filesz; at += sizeof(Elf64_Dyn)) {
    const auto entry = struct_at<Elf64_Dyn>(bytes, dynamic.p_offset + at);
    if (!entry || entry->d_tag == DT_NULL) return false;
    if (entry->d_tag == DT_FLAGS_1) return (entry->d_un.d_val & DF_1_PIE) != 0;
  }
  return false;
}

}  // namespace

std::string shared_library_problem(const std::filesystem::path& file) {
  // The header alone: what is no library may be a huge file of another kind.
  std::string bytes(sizeof(Elf64_Ehdr), '\0');
  try {
    bytes.resize(InputFile(file, kMostLibraryBytes).read(bytes));
  } catch (const InputError& error) {
    return error.problems().front().message;
  }
  if (bytes.size() < SELFMAG || std::memcmp(bytes.data(), ELFMAG, SELFMAG) != 0) {
    return "is not a shared library (no ELF header)";
  }
  const auto header = struct_at<Elf64_Ehdr>(bytes, 0);
  if (!header) return "is not a shared library (the file is cut off)";
  if (header->e_ident[EI_CLASS] != ELFCLASS64 || header->e_machine != EM_X86_64) {
    return "is built for another processor than this x86-64";
  }
  if (header->e_type != ET_DYN) return "is not a shared library (another kind of ELF file)";
  return "";
}

bool is_elf_program(const std::filesystem::path& file) {
  std::string bytes;
  try {
    bytes = InputFile(file, kMostLibraryBytes).read_rest();
  } catch (const InputError&) {
    return false;
  }
  const auto header = struct_at<Elf64_Ehdr>(bytes, 0);
  if (!header || std::memcmp(header->e_ident, ELFMAG, SELFMAG) != 0) return false;
  if (header->e_ident[EI_CLASS] != ELFCLASS64 || header->e_machine != EM_X86_64) return false;
  // Linked to fixed addresses: never a library.
  if (header->e_type == ET_EXEC) return true;
  for (std::uint64_t i = 0; i < header->e_phnum && header->e_type == ET_DYN; ++i) {
    const auto part = struct_at<Elf64_Phdr>(bytes, header->e_phoff + i * sizeof(Elf64_Phdr));
    // Position-independent programs are ET_DYN, as libraries are, but ask for a dynamic linker or,
    // where they are static, say that they are programs.
    if (part && part->p_type == PT_INTERP) return true;
    if (part && part->p_type == PT_DYNAMIC && says_program(bytes, *part)) return true;
  }
  return false;
}

std::vector<std::string> exported_symbols(const std::filesystem::path& file) {
  std::vector<std::string> names;
  visit_symbols(file, SHT_DYNSYM, [&](const Elf64_Sym& symbol, const std::string& name) {
    if (is_exported(symbol)) names.push_back(name);
  });
  return names;
}

std::vector<std::string> imported_symbols(const std::filesystem::path& file) {
  std::vector<std::string> names;
  visit_symbols(file, SHT_DYNSYM, [&](const Elf64_Sym& symbol, const std::string& name) {
    if (symbol.st_shndx == SHN_UNDEF && !name.empty()) names.push_back(name);
  });
  return names;
}

std::vector<std::string> needed_libraries(const std::filesystem::path& file) {
  std::vector<std::string> names;
  visit_entries<Elf64_Dyn>(
      file, SHT_DYNAMIC, [](const Elf64_Dyn& entry) { return std::uint64_t{entry.d_un.d_val}; },
      [&](const Elf64_Dyn& entry, const std::string& name) {
        if (entry.d_tag == DT_NEEDED) names.push_back(name);
      });
  return names;
}

std::string function_at(const std::filesystem::path& file, std::uint64_t address) {
  std::string best;
  std::uint64_t begin = 0;
  const auto look = [&](const Elf64_Sym& symbol, const std::string& name) {
    const bool has_it = ELF64_ST_TYPE(symbol.st_info) == STT_FUNC && symbol.st_shndx != SHN_UNDEF &&
                        symbol.st_value <= address && address - symbol.st_value < symbol.st_size;
    if (!has_it || name.empty()) return;
    // Of several names of one place the first, so that the answer does not depend on their order.
    if (best.empty() || symbol.st_value > begin || (symbol.st_value == begin && name < best)) {
      best = name;
      begin = symbol.st_value;
    }
  };
  // Functions that are not exported stand in this table alone; stripped libraries lack it.
  visit_symbols(file, SHT_SYMTAB, look);
  if (best.empty()) visit_symbols(file, SHT_DYNSYM, look);
  if (best.empty()) return "";
  char offset[32];
  std::snprintf(offset, sizeof offset, "+0x%llx", static_cast<unsigned long long>(address - begin));
  return best + offset;
}

std::uint64_t address_of(const std::filesystem::path& file, std::string_view symbol) {
  std::uint64_t address = 0;
  visit_symbols(file, SHT_DYNSYM, [&](const Elf64_Sym& one, const std::string& name) {
    if (one.st_shndx != SHN_UNDEF && name == symbol) address = one.st_value;
  });
  return address;
}

}  // namespace avoidbench
