#include "plugin/planner_instance.hpp"

#include <algorithm>
#include <ctime>
#include <exception>

#include "base/check.hpp"
#include "base/input_error.hpp"
#include "base/utf8.hpp"
#include "plugin/command_check.hpp"
#include "plugin/cpu_meter.hpp"
#include "plugin/float_guard.hpp"
#include "plugin/host_buffers.hpp"
#include "plugin/planner_table.hpp"
#include "process/locale_guard.hpp"
#include "program_planner/program_planner.hpp"

namespace avoidbench {
namespace {

double wall_clock_s() {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// Runs `call`; "" or what escaped from it. No exception may cross the interface: one that does is
/// the planner's error.
template <class Call>
std::string escaped_exception(CallClock* clock, Call&& call) {
  // Guards outside the try block: they are taken down after whatever escapes.
  const TimedCall timed(clock);
  const FloatGuard float_guard;
  const LocaleGuard locale_guard;
  try {
    call();
  } catch (const std::exception& error) {
    return "an exception crossed the interface: " +
           shortened(error.what(), HostSide::kMostTextBytes);
  } catch (...) {
    return "an exception crossed the interface";
  }
  return "";
}

std::string error_text(const char* function, HostSide& host) {
  const std::string given = host.take_error();
  return given.empty() ? std::string(function) + " failed without saying why" : given;
}

}  // namespace

struct PlannerInstance::Internals {
  Internals(ThreadOwner library, std::uint32_t needs) : host(true, needs), meter(library) {}

  const ab_planner* table = nullptr;
  std::string name;
  std::vector<CameraSetup> cameras;
  HostSide host;
  ObservationBuffers observation;
  GoalView first_goal;  ///< of the mission
  void* instance = nullptr;
  CallClock* clock = nullptr;
  CpuMeter meter;
  const ab_map* map = nullptr;  ///< where the planner answers AB_MAP_EXTENSION
  bool is_program = false;
  double charged_program_s = 0.0;  ///< CPU time of the program that calls were charged for

  /// What the program has used since it was asked last.
  double program_time_s() {
    if (!is_program) return 0.0;
    const double before_s = charged_program_s;
    charged_program_s = program_cpu_time_s(instance);
    return std::max(0.0, charged_program_s - before_s);
  }

