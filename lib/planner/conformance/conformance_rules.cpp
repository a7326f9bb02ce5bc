#include "conformance/conformance_rules.hpp"

#include <dlfcn.h>

#include <algorithm>
#include <limits>
#include <thread>

#include "base/math.hpp"
#include "conformance/conformance_flight.hpp"
#include "conformance/goal_rule.hpp"
#include "conformance/input_rules.hpp"
#include "conformance/own_process.hpp"
#include "conformance/rig_rule.hpp"
#include "plugin/elf_symbols.hpp"

namespace avoidbench {
namespace {

std::vector<ParameterValue> presets(const PlannerLibrary& library) {
  return resolve_parameters(library.description(), {});
}

std::string with_context(const std::string& finding, const std::string& context) {
  return finding.empty() ? "" : finding + " " + context;
}

/// Replies of a new instance, flown alone.
std::vector<Reply> alone(const PlannerLibrary& library, const ConformanceFlight& flight,
                         Looking looking = Looking::nobody) {
  return replies_in_own_process(library, [&] {
    Probe probe(library.table(), presets(library), false, looking);
    return probe.is_created() ? probe.fly(flight) : std::vector<Reply>{};
  });
}

/// Any breach of the interface while flying; also AB_ERROR where `errors_allowed` is false.
std::string flight_problem(const PlannerLibrary& library, const ConformanceFlight& flight,
                           bool errors_allowed) {
  return in_own_process(library, [&]() -> std::string {
    Probe probe(library.table(), presets(library));
    if (!probe.is_created()) return probe.problem();
    const std::vector<Reply> replies = probe.fly(flight);
    for (std::size_t i = 0; i < replies.size(); ++i) {
      std::string problem = reply_problem(replies[i], library.table());
      if (problem.empty() && !errors_allowed && replies[i].status == AB_ERROR) {
        problem = "AB_ERROR: " + replies[i].error;
      }
      if (!problem.empty()) return reply_place(i) + ": " + problem;
    }
    return "";
  });
}

std::string exports_one_symbol(const PlannerLibrary& library) {
  if (library.description().is_program) return "";  // shares no symbols with anybody
  std::string others;
  for (const std::string& symbol : exported_symbols(library.description().file)) {
    // A planner's own symbols are its own affair; those of the SDK must not be shared.
    if (symbol.find("avoidbench") == std::string::npos) continue;
    if (symbol.starts_with("avoidbench_planner_v")) continue;
    others += (others.empty() ? "" : ", ") + symbol;
  }
  return others.empty() ? "" : "it also exports " + others + "; build with -fvisibility=hidden";
}

std::string refuses_unknown_hosts(const PlannerLibrary& library) {
  if (library.description().is_program) return "";  // its protocol's version was checked
  const std::string path = std::filesystem::absolute(library.description().file).string();
  // NOLOAD: the library that was described, not another file that lies there by now.
  void* handle = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL | RTLD_NOLOAD);
  if (handle == nullptr) return "it is no longer loaded";
  using TableFunction = const ab_planner* (*)(std::uint32_t);
  const auto function = reinterpret_cast<TableFunction>(dlsym(handle, "avoidbench_planner_v1"));
  if (function == nullptr) return "its symbol is gone";
  return function(0) == nullptr ? "" : "it gives a table to a host of ABI 0";
}

std::string describes_itself(const PlannerLibrary& library) {
  const PlannerDescription& planner = library.description();
  if (planner.version.empty()) return "version is empty";
  if (planner.summary.empty()) return "summary is empty";
  for (const ParameterDef& def : planner.parameters) {
    if (def.doc.empty()) return "parameter " + def.name + " has no doc";
  }
  return "";
}

std::string creates_with_presets(const PlannerLibrary& library) {
  return in_own_process(library,
                        [&] { return Probe(library.table(), presets(library)).problem(); });
}

std::string creates_over_its_ranges(const PlannerLibrary& library) {
  const PlannerDescription& planner = library.description();
  for (const ParameterDef& def : planner.parameters) {
    std::vector<ParameterValue> tried;
    for (const std::string& word : def.choices) tried.push_back({0.0, word});
    if (def.kind == AB_NUMBER || def.kind == AB_INTEGER) {
      tried.push_back({def.lowest, ""});
      tried.push_back({def.highest, ""});
    }
    for (const ParameterValue& value : tried) {
      const std::string problem = in_own_process(library, [&] {
        return Probe(library.table(), resolve_parameters(planner, {{def.name, value}})).problem();
      });
      // The rest of the parameters keep their presets: ends of several ranges at once may
      // contradict each other, and their number would multiply.
      const std::string given = value.text.empty() ? std::to_string(value.number) : value.text;
      if (!problem.empty()) return "with " + def.name + " = " + given + ": " + problem;
    }
  }
  return "";
}

std::string flies_toward_a_wall(const PlannerLibrary& library) {
  const std::string problem = flight_problem(library, wall_flight(), false);
  if (!problem.empty()) return problem;
  const std::vector<Reply> replies = alone(library, wall_flight());
  // From 1 on, since the first reply is reset()'s, which is AB_OK without a command.
  for (std::size_t i = 1; i < replies.size(); ++i) {
    if (replies[i].status == AB_OK) return "";
  }
  return "not one command in 20 calls";
}

std::string reset_forgets(const PlannerLibrary& library) {
  if (needs_own_process(library)) return "";  // no instance is reset twice
  Probe probe(library.table(), presets(library));
  if (!probe.is_created()) return probe.problem();
  const ConformanceFlight flight = wall_flight();
  // Its own first flight is the measure: what differs between instances is the next rule's.
  const std::vector<Reply> first = probe.fly(flight);
  ConformanceFlight other = flight;
  // Another goal, aside: what is remembered of it turns the next flight.
  other.mission.goal_world.y() += 5.0;
  probe.fly(other);
  return with_context(first_difference(first, probe.fly(flight)),
                      "after another trial and reset: it remembers");
}

std::string a_new_instance_is_like_a_reset_one(const PlannerLibrary& library) {
  const ConformanceFlight flight = wall_flight();
  const std::vector<Reply> first = alone(library, flight);
  return with_context(first_difference(first, alone(library, flight)),
                      needs_own_process(library)
                          ? "in a second process: something differs from run to run"
                          : "from a second instance: instances share something");
}

std::string instances_are_apart(const PlannerLibrary& library) {
  if (needs_own_process(library)) return "";  // there is one in a process
  const ConformanceFlight flight = wall_flight();
  ConformanceFlight other = flight;
  other.mission.goal_world.y() -= 6.0;
  const std::vector<Reply> expected = alone(library, flight);
  Probe a(library.table(), presets(library)), b(library.table(), presets(library));
  if (!a.is_created() || !b.is_created()) return a.problem() + b.problem();
  std::vector<Reply> replies{a.reset(flight.mission)};
  b.reset(other.mission);
  // Call by call, so that static variables that one call leaves are met by the other's next.
  for (std::size_t i = 0; i < flight.frames.size(); ++i) {
    replies.push_back(a.plan(flight.frames[i]));
    b.plan(other.frames[i]);
  }
  return with_context(first_difference(expected, replies),
                      "when another instance flies in between: instances share something");
}

std::string instances_may_run_at_once(const PlannerLibrary& library) {
  if (needs_own_process(library)) return "";
  const ConformanceFlight flight = wall_flight();
  const std::vector<Reply> expected = alone(library, flight);
  std::vector<Reply> a, b;
  // Races are found by chance only; what they break most often, shared buffers, breaks soon.
  std::thread other([&] { a = alone(library, flight); });
  b = alone(library, flight);
  other.join();
  const std::string finding = first_difference(expected, a);
  return with_context(finding.empty() ? first_difference(expected, b) : finding,
                      "when two threads fly an instance each");
}

std::string keeps_no_input(const PlannerLibrary& library) {
  const ConformanceFlight flight = wall_flight();
  const std::vector<Reply> expected = alone(library, flight);
  const std::vector<Reply> poisoned = replies_in_own_process(library, [&] {
    Probe probe(library.table(), presets(library), true);
    return probe.is_created() ? probe.fly(flight) : std::vector<Reply>{};
  });
  return with_context(first_difference(expected, poisoned),
                      "when inputs are overwritten after each call: it keeps a pointer to them");
}

std::string drawing_changes_nothing(const PlannerLibrary& library) {
  const ConformanceFlight flight = wall_flight();
  const std::vector<Reply> expected = alone(library, flight);
  std::string finding =
      // A host without the extension first: planners that don't ask for null crash there.
      with_context(first_difference(expected, alone(library, flight, Looking::impossible)),
                   "with a host that has no extension " AB_DEBUG_EXTENSION);
  if (!finding.empty()) return finding;
  return with_context(first_difference(expected, alone(library, flight, Looking::somebody)),
                      "when its drawings are shown");
}

std::string being_asked_changes_nothing(const PlannerLibrary& library) {
  const ConformanceFlight flight = wall_flight();
  const std::vector<Reply> asked = alone(library, flight, Looking::asking);
  for (std::size_t i = 0; i < asked.size(); ++i) {
    if (!asked[i].map_problem.empty())
      return "after " + reply_place(i) + ": " + asked[i].map_problem;
  }
  return with_context(first_difference(alone(library, flight), asked),
                      "when it is asked what it knows of places");
}

std::string survives_odd_images(const PlannerLibrary& library) {
  struct Case {
    const char* name;
    float depth_m;
  };
  constexpr Case kCases[] = {{"an image of NaN", std::numeric_limits<float>::quiet_NaN()},
                             {"an image of +inf", std::numeric_limits<float>::infinity()},
                             {"an image of zeros", 0.0F}};
  for (const Case& odd : kCases) {
    // No errors: cameras see such things in flight (the sky, a wall nearer than their range).
    const std::string problem = flight_problem(library, uniform_flight(odd.depth_m), false);
    if (!problem.empty()) return std::string(odd.name) + ", " + problem;
  }
  ConformanceFlight blind = wall_flight();
  for (Frame& frame : blind.frames) frame.images.clear();
  std::string problem = flight_problem(library, blind, false);
  if (!problem.empty()) return "no image, " + problem;
  ConformanceFlight late = wall_flight();
  // As after a slow call: more images than one came since the last.
  for (Frame& frame : late.frames) frame.images.insert(frame.images.end(), 2, frame.images.front());
  problem = flight_problem(library, late, false);
  return problem.empty() ? "" : "three images a call, " + problem;
}

std::string survives_odd_goals(const PlannerLibrary& library) {
  ConformanceFlight at_start = wall_flight();
  at_start.mission.goal_world = at_start.mission.start_world;
  std::string problem = flight_problem(library, at_start, false);
  if (!problem.empty()) return "goal at the start, " + problem;
  ConformanceFlight arrived = wall_flight();
  for (Frame& frame : arrived.frames) {
    frame.position_world = arrived.mission.goal_world;
    frame.velocity_world.setZero();
  }
  problem = flight_problem(library, arrived, false);
  if (!problem.empty()) return "vehicle at the goal, " + problem;
  ConformanceFlight above = wall_flight();
  // No horizontal direction leads there: planners that normalise one divide by zero.
  above.mission.goal_world = above.mission.start_world + Eigen::Vector3d(0.0, 0.0, 5.0);
  problem = flight_problem(library, above, false);
  if (!problem.empty()) return "goal straight above, " + problem;
  if ((library.description().needs & AB_INPUT_GOALS) == 0) return "";
  ConformanceFlight moving = wall_flight();
  // To and fro through where the vehicle is.
  for (Frame& frame : moving.frames) {
    const double way_m = 2.0 * math::sin(5.0 * frame.time_s);
    frame.goal = GoalView{.index = 0,
                          .place_world = frame.position_world + Eigen::Vector3d(way_m, 0.0, 0.0)};
  }
  problem = flight_problem(library, moving, false);
  if (!problem.empty()) return "a goal that moves, " + problem;
  ConformanceFlight many = wall_flight();
  // All in one place, and each call another's turn.
  many.mission.goals_world.assign(many.frames.size(), many.mission.goal_world);
  for (std::size_t i = 0; i < many.frames.size(); ++i) {
    many.frames[i].goal =
        GoalView{.index = static_cast<std::uint32_t>(i), .place_world = many.mission.goal_world};
  }
  problem = flight_problem(library, many, false);
  return problem.empty() ? "" : "a goal each call, all in one place, " + problem;
}

std::string errors_have_a_text(const PlannerLibrary& library) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  ConformanceFlight lost = wall_flight();
  // Errors are allowed here, silent ones and exceptions are not.
  for (Frame& frame : lost.frames) frame.position_world.setConstant(nan);
  ConformanceFlight nowhere = wall_flight();
  nowhere.mission.goal_world.setConstant(nan);
  for (const ConformanceFlight* flight : {&lost, &nowhere}) {
    const std::string problem = in_own_process(library, [&]() -> std::string {
      Probe probe(library.table(), presets(library));
      if (!probe.is_created()) return probe.problem();
      for (const Reply& reply : probe.fly(*flight)) {
        if (!reply.escaped.empty()) return "an exception crossed the interface: " + reply.escaped;
        if (reply.status == AB_ERROR && reply.error.empty()) {
          return "AB_ERROR without a text for set_error";
        }
      }
      return "";
    });
    if (!problem.empty()) return problem;
  }
  return "";
}

