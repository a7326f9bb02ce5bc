/* Turns a plain C++17 class into the planner table of planner.h. Header-only; needs only the
 * standard library.
 *
 * SPDX-License-Identifier: MIT
 * Planners under any licence, including closed ones, may use this header and link with it.
 *
 *   class Drift {
 *    public:
 *     static constexpr const char* name = "drift";
 *     static constexpr std::uint32_t needs = AB_INPUT_STATE | AB_INPUT_DEPTH;
 *     static constexpr std::uint32_t commands = AB_COMMAND_VELOCITY;
 *     static constexpr std::array parameters{
 *         avoidbench::parameter("speed_mps", "m/s", 3.0, 0.1, 20.0, "Held until the goal.")};
 *     explicit Drift(const ab_setup& setup)
 *         : speed_mps_(avoidbench::Parameters<Drift>(setup).number("speed_mps")) {}
 *     void reset(const ab_mission& mission);
 *     std::optional<ab_command> plan(const ab_observation& seen);  // nullopt: no plan now
 *   };
 *   AVOIDBENCH_PLANNER(Drift)
 *
 * Optional members of the class:
 *   `static constexpr const char* version` and `summary`
 *   `profiles`: other sets of defaults (see profile())
 *   `least_fov_rad`: a std::array<double, 2>, the view across and down that each camera must have
 *   `files`: a std::array<const char*, n> that it depends on (see AB_FILES_EXTENSION)
 *   `static void check()`: throws if the planner can't fly, for example because its weights are
 *       damaged (see AB_CHECK_EXTENSION)
 *   `std::uint8_t place_at(const Vec3& point_world_m) const`: AB_PLACE_… (see AB_MAP_EXTENSION)
 *   a constructor (const ab_setup&, const ab_host&): Canvas and KnownWorld use the host
 *   `parameters` may be missing; if they name members, settings_from() fills these in.
 * An exception becomes AB_ERROR with its text; give_up("reason") ends the trial. The points of
 * ab_command.points must live until the next call. CurrentGoal follows missions with several goals;
 * tracks.hpp predicts where moving objects will be.
 */
#ifndef AVOIDBENCH_PLANNER_HPP
#define AVOIDBENCH_PLANNER_HPP

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <exception>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "avoidbench/canvas.hpp"
#include "avoidbench/goals.hpp"
#include "avoidbench/known_world.hpp"
#include "avoidbench/planner.h"
#include "avoidbench/tracks.hpp"
#include "avoidbench/views.hpp"

#if defined(__GNUC__)
#define AB_HIDDEN __attribute__((visibility("hidden")))
#else
#define AB_HIDDEN
#endif

namespace avoidbench {

/// `sizeof` as the struct_size of planner.h.
template <class Struct>
constexpr std::uint32_t struct_size_of() {
  return static_cast<std::uint32_t>(sizeof(Struct));
}

// declaring parameters

/// A number in [lowest, highest]. `name` includes the unit: "cruise_speed_mps".
constexpr ab_parameter parameter(const char* name, const char* unit, double preset, double lowest,
                                 double highest, const char* doc) {
  return {struct_size_of<ab_parameter>(),
          AB_NUMBER,
          name,
          unit,
          doc,
          lowest,
          highest,
          preset,
          nullptr,
          nullptr};
}

/// A whole number in [lowest, highest].
constexpr ab_parameter integer_parameter(const char* name, const char* unit, std::int32_t preset,
                                         std::int32_t lowest, std::int32_t highest,
                                         const char* doc) {
  return {struct_size_of<ab_parameter>(),
          AB_INTEGER,
          name,
          unit,
          doc,
          static_cast<double>(lowest),
          static_cast<double>(highest),
          static_cast<double>(preset),
          nullptr,
          nullptr};
}

/// One word of `choices`, which are separated by '|': "safe|fast".
constexpr ab_parameter choice_parameter(const char* name, const char* preset, const char* choices,
                                        const char* doc) {
  return {struct_size_of<ab_parameter>(), AB_CHOICE, name, "", doc, 0.0, 0.0, 0.0, choices, preset};
}

/// Any text, e.g. the path of a file.
constexpr ab_parameter text_parameter(const char* name, const char* preset, const char* doc) {
  return {struct_size_of<ab_parameter>(), AB_TEXT, name, "", doc, 0.0, 0.0, 0.0, nullptr, preset};
}

/// While the choice parameter `choice` has the word `word`, the parameters in `numbers`, a static
/// array, default to these numbers:
///   static constexpr std::array published{ab_named_number{"speed_mps", 2.0}};
///   static constexpr std::array profiles{avoidbench::profile("preset", "published", published)};
template <std::size_t count>
constexpr ab_profile profile(const char* choice, const char* word,
                             const std::array<ab_named_number, count>& numbers) {
  return {struct_size_of<ab_profile>(), static_cast<std::uint32_t>(count), choice, word,
          numbers.data()};
}

/// A parameter with the member of a planner's settings that takes its value; see settings_from.
template <class Settings>
struct Setting {
  ab_parameter parameter;
  void (*assign)(Settings& settings, const ab_value& value);  ///< null where no member takes it
};

namespace detail AB_HIDDEN {

template <class Settings, class First, class... Rest>
constexpr auto& member_of(Settings& settings, First first, Rest... rest) {
  if constexpr (sizeof...(rest) == 0) {
    return settings.*first;
  } else {
    return member_of(settings.*first, rest...);
  }
}

template <class Pointer>
struct OwnerOf;
template <class Owner, class Member>
struct OwnerOf<Member Owner::*> {
  using Type = Owner;
};

/// The member at the end of a way of member pointers, from the settings inward.
template <auto first, auto... inner>
struct MemberAt {
  using Settings = typename OwnerOf<decltype(first)>::Type;
  using Value =
      std::remove_reference_t<decltype(member_of(std::declval<Settings&>(), first, inner...))>;