  ~Internals() {
    // create() may have failed; a planner is destroyed only if there is one.
    if (instance == nullptr) return;
    // Threads that start in destroy() are the planner's, too.
    meter.begin_call();
    escaped_exception(clock, [this] { table->destroy(instance); });
  }
};

PlannerInstance::PlannerInstance(const PlannerLibrary& library, const PlannerSetup& setup,
                                 const std::vector<ParameterValue>& values, CallClock* clock)
    : internals_(std::make_unique<Internals>(library.thread_owner(), library.table().needs)) {
  const PlannerDescription& description = library.description();
  AB_CHECK(values.size() == description.parameters.size(), values.size());
  if (const std::string problem = sensor_problem(description, setup); !problem.empty()) {
    throw InputError("planner " + description.name + " can't fly with this sensor: " + problem);
  }
  internals_->table = &library.table();
  internals_->name = description.name;
  internals_->cameras = setup.cameras;
  internals_->clock = clock;
  internals_->is_program = description.is_program;
  const SetupBuffers buffers(setup, values, internals_->table->needs);
  internals_->meter.begin_call();
  std::string problem = escaped_exception(clock, [&] {
    internals_->instance = internals_->table->create(&internals_->host.table(), &buffers.setup());
  });
  if (problem.empty() && internals_->instance == nullptr) {
    problem = error_text("create", internals_->host);
  }
  if (!problem.empty()) {
    throw InputError("planner " + description.name + ": " + problem);
  }
}

PlannerInstance::~PlannerInstance() = default;
PlannerInstance::PlannerInstance(PlannerInstance&&) noexcept = default;
PlannerInstance& PlannerInstance::operator=(PlannerInstance&&) noexcept = default;

std::uint32_t PlannerInstance::needs() const { return internals_->table->needs; }

const std::string& PlannerInstance::name() const { return internals_->name; }

void PlannerInstance::show_world(PlannerWorld world) {
  internals_->host.show_world(std::move(world));
}

std::string PlannerInstance::reset(const PlannerMission& mission) {
  Internals& self = *internals_;
  const ab_mission given = to_mission(mission);
  self.first_goal = {.index = 0, .place_world = mission.goal_world};
  ab_status status = AB_ERROR;
  // What an earlier call left would be taken for this one's reason.
  self.host.take_error();
  self.meter.begin_call();
  const std::string escaped =
      escaped_exception(self.clock, [&] { status = self.table->reset(self.instance, &given); });
  // What reset() used is charged to no call.
  self.meter.settle();
  self.program_time_s();
  if (!escaped.empty()) return escaped;
  return status == AB_OK ? "" : error_text("reset", self.host);
}

PlanResult PlannerInstance::plan(const PlannerView& view, const PlanResult* wanted) {
  Internals& self = *internals_;
  const ab_observation& observation =
      self.observation.fill(view, self.cameras, self.table->needs, self.first_goal, wanted);
  PlanResult result;
  result.command.struct_size = static_cast<std::uint32_t>(sizeof(ab_command));
  ab_status status = AB_ERROR;
  self.host.take_error();

  // Before the wall clock is read: the meter's own work is not the planner's time.
  self.meter.begin_call();
  const double wall_before_s = wall_clock_s();
  std::string problem = escaped_exception(
      self.clock, [&] { status = self.table->plan(self.instance, &observation, &result.command); });
  result.wall_time_s = wall_clock_s() - wall_before_s;
  result.cpu_time_s = self.meter.end_call() + self.program_time_s();

  if (problem.empty() && status == AB_OK) {
    problem = command_problem(result.command, self.table->commands);
  }
  if (problem.empty() && status == AB_ERROR) problem = error_text("plan", self.host);
  if (problem.empty() && (status < AB_ERROR || status > AB_GIVE_UP)) {
    problem = "plan returned " + std::to_string(status) + ", which is no status";
  }
  if (!problem.empty()) {
    result.reason = problem;
    result.has_crashed = has_crashed();
    // Nothing of it is flown, and its pointer is the planner's.
    result.command = ab_command{};
    return result;
  }
  if (status == AB_GIVE_UP) {
    result.status = PlanStatus::gave_up;
    result.reason = self.host.take_error();
    return result;
  }
  result.status = status == AB_NO_PLAN ? PlanStatus::no_plan : PlanStatus::command;
  if (status == AB_OK && result.command.kind == AB_COMMAND_TRAJECTORY) {
    // Copied at once: the planner's array is its own again after the next call.
    result.points.assign(result.command.points, result.command.points + result.command.point_count);
  }
  result.command.points = nullptr;
  return result;
}

bool PlannerInstance::has_map() const {
  Internals& self = *internals_;
  if (self.table->get_extension == nullptr) return false;
  // Asked each time: a planner may have it from reset() on only.
  self.map = nullptr;
  escaped_exception(self.clock, [&] {
    const auto* map =
        static_cast<const ab_map*>(self.table->get_extension(self.instance, AB_MAP_EXTENSION));
    const bool is_table = map != nullptr && map->struct_size >= sizeof(ab_map);
    self.map = is_table && map->look_up != nullptr ? map : nullptr;
  });
  return self.map != nullptr;
}

std::optional<std::vector<PlaceKnown>> PlannerInstance::look_up(
    std::span<const Eigen::Vector3d> places_world) {
  if (!has_map()) return std::nullopt;
  Internals& self = *internals_;
  std::vector<double> points;
  points.reserve(3 * places_world.size());
  for (const Eigen::Vector3d& place : places_world) {
    points.insert(points.end(), {place.x(), place.y(), place.z()});
  }
  std::vector<std::uint8_t> answers(places_world.size(), AB_PLACE_UNKNOWN);
  ab_status status = AB_ERROR;
  self.meter.begin_call();
  const std::string escaped = escaped_exception(self.clock, [&] {
    status = self.map->look_up(self.instance, points.data(),
                               static_cast<std::uint32_t>(places_world.size()), answers.data());
  });
  // What the question took is charged to no call of the planner.
  self.meter.settle();
  self.program_time_s();
  self.host.take_error();
  if (!escaped.empty() || status != AB_OK) return std::nullopt;
  std::vector<PlaceKnown> known;
  known.reserve(answers.size());
  for (const std::uint8_t answer : answers) {
    if (answer > AB_PLACE_OCCUPIED) return std::nullopt;  // no answer that has a meaning
    known.push_back(static_cast<PlaceKnown>(answer));
  }
  return known;
}

bool PlannerInstance::has_crashed() const {
  return internals_->is_program && program_has_ended(internals_->instance);
}

bool PlannerInstance::was_killed() const {
  return internals_->is_program && program_was_killed(internals_->instance);
}

std::vector<std::string> PlannerInstance::take_log() { return internals_->host.take_log(); }

void PlannerInstance::want_drawings(bool wanted) { internals_->host.want_drawings(wanted); }

std::vector<Drawing> PlannerInstance::take_drawings() { return internals_->host.take_drawings(); }

}  // namespace avoidbench
