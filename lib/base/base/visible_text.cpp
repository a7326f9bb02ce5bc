#include "base/visible_text.hpp"

#include <algorithm>

#include "base/utf8.hpp"

namespace avoidbench {
namespace {

constexpr std::string_view kHexDigits = "0123456789abcdef";

struct CodeRange {
  char32_t first, last;
};

// C1; marks and isolates of direction (Unicode Annex 9) and its other zero-width formats that
// change what is read; separators of lines; the mark of byte order; interlinear marks; tags.
constexpr CodeRange kHidden[] = {{0x80, 0x9f},     {0x61c, 0x61c},    {0x200e, 0x200f},
                                 {0x2028, 0x202e}, {0x2066, 0x206f},  {0xfeff, 0xfeff},
                                 {0xfff9, 0xfffb}, {0xe0000, 0xe007f}};

std::string in_hex(char32_t value, int digits) {
  std::string text;
  for (int i = digits - 1; i >= 0; --i) {
    text += kHexDigits[(value >> (4U * static_cast<unsigned>(i))) & 15U];
  }
  return text;
}

/// The escape for the character or byte at the start of `text`, or "" where it can be seen.
std::string escape_of(std::string_view text, const Utf8Character& character, bool is_line) {
  if (character.length == 0) return "\\x" + in_hex(byte_at(text, 0), 2);
  const char32_t code = character.code;
  // In a text of several lines these have their meaning.
  if (code == '\n') return is_line ? "\\n" : "";
  if (code == '\t') return is_line ? "\\t" : "";
  // Alone it would let what follows overwrite the line.
  if (code == '\r') return is_line || !text.starts_with("\r\n") ? "\\r" : "";
  if (code < 0x20 || code == 0x7f) return "\\x" + in_hex(code, 2);
  const bool is_hidden = std::any_of(std::begin(kHidden), std::end(kHidden), [&](CodeRange range) {
    return code >= range.first && code <= range.last;
  });
  if (!is_hidden) return "";
  return code > 0xffff ? "\\U" + in_hex(code, 8) : "\\u" + in_hex(code, 4);
}

std::string visible(std::string_view text, bool is_line) {
  std::string shown;
  shown.reserve(text.size());
  while (!text.empty()) {
    const Utf8Character character = first_character(text);
    // A byte that is no UTF-8 is escaped alone, and the next one looked at afresh.
    const std::size_t length = std::max<std::size_t>(character.length, 1);
    const std::string escape = escape_of(text, character, is_line);
    if (escape.empty()) {
      shown += text.substr(0, length);
    } else {
      shown += escape;
    }
    text.remove_prefix(length);
  }
  return shown;
}

}  // namespace

std::string visible_text(std::string_view text) { return visible(text, false); }

std::string visible_line(std::string_view text) { return visible(text, true); }

/// For texts that come in pieces: what is cut off at the end waits for the next piece.
std::size_t unfinished_bytes(std::string_view text) {
  // A newline may follow.
  if (text.ends_with('\r')) return 1;
  // A character has four bytes at most: its first is among the last three, or it is whole.
  for (std::size_t back = 1; back <= std::min<std::size_t>(3, text.size()); ++back) {
    const unsigned char byte = byte_at(text, text.size() - back);
    if ((byte & 0xc0U) == 0x80U) continue;  // goes on with a character
    return utf8_length(byte) > back ? back : 0;
  }
  return 0;
}

}  // namespace avoidbench
