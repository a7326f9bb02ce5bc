#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace avoidbench {

/// The fields of a text after RFC 4180, section 2; fails the test where it breaks a rule.
inline std::vector<std::vector<std::string>> parsed_csv(const std::string& text) {
  std::vector<std::vector<std::string>> rows(1, std::vector<std::string>(1));
  bool is_quoted = false, was_quoted = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    std::string& field = rows.back().back();
    const char c = text[i];
    if (is_quoted) {
      if (c != '"') {
        field += c;
      } else if (i + 1 < text.size() && text[i + 1] == '"') {
        field += text[++i];
      } else {
        is_quoted = false;
        was_quoted = true;
      }
    } else if (c == ',') {
      rows.back().emplace_back();
      was_quoted = false;
    } else if (c == '\r') {
      EXPECT_EQ(text.at(++i), '\n');
      rows.emplace_back(1);
      was_quoted = false;
    } else if (c == '"') {
      EXPECT_TRUE(field.empty() && !was_quoted);
      is_quoted = true;
    } else {
      EXPECT_NE(c, '\n');
      EXPECT_FALSE(was_quoted);
      field += c;
    }
  }
  EXPECT_FALSE(is_quoted);
  EXPECT_EQ(rows.back(), std::vector<std::string>(1)) << "the last line has no end";
  rows.pop_back();
  for (const auto& row : rows) EXPECT_EQ(row.size(), rows.front().size());
  return rows;
}

}  // namespace avoidbench
