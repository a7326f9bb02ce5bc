#include "page/flight_filling.hpp"

#include <algorithm>
#include <utility>

#include "base/number_text.hpp"
#include "base/words.hpp"
#include "page/page_text.hpp"

namespace avoidbench {
namespace {

using nlohmann::ordered_json;

constexpr std::size_t kMostUnread = 20;  ///< flights of which it is said why they are not there

std::string megabytes(std::size_t bytes) {
  return fixed_digits(1e-6 * static_cast<double>(bytes), 1) + " MB";
}

}  // namespace

FlightFilling filling_beside(const ordered_json& page, std::size_t limit_bytes,
                             std::size_t warning_count) {
  // With warnings as long as they get.
  const std::size_t own_bytes =
      size_in_page(page) + (kMostUnread + 2 + warning_count) * kMostPageWarning;
  return {.bytes = own_bytes, .limit = limit_bytes};
}

void warn_of_size(std::size_t trial_count, FlightFilling& filling) {
  filling.scenes.warnings.push_back(
      "no flight fits: the tables and the numbers of " + counted(trial_count, "trial") +
      " alone take " + megabytes(filling.bytes) + ", but the limit leaves " +
      megabytes(filling.limit) + " for data: the page is larger than the limit");
}

bool add_flight(PackedFlight packed, const ordered_json& marks, const ReplayFiles& files,
                FlightFilling& filling) {
  if (!packed.stored) {
    // Of all flights of a damaged file a few stand for the others.
    if (filling.unread_count++ < kMostUnread) {
      filling.scenes.warnings.push_back("a flight is not shown: " + packed.problem);
    }
    return true;
  }
  if (packed.json == nullptr) return true;
  const StoredTrial& stored = *packed.stored;
  const PageScenes::Mark before = filling.scenes.mark();
  ordered_json flight = std::move(*packed.json);
  for (const auto& [name, value] : marks.items()) flight[name] = value;
  filling.scenes.place(stored, filling.scenes.world_of(stored, files), flight);
  const std::size_t flight_bytes = size_in_page(flight);
  const std::size_t bytes = flight_bytes + filling.scenes.bytes_since(before);
  if (filling.bytes + bytes > filling.limit) {
    filling.scenes.back_to(before);
    return false;
  }
  filling.bytes += bytes;
  filling.largest_bytes = std::max(filling.largest_bytes, flight_bytes);
  filling.flights.push_back(std::move(flight));
  return true;
}

void add_filling(FlightFilling filling, std::size_t left_out, ordered_json& page) {
  if (filling.unread_count > kMostUnread) {
    filling.scenes.warnings.push_back(
        "and so " + counted(filling.unread_count - kMostUnread, "further flight"));
  }
  page["flights"] = std::move(filling.flights);
  page["flights_left_out"] = left_out;
  add_scenes(std::move(filling.scenes), page);
}

}  // namespace avoidbench
