#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace avoidbench {

inline unsigned char byte_at(std::string_view text, std::size_t at) {
  return static_cast<unsigned char>(text[at]);
}

/// Bytes of the character that begins with `first`; 0 where none does.
std::size_t utf8_length(unsigned char first);

/// A character of UTF-8.
struct Utf8Character {
  char32_t code = 0;
  std::size_t length = 0;  ///< bytes; 0: what begins there is no UTF-8
};

/// The character at the start of `text`, which is not empty.
Utf8Character first_character(std::string_view text);

/// At most so many bytes of the text, without the beginning of a character at their end; of a
/// longer text also how long it was.
std::string shortened(std::string_view text, std::size_t most_bytes);

/// Throws InputError with line and column of the first byte that is no UTF-8. What a person writes
/// is checked as it is read: further on, in JSON and in databases, nobody knows its place any more.
void check_utf8(std::string_view text, const std::string& file);

}  // namespace avoidbench
