#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace avoidbench {

/// Specialise for each enum that is written to disk: `static constexpr std::pair<E,
/// std::string_view> entries[]`, each enumerator beside its text, which is its name.
template <class E>
struct EnumText;

template <class E>
concept TextEnum = requires {
  EnumText<E>::entries;
};

/// The enumerator's text on disk.
template <TextEnum E>
std::string_view text(E value) {
  for (const auto& [enumerator, name] : EnumText<E>::entries) {
    if (enumerator == value) return name;
  }
  return "?";
}

/// The enumerator of this text, or nothing.
template <TextEnum E>
std::optional<E> enum_from_text(std::string_view name) {
  for (const auto& [enumerator, entry] : EnumText<E>::entries) {
    if (entry == name) return enumerator;
  }
  return std::nullopt;
}

template <TextEnum E>
std::vector<std::string> enum_texts() {
  std::vector<std::string> names;
  for (const auto& [enumerator, name] : EnumText<E>::entries) names.emplace_back(name);
  return names;
}

}  // namespace avoidbench
