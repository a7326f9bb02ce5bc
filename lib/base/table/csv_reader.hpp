#pragma once

#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "base/number_text.hpp"

namespace avoidbench {

/// Reads what CsvRow writes, line by line, and knows where it is, so that what is wrong can be told
/// with its line. Lines that begin with # are comments.
class CsvReader {
 public:
  /// `source` is the file's name in messages. Both texts must outlive the reader.
  /// A comment that begins with `comment_with_fields` may have fields in quotes.
  CsvReader(const std::string& text, const std::string& source,
            std::string_view comment_with_fields = "")
      : rest_(text), source_(source), comment_with_fields_(comment_with_fields) {}

  /// The next row or comment without its end; false after the last.
  bool next(std::string_view& line);

  /// Throws InputError with the file and the line that was read last.
  [[noreturn]] void fail(const std::string& message) const;

  /// The fields of a line, without quotes; still with the apostrophe of text_of_csv_field().
  std::vector<std::string> fields(std::string_view line) const;

  /// NaN for an empty field, where numbers have that.
  template <class Number, class... Base>
  Number number(const std::string& field, const char* what, Base... base) const {
    if (std::is_floating_point_v<Number> && field.empty()) {
      return std::numeric_limits<Number>::quiet_NaN();
    }
    const std::optional<Number> value = number_from<Number>(field, base...);
    if (!value) fail(std::string(what) + ": '" + field + "' is not a valid number");
    return *value;
  }

 private:
  std::size_t end_of_line() const;

  std::string_view rest_;
  const std::string& source_;
  std::string_view comment_with_fields_;
  int line_ = 0, next_line_ = 1;
};

}  // namespace avoidbench
