#include <algorithm>
#include <cmath>

#include "base/input_error.hpp"
#include "base/number_text.hpp"
#include "logs/log_readers.hpp"

namespace avoidbench {
namespace {

constexpr std::size_t kMostLineBytes = 4096;

/// The words of a line: between blanks, or between commas and without the blanks around them.
std::vector<std::string_view> columns_of(std::string_view line, bool is_csv) {
  constexpr std::string_view kBlanks = " \t\r\n";
  std::vector<std::string_view> columns;
  while (true) {
    line.remove_prefix(std::min(line.size(), line.find_first_not_of(kBlanks)));
    if (line.empty()) return columns;
    std::string_view word = line.substr(0, line.find_first_of(is_csv ? "," : kBlanks));
    line.remove_prefix(std::min(line.size(), word.size() + 1));
    word = word.substr(0, word.find_last_not_of(kBlanks) + 1);
    columns.push_back(word);
  }
}

/// Ten to the `power`, 0 to 18.
std::int64_t power_of_ten(std::size_t power) {
  std::int64_t value = 1;
  for (std::size_t i = 0; i < power; ++i) value *= 10;
  return value;
}

/// A number of seconds (`decimals` 9) or nanoseconds (0) as nanoseconds: exactly, where it is
/// written without an exponent, since a double has no room for today's seconds with nine digits
/// behind the point. Further digits are cut off.
std::optional<std::int64_t> nanoseconds(std::string_view word, std::size_t decimals) {
  constexpr double kMost_ns = 9e18;
  const std::int64_t unit = power_of_ten(decimals);
  const std::size_t point = std::min(word.find('.'), word.size());
  const auto whole = number_from<std::int64_t>(word.substr(0, point));
  std::string_view fraction = word.substr(std::min(word.size(), point + 1));
  fraction = fraction.substr(0, decimals);
  const bool is_plain = word.find_first_not_of("-0123456789.") == word.npos;
  if (!is_plain || !whole || (point < word.size() && word.find('.', point + 1) != word.npos)) {
    const auto value = number_from<double>(word);
    if (!value) return std::nullopt;
    if (!(std::abs(*value) * static_cast<double>(unit) < kMost_ns)) return std::nullopt;
    // Whole units apart: their product with `unit` would be rounded.
    const double part = *value - std::trunc(*value);
    return static_cast<std::int64_t>(std::trunc(*value)) * unit +
           std::llround(part * static_cast<double>(unit));
  }
  if (std::abs(static_cast<double>(*whole)) * static_cast<double>(unit) > kMost_ns) {
    return std::nullopt;
  }
  std::int64_t rest = 0;
  if (!fraction.empty()) {
    const auto digits = number_from<std::int64_t>(fraction);
    if (!digits || *digits < 0) return std::nullopt;
    rest = *digits * power_of_ten(decimals - fraction.size());
  }
  return *whole * unit + (word.starts_with('-') ? -rest : rest);
}

class TextPathReader {
 public:
  TextPathReader(ByteReader& in, FlightBuilder& flight) : in_(in), flight_(flight) {}

  void read() {
    while (true) {
      const std::uint64_t position = in_.position();
      const auto line = in_.line(kMostLineBytes);
      if (!line) return;
      ++line_;
      try {
        read_line(*line);
      } catch (const InputError&) {
        // The end of a line that was never written is no mistake of the file's.
        if (line->ends_with('\n') || flight_.poses().empty()) throw;
        throw CutOff{position};
      }
      if (!line->ends_with('\n')) {
        flight_.warn("the last line of " + in_.file().string() +
                     " has no end: if the file is cut off there, poses are missing");
      }
    }
  }

 private:
  void read_line(std::string_view line) {
    const std::size_t first = line.find_first_not_of(" \t\r\n");
    if (first == line.npos) return;
    if (line[first] == '#') return check_order(columns_of(line, true));
    const bool is_first = !is_csv_;
    if (is_first) {
      is_csv_ = line.find(',') != line.npos;
      flight_.set_format(*is_csv_ ? "EuRoC CSV" : "TUM");
    }
    const auto columns = columns_of(line, *is_csv_);
    // A header that is no comment, as pandas writes it.
    if (is_first && *is_csv_ && !number_from<double>(columns[0])) return check_order(columns);
    add_line(columns);
  }

  [[noreturn]] void refuse_word(const char* wanted, std::string_view word) const {
    constexpr std::size_t kMostShown = 40;
    refuse_line("expected " + std::string(wanted) + ", got '" +
                std::string(word.substr(0, kMostShown)) + "'");
  }

  [[noreturn]] void refuse_line(std::string message) const {
    throw InputError(
        InputProblem{.file = in_.file().string(), .line = line_, .message = std::move(message)});
  }

  /// Other files of seven numbers have w last: read so, attitudes would be wrong without a word.
  void check_order(const std::vector<std::string_view>& names) const {
    constexpr std::size_t kFirstOfAttitude = 4;
    if (names.size() < 8) return;
    const std::string_view name = names[kFirstOfAttitude];
    if (name.find('q') != name.npos && name.find('w') == name.npos) {
      refuse_line("expected the attitude's w in column 5, got " + std::string(name.substr(0, 40)) +
                  ": columns are time in ns, x, y, z, qw, qx, qy, qz");
    }
  }

  void add_line(const std::vector<std::string_view>& columns) {
    const char* const wanted =
        *is_csv_ ? "expected at least 8 columns (time in ns, x, y, z, qw, qx, qy, qz), got "
                 : "expected 8 columns (time in s, x, y, z, qx, qy, qz, qw), got ";
    if (*is_csv_ ? columns.size() < 8 : columns.size() != 8) {
      refuse_line(wanted + std::to_string(columns.size()));
    }
    const auto time_ns = nanoseconds(columns[0], *is_csv_ ? 0 : 9);
    if (!time_ns) refuse_word("a time", columns[0]);
    const auto number = [&](std::size_t column) {
      std::string_view word = columns[column];
      if (word.starts_with('+')) word.remove_prefix(1);
      const auto value = number_from<double>(word);
      if (!value) refuse_word("a number", columns[column]);
      return *value;
    };
    LoggedPose pose;
    pose.time_ns = *time_ns;
    pose.position = {number(1), number(2), number(3)};
    pose.q = *is_csv_ ? Eigen::Quaterniond(number(4), number(5), number(6), number(7))
                      : Eigen::Quaterniond(number(7), number(4), number(5), number(6));
    const bool has_velocity = *is_csv_ && columns.size() >= 11;
    has_velocity_ = has_velocity_.value_or(has_velocity);
    if (has_velocity != *has_velocity_) {
      refuse_line(has_velocity ? "has a velocity in columns 9 to 11; the lines before have none"
                               : "has no velocity in columns 9 to 11, as the lines before have");
    }
    if (has_velocity) pose.velocity = {number(8), number(9), number(10)};
    try {
      flight_.add(pose);
    } catch (const BadMessage& bad) {
      refuse_line(bad.what());
    }
  }

  ByteReader& in_;
  FlightBuilder& flight_;
  int line_ = 0;
  std::optional<bool> is_csv_, has_velocity_;  ///< as the first line of numbers has it
};

}  // namespace

void read_text_path(ByteReader& in, FlightBuilder& flight) { TextPathReader(in, flight).read(); }

}  // namespace avoidbench
