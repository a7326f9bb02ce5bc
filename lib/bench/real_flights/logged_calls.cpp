#include "real_flights/logged_calls.hpp"

#include <algorithm>
#include <array>
#include <limits>

#include "avoidbench/planner.h"
#include "base/input_error.hpp"
#include "base/input_file.hpp"
#include "base/words.hpp"
#include "table/csv_reader.hpp"

namespace avoidbench {
namespace {

constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();

/// Where the columns stand; kNone for one that is not there.
std::array<std::size_t, 4> columns_of(const CsvReader& reader,
                                      const std::vector<std::string>& header) {
  const std::array<std::string, 4> names{"time_s", "cpu_time_s", "wall_time_s", "status"};
  std::array<std::size_t, 4> places{};
  for (std::size_t i = 0; i < names.size(); ++i) {
    const auto found = std::find(header.begin(), header.end(), names[i]);
    places[i] = found == header.end() ? kNone : static_cast<std::size_t>(found - header.begin());
  }
  if (places[0] == kNone) reader.fail("lacks the column 'time_s'; it has " + joined(header));
  if (places[1] == kNone && places[2] == kNone) {
    reader.fail("lacks the columns 'cpu_time_s' and 'wall_time_s'; it has " + joined(header));
  }
  return places;
}

}  // namespace

std::vector<PlanCall> read_logged_calls(const std::string& file, double begin_s) {
  constexpr std::uint64_t kMostBytes = 256'000'000;
  const std::string bytes = read_input_file(file, kMostBytes);
  CsvReader reader(bytes, file);
  std::vector<PlanCall> calls;
  std::array<std::size_t, 4> places{};
  std::size_t column_count = 0;
  for (std::string_view line; reader.next(line);) {
    if (line.empty() || line.starts_with('#')) continue;
    const std::vector<std::string> fields = reader.fields(line);
    if (column_count == 0) {
      column_count = fields.size();
      places = columns_of(reader, fields);
      continue;
    }
    if (fields.size() != column_count) {
      reader.fail(std::to_string(fields.size()) + " fields, but " + std::to_string(column_count) +
                  " columns");
    }
    const auto number = [&](std::size_t which, const char* name) {
      const std::size_t place = places[which];
      if (place == kNone) return std::numeric_limits<double>::quiet_NaN();
      return reader.number<double>(fields[place], name);
    };
    PlanCall call{.time_s = number(0, "time_s") - begin_s,
                  .cpu_time_s = number(1, "cpu_time_s"),
                  .wall_time_s = number(2, "wall_time_s"),
                  .status = AB_OK};
    if (places[3] != kNone && fields[places[3]] == "no_plan") call.status = AB_NO_PLAN;
    if (!calls.empty() && !(call.time_s > calls.back().time_s)) {
      reader.fail("time_s: does not rise");
    }
    calls.push_back(call);
  }
  if (column_count == 0) refuse_file(file, "has no header");
  return calls;
}

}  // namespace avoidbench
