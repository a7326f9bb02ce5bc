#include "conformance/input_rules.hpp"

#include <span>
#include <utility>

#include "conformance/conformance_flight.hpp"
#include "conformance/own_process.hpp"
#include "conformance/wanted_commands.hpp"

namespace avoidbench {
namespace {

/// Something that a frame may show, and what it is called.
struct OddInput {
  const char* name;
  void (*change)(Frame& frame, std::size_t index);
};

/// What is wrong with flights toward the wall in which each frame is changed so, errors included:
/// all of it is seen in flights.
std::string problem_with(const PlannerLibrary& library, std::span<const OddInput> inputs) {
  for (const OddInput& odd : inputs) {
    ConformanceFlight flight = wall_flight();
    for (std::size_t i = 0; i < flight.frames.size(); ++i) odd.change(flight.frames[i], i);
    const std::string problem = in_own_process(library, [&]() -> std::string {
      Probe probe(library.table(), resolve_parameters(library.description(), {}));
      if (!probe.is_created()) return probe.problem();
      const std::vector<Reply> replies = probe.fly(flight);
      for (std::size_t i = 0; i < replies.size(); ++i) {
        std::string wrong = reply_problem(replies[i], library.table());
        if (wrong.empty() && replies[i].status == AB_ERROR) wrong = "AB_ERROR: " + replies[i].error;
        if (!wrong.empty()) return reply_place(i) + ": " + wrong;
      }
      return "";
    });
    if (!problem.empty()) return std::string(odd.name) + ", " + problem;
  }
  return "";
}

constexpr OddInput kSweeps[] = {
    // At 30 calls and 10 sweeps a second two calls of three have none.
    {"a sweep each third call",
     [](Frame& frame, std::size_t index) { frame.sweep_count = index % 3 == 0 ? 1 : 0; }},
    {"no sweep at all", [](Frame& frame, std::size_t) { frame.sweep_count = 0; }},
    {"three sweeps a call", [](Frame& frame, std::size_t) { frame.sweep_count = 3; }},
    {"sweeps without points and misses",
     [](Frame& frame, std::size_t) {
       frame.points.clear();
       frame.misses_lidar.clear();
     }},
    {"a sweep of misses alone", [](Frame& frame, std::size_t) { frame.points.clear(); }},
    {"a sweep without misses", [](Frame& frame, std::size_t) { frame.misses_lidar.clear(); }},
    {"points at the lidar itself",
     [](Frame& frame, std::size_t) {
       for (ab_lidar_point& point : frame.points) point = {{0.0F, 0.0F, 0.0F}, 0.0F, 0.0F};
     }},
    {"a single point",
     [](Frame& frame, std::size_t) {
       if (!frame.points.empty()) frame.points.resize(1);
     }},
};

constexpr OddInput kTracks[] = {
    {"no tracks", [](Frame& frame, std::size_t) { frame.tracks.clear(); }},
    // Ids that come and go, and stand in no order.
    {"a thousand tracks",
     [](Frame& frame, std::size_t index) {
       constexpr std::uint32_t kCount = 1000;
       const TrackView person = frame.tracks.front();
       frame.tracks.clear();
       for (std::uint32_t i = 0; i < kCount; ++i) {
         TrackView& track = frame.tracks.emplace_back(person);
         track.id = (i * 617 + static_cast<std::uint32_t>(index) * 100) % 4096;
         track.kind = i % (AB_TRACK_POLE + 1);
         track.center_world += Eigen::Vector3d(0.1 * i, i % 2 == 0 ? 3.0 : -3.0, 0.0);
       }
     }},
    {"a track that stands where the vehicle is",
     [](Frame& frame, std::size_t) {
       frame.tracks.front().center_world = frame.position_world;
       frame.tracks.front().velocity_world.setZero();
     }},
    {"a track as fast as the vehicle beside it",
     [](Frame& frame, std::size_t) {
       frame.tracks.front().center_world = frame.position_world + Eigen::Vector3d(0.0, 2.0, 0.0);
       frame.tracks.front().velocity_world = frame.velocity_world;
     }},
    {"a track without size",
     [](Frame& frame, std::size_t) { frame.tracks.front().size_m.setZero(); }},
    {"a track of a kind that was added later",
     [](Frame& frame, std::size_t) { frame.tracks.front().kind = 1000; }},
    {"a track that is a second old",
     [](Frame& frame, std::size_t) { frame.tracks.front().time_s -= 1.0; }},
};

constexpr OddInput kCommands[] = {
    {"no wanted command", [](Frame& frame, std::size_t) { frame.wanted = no_plan(); }},
    {"a wanted command each third call",
     [](Frame& frame, std::size_t index) {
       if (index % 3 != 0) frame.wanted = no_plan();
     }},
};
constexpr OddInput kVelocities[] = {
    {"a wanted velocity of zero",
     [](Frame& frame, std::size_t) {
       frame.wanted = wanted_onward(frame, AB_COMMAND_VELOCITY);
       frame.wanted->command.velocity_world_mps[0] = 0.0;
     }},
    {"a wanted velocity straight up at a turning yaw",
     [](Frame& frame, std::size_t) {
       frame.wanted = wanted_onward(frame, AB_COMMAND_VELOCITY);
       std::swap(frame.wanted->command.velocity_world_mps[0],
                 frame.wanted->command.velocity_world_mps[2]);
       frame.wanted->command.flags = AB_YAW_IS_RATE;
       frame.wanted->command.yaw_rate_radps = 1.0;
     }},
    {"a wanted velocity of 10 km/s",
     [](Frame& frame, std::size_t) {
       frame.wanted = wanted_onward(frame, AB_COMMAND_VELOCITY);
       frame.wanted->command.velocity_world_mps[0] = 1e4;
     }},
};
constexpr OddInput kTrajectories[] = {
    {"a wanted trajectory of two points",
     [](Frame& frame, std::size_t) {
       frame.wanted = wanted_onward(frame, AB_COMMAND_TRAJECTORY);
       frame.wanted->points.resize(2);
     }},
    {"a wanted trajectory that stays where it is",
     [](Frame& frame, std::size_t) {
       frame.wanted = wanted_onward(frame, AB_COMMAND_TRAJECTORY);
       const double start_s = frame.wanted->points.front().time_s;
       for (ab_point& point : frame.wanted->points) {
         const double time_s = point.time_s - start_s;
         point = frame.wanted->points.front();
         point.time_s = time_s;
         point.velocity_world_mps[0] = 0.0;
       }
     }},
    {"a wanted trajectory that begins 5 m away",
     [](Frame& frame, std::size_t) {
       Frame aside = frame;
       aside.position_world.y() += 5.0;
       frame.wanted = wanted_onward(aside, AB_COMMAND_TRAJECTORY);
     }},
};

}  // namespace

std::string survives_odd_sweeps(const PlannerLibrary& library) {
  if ((library.description().needs & AB_INPUT_POINTS) == 0) return "";
  return problem_with(library, kSweeps);
}

std::string survives_odd_tracks(const PlannerLibrary& library) {
  if ((library.description().needs & AB_INPUT_TRACKS) == 0) return "";
  return problem_with(library, kTracks);
}

std::string survives_odd_commands(const PlannerLibrary& library) {
  const std::uint32_t needs = library.table().needs, commands = library.table().commands;
  if ((needs & AB_INPUT_COMMAND) == 0) return "";
  std::string problem = problem_with(library, kCommands);
  if (problem.empty() && (commands & AB_COMMAND_VELOCITY) != 0) {
    problem = problem_with(library, kVelocities);
  }
  if (problem.empty() && (commands & AB_COMMAND_TRAJECTORY) != 0) {
    problem = problem_with(library, kTrajectories);
  }
  return problem;
}

}  // namespace avoidbench
