#include "table/csv.hpp"

#include <algorithm>
#include <cmath>

#include "base/number_text.hpp"

namespace avoidbench {
namespace {

/// A sign before a number is no formula: -3 stays a number.
bool is_number(std::string_view word) {
  if (word.starts_with('+') && !word.starts_with("+-")) word.remove_prefix(1);
  return number_from<double>(word).has_value();
}

/// Whether a spreadsheet would take the word, or what follows its apostrophes, for a formula.
bool may_be_formula(std::string_view word) {
  // Apostrophes of the text itself get one more, so that taking one off gives the text back.
  const std::size_t start = word.find_first_not_of('\'');
  if (start == std::string_view::npos) return false;
  word.remove_prefix(start);
  return std::string_view("=+-@\t\r").find(word.front()) != std::string_view::npos &&
         !is_number(word);
}

}  // namespace

std::string csv_field(std::string_view word) {
  const std::string mark = may_be_formula(word) ? "'" : "";
  // RFC 4180: quotes around what has a comma, a quote or a line's end; quotes within are doubled.
  // And around what begins with #: at the beginning of a line it would be taken for a comment.
  const bool is_bare =
      word.find_first_of(",\"\r\n") == std::string_view::npos && !word.starts_with('#');
  if (is_bare) return mark + std::string(word);
  std::string quoted = "\"" + mark;
  for (const char c : word) {
    if (c == '"') quoted += '"';
    quoted += c;
  }
  return quoted + "\"";
}

std::string_view text_of_csv_field(std::string_view field) {
  const bool is_marked = field.starts_with('\'') && may_be_formula(field);
  return is_marked ? field.substr(1) : field;
}

CsvRow& CsvRow::add(std::string_view word) {
  if (!is_first_) text_ += ',';
  is_first_ = false;
  text_ += csv_field(word);
  return *this;
}

CsvRow& CsvRow::add_words(std::initializer_list<std::string_view> words) {
  for (const std::string_view word : words) add(word);
  return *this;
}

CsvRow& CsvRow::add_vector(const double* xyz) {
  // Three empty fields for no vector, so that the columns stay.
  for (int i = 0; i < 3; ++i) add(xyz == nullptr ? std::nan("") : xyz[i]);
  return *this;
}

std::string csv_header(std::string_view names) {
  std::string header(names);
  std::replace(header.begin(), header.end(), ' ', ',');
  return header + "\r\n";
}

}  // namespace avoidbench