constexpr ConformanceRule kRules[] = {
    {"exports_one_avoidbench_symbol",
     "Nothing of avoidbench but avoidbench_planner_vN is exported, so that two planners in one "
     "process never share code.",
     exports_one_symbol},
    {"refuses_unknown_hosts",
     "The symbol returns null for an ABI that the planner was not built for.",
     refuses_unknown_hosts},
    {"describes_itself", "Version, summary and each parameter's doc are not empty.",
     describes_itself},
    {"creates_with_presets", "An instance can be made from the presets.", creates_with_presets},
    {"creates_over_its_ranges",
     "An instance can be made with each parameter at either end of its range and with each choice.",
     creates_over_its_ranges},
    {"flies_toward_a_wall",
     "20 calls toward a wall with a gap: no error, at least one command, only declared kinds, all "
     "finite, inputs untouched.",
     flies_toward_a_wall},
    {"reset_forgets",
     "After reset, equal inputs give equal commands, bit for bit, whatever was flown before. (Of a "
     "planner that declares AB_USES_GLOBALS no instance is reset twice.)",
     reset_forgets, true},
    {"a_new_instance_is_like_a_reset_one",
     "Two instances one after the other give equal commands; with AB_USES_GLOBALS, in two "
     "processes.",
     a_new_instance_is_like_a_reset_one, true},
    {"instances_are_apart",
     "Two instances called in turn do not disturb each other; with AB_USES_GLOBALS there is one.",
     instances_are_apart, true},
    {"instances_may_run_at_once",
     "Two instances called from two threads give the same as alone; not with AB_USES_GLOBALS.",
     instances_may_run_at_once, true},
    {"keeps_no_input",
     "What is passed into a call is not read after it: setup, mission, state, images, sweeps, "
     "tracks and the wanted command.",
     keeps_no_input, true},
    {"drawing_changes_nothing",
     "Commands are the same, bit for bit, with a host that has no " AB_DEBUG_EXTENSION
     " and with one that shows the drawings.",
     drawing_changes_nothing, true},
    {"being_asked_changes_nothing",
     "Commands are the same, bit for bit, when the planner is asked after each call what it knows "
     "of "
     "places (" AB_MAP_EXTENSION "), and its answers have a meaning.",
     being_asked_changes_nothing, true},
    {"survives_odd_images",
     "Images of NaN, +inf or zeros, none and several at once give commands or no plan, not errors.",
     survives_odd_images},
    {"survives_odd_goals",
     "A goal at the start, at the vehicle or straight above, and with AB_INPUT_GOALS one that "
     "moves "
     "and many in one place, give commands or no plan, not errors.",
     survives_odd_goals},
    {"survives_odd_sweeps",
     "Rare sweeps, several at once, empty or at the lidar itself give commands or no plan, not "
     "errors. (Asked of a planner that declares AB_INPUT_POINTS.)",
     survives_odd_sweeps},
    {"survives_odd_tracks",
     "No tracks, a thousand, and one where the vehicle is, without size or of an unknown kind give "
     "commands or no plan, not errors. (Asked of a planner that declares AB_INPUT_TRACKS.)",
     survives_odd_tracks},
    {"survives_odd_commands",
     "No wanted command, or a velocity or trajectory that is odd, gives commands or no plan, not "
     "errors. (Asked of a filter: it declares AB_INPUT_COMMAND.)",
     survives_odd_commands},
    {"tells_cameras_apart",
     "With a second camera that looks down, commands still depend on what the first one sees. (Not "
     "asked of a planner that declares AB_INPUT_ONE_CAMERA: no rig reaches it.)",
     tells_cameras_apart, true},
    {"flies_to_the_next_goal",
     "With two goals, commands depend on where the second one is when its turn has come. (Asked of "
     "a planner that declares AB_INPUT_GOALS.)",
     flies_to_the_next_goal, true},
    {"errors_have_a_text",
     "With a NaN state or goal a planner may fail, but says why by set_error.", errors_have_a_text},
};

}  // namespace

std::span<const ConformanceRule> conformance_rules() { return kRules; }

}  // namespace avoidbench
