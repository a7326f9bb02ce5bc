#pragma once

#include <concepts>
#include <limits>
#include <string_view>
#include <type_traits>
#include <variant>

namespace avoidbench {

/// The values a number may take, ends included.
struct Range {
  double lowest = -std::numeric_limits<double>::infinity();
  double highest = std::numeric_limits<double>::infinity();
};

/// `T` is Spec, const or not: what readers fill in and the others look at.
template <class T, class Spec>
concept ConstOr = std::same_as<std::remove_const_t<T>, Spec>;

/// Each spec struct has one free function beside it,
///
///     template <class Visitor, ConstOr<ForestSpec> Spec>
///     void visit(Visitor& v, Spec& s) {
///       v.field("poisson_radius_m", s.poisson_radius_m, Range{0.5, 50},
///               "Least distance between two plants.");
///       …
///     }
///
/// which names every field once, with its range and doc. The YAML reader, the tree of fields that
/// help and schemas are made from, the canonical JSON and with it the trial's key are visitors;
/// those that only read take a const spec. A name is the YAML key, the C++ member and the column,
/// with its unit.
///
/// A field is a double, an integer, a bool, a std::string, an enum with EnumText, a std::array or
/// std::vector of these, another spec struct, or a std::variant of spec structs, of which each has
/// `static constexpr std::string_view kind`:
///
///     v.variant("generator", s.map, "What makes the map.");
///
/// which reads the key `generator` first and then the fields of that kind, on the same level.
template <class T, class Visitor>
concept Visitable = requires(Visitor& visitor, T& value) {
  visit(visitor, value);
};

template <class T>
struct IsVariant : std::false_type {};
template <class... Kinds>
struct IsVariant<std::variant<Kinds...>> : std::true_type {};

/// The text of the kind that `variant` holds.
template <class... Kinds>
std::string_view kind(const std::variant<Kinds...>& variant) {
  return std::visit([](const auto& held) { return std::remove_cvref_t<decltype(held)>::kind; },
                    variant);
}

}  // namespace avoidbench
