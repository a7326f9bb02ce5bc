#include <nanobind/nanobind.h>
#include <nanobind/stl/function.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "avoidbench/planner.h"
#include "avoidbench/portable_math.hpp"
#include "base/input_error.hpp"
#include "bindings.hpp"
#include "config/sweep_file.hpp"
#include "metrics/metric_table.hpp"
#include "plugin/planner_table.hpp"
#include "replay/provenance.hpp"
#include "store/database.hpp"
#include "sweep/listed_missions.hpp"
#include "sweep/run_sweep.hpp"
#include "version.hpp"

namespace nb = nanobind;

namespace avoidbench::python {
namespace {

using FlownSweep = nb::typed<nb::dict, nb::str, nb::any>;

/// Called with how many trials there are, and how many are in the database.
using OnProgress = std::function<void(std::int64_t total, std::int64_t done)>;

// Set by handlers of signals, which have nothing else to hold on to.
std::atomic<bool> must_stop{false};

RunRow provenance() {
  RunRow run = run_on_this_host();
  run.program_version = kVersion;
  run.git_hash = kGitHash;
  run.compiler = kCompiler;
  run.flags = kCompilerFlags;
  run.shard = "1/1";
  run.sandbox = "none: flown in Python";
  return run;
}

/// The given one, or results/NAME.db, whose folder is made.
std::string database_of(const std::string& given, const SweepSpec& sweep) {
  if (!given.empty()) return given;
  std::filesystem::create_directories("results");
  return "results/" + sweep.name + ".db";
}

/// Flies the sweep in this process: its planners are Python's own.
FlownSweep fly_sweep(const std::string& given, const std::optional<std::string>& text,
                     const std::vector<std::string>& overrides, const std::string& given_database,
                     const OnProgress& on_progress) {
  static std::mutex one_at_a_time;
  const std::unique_lock lock(one_at_a_time, std::try_to_lock);
  if (!lock) throw InputError("another sweep is being flown in this process");
  must_stop = false;
  std::string name, database_file;
  std::vector<std::string> warnings;
  RunSummary summary;
  {
    const Released released;
    const SweepSpec sweep =
        text ? sweep_of_text(*text, given, overrides) : read_sweep(given, overrides);
    name = sweep.name;
    warnings = sweep.warnings;
    check_listed_missions(sweep, expand(sweep));
    database_file = database_of(given_database, sweep);
    Database database = Database::open_for_run(database_file, metric_table());
    RunOptions options;
    options.in_process = true;
    options.on_progress = [&](const Progress& progress) {
      check_signals();
      const nb::gil_scoped_acquire held;
      on_progress(progress.total, progress.done);
    };
    options.stop = &must_stop;
    summary = run_sweep(sweep, provenance(), database, options);
  }
  FlownSweep result;
  result["sweep"] = name;
  result["database"] = database_file;
  result["revision"] = summary.revision;
  result["warnings"] = warnings;
  result["is_stopped"] = summary.is_stopped;
  result["done"] = summary.progress.done;
  result["total"] = summary.progress.total;
  result["invalid_missions"] = summary.progress.invalid_missions;
  return result;
}

/// Sizes of the structs of planner.h, by which the package checks its own.
nb::typed<nb::dict, nb::str, nb::int_> struct_sizes() {
  nb::typed<nb::dict, nb::str, nb::int_> sizes;
  sizes["ab_host"] = sizeof(ab_host);
  sizes["ab_parameter"] = sizeof(ab_parameter);
  sizes["ab_value"] = sizeof(ab_value);
  sizes["ab_camera"] = sizeof(ab_camera);
  sizes["ab_setup"] = sizeof(ab_setup);
  sizes["ab_mission"] = sizeof(ab_mission);
  sizes["ab_state"] = sizeof(ab_state);
  sizes["ab_depth_image"] = sizeof(ab_depth_image);
  sizes["ab_picture"] = sizeof(ab_picture);
  sizes["ab_stereo_pair"] = sizeof(ab_stereo_pair);
  sizes["ab_imu_sample"] = sizeof(ab_imu_sample);
  sizes["ab_observation"] = sizeof(ab_observation);
  sizes["ab_point"] = sizeof(ab_point);
  sizes["ab_command"] = sizeof(ab_command);
  sizes["ab_planner"] = sizeof(ab_planner);
  sizes["ab_files"] = sizeof(ab_files);
  return sizes;
}

/// avoidbench.portable_math has them by their own names.
void bind_portable_math(nb::module_& m) {
  m.def("portable_sin", &portable::sin, nb::arg("x"));
  m.def("portable_cos", &portable::cos, nb::arg("x"));
  m.def("portable_tan", &portable::tan, nb::arg("x"));
  m.def("portable_asin", &portable::asin, nb::arg("x"));
  m.def("portable_acos", &portable::acos, nb::arg("x"));
  m.def("portable_atan", &portable::atan, nb::arg("x"));
  m.def("portable_atan2", &portable::atan2, nb::arg("y"), nb::arg("x"));
  m.def("portable_exp", &portable::exp, nb::arg("x"));
  m.def("portable_log", &portable::log, nb::arg("x"));
}

}  // namespace

void bind_planner(nb::module_& m) {
  m.def(
      "register_planner",
      [](const std::string& file, std::uintptr_t table) {
        // NOLINTNEXTLINE(performance-no-int-to-ptr): ctypes gives addresses as numbers
        register_own_planner(file, *reinterpret_cast<const ab_planner*>(table));
      },
      nb::arg("file"), nb::arg("table"),
      "From now on `file` is the planner whose ab_planner is at this address.");
  m.def("fly_sweep", &fly_sweep, nb::arg("sweep"), nb::arg("text").none(), nb::arg("overrides"),
        nb::arg("database"), nb::arg("on_progress"),
        "Flies a sweep in this process; what came of it.");
  m.def(
      "stop_flying", [] { must_stop = true; }, "fly_sweep ends after the trial that flies.");
  m.def("struct_sizes", &struct_sizes, "Of planner.h, in bytes.");
  bind_portable_math(m);
}

}  // namespace avoidbench::python
