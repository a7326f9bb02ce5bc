#include <nanobind/ndarray.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include "avoidbench/planner.h"
#include "base/enum_text.hpp"
#include "base/input_error.hpp"
#include "bindings.hpp"
#include "config/sweep_file.hpp"
#include "env/vector_env.hpp"
#include "metrics/metric_table.hpp"

namespace nb = nanobind;

namespace avoidbench::python {
namespace {

using NamedValues = nb::typed<nb::dict, nb::str, nb::any>;

template <class T>
using Array = nb::ndarray<T, nb::c_contig, nb::device::cpu>;

/// The sweep of a file or a built-in one, or where `text` is given that of the text.
SweepSpec sweep_of(const std::string& given, const std::optional<std::string>& text,
                   const std::vector<std::string>& overrides) {
  return text ? sweep_of_text(*text, given, overrides) : read_sweep(given, overrides);
}

std::uint32_t need_of(const std::string& name) {
  if (name == "depth") return AB_INPUT_DEPTH;
  if (name == "stereo") return AB_INPUT_STEREO;
  if (name == "color") return AB_INPUT_COLOR;
  if (name == "imu") return AB_INPUT_IMU;
  if (name == "points" || name == "ranges") return AB_INPUT_POINTS;
  return 0;
}

/// While it lives no other call may begin: of another thread, or of a signal's handler.
class Turn {
 public:
  explicit Turn(std::atomic<bool>& is_taken) : is_taken_(is_taken) {
    if (is_taken_.exchange(true)) {
      throw std::runtime_error(
          "another call of this environment has not returned yet: one thread at a time");
    }
  }
  ~Turn() { is_taken_ = false; }
  Turn(const Turn&) = delete;
  Turn& operator=(const Turn&) = delete;

 private:
  std::atomic<bool>& is_taken_;
};

/// Flights and the arrays that Python owns and this keeps alive.
class SteppedFlights {
 public:
  SteppedFlights(std::unique_ptr<VectorEnv> env, std::vector<std::string> warnings)
      : warnings_(std::move(warnings)), env_(std::move(env)) {
    all().insert(this);
  }
  ~SteppedFlights() {
    all().erase(this);
    if (env_ == nullptr) return;
    // Its threads may be making maps for a while.
    const Released released;
    env_.reset();
  }
  SteppedFlights(const SteppedFlights&) = delete;
  SteppedFlights& operator=(const SteppedFlights&) = delete;

  /// All that there are; guarded by the interpreter's lock.
  static std::set<SteppedFlights*>& all() {
    static std::set<SteppedFlights*> flights;
    return flights;
  }

  /// Ends its threads: no other call does anything after it.
  void close() { env_.reset(); }

  VectorEnv& env() const {
    if (env_ == nullptr) end_thread();  // Python is ending
    return *env_;
  }
  const std::vector<std::string>& warnings() const { return warnings_; }

  /// Where this observation is written from now on.
  void write_view(const std::string& name, const nb::object& array) {
    const ViewShape& shape = env().shape();
    ViewArrays& view = arrays_.view;
    if (name == "depth") view.depth = data<float>(name, array, shape.pixels());
    if (name == "stereo") view.stereo = data<std::uint8_t>(name, array, 2 * shape.pixels());
    if (name == "color") view.color = data<std::uint8_t>(name, array, 3 * shape.pixels());
    if (name == "points") view.points = data<float>(name, array, 3 * shape.shots());
    if (name == "ranges") view.ranges = data<float>(name, array, shape.shots());
    if (name == "imu") view.imu = data<float>(name, array, shape.imu_samples * kImuWidth);
    if (name == "state") view.state = data<float>(name, array, kStateWidth);
    if (name == "goal") view.goal = data<float>(name, array, kGoalWidth);
    if (name == "pose") view.pose = data<double>(name, array, kPoseWidth);
  }

  /// Where what comes of steps is written from now on.
  void write_results(const nb::object& reward, const nb::object& terminated,
                     const nb::object& truncated) {
    arrays_.reward = data<double>("reward", reward, 1);
    arrays_.terminated = data<std::uint8_t>("terminated", terminated, 1);
    arrays_.truncated = data<std::uint8_t>("truncated", truncated, 1);
  }

