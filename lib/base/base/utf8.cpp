#include "base/utf8.hpp"

#include <array>

#include "base/input_error.hpp"

namespace avoidbench {
namespace {

std::string in_hex(unsigned char byte) {
  constexpr std::string_view kDigits = "0123456789abcdef";
  return {kDigits[byte >> 4U], kDigits[byte & 15U]};
}

/// What the byte is in Latin-1, the usual reason: "ü in Latin-1".
std::string latin_1_text(unsigned char byte) {
  if (byte < 0xa0) return "";
  // Latin-1's numbers are Unicode's: two bytes of UTF-8.
  const std::string utf8{static_cast<char>(0xc0U | (byte >> 6U)),
                         static_cast<char>(0x80U | (byte & 0x3fU))};
  return ", " + utf8 + " in Latin-1";
}

}  // namespace

/// 0xc0, 0xc1 and what is above 0xf4 begin no character: they would be overlong or above U+10FFFF.
std::size_t utf8_length(unsigned char first) {
  if (first < 0x80) return 1;
  if (first >= 0xc2 && first <= 0xdf) return 2;
  if (first >= 0xe0 && first <= 0xef) return 3;
  return first >= 0xf0 && first <= 0xf4 ? 4 : 0;
}

Utf8Character first_character(std::string_view text) {
  // Of each length: what a shorter form could say is refused, as UTF-8 demands.
  constexpr std::array<char32_t, 5> kLeast{0, 0, 0x80, 0x800, 0x10000};
  const unsigned char first = byte_at(text, 0);
  const std::size_t length = utf8_length(first);
  if (length == 0 || length > text.size()) return {};
  if (length == 1) return {first, 1};
  // The leading byte's lower bits: 5, 4 or 3 of them.
  char32_t code = first & (0xffU >> (length + 1));
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte_at(text, i) & 0xc0U) != 0x80U) return {};
    code = (code << 6U) | (byte_at(text, i) & 0x3fU);
  }
  const bool is_surrogate = code >= 0xd800 && code <= 0xdfff;
  if (code < kLeast[length] || code > 0x10ffff || is_surrogate) return {};
  return {code, length};
}

std::string shortened(std::string_view text, std::size_t most_bytes) {
  if (text.size() <= most_bytes) return std::string(text);
  std::size_t end = most_bytes;
  const auto is_within = [&text](std::size_t at) { return (byte_at(text, at) & 0xC0U) == 0x80U; };
  // Three at most: longer ones are no character, and cut as they are.
  for (int i = 0; i < 3 && end > 0 && is_within(end); ++i) --end;
  return std::string(text.substr(0, end)) + "… (" + std::to_string(text.size()) + " bytes)";
}

void check_utf8(std::string_view text, const std::string& file) {
  int line = 1, column = 1;
  while (!text.empty()) {
    const Utf8Character character = first_character(text);
    if (character.length == 0) {
      const unsigned char byte = byte_at(text, 0);
      throw InputError(InputProblem{file, line, column,
                                    "byte 0x" + in_hex(byte) + " is not UTF-8" +
                                        latin_1_text(byte) + ": save the file as UTF-8"});
    }
    // Columns count characters.
    column = character.code == '\n' ? 1 : column + 1;
    line += character.code == '\n' ? 1 : 0;
    text.remove_prefix(character.length);
  }
}

}  // namespace avoidbench