  static void assign(Settings& settings, const ab_value& value) {
    Value& member = member_of(settings, first, inner...);
    if constexpr (std::is_arithmetic_v<Value>) {
      member = static_cast<Value>(value.number);
    } else {
      member = value.text != nullptr ? value.text : "";
    }
  }

  /// In a constant the throw is an error of the compiler.
  static constexpr Setting<Settings> setting(const ab_parameter& parameter) {
    const bool fits = std::is_floating_point_v<Value> ? parameter.kind == AB_NUMBER
                      : std::is_integral_v<Value>
                          ? parameter.kind == AB_INTEGER
                          : parameter.kind == AB_CHOICE || parameter.kind == AB_TEXT;
    if (!fits) throw std::logic_error("a parameter of another kind than its member");
    return {parameter, &assign};
  }
};

}  // namespace AB_HIDDEN

/// The same declarations, each with the member that takes the value, a double, an int or a string:
/// `parameter<&Settings::speed_mps>("speed_mps", …)`. For a member of a member, name both:
/// `parameter<&Settings::grid, &Grid::resolution_m>("resolution_m", …)`.
template <auto first, auto... inner>
constexpr auto parameter(const char* name, const char* unit, double preset, double lowest,
                         double highest, const char* doc) {
  return detail::MemberAt<first, inner...>::setting(
      parameter(name, unit, preset, lowest, highest, doc));
}
template <auto first, auto... inner>
constexpr auto integer_parameter(const char* name, const char* unit, std::int32_t preset,
                                 std::int32_t lowest, std::int32_t highest, const char* doc) {
  return detail::MemberAt<first, inner...>::setting(
      integer_parameter(name, unit, preset, lowest, highest, doc));
}
template <auto first, auto... inner>
constexpr auto choice_parameter(const char* name, const char* preset, const char* choices,
                                const char* doc) {
  return detail::MemberAt<first, inner...>::setting(choice_parameter(name, preset, choices, doc));
}
template <auto first, auto... inner>
constexpr auto text_parameter(const char* name, const char* preset, const char* doc) {
  return detail::MemberAt<first, inner...>::setting(text_parameter(name, preset, doc));
}

/// The settings with the values of `setup` for `parameters`, all that the planner declares.
template <class Settings, std::size_t count>
Settings settings_from(const std::array<Setting<Settings>, count>& parameters,
                       const ab_setup& setup) {
  if (setup.value_count < count) throw std::logic_error("the host gave too few values");
  Settings settings{};
  for (std::size_t i = 0; i < count; ++i) {
    if (parameters[i].assign != nullptr) parameters[i].assign(settings, *setup.values[i]);
  }
  return settings;
}

// while flying
/// A planner throws it if it knows that it cannot reach the goal; the trial ends with
/// planner_gave_up and this reason.
class GiveUp : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

[[noreturn]] inline void give_up(const std::string& reason) { throw GiveUp(reason); }

/// A command of this kind with everything else zero.
inline ab_command make_command(std::uint32_t kind) {
  ab_command command{};
  command.struct_size = struct_size_of<ab_command>();
  command.kind = kind;
  return command;
}

inline ab_command make_position_command(const Vec3& position_world_m, double yaw_rad) {
  ab_command command = make_command(AB_COMMAND_POSITION);
  std::copy(position_world_m.begin(), position_world_m.end(), command.position_world_m);
  command.yaw_rad = yaw_rad;
  return command;
}

inline ab_command make_velocity_command(const Vec3& velocity_world_mps, double yaw_rad) {
  ab_command command = make_command(AB_COMMAND_VELOCITY);
  std::copy(velocity_world_mps.begin(), velocity_world_mps.end(), command.velocity_world_mps);
  command.yaw_rad = yaw_rad;
  return command;
}

/// As make_velocity_command, turning at `yaw_rate_radps`.
inline ab_command make_velocity_yaw_rate_command(const Vec3& velocity_world_mps,
                                                 double yaw_rate_radps) {
  ab_command command = make_velocity_command(velocity_world_mps, 0.0);
  command.flags = AB_YAW_IS_RATE;
  command.yaw_rate_radps = yaw_rate_radps;
  return command;
}

inline ab_command make_acceleration_command(const Vec3& acceleration_world_mps2, double yaw_rad) {
  ab_command command = make_command(AB_COMMAND_ACCELERATION);
  std::copy(acceleration_world_mps2.begin(), acceleration_world_mps2.end(),
            command.acceleration_world_mps2);
  command.yaw_rad = yaw_rad;
  return command;
}

/// `points`: at least 2, times rising from 0. Not copied: keep them as a member of the planner.
inline ab_command make_trajectory_command(const std::vector<ab_point>& points) {
  ab_command command = make_command(AB_COMMAND_TRAJECTORY);
  command.points = points.data();
  command.point_count = static_cast<std::uint32_t>(points.size());
  return command;
}

/// `thrust_mps2` is collective and mass-normalised: 9.81 hovers.
inline ab_command make_rates_command(const Vec3& rates_body_radps, double thrust_mps2) {
  ab_command command = make_command(AB_COMMAND_RATES);
  std::copy(rates_body_radps.begin(), rates_body_radps.end(), command.rates_body_radps);
  command.thrust_mps2 = thrust_mps2;
  return command;
}

// class to table

/// Hidden, so that equally named planners in two libraries never share a variable.
namespace detail AB_HIDDEN {

template <class Planner, class = void>
struct Version {
  static constexpr const char* text = "0";
};
template <class Planner>
struct Version<Planner, std::void_t<decltype(Planner::version)>> {
  static constexpr const char* text = Planner::version;
};

template <class Planner, class = void>
struct Summary {
  static constexpr const char* text = "";
};
template <class Planner>
struct Summary<Planner, std::void_t<decltype(Planner::summary)>> {
  static constexpr const char* text = Planner::summary;
};

constexpr const ab_parameter* declared(const ab_parameter& parameter) { return &parameter; }
template <class Settings>
constexpr const ab_parameter* declared(const Setting<Settings>& setting) {
  return &setting.parameter;
}

template <class Planner, class = void>
struct Declared {
  static constexpr std::size_t count = 0;
  static constexpr const ab_parameter* const* pointers = nullptr;
};
template <class Planner>
struct Declared<Planner, std::void_t<decltype(Planner::parameters)>> {
  static constexpr std::size_t count = Planner::parameters.size();
  template <std::size_t... index>
  static constexpr std::array<const ab_parameter*, count> pointers_to(
      std::index_sequence<index...>) {
    return {declared(Planner::parameters[index])...};
  }
  static constexpr std::array<const ab_parameter*, count> array =
      pointers_to(std::make_index_sequence<count>());
  static constexpr const ab_parameter* const* pointers = array.data();
};

template <class Planner, class = void>
struct Profiles {
  static constexpr std::size_t count = 0;
  static constexpr const ab_profile* const* pointers = nullptr;
};
template <class Planner>
struct Profiles<Planner, std::void_t<decltype(Planner::profiles)>> {
  static constexpr std::size_t count = Planner::profiles.size();
  template <std::size_t... index>
  static constexpr std::array<const ab_profile*, count> pointers_to(std::index_sequence<index...>) {
    return {&Planner::profiles[index]...};
  }
  static constexpr std::array<const ab_profile*, count> array =
      pointers_to(std::make_index_sequence<count>());
  static constexpr const ab_profile* const* pointers = array.data();
};

template <class Planner, class = void>
struct LeastFov {
  static constexpr std::array<double, 2> rad{};
};
template <class Planner>
struct LeastFov<Planner, std::void_t<decltype(Planner::least_fov_rad)>> {
  static constexpr std::array<double, 2> rad = Planner::least_fov_rad;
};

template <class Planner, class = void>
struct Files {
  static const ab_files* table() { return nullptr; }
};
template <class Planner>
struct Files<Planner, std::void_t<decltype(Planner::files)>> {
  static constexpr ab_files value{struct_size_of<ab_files>(),
                                  static_cast<std::uint32_t>(Planner::files.size()),
                                  Planner::files.data()};
  static const ab_files* table() { return &value; }
};

template <class Planner, class = void>
struct Check {
  static const ab_check* table() { return nullptr; }
};
template <class Planner>
struct Check<Planner, std::void_t<decltype(Planner::check())>> {
  static const char* problem() {
    static std::string text;
    text.clear();
    try {
      Planner::check();
    } catch (const std::exception& error) {
      text = error.what();
      if (text.empty()) text = "its check failed";
    } catch (...) {
      text = "its check threw what is no exception";
    }
    return text.empty() ? nullptr : text.c_str();
  }
  static constexpr ab_check value{struct_size_of<ab_check>(), 0, &problem};
  static const ab_check* table() { return &value; }
};

template <class Planner>
struct Instance {
  Instance(const ab_host& given_host, const ab_setup& setup)
      : host(&given_host), planner(made(setup, given_host)) {}

