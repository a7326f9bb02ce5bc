#include "wind/wind_field.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <map>
#include <optional>

#include "base/digest.hpp"
#include "base/input_error.hpp"
#include "base/input_file.hpp"

namespace avoidbench {
namespace {

using Eigen::Vector3d;

constexpr std::string_view kBlanks = " \t\r\n";

/// Where the next word at or after `from` begins; the text's size where there is none.
std::size_t next_word(std::string_view text, std::size_t from) {
  while (true) {
    from = std::min(text.find_first_not_of(kBlanks, from), text.size());
    if (from == text.size() || text[from] != '#') return from;
    from = std::min(text.find('\n', from), text.size());
  }
}

/// A key with its numbers; places are offsets in the text.
struct Entry {
  std::size_t place = 0;
  std::vector<double> numbers;
  std::vector<std::size_t> places;
};

/// Words of a file in any order and on any lines: a key with a colon, then its numbers up to the
/// next key. Comments go from # to the line's end.
class FieldReader {
 public:
  FieldReader(std::string_view text, std::string file) : text_(text), file_(std::move(file)) {
    for (std::size_t at = next_word(text, 0); at < text.size();) {
      const std::size_t end = std::min(text.find_first_of(" \t\r\n#", at), text.size());
      const std::string_view word = text.substr(at, end - at);
      if (word.back() == ':') {
        begin_entry(word.substr(0, word.size() - 1), at);
      } else {
        add_number(word, at);
      }
      at = next_word(text, end);
    }
  }

  const Entry& entry(const std::string& key, std::optional<std::size_t> count) const {
    const auto found = entries_.find(key);
    if (found == entries_.end()) {
      throw InputError(InputProblem{.file = file_, .message = "lacks '" + key + ":'"});
    }
    const Entry& entry = found->second;
    if (entry.numbers.empty() || (count && entry.numbers.size() != *count)) {
      fail(entry.place, key + ": " + std::to_string(entry.numbers.size()) + " numbers, not " +
                            (count ? std::to_string(*count) : "one or more"));
    }
    return entry;
  }

  double number(const std::string& key) const { return entry(key, 1).numbers[0]; }

  double positive(const std::string& key) const {
    const Entry& one = entry(key, 1);
    if (!(one.numbers[0] > 0.0)) fail(one.places[0], key + ": not above 0");
    return one.numbers[0];
  }

  std::size_t whole(const std::string& key) const {
    // So that n_x · n_y · n_z fits: the numbers themselves are bounded by the file's size.
    constexpr double kMost = 10000.0;
    const Entry& one = entry(key, 1);
    const double value = one.numbers[0];
    if (!(value >= 1.0 && value <= kMost && value == std::floor(value))) {
      fail(one.places[0], key + ": not a whole number from 1 to 10000");
    }
    return static_cast<std::size_t>(value);
  }

  [[noreturn]] void fail(std::size_t place, std::string message) const {
    const std::string_view before = text_.substr(0, place);
    const std::size_t line_begin = before.rfind('\n') + 1;  // npos + 1 is 0
    throw InputError(
        InputProblem{.file = file_,
                     .line = static_cast<int>(std::count(before.begin(), before.end(), '\n')) + 1,
                     .column = static_cast<int>(place - line_begin) + 1,
                     .message = std::move(message)});
  }

 private:
  void begin_entry(std::string_view word, std::size_t place) {
    // Those of RotorS' reader, so that its files work.
    static const std::vector<std::string> kKeys = {
        "min_x",    "min_y", "n_x", "n_y", "res_x", "res_y", "vertical_spacing_factors",
        "bottom_z", "top_z", "u",   "v",   "w"};
    const std::string key(word);
    if (std::find(kKeys.begin(), kKeys.end(), key) == kKeys.end()) {
      fail(place, "'" + key.substr(0, 40) + "' is not a key" + did_you_mean(key, kKeys));
    }
    const auto [entry, is_new] = entries_.emplace(key, Entry{place, {}, {}});
    if (!is_new) fail(place, key + ": is given twice");
    open_ = &*entry;
  }

  void add_number(std::string_view word, std::size_t place) {
    if (open_ == nullptr) fail(place, "a number before the first 'key:'");
    double value = 0.0;
    const char* last = word.data() + word.size();
    const auto [end, error] = std::from_chars(word.data(), last, value);
    if (error != std::errc{} || end != last || !std::isfinite(value)) {
      fail(place,
           open_->first + ": '" + std::string(word.substr(0, 40)) + "' is not a finite number");
    }
    open_->second.numbers.push_back(value);
    open_->second.places.push_back(place);
  }

