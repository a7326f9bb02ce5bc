#include "table/csv_reader.hpp"

#include <algorithm>

#include "base/input_error.hpp"

namespace avoidbench {

bool CsvReader::next(std::string_view& line) {
  if (rest_.empty()) return false;
  line_ = next_line_;
  line = rest_.substr(0, end_of_line());
  rest_.remove_prefix(std::min(rest_.size(), line.size() + 1));
  next_line_ += 1 + static_cast<int>(std::count(line.begin(), line.end(), '\n'));
  if (line.ends_with('\r')) line.remove_suffix(1);
  return true;
}

void CsvReader::fail(const std::string& message) const {
  throw InputError(InputProblem{.file = source_, .line = line_, .message = message});
}

// Quotes may begin anywhere in a field.
std::vector<std::string> CsvReader::fields(std::string_view line) const {
  std::vector<std::string> all(1);
  bool is_quoted = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const bool is_escaped = is_quoted && line.substr(i).starts_with("\"\"");
    if (is_escaped) {
      all.back() += '"';
      ++i;
    } else if (line[i] == '"') {
      is_quoted = !is_quoted;
    } else if (line[i] == ',' && !is_quoted) {
      all.emplace_back();
    } else {
      all.back() += line[i];
    }
  }
  if (is_quoted) fail("a quote is not closed");
  return all;
}

/// Where the line ends: line ends in quotes belong to their field (RFC 4180). A quote in a comment
/// of a person's opens nothing.
std::size_t CsvReader::end_of_line() const {
  const bool has_fields = !rest_.starts_with('#') || (!comment_with_fields_.empty() &&
                                                      rest_.starts_with(comment_with_fields_));
  bool is_quoted = false;
  for (std::size_t i = 0; i < rest_.size(); ++i) {
    // The two quotes of an escaped one close and open again.
    if (has_fields && rest_[i] == '"') is_quoted = !is_quoted;
    if (rest_[i] == '\n' && !is_quoted) return i;
  }
  return std::string_view::npos;
}

}  // namespace avoidbench
