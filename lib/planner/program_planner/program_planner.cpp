#include "program_planner/program_planner.hpp"

#include <unistd.h>

#include <array>
#include <cstdlib>
#include <exception>
#include <memory>
#include <mutex>
#include <optional>
#include <string_view>
#include <utility>

#include "base/input_error.hpp"
#include "base/utf8.hpp"
#include "program_planner/flat_structs.hpp"
#include "program_planner/started_program.hpp"

namespace avoidbench {
namespace {

using ProgramPointer = std::unique_ptr<StartedProgram>;

/// One planner of this process, with the programs that serve it and have nothing to do.
struct ServedPlanner {
  PlannerSource source;
  std::string state;  ///< of the file, when it was asked
  std::unique_ptr<DescribedTable> described;
  std::mutex mutex;
  std::vector<ProgramPointer> idle;
  pid_t process = 0;
};

struct ProgramInstance {
  ServedPlanner* planner = nullptr;
  const ab_host* host = nullptr;
  std::vector<std::byte> setup;  ///< as it lay in the segment, for a program that takes over
  std::uint64_t setup_offset = 0;
  ProgramPointer program;
  std::vector<ab_point> points;
  double used_before_s = 0.0;  ///< less than 0: what the program had used before the instance
  bool has_ended = false, was_killed = false;
};

/// Somebody else's signal, such as the SIGKILL of a kernel short of memory, is no planner's
/// failure; one that comes again is taken for its own.
constexpr int kMostStarts = 2;

std::string name_of(const ServedPlanner& planner) {
  return planner.source.file.filename().string();
}

struct Described {
  ProgramPointer program;
  std::unique_ptr<DescribedTable> table;
};

/// Starts a program and asks what it is.
Described described_program(const PlannerSource& source, int starts_left = kMostStarts) {
  const std::string name = source.file.filename().string();
  auto program = std::make_unique<StartedProgram>(source);
  try {
    const FlatAnswer answer(program->ask(AB_PROCESS_HELLO, {}));
    if (answer.head().status != AB_OK) {
      const bool has_text = answer.head().error != 0;
      constexpr std::size_t kMostBytes = 1000;  // shown to people as it is
      throw BadAnswer(
          has_text ? shortened(answer.text(answer.head().error, "an error's text"), kMostBytes)
                   : "it refuses without saying why");
    }
    return {std::move(program), std::make_unique<DescribedTable>(answer)};
  } catch (const BadAnswer& bad) {
    throw InputError("the program " + name + " does not describe itself: " + bad.what());
  } catch (const ProgramFault& fault) {
    if (fault.was_killed && starts_left > 1) return described_program(source, starts_left - 1);
    throw InputError(std::string(fault.what()) + " before it described itself as a planner");
  }
}

bool are_alike(const ab_planner& a, const ab_planner& b) {
  const auto same = [](const char* one, const char* other) {
    return std::string_view(one != nullptr ? one : "") ==
           std::string_view(other != nullptr ? other : "");
  };
  return same(a.name, b.name) && same(a.version, b.version) &&
         // program_table() has added the flag to one of them.
         (a.needs | AB_USES_PROCESSES) == (b.needs | AB_USES_PROCESSES) &&
         a.commands == b.commands && a.parameter_count == b.parameter_count;
}

/// Programs of the process that this one was forked from are not its own: forgotten, not ended.
void forget_others(ServedPlanner& planner) {
  if (planner.process == ::getpid()) return;
  for (ProgramPointer& program : planner.idle) static_cast<void>(program.release());
  planner.idle.clear();
  planner.process = ::getpid();
}

ProgramPointer taken_program(ServedPlanner& planner) {
  {
    const std::lock_guard lock(planner.mutex);
    forget_others(planner);
    while (!planner.idle.empty()) {
      ProgramPointer program = std::move(planner.idle.back());
      planner.idle.pop_back();
      // One that died while it had nothing to do is no trial's failure: another one starts.
      if (program->still_lives()) return program;
    }
  }
  // Not under the lock: a start takes long, and other instances want their programs.
  Described described = described_program(planner.source);
  // The file may have been written over since; its table would no longer be true.
  if (!are_alike(described.table->table, planner.described->table)) {
    throw InputError("the program " + name_of(planner) +
                     " describes itself otherwise than when it was started first");
  }
  return std::move(described.program);
}

/// Only sound programs come here: asked() has dropped the others.
void give_back(ServedPlanner& planner, ProgramPointer program) {
  if (program == nullptr || !program->is_alive()) return;
  const std::lock_guard lock(planner.mutex);
  forget_others(planner);
  planner.idle.push_back(std::move(program));
}

/// Keeps the CPU time of a program that is gone.
void drop_program(ProgramInstance& self) {
  if (self.program != nullptr) self.used_before_s += self.program->cpu_time_s();
  self.program.reset();
}

void take_log(const ProgramInstance& self, const FlatAnswer& answer) {
  constexpr std::uint32_t kMostLines = 1000;
  const std::uint32_t count = answer.head().log_count;
  if (count > kMostLines) throw BadAnswer("it has too many lines of log");
  for (const ab_process_log& line :
       answer.array<ab_process_log>(answer.head().log, count, "the log")) {
    self.host->log(self.host->context, line.level,
                   answer.text(line.text, "a line of the log").c_str());
  }
}

void tell_error(const ProgramInstance& self, const std::string& text) {
  self.host->set_error(self.host->context, text.c_str());
}

/// One request. `read` gets the answer where the status is AB_OK. A program that answers wrongly is
/// ended: nobody knows what it would do next.
template <class Write, class Read>
ab_status asked(ProgramInstance& self, std::uint32_t kind, Write&& write, Read&& read) {
  self.has_ended = self.was_killed = false;
  try {
    if (self.program == nullptr) {
      // Nothing can be asked until reset() starts another.
      throw ProgramFault("the program " + name_of(*self.planner) + " has ended before", true);
    }
    const FlatAnswer answer(self.program->ask(kind, write));
    // First, so that people see it where the rest of the answer is wrong.
    take_log(self, answer);
    if (answer.head().error != 0) tell_error(self, answer.text(answer.head().error, "the error"));
    if (answer.head().status == AB_OK) read(answer);
    return answer.head().status;
  } catch (const ProgramFault& fault) {
    self.has_ended = fault.has_ended;
    self.was_killed = fault.was_killed;
    tell_error(self, fault.what());
  } catch (const BadAnswer& bad) {
    tell_error(self,
               "the program " + name_of(*self.planner) + " gave an invalid answer: " + bad.what());
  } catch (const std::exception& error) {
    tell_error(self, error.what());
  }
  drop_program(self);
  return AB_ERROR;
}

constexpr auto kNothing = [](const FlatAnswer&) {};

/// Gives the instance a program that has been told the setup.
ab_status begin_program(ProgramInstance& self,
                        const std::function<std::uint64_t(Segment&)>& write_setup,
                        int starts_left = kMostStarts) {
  try {
    self.program = taken_program(*self.planner);
  } catch (const InputError& error) {
    tell_error(self, error.what());
    return AB_ERROR;
  }
  // What it has used for instances before is not this one's.
  self.used_before_s -= self.program->cpu_time_s();
  const ab_status status = asked(self, AB_PROCESS_CREATE, write_setup, kNothing);
  if (!self.was_killed || starts_left == 1) return status;
  return begin_program(self, write_setup, starts_left - 1);
}

void* create_instance(ServedPlanner& planner, const ab_host* host, const ab_setup* setup) {
  auto self = std::make_unique<ProgramInstance>();
  self->planner = &planner;
  self->host = host;
  const ab_status status = begin_program(*self, [&](Segment& segment) {
    self->setup_offset = write_flat(segment, *setup);
    self->setup = segment.body_bytes();
    return self->setup_offset;
  });
  if (status == AB_OK) return self.release();
  // A program that refuses a setup is sound and serves the next one.
  give_back(planner, std::move(self->program));
  return nullptr;
}

void destroy_instance(void* instance) {
  const std::unique_ptr<ProgramInstance> self(static_cast<ProgramInstance*>(instance));
  if (self->program == nullptr) return;
  // Its status tells nothing more: a program that fails here is dropped by asked().
  asked(*self, AB_PROCESS_DESTROY, std::function<std::uint64_t(Segment&)>(), kNothing);
  give_back(*self->planner, std::move(self->program));
}

ab_status reset_instance(void* instance, const ab_mission* mission) {
  ProgramInstance& self = *static_cast<ProgramInstance*>(instance);
  if (self.program == nullptr) {
    // The one that flew the last trial ended in it; this trial is flown by another.
    // The same bytes at the same place: the offsets in them still hold.
    const ab_status status = begin_program(self, [&self](Segment& segment) {
      segment.add(self.setup.data(), self.setup.size());
      return self.setup_offset;
    });
    if (status != AB_OK) return AB_ERROR;
  }
  return asked(
      self, AB_PROCESS_RESET, [mission](Segment& segment) { return write_flat(segment, *mission); },
      kNothing);
}

ab_status plan_in_program(void* instance, const ab_observation* observation, ab_command* command) {
  ProgramInstance& self = *static_cast<ProgramInstance*>(instance);
  return asked(
      self, AB_PROCESS_PLAN,
      [observation](Segment& segment) { return write_flat(segment, *observation); },
      [&](const FlatAnswer& answer) {
        // The caller's word of how much it can read, not the program's.
        const std::uint32_t size = command->struct_size;
        *command = read_command(answer, self.points);
        command->struct_size = size;
      });
}

/// The planners of this process. create() is told no context: each planner has one of its own,
/// which knows its slot.
constexpr std::size_t kMostSlots = 128;

struct Slots {
  std::mutex mutex;
  std::array<std::unique_ptr<ServedPlanner>, kMostSlots> planners;
  std::size_t count = 0;
};

Slots& slots() {
  static Slots* all = new Slots;  // never destroyed: instances may outlive everything static
  return *all;
}

template <std::size_t slot>
void* create_in_slot(const ab_host* host, const ab_setup* setup) {
  return create_instance(*slots().planners[slot], host, setup);
}

template <std::size_t slot>
const void* extension_of_slot(void*, const char* id) {
  const bool is_files = id != nullptr && std::string_view(id) == AB_FILES_EXTENSION;
  return is_files ? slots().planners[slot]->described->files() : nullptr;
}

struct SlotFunctions {
  void* (*create)(const ab_host*, const ab_setup*);
  const void* (*get_extension)(void*, const char*);
};

template <std::size_t... slot>
constexpr std::array<SlotFunctions, kMostSlots> functions_of(std::index_sequence<slot...>) {
  return {SlotFunctions{&create_in_slot<slot>, &extension_of_slot<slot>}...};
}

constexpr auto kSlotFunctions = functions_of(std::make_index_sequence<kMostSlots>());

/// What changes when the file is written to.
std::string state_of_file(const std::filesystem::path& file) {
  std::error_code error;
  const auto size = std::filesystem::file_size(file, error);
  const auto time = std::filesystem::last_write_time(file, error).time_since_epoch().count();
  return std::to_string(size) + " " + std::to_string(time);
}

/// Ends what has nothing to do, with all that it has started.
/// The death signal of exit alone would spare what they have started.
void end_idle_programs() {
  for (const auto& planner : slots().planners) {
    if (planner == nullptr) continue;
    const std::lock_guard lock(planner->mutex);
    forget_others(*planner);
    planner->idle.clear();
  }
}

}  // namespace

const ab_planner* program_table(PlannerSource source) {
  source.file = std::filesystem::absolute(source.file).lexically_normal();
  const std::string state = state_of_file(source.file);
  Slots& all = slots();
  const std::lock_guard lock(all.mutex);
  // A file that was written to is another planner, with programs of its own.
  for (std::size_t i = 0; i < all.count; ++i) {
    const ServedPlanner& known = *all.planners[i];
    if (known.source.file == source.file && known.source.command == source.command &&
        known.state == state) {
      return &known.described->table;
    }
  }
  if (all.count == kMostSlots) {
    throw InputError("more than " + std::to_string(kMostSlots) +
                     " planners that are programs in one process");
  }
  if (all.count == 0) std::atexit(end_idle_programs);
  auto planner = std::make_unique<ServedPlanner>();
  planner->source = std::move(source);
  planner->state = state;
  planner->process = ::getpid();
  Described described = described_program(planner->source);
  planner->described = std::move(described.table);
  ab_planner& table = planner->described->table;
  // Without it the worker's sandbox would let nothing start.
  table.needs |= AB_USES_PROCESSES;
  // A program's own functions are in another process: these ask it.
  const SlotFunctions& functions = kSlotFunctions[all.count];
  table.create = functions.create;
  table.destroy = destroy_instance;
  table.reset = reset_instance;
  table.plan = plan_in_program;
  table.get_extension = functions.get_extension;
  // It has described itself already and serves the first instance.
  planner->idle.push_back(std::move(described.program));
  all.planners[all.count] = std::move(planner);
  return &all.planners[all.count++]->described->table;
}

bool is_program_table(const ab_planner& table) { return table.destroy == &destroy_instance; }

double program_cpu_time_s(const void* instance) {
  const ProgramInstance& self = *static_cast<const ProgramInstance*>(instance);
  return self.used_before_s + (self.program != nullptr ? self.program->cpu_time_s() : 0.0);
}

bool program_has_ended(const void* instance) {
  return static_cast<const ProgramInstance*>(instance)->has_ended;
}

bool program_was_killed(const void* instance) {
  return static_cast<const ProgramInstance*>(instance)->was_killed;
}

}  // namespace avoidbench