  std::string_view text_;
  std::string file_;
  std::map<std::string, Entry> entries_;
  std::pair<const std::string, Entry>* open_ = nullptr;  ///< whose numbers are being read
};

/// Between which two of several knots a value lies, and how far towards the upper; clamped.
struct Between {
  std::size_t low = 0, high = 0;
  double part = 0.0;
};

/// Of evenly spaced knots, `at` in steps from the first.
Between between(double at, std::size_t count) {
  const double last = static_cast<double>(count - 1);
  if (!(at > 0.0)) return {};
  if (at >= last) return {count - 1, count - 1, 0.0};
  const double floor = std::floor(at);
  const auto low = static_cast<std::size_t>(floor);
  return {low, low + 1, at - floor};
}

/// Of rising knots.
Between between(double value, const std::vector<double>& knots) {
  const auto above = std::upper_bound(knots.begin(), knots.end(), value);
  if (above == knots.begin()) return {};
  if (above == knots.end()) return {knots.size() - 1, knots.size() - 1, 0.0};
  const auto high = static_cast<std::size_t>(above - knots.begin());
  return {high - 1, high, (value - knots[high - 1]) / (knots[high] - knots[high - 1])};
}

Vector3d mixed(const Vector3d& low, const Vector3d& high, double part) {
  return low + part * (high - low);
}

}  // namespace

WindField parse_wind_field(std::string_view text, const std::string& file) {
  const FieldReader reader(text, file);
  WindField field;
  field.min_x_m = reader.number("min_x");
  field.min_y_m = reader.number("min_y");
  field.count_x = reader.whole("n_x");
  field.count_y = reader.whole("n_y");
  field.step_x_m = reader.positive("res_x");
  field.step_y_m = reader.positive("res_y");
  const std::size_t columns = field.count_x * field.count_y;
  const Entry& layers = reader.entry("vertical_spacing_factors", std::nullopt);
  field.layers = layers.numbers;
  for (std::size_t i = 1; i < field.layers.size(); ++i) {
    if (field.layers[i] > field.layers[i - 1]) continue;
    reader.fail(layers.places[i], "vertical_spacing_factors: not above the one before");
  }
  field.bottom_m = reader.entry("bottom_z", columns).numbers;
  const Entry& top = reader.entry("top_z", columns);
  field.top_m = top.numbers;
  for (std::size_t i = 0; i < columns; ++i) {
    if (!(field.top_m[i] > field.bottom_m[i])) {
      reader.fail(top.places[i], "top_z: not above the same column's bottom_z");
    }
  }
  const std::size_t count = columns * field.layers.size();
  field.wind_mps.assign(count, Vector3d::Zero());
  // x fastest, then y, then the layers, as in RotorS' files.
  for (const auto& [key, axis] : {std::pair("u", 0), std::pair("v", 1), std::pair("w", 2)}) {
    const std::vector<double>& numbers = reader.entry(key, count).numbers;
    for (std::size_t i = 0; i < count; ++i) field.wind_mps[i][axis] = numbers[i];
  }
  return field;
}

WindField read_wind_field(const std::string& file, const std::string& digest) {
  const std::string found = file_digest(file);
  // A replay must fly in the wind that was flown in.
  if (!digest.empty() && found != digest) {
    throw InputError(
        InputProblem{.file = file, .message = "has another SHA-256 than " + digest + ": " + found});
  }
  constexpr std::uint64_t kMostBytes = 1'000'000'000;
  return parse_wind_field(read_input_file(file, kMostBytes), file);
}

Vector3d wind_at(const WindField& field, const Vector3d& position_world) {
  const Between x = between((position_world.x() - field.min_x_m) / field.step_x_m, field.count_x);
  const Between y = between((position_world.y() - field.min_y_m) / field.step_y_m, field.count_y);
  const std::size_t columns = field.count_x * field.count_y;
  // Each column has its own ground and top: the layers are shares of the height between them.
  const auto in_column = [&](std::size_t ix, std::size_t iy) {
    const std::size_t column = ix + iy * field.count_x;
    const double bottom = field.bottom_m[column], top = field.top_m[column];
    const Between z = between((position_world.z() - bottom) / (top - bottom), field.layers);
    return mixed(field.wind_mps[column + z.low * columns],
                 field.wind_mps[column + z.high * columns], z.part);
  };
  // Up and down within the four columns around, then along x, then along y.
  const Vector3d low = mixed(in_column(x.low, y.low), in_column(x.high, y.low), x.part);
  const Vector3d high = mixed(in_column(x.low, y.high), in_column(x.high, y.high), x.part);
  return mixed(low, high, y.part);
}

}  // namespace avoidbench
