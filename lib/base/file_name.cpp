#include "base/file_name.hpp"

#include "base/digest.hpp"

namespace avoidbench {

std::string safe_file_name(std::string_view text) {
  // 80 letters, a dash and 8 of the digest: a name made here is kept as it is if it comes again.
  constexpr std::size_t kMostLetters = 100, kMostKept = 80, kDigestLetters = 8;
  const auto is_plain = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
           c == '.' || c == '-';
  };
  std::string name(text);
  for (char& c : name) c = is_plain(c) ? c : '_';
  // Hidden files, and what looks like an option.
  if (name.starts_with('.') || name.starts_with('-')) name.front() = '_';
  const bool is_kept = name == text && !name.empty() && name.size() <= kMostLetters;
  if (is_kept) return name;
  // Texts that become the same name stay apart by their digests.
  const std::string digest = Digest().add_bytes(std::as_bytes(std::span(text))).hex();
  return name.substr(0, kMostKept) + "-" + digest.substr(0, kDigestLetters);
}

}  // namespace avoidbench
