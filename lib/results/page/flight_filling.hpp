#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>

#include "page/flight_reading.hpp"
#include "page/page.hpp"

namespace avoidbench {

/// Flights of a page while it fills, with the maps and rigs that they share.
struct FlightFilling {
  PageScenes scenes = {};
  nlohmann::ordered_json flights = nlohmann::ordered_json::array();
  std::size_t bytes = 0, limit = 0;  ///< of the whole page
  std::size_t largest_bytes = 0;     ///< of the flights, without maps
  std::size_t unread_count = 0;      ///< of flights that can't be read

  /// Whether another flight is not even worth reading.
  bool is_full() const { return bytes + largest_bytes > limit; }
  std::size_t room() const { return limit > bytes ? limit - bytes : 0; }
};

/// What is left of `limit_bytes` beside the page as it is, with so many warnings beside those of
/// flights.
FlightFilling filling_beside(const nlohmann::ordered_json& page, std::size_t limit_bytes,
                             std::size_t warning_count);

/// Warns that the page is larger than its limit even without a flight.
void warn_of_size(std::size_t trial_count, FlightFilling& filling);

/// Puts the flight into the page, with `marks`, map and rig; one that can't be read or has no
/// samples is left out. False: there is no room, and nothing was put in.
bool add_flight(PackedFlight packed, const nlohmann::ordered_json& marks, const ReplayFiles& files,
                FlightFilling& filling);

/// Puts the flights and what they share into the page, and how many had no room.
void add_filling(FlightFilling filling, std::size_t left_out, nlohmann::ordered_json& page);

}  // namespace avoidbench
