#pragma once

#include <Eigen/Core>
#include <string>
#include <string_view>

#include "store/table_value.hpp"

namespace avoidbench {

/// One line of a CSV file after RFC 4180. Numbers have the fewest digits that read back to the same
/// bits; NaN and nothing are empty fields, infinity is `inf`.
class CsvRow {
 public:
  CsvRow& add(double value);
  CsvRow& add(std::string_view word);  ///< in quotes where it needs them
  CsvRow& add_value(const TableValue& value);
  CsvRow& add_vector(const double* xyz);  ///< three fields, empty where `xyz` is null
  CsvRow& add(const Eigen::Vector3d& v) { return add_vector(v.data()); }

  /// The row with its end of line, CR LF.
  std::string line() const { return text_ + "\r\n"; }

 private:
  void begin_field();

  std::string text_;
  bool is_first_ = true;
};

}  // namespace avoidbench
