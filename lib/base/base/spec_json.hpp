#pragma once

#include <array>
#include <cmath>
#include <concepts>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "base/check.hpp"
#include "base/enum_text.hpp"
#include "base/fields.hpp"

/// Specs as JSON and back, through their visit(). Used between the processes of a run, in databases
/// and for the trial's key: keys are sorted, numbers are printed with the fewest digits that read
/// back to the same bits. For input from people see config/: what comes here was checked before.
namespace avoidbench {

template <class Spec>
nlohmann::json spec_to_json(const Spec& spec);

/// Without the fields that are at their defaults, in nested specs neither; kinds of variants stay.
/// A field that a later program adds, at its default, changes nothing of it.
template <class Spec>
nlohmann::json sparse_json(const Spec& spec);

/// A field that is not there is at its default, or, with `needs_all`, throws as one does whose
/// value is of another type: nlohmann::json::exception.
template <class Spec>
Spec spec_from_json(const nlohmann::json& json, bool needs_all = false);

namespace detail {

template <class T>
nlohmann::json value_to_json(const T& value);
template <class T>
void value_from_json(const nlohmann::json& json, T& value, bool needs_all);

struct JsonWriter {
  nlohmann::json& json;

  template <class T>
  void field(std::string_view name, const T& value, Range, std::string_view) {
    json[std::string(name)] = value_to_json(value);
  }
  template <class T>
  void field(std::string_view name, const T& value, std::string_view doc = {}) {
    field(name, value, Range{}, doc);
  }
  template <class Variant>
  void variant(std::string_view name, const Variant& value, std::string_view) {
    json[std::string(name)] = std::string(kind(value));
    std::visit([this](const auto& held) { visit(*this, held); }, value);
  }
};

template <class T>
nlohmann::json sparse_value(const T& value);

/// Writes the fields that differ from `defaults`, the same spec's at its defaults.
struct SparseJsonWriter {
  nlohmann::json& json;
  const nlohmann::json& defaults;

  template <class T>
  void field(std::string_view name, const T& value, Range, std::string_view) {
    const std::string key(name);
    if (value_to_json(value) != defaults.at(key)) json[key] = sparse_value(value);
  }
  template <class T>
  void field(std::string_view name, const T& value, std::string_view doc = {}) {
    field(name, value, Range{}, doc);
  }
  template <class Variant>
  void variant(std::string_view name, const Variant& value, std::string_view) {
    json[std::string(name)] = std::string(kind(value));
    std::visit([this](const auto& held) { json.update(sparse_json(held)); }, value);
  }
};

struct JsonReader {
  const nlohmann::json& json;
  bool needs_all = false;

  template <class T>
  void field(std::string_view name, T& value, Range, std::string_view) {
    const std::string key(name);
    if (needs_all || json.contains(key)) value_from_json(json.at(key), value, needs_all);
  }
  template <class T>
  void field(std::string_view name, T& value, std::string_view doc = {}) {
    field(name, value, Range{}, doc);
  }
  template <class Variant>
  void variant(std::string_view name, Variant& value, std::string_view) {
    const std::string wanted = json.at(std::string(name));
    read_kind<Variant, 0>(wanted, value);
  }

