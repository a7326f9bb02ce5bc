#pragma once

#include <algorithm>
#include <string_view>

#include "logs/log_readers.hpp"

namespace avoidbench::test {

/// A log that is in memory. Gives few bytes at a time, so that readers see all kinds of ends.
class MemoryBytes : public ByteSource {
 public:
  explicit MemoryBytes(std::string_view bytes, std::size_t most_at_once = 1000)
      : rest_(bytes), most_at_once_(most_at_once) {}
  std::size_t read(std::span<char> bytes) override {
    const std::size_t count = std::min({bytes.size(), rest_.size(), most_at_once_});
    std::copy_n(rest_.data(), count, bytes.data());
    rest_.remove_prefix(count);
    return count;
  }

 private:
  std::string_view rest_;
  std::size_t most_at_once_;
};

inline RecordedFlight flight_of_bytes(std::string_view bytes, RecordedFlightChoice choice = {}) {
  choice.file = "log";
  MemoryBytes source(bytes);
  ByteReader in(source, choice.file);
  FlightBuilder flight(choice);
  read_log(in, flight);
  return flight.finish();
}

}  // namespace avoidbench::test
