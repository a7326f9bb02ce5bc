#include "base/utf8.hpp"

#include <gtest/gtest.h>

#include "base/input_error.hpp"

namespace avoidbench {
namespace {

std::pair<char32_t, std::size_t> first_of(std::string_view text) {
  const Utf8Character character = first_character(text);
  return {character.code, character.length};
}

TEST(Utf8, FirstCharactersOfEachLengthToTheirBounds) {
  const auto found = [](char32_t code, std::size_t length) { return std::pair(code, length); };
  EXPECT_EQ(first_of("ab"), found('a', 1));
  EXPECT_EQ(first_of("\x7f"), found(0x7f, 1));
  EXPECT_EQ(first_of("\xc2\x80z"), found(0x80, 2));
  EXPECT_EQ(first_of("\xdf\xbf"), found(0x7ff, 2));
  EXPECT_EQ(first_of("\xe0\xa0\x80"), found(0x800, 3));
  EXPECT_EQ(first_of("\xed\x9f\xbf"), found(0xd7ff, 3));
  EXPECT_EQ(first_of("\xee\x80\x80"), found(0xe000, 3));
  EXPECT_EQ(first_of("\xef\xbf\xbf"), found(0xffff, 3));
  EXPECT_EQ(first_of("\xf0\x90\x80\x80"), found(0x10000, 4));
  EXPECT_EQ(first_of("\xf4\x8f\xbf\xbf"), found(0x10ffff, 4));
}

TEST(Utf8, WhatIsNoCharacterHasNoLength) {
  for (const char* bad :
       {"\x80", "\xbf", "\xc0\x80", "\xc1\xbf", "\xe0\x9f\xbf", "\xed\xa0\x80", "\xed\xbf\xbf",
        "\xf0\x8f\xbf\xbf", "\xf4\x90\x80\x80", "\xf5\x80\x80\x80", "\xff\xbf\xbf\xbf", "\xc3",
        "\xe2\x82", "\xf0\x9f\x98", "\xc3(", "\xe2\x82(", "\xe2(\xac"}) {
    EXPECT_EQ(first_character(bad).length, 0U) << bad;
  }
}

TEST(Utf8, ABadByteIsNamedAtItsPlace) {
  check_utf8("a é €\n😀\n", "good.yaml");
  try {
    check_utf8("é: 1\nname: M\xfcller\n", "bad.yaml");
    FAIL() << "nothing was thrown";
  } catch (const InputError& error) {
    const std::string message = error.what();
    EXPECT_EQ(message.find("bad.yaml:2:8: byte 0xfc is not UTF-8"), 0U) << message;
  }
}

}  // namespace
}  // namespace avoidbench