 private:
  template <class Variant, std::size_t index>
  void read_kind(const std::string& wanted, Variant& value) {
    if constexpr (index < std::variant_size_v<Variant>) {
      using Kind = std::variant_alternative_t<index, Variant>;
      if (wanted == Kind::kind) {
        Kind held{};
        visit(*this, held);
        value = std::move(held);
      } else {
        read_kind<Variant, index + 1>(wanted, value);
      }
    } else {
      AB_CHECK(false, wanted, "is not a kind");
    }
  }
};

template <class T>
struct IsSequence : std::false_type {};
template <class T>
struct IsSequence<std::vector<T>> : std::true_type {};
template <class T, std::size_t count>
struct IsSequence<std::array<T, count>> : std::true_type {};

template <class T>
struct IsOptional : std::false_type {};
template <class T>
struct IsOptional<std::optional<T>> : std::true_type {};

/// JSON has neither NaN nor infinity, and null would not say which.
inline nlohmann::json number_to_json(double value) {
  if (std::isnan(value)) return "nan";
  if (std::isinf(value)) return value > 0 ? "inf" : "-inf";
  return value;
}

[[noreturn]] inline void throw_no_value(const nlohmann::json& json) {
  throw nlohmann::json::type_error::create(302, "no such value: " + json.dump(), &json);
}

inline double number_from_json(const nlohmann::json& json) {
  if (!json.is_string()) return json.get<double>();
  const auto& text = json.get_ref<const std::string&>();
  if (text == "nan") return std::numeric_limits<double>::quiet_NaN();
  if (text != "inf" && text != "-inf") throw_no_value(json);
  return (text == "inf" ? 1.0 : -1.0) * std::numeric_limits<double>::infinity();
}

template <class T>
nlohmann::json value_to_json(const T& value) {
  if constexpr (TextEnum<T>) {
    return std::string(text(value));
  } else if constexpr (std::same_as<T, double>) {
    return number_to_json(value);
  } else if constexpr (IsOptional<T>::value) {
    return value ? value_to_json(*value) : nlohmann::json();
  } else if constexpr (IsSequence<T>::value) {
    nlohmann::json array = nlohmann::json::array();
    for (const auto& element : value) array.push_back(value_to_json(element));
    return array;
  } else if constexpr (Visitable<const T, JsonWriter>) {
    return spec_to_json(value);
  } else {
    return value;
  }
}

template <class T>
nlohmann::json sparse_value(const T& value) {
  if constexpr (IsOptional<T>::value) {
    return value ? sparse_value(*value) : nlohmann::json();
  } else if constexpr (IsSequence<T>::value) {
    nlohmann::json array = nlohmann::json::array();
    for (const auto& element : value) array.push_back(sparse_value(element));
    return array;
  } else if constexpr (!TextEnum<T> && Visitable<const T, JsonWriter>) {
    return sparse_json(value);
  } else {
    return value_to_json(value);
  }
}

template <class T>
void value_from_json(const nlohmann::json& json, T& value, bool needs_all) {
  if constexpr (TextEnum<T>) {
    const auto found = enum_from_text<T>(json.get<std::string>());
    if (!found) throw_no_value(json);
    value = *found;
  } else if constexpr (std::same_as<T, double>) {
    value = number_from_json(json);
  } else if constexpr (IsOptional<T>::value) {
    value.reset();
    if (!json.is_null()) value_from_json(json, value.emplace(), needs_all);
  } else if constexpr (IsSequence<T>::value) {
    if (!json.is_array()) throw_no_value(json);
    if constexpr (requires { value.clear(); }) value.resize(json.size());
    std::size_t i = 0;
    for (auto& element : value) value_from_json(json.at(i++), element, needs_all);
    if (i != json.size()) throw_no_value(json);
  } else if constexpr (Visitable<T, JsonReader>) {
    value = spec_from_json<T>(json, needs_all);
  } else {
    value = json.get<T>();
  }
}

}  // namespace detail

template <class Spec>
nlohmann::json spec_to_json(const Spec& spec) {
  nlohmann::json json = nlohmann::json::object();
  detail::JsonWriter writer{json};
  visit(writer, spec);
  return json;
}

template <class Spec>
nlohmann::json sparse_json(const Spec& spec) {
  nlohmann::json json = nlohmann::json::object();
  const nlohmann::json defaults = spec_to_json(Spec{});
  detail::SparseJsonWriter writer{json, defaults};
  visit(writer, spec);
  return json;
}

template <class Spec>
Spec spec_from_json(const nlohmann::json& json, bool needs_all) {
  Spec spec{};
  detail::JsonReader reader{json, needs_all};
  visit(reader, spec);
  return spec;
}

}  // namespace avoidbench