  static Planner made(const ab_setup& setup, const ab_host& given_host) {
    if constexpr (std::is_constructible_v<Planner, const ab_setup&, const ab_host&>) {
      return Planner(setup, given_host);
    } else {
      static_cast<void>(given_host);
      return Planner(setup);
    }
  }

  const ab_host* host;
  Planner planner;
};

/// Runs `call` and turns what it throws into a status, and passes the text to the host.
template <class Call>
ab_status guarded(const ab_host* host, Call&& call) noexcept {
  try {
    return call();
  } catch (const GiveUp& reason) {
    host->set_error(host->context, reason.what());
    return AB_GIVE_UP;
  } catch (const std::exception& error) {
    host->set_error(host->context,
                    *error.what() != '\0' ? error.what() : "an exception without text");
  } catch (...) {
    host->set_error(host->context, "an exception that is no std::exception");
  }
  return AB_ERROR;
}

template <class Planner>
void* create(const ab_host* host, const ab_setup* setup) {
  void* made = nullptr;
  guarded(host, [&]() -> ab_status {
    made = new Instance<Planner>(*host, *setup);
    return AB_OK;
  });
  return made;
}

template <class Planner>
void destroy(void* instance) {
  delete static_cast<Instance<Planner>*>(instance);
}

template <class Planner>
ab_status reset(void* instance, const ab_mission* mission) {
  Instance<Planner>& self = *static_cast<Instance<Planner>*>(instance);
  return guarded(self.host, [&]() -> ab_status {
    self.planner.reset(*mission);
    return AB_OK;
  });
}

template <class Planner>
ab_status plan(void* instance, const ab_observation* observation, ab_command* command) {
  Instance<Planner>& self = *static_cast<Instance<Planner>*>(instance);
  return guarded(self.host, [&]() -> ab_status {
    const std::optional<ab_command> planned = self.planner.plan(*observation);
    if (!planned) return AB_NO_PLAN;
    const std::uint32_t room =
        command->struct_size;  // an older host's struct may be shorter than ours
    std::memcpy(command, &*planned, std::min<std::size_t>(room, sizeof(ab_command)));
    command->struct_size = room;
    return AB_OK;
  });
}

template <class Planner, class = void>
struct Map {
  static const ab_map* table() { return nullptr; }
};
template <class Planner>
struct Map<Planner, std::void_t<decltype(std::declval<const Planner&>().place_at(Vec3{}))>> {
  static ab_status look_up(void* instance, const double* points_world_m, std::uint32_t point_count,
                           std::uint8_t* places) {
    Instance<Planner>& self = *static_cast<Instance<Planner>*>(instance);
    return guarded(self.host, [&]() -> ab_status {
      const Planner& planner = self.planner;
      for (std::uint32_t i = 0; i < point_count; ++i) {
        const double* const point = points_world_m + 3 * static_cast<std::size_t>(i);
        places[i] = planner.place_at(Vec3{point[0], point[1], point[2]});
      }
      return AB_OK;
    });
  }
  static const ab_map* table() {
    static constexpr ab_map value{struct_size_of<ab_map>(), 0, &look_up};
    return &value;
  }
};

/// AB_FILES_EXTENSION and AB_CHECK_EXTENSION are asked for without an instance, others are of one.
template <class Planner>
const void* get_extension(void* instance, const char* id) {
  if (id == nullptr) return nullptr;
  const std::string_view name = id;
  if (name == AB_FILES_EXTENSION) return Files<Planner>::table();
  if (name == AB_CHECK_EXTENSION) return Check<Planner>::table();
  if (name == AB_MAP_EXTENSION && instance != nullptr) return Map<Planner>::table();
  return nullptr;
}

template <class Planner>
struct Table {
  static constexpr ab_planner value{struct_size_of<ab_planner>(),
                                    AVOIDBENCH_ABI_VERSION,
                                    Planner::name,
                                    Version<Planner>::text,
                                    Summary<Planner>::text,
                                    Planner::needs,
                                    Planner::commands,
                                    static_cast<std::uint32_t>(Declared<Planner>::count),
                                    0,
                                    Declared<Planner>::pointers,
                                    &create<Planner>,
                                    &destroy<Planner>,
                                    &reset<Planner>,
                                    &plan<Planner>,
                                    &get_extension<Planner>,
                                    static_cast<std::uint32_t>(Profiles<Planner>::count),
                                    0,
                                    Profiles<Planner>::pointers,
                                    LeastFov<Planner>::rad[0],
                                    LeastFov<Planner>::rad[1]};
};

}  // namespace AB_HIDDEN

/// The values of `Planner::parameters` in a setup, by name. Throws for a name that is not declared
/// or has another kind, so that create fails with that text.
template <class Planner>
class AB_HIDDEN Parameters {
 public:
  explicit Parameters(const ab_setup& setup) : setup_(&setup) {}

