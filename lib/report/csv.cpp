#include "report/csv.hpp"

#include <cmath>

#include "store/record_format.hpp"

namespace avoidbench {

void CsvRow::begin_field() {
  if (!is_first_) text_ += ',';
  is_first_ = false;
}

CsvRow& CsvRow::add(double value) {
  begin_field();
  if (!std::isnan(value)) text_ += shortest(value);
  return *this;
}

CsvRow& CsvRow::add(std::string_view word) {
  begin_field();
  if (word.find_first_of(",\"\r\n") == std::string_view::npos) {
    text_ += word;
    return *this;
  }
  text_ += '"';
  for (const char c : word) {
    if (c == '"') text_ += '"';
    text_ += c;
  }
  text_ += '"';
  return *this;
}

CsvRow& CsvRow::add_value(const TableValue& value) {
  if (const auto* number = std::get_if<double>(&value)) return add(*number);
  if (const auto* word = std::get_if<std::string>(&value)) return add(std::string_view(*word));
  begin_field();
  if (const auto* count = std::get_if<std::int64_t>(&value)) text_ += std::to_string(*count);
  if (const auto* seed = std::get_if<std::uint64_t>(&value)) text_ += std::to_string(*seed);
  return *this;
}

CsvRow& CsvRow::add_vector(const double* xyz) {
  for (int i = 0; i < 3; ++i) xyz == nullptr ? begin_field() : static_cast<void>(add(xyz[i]));
  return *this;
}

}  // namespace avoidbench
