// Any bytes are a recorded flight or an InputError; what is read keeps its promises.
#include <unistd.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string_view>

#include "base/input_error.hpp"
#include "support/log_bytes.hpp"

namespace {

using namespace avoidbench;

/// SQLite reads files only.
RecordedFlight flight_of_db3(std::string_view bytes) {
  static const std::string file =
      (std::filesystem::temp_directory_path() / ("log_fuzz_" + std::to_string(getpid()))).string();
  std::ofstream(file, std::ios::binary) << bytes;
  return read_recorded_flight({.file = file});
}

void check(const RecordedFlight& flight) {
  if (flight.poses.empty() || flight.format.empty()) std::abort();
  if (!flight.velocities.empty() && flight.velocities.size() != flight.poses.size()) std::abort();
  for (std::size_t i = 0; i < flight.poses.size(); ++i) {
    const RecordedPose& pose = flight.poses[i];
    if (i > 0 && pose.time_ns <= flight.poses[i - 1].time_ns) std::abort();
    if (!pose.position.allFinite() || !(std::abs(pose.q.norm() - 1.0) < 1e-9)) std::abort();
    if (!flight.velocities.empty() && !flight.velocities[i].allFinite()) std::abort();
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  const bool is_db3 = bytes.starts_with(kSqliteMagic);
  for (const char* topic : {"", "vehicle_odometry"}) {
    try {
      check(is_db3 ? flight_of_db3(bytes) : test::flight_of_bytes(bytes, {.topic = topic}));
    } catch (const InputError&) {
    }
    if (!bytes.starts_with(kUlogMagic)) break;
  }
  return 0;
}