  void reset(std::optional<std::uint64_t> seed, const std::vector<std::uint8_t>& mask) {
    require_arrays();
    const Turn turn(is_flying_);
    VectorEnv& flown = env();
    const Released released;
    flown.reset(seed, mask, arrays_, check_signals);
  }

  void step(const Array<const double>& actions, bool begins_next) {
    require_arrays();
    if (actions.size() != slots() * action_width(env().spec().action)) {
      throw InputError("the actions are not of this environment's size");
    }
    const Turn turn(is_flying_);
    // Copied before they are checked: another thread may write to what Python passed.
    actions_.assign(actions.data(), actions.data() + actions.size());
    VectorEnv& flown = env();
    const Released released;
    flown.step(actions_, begins_next, arrays_, check_signals);
  }

  std::vector<EpisodeEnd> ended() {
    const Turn turn(is_flying_);
    return env().ended();
  }

  std::vector<std::int64_t> rounds() {
    const Turn turn(is_flying_);
    std::vector<std::int64_t> rounds;
    for (std::size_t slot = 0; slot < slots(); ++slot) rounds.push_back(env().round(slot));
    return rounds;
  }

 private:
  std::size_t slots() const { return static_cast<std::size_t>(env().spec().slots); }

  template <class T>
  T* data(const std::string& name, const nb::object& given, std::size_t numbers_a_slot) {
    const auto array = nb::cast<Array<T>>(given, false);
    if (array.size() != slots() * numbers_a_slot) {
      throw InputError("the array '" + name + "' is not of this environment's size");
    }
    kept_.push_back(given);
    return array.data();
  }

  void require_arrays() const {
    if (arrays_.reward == nullptr) throw InputError("there are no arrays to write to");
  }