  double number(std::string_view name) const { return value(name, AB_NUMBER, AB_INTEGER).number; }
  std::int64_t integer(std::string_view name) const {
    return static_cast<std::int64_t>(value(name, AB_INTEGER, AB_INTEGER).number);
  }
  std::string text(std::string_view name) const {
    const char* found = value(name, AB_CHOICE, AB_TEXT).text;
    return found != nullptr ? found : "";
  }

 private:
  const ab_value& value(std::string_view name, std::int32_t kind, std::int32_t other_kind) const {
    constexpr std::size_t count = detail::Declared<Planner>::count;
    for (std::size_t i = 0; i < count; ++i) {
      const ab_parameter& declared = *detail::Declared<Planner>::pointers[i];
      if (name != declared.name) continue;
      if (declared.kind != kind && declared.kind != other_kind) {
        throw std::logic_error("parameter " + std::string(name) + " is of another kind");
      }
      if (i >= setup_->value_count)
        throw std::logic_error("the host gave no value for " + std::string(name));
      return *setup_->values[i];
    }
    throw std::logic_error("no parameter " + std::string(name) + " is declared");
  }

  const ab_setup* setup_;
};

}  // namespace avoidbench

/// Exports `Class` as the planner of this library. Use it once per library, outside any namespace.
#define AVOIDBENCH_PLANNER(Class)                                                          \
  extern "C" AB_EXPORT const ab_planner* avoidbench_planner_v1(std::uint32_t host_api) {   \
    return host_api == AVOIDBENCH_ABI_VERSION ? &::avoidbench::detail::Table<Class>::value \
                                              : nullptr;                                   \
  }

#endif
