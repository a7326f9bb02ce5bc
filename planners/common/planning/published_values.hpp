#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <string_view>

#include "avoidbench/planner.hpp"

namespace planning {

/// What a planner's authors published for one parameter.
struct PublishedValue {
  std::string_view name;
  double value;
};

/// The parameter of planners that have `PublishedValues`.
inline constexpr ab_parameter kPreset = avoidbench::choice_parameter(
    "preset", "avoidbench", "avoidbench|published",
    "published: each parameter that is left at its default takes its authors' figure.");

/// The numbers of a setup, where `preset: published` gives the authors' figures to parameters that
/// are left at their defaults. `Planner` declares `parameters`, kPreset among them. Names that it
/// does not declare throw std::logic_error.
template <class Planner, std::size_t count>
class PublishedValues {
 public:
  PublishedValues(const ab_setup& setup, const std::array<PublishedValue, count>& published)
      : given_(setup), published_(published), is_published_(given_.text("preset") == "published") {}

  double number(std::string_view name) const {
    const double given = given_.number(name);
    if (!is_published_ || !is_default(name, given)) return given;
    const auto found =
        std::find_if(published_.begin(), published_.end(),
                     [&](const PublishedValue& figure) { return figure.name == name; });
    return found != published_.end() ? found->value : given;
  }
  int integer(std::string_view name) const { return static_cast<int>(number(name)); }

 private:
  static bool is_default(std::string_view name, double value) {
    return std::any_of(Planner::parameters.begin(), Planner::parameters.end(),
                       [&](const ab_parameter& declared) {
                         return name == declared.name && value == declared.preset;
                       });
  }

  avoidbench::Parameters<Planner> given_;
  std::array<PublishedValue, count> published_;
  bool is_published_;
};

}  // namespace planning