  std::vector<nb::object> kept_;
  std::vector<std::string> warnings_;
  EnvArrays arrays_;
  std::vector<double> actions_;     // of the step that flies
  std::unique_ptr<VectorEnv> env_;  // null after close() alone
  std::atomic<bool> is_flying_ = false;
};

NamedValues dict_of(const EpisodeEnd& end) {
  nb::dict metrics;
  const auto table = metric_table();
  for (std::size_t i = 0; i < table.size(); ++i) {
    metrics[nb::str(table[i].name.data(), table[i].name.size())] = end.metrics[i];
  }
  NamedValues dict;
  dict["slot"] = end.slot;
  dict["episode_index"] = end.episode;  // "episode" is what Gymnasium's wrappers write
  dict["round"] = end.round;
  dict["trial_key"] = end.trial_key;
  dict["map_seed"] = end.map_seed;
  dict["mission_index"] = end.mission_index;
  dict["outcome"] = std::string(text(end.outcome));
  dict["reason"] = end.reason;
  dict["end_time_s"] = end.end_time_s;
  dict["reward_sum"] = end.reward_sum;
  dict["steps"] = end.steps;
  dict["metrics"] = metrics;
  return dict;
}

nb::typed<nb::list, NamedValues> ended(SteppedFlights& flights) {
  nb::typed<nb::list, NamedValues> list;
  for (const EpisodeEnd& end : flights.ended()) list.append(dict_of(end));
  return list;
}

/// Sizes and ranges, from which spaces are made.
NamedValues shape_of(const SteppedFlights& flights) {
  const ViewShape& shape = flights.env().shape();
  NamedValues dict;
  dict["cameras"] = shape.cameras;
  dict["height_px"] = shape.height_px;
  dict["width_px"] = shape.width_px;
  dict["imu_samples"] = shape.imu_samples;
  dict["min_range_m"] = shape.min_range_m;
  dict["max_range_m"] = shape.max_range_m;
  dict["lidars"] = shape.lidars.size();
  dict["lidar_shots"] = shape.widest_lidar.shots;
  dict["lidar_max_range_m"] = shape.widest_lidar.max_range_m;
  dict["action_lowest"] = flights.env().limits().lowest;
  dict["action_highest"] = flights.env().limits().highest;
  dict["step_s"] = flights.env().step_s();
  dict["trial_count"] = flights.env().trial_count();
  return dict;
}

template <class Enum>
Enum enum_named(const NamedValues& options, const char* name) {
  const auto word = nb::cast<std::string>(options[name]);
  if (const auto value = enum_from_text<Enum>(word)) return *value;
  const std::vector<std::string> words = enum_texts<Enum>();
  std::string message = std::string(name) + ": '" + word + "' is none of";
  for (const std::string& known : words) message += " " + known;
  throw InputError(message + did_you_mean(word, words));
}

/// The options, which the package's Python files have checked to be of these types.
EnvSpec spec_of(SweepSpec sweep, const NamedValues& options) {
  EnvSpec spec;
  spec.sweep = std::move(sweep);
  spec.policy = nb::cast<std::string>(options["policy"]);
  spec.slots = nb::cast<std::int64_t>(options["slots"]);
  spec.threads = nb::cast<std::int64_t>(options["threads"]);
  spec.seed = nb::cast<std::uint64_t>(options["seed"]);
  spec.kept_maps = nb::cast<std::int64_t>(options["kept_maps"]);
  spec.order = enum_named<EpisodeOrder>(options, "order");
  spec.depth = enum_named<DepthEncoding>(options, "depth");
  spec.action.kind = enum_named<ActionKind>(options, "action");
  spec.action.frame = enum_named<ActionFrame>(options, "frame");
  spec.action.points = nb::cast<std::int64_t>(options["trajectory_points"]);
  spec.action.horizon_s = nb::cast<double>(options["trajectory_horizon_s"]);
  spec.reward.progress_per_m = nb::cast<double>(options["progress_per_m"]);
  spec.reward.time_per_s = nb::cast<double>(options["time_per_s"]);
  spec.reward.crash = nb::cast<double>(options["crash"]);
  spec.reward.goal = nb::cast<double>(options["goal"]);
  for (const nb::handle name : nb::cast<nb::list>(options["observe"])) {
    const auto observed = nb::cast<std::string>(name);
    spec.needs |= need_of(observed);
    if (observed == "ranges") spec.sees_ranges = true;
  }
  return spec;
}

void make_flights(SteppedFlights* self, const std::string& given,
                  const std::optional<std::string>& text, const std::vector<std::string>& overrides,
                  const NamedValues& options) {
  std::optional<SweepSpec> sweep;
  {
    const Released released;
    sweep = sweep_of(given, text, overrides);
  }
  std::vector<std::string> warnings = sweep->warnings;
  const EnvSpec spec = spec_of(std::move(*sweep), options);
  std::unique_ptr<VectorEnv> env;
  {
    const Released released;
    env = std::make_unique<VectorEnv>(spec);
  }
  new (self) SteppedFlights(std::move(env), std::move(warnings));
}

}  // namespace

void close_all_flights() {
  for (SteppedFlights* flights : SteppedFlights::all()) flights->close();
}

void bind_env(nb::module_& m) {
  nb::class_<SteppedFlights>(m, "SteppedFlights",
                             "Many flights that are stepped together: avoidbench.env has what is "
                             "made of it.")
      .def("__init__", &make_flights, nb::arg("sweep"), nb::arg("text").none(),
           nb::arg("overrides"), nb::arg("options"))
      .def("write_view", &SteppedFlights::write_view, nb::arg("name"), nb::arg("array"),
           "Where an observation is written from now on: a C-contiguous array, kept alive.")
      .def("write_results", &SteppedFlights::write_results, nb::arg("reward"),
           nb::arg("terminated"), nb::arg("truncated"),
           "Where float64 rewards and uint8 ends are written from now on.")
      .def("reset", &SteppedFlights::reset, nb::arg("seed").none(), nb::arg("mask"),
           "Begins episodes: in all slots, or those whose mask is not 0.")
      .def("step", &SteppedFlights::step, nb::arg("actions"), nb::arg("begins_next"),
           "Flies each slot to its next observation; float64 actions, slot after slot.")
      .def("ended", &ended, "The episodes that ended in the last step, a dict each, by slot.")
      .def("rounds", &SteppedFlights::rounds,
           "How often each slot has flown its trials before, in turn.")
      .def("shape", &shape_of, "Sizes and ranges of observations and actions.")
      .def_prop_ro("warnings", &SteppedFlights::warnings, "What was read otherwise than written.");
}

}  // namespace avoidbench::python
