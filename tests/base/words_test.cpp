#include "base/words.hpp"

#include <gtest/gtest.h>

#include <array>
#include <utility>
#include <vector>

namespace avoidbench {
namespace {

TEST(Words, AreJoinedBetweenThem) {
  EXPECT_EQ(joined(std::vector<std::string>{}), "");
  EXPECT_EQ(joined(std::vector<std::string>{"a"}), "a");
  EXPECT_EQ(joined(std::vector<std::string>{"a", "b", "c"}), "a, b, c");
  EXPECT_EQ(joined(std::vector<std::string>{"", "b"}, " or "), " or b");
}

TEST(Words, SignsAreReplacedTheFirstOfTheListFirst) {
  using Sign = std::pair<std::string_view, std::string_view>;
  const std::array<Sign, 3> signs{Sign{"<=", "≤"}, Sign{"<", "&lt;"}, Sign{"é", ""}};
  EXPECT_EQ(replaced("a <= b < c", signs), "a ≤ b &lt; c");
  EXPECT_EQ(replaced("<<=", signs), "&lt;≤");
  EXPECT_EQ(replaced("né ü", signs), "n ü");
  EXPECT_EQ(replaced("", signs), "");
}

TEST(Words, ContainIsOfWholeWords) {
  const std::vector<std::string> words{"one", "two"};
  EXPECT_TRUE(contains(words, "one"));
  EXPECT_TRUE(contains(words, "two"));
  EXPECT_FALSE(contains(words, "tw"));
  EXPECT_FALSE(contains(words, ""));
}

TEST(Words, CountsHaveTheirPlural) {
  EXPECT_EQ(counted(std::int64_t{1}, "trial"), "1 trial");
  EXPECT_EQ(counted(std::int64_t{0}, "trial"), "0 trials");
  EXPECT_EQ(counted(std::size_t{2}, "trial"), "2 trials");
  EXPECT_EQ(counted(std::int64_t{-1}, "trial"), "-1 trials");
}

}  // namespace
}  // namespace avoidbench
