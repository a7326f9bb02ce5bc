#pragma once

#include <Eigen/Core>
#include <initializer_list>
#include <string>
#include <string_view>

#include "table/table_value.hpp"

namespace avoidbench {

/// A word as a field of a CSV file: in quotes where it needs them (RFC 4180), and where it begins
/// with #, so that no reader takes its line for a comment. A spreadsheet takes a text that begins
/// with = + - @, a tab or CR for a formula, which may do anything; such a text, but no number, gets
/// an apostrophe before it, as OWASP advises. So does one that looks like that with apostrophes
/// already before it, so that text_of_csv_field() gives back every word.
std::string csv_field(std::string_view word);

/// The word that csv_field() made this of, its quotes already taken off.
std::string_view text_of_csv_field(std::string_view field);

/// One line of a CSV file. Every CSV of the program is written by it, so that there is one dialect,
/// RFC 4180's: lines end with CR LF, fields are parted by commas and in quotes only where they need
/// them. Numbers have the fewest digits that read back to the same bits; NaN and nothing are empty
/// fields, infinity is `inf`.
class CsvRow {
 public:
  CsvRow& add(std::string_view word);  ///< as csv_field()
  CsvRow& add(double value) { return add_value(value); }
  CsvRow& add_words(std::initializer_list<std::string_view> words);
  CsvRow& add_value(const TableValue& value) { return add(std::string_view(text_of(value))); }
  CsvRow& add_vector(const double* xyz);  ///< three fields, empty where `xyz` is null
  CsvRow& add(const Eigen::Vector3d& v) { return add_vector(v.data()); }

  /// The row with its end of line, CR LF.
  std::string line() const { return text_ + "\r\n"; }

 private:
  std::string text_;
  bool is_first_ = true;
};

/// The header of columns, their names parted by blanks.
std::string csv_header(std::string_view names);

}  // namespace avoidbench
