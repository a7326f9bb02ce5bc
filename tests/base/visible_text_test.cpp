#include "base/visible_text.hpp"

#include <gtest/gtest.h>

#include "base/random.hpp"
#include "base/utf8.hpp"

namespace avoidbench {
namespace {

TEST(VisibleText, LeavesWhatCanBeSeen) {
  for (const std::string& text :
       {std::string("plain ASCII ~"), std::string("Größe – µ² ∫ 飛行 🚁"),
        std::string("a\nb\tc\r\nd"), std::string("schon \\x1b entschärft"), std::string("e\u0301"),
        std::string()}) {
    EXPECT_EQ(visible_text(text), text);
  }
}

TEST(VisibleText, ShowsWhatATerminalWouldObey) {
  EXPECT_EQ(visible_text("\033[2J\033]0;title\a"), "\\x1b[2J\\x1b]0;title\\x07");
  EXPECT_EQ(visible_text("a\bb\x7f"), "a\\x08b\\x7f");
  EXPECT_EQ(visible_text("over\rwritten"), "over\\rwritten");
  EXPECT_EQ(visible_text(std::string("nul\0!", 5)), "nul\\x00!");
  EXPECT_EQ(visible_text("\u009b2J"), "\\u009b2J");  // C1: a control sequence too
  EXPECT_EQ(visible_text("\x9b"
                         "2J"),
            "\\x9b2J");  // and as one byte
  EXPECT_EQ(visible_text("safe\u202egnp.exe"), "safe\\u202egnp.exe");
  EXPECT_EQ(visible_text("\u2066x\u2069 \u200f \u061c"), "\\u2066x\\u2069 \\u200f \\u061c");
  EXPECT_EQ(visible_text("a\u2028b\ufeff"), "a\\u2028b\\ufeff");
  EXPECT_EQ(visible_text("\U000e0041"), "\\U000e0041");
}

TEST(VisibleText, ShowsBytesThatAreNoUtf8) {
  EXPECT_EQ(visible_text("\xff"), "\\xff");
  EXPECT_EQ(visible_text("\xc3("), "\\xc3(");                           // begun and not ended
  EXPECT_EQ(visible_text("\xc0\x9b"), "\\xc0\\x9b");                    // overlong
  EXPECT_EQ(visible_text("\xe0\x82\x9b"), "\\xe0\\x82\\x9b");           // overlong
  EXPECT_EQ(visible_text("\xed\xa0\x80"), "\\xed\\xa0\\x80");           // half of a surrogate pair
  EXPECT_EQ(visible_text("\xf4\x90\x80\x80"), "\\xf4\\x90\\x80\\x80");  // above U+10FFFF
  EXPECT_EQ(visible_text("ü\xc3"), "ü\\xc3");
}

TEST(VisibleText, LinesStayOne) {
  EXPECT_EQ(visible_line("ok\nwarning: none\r\n\t"), "ok\\nwarning: none\\r\\n\\t");
  EXPECT_EQ(visible_line("ü"), "ü");
}

/// Whatever comes in: what goes out is seen, and stays as it is when it goes through again.
TEST(VisibleText, RandomBytesBecomeVisible) {
  RandomStream random = stream(1, "visible text");
  for (int round = 0; round < 5000; ++round) {
    std::string bytes(random.below(40), '\0');
    for (char& c : bytes) c = static_cast<char>(random.below(256));
    const std::string text = visible_text(bytes), line = visible_line(bytes);
    EXPECT_EQ(visible_text(text), text);
    EXPECT_EQ(visible_line(line), line);
    for (const char c : line) {
      const auto byte = static_cast<unsigned char>(c);
      ASSERT_TRUE(byte >= 0x20 && byte != 0x7f);
    }
  }
}

TEST(VisibleText, FindsWhatIsNotFinished) {
  EXPECT_EQ(unfinished_bytes(""), 0U);
  EXPECT_EQ(unfinished_bytes("abc"), 0U);
  EXPECT_EQ(unfinished_bytes("ü"), 0U);
  EXPECT_EQ(unfinished_bytes("a\xc3"), 1U);
  EXPECT_EQ(unfinished_bytes("\xe2\x80"), 2U);
  EXPECT_EQ(unfinished_bytes("\xf0\x9f\x9a"), 3U);
  EXPECT_EQ(unfinished_bytes("🚁"), 0U);
  EXPECT_EQ(unfinished_bytes("\x80\x80\x80\x80"), 0U);  // no UTF-8 whatever follows
  EXPECT_EQ(unfinished_bytes("line\r"), 1U);
}

TEST(Shortened, KeepsWholeCharactersAndSaysHowLongItWas) {
  EXPECT_EQ(shortened("abc", 3), "abc");
  EXPECT_EQ(shortened("abcd", 3), "abc… (4 bytes)");
  EXPECT_EQ(shortened("aü", 2), "a… (3 bytes)");
  EXPECT_EQ(shortened("", 0), "");
}

}  // namespace
}  // namespace avoidbench
