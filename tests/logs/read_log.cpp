// read_log FILE [TOPIC [CHILD_FRAME]]: prints a recorded flight, a pose a line with 17 digits; or
// says why not and exits 2. For recorded_logs.py.
#include <cstdio>

#include "base/input_error.hpp"
#include "base/number_text.hpp"
#include "logs/recorded_flight.hpp"

int main(int argc, char** argv) {
  using namespace avoidbench;
  if (argc < 2) return 1;
  try {
    const RecordedFlight flight = read_recorded_flight({.file = argv[1],
                                                        .topic = argc > 2 ? argv[2] : "",
                                                        .child_frame = argc > 3 ? argv[3] : ""});
    std::printf("format %s\ntopic %s\ntype %s\nattitude %d\n", flight.format.c_str(),
                flight.topic.c_str(), flight.type.c_str(), flight.has_attitude ? 1 : 0);
    for (const std::string& warning : flight.warnings) {
      std::printf("warning %s\n", warning.c_str());
    }
    for (std::size_t i = 0; i < flight.poses.size(); ++i) {
      const auto& [time_ns, p, q] = flight.poses[i];
      std::string line = "pose " + std::to_string(time_ns);
      for (const double number : {p.x(), p.y(), p.z(), q.w(), q.x(), q.y(), q.z()}) {
        line += " " + significant_digits(number, 17);
      }
      if (!flight.velocities.empty()) {
        for (const double number : flight.velocities[i]) {
          line += " " + significant_digits(number, 17);
        }
      }
      std::puts(line.c_str());
    }
  } catch (const InputError& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
  return 0;
}
