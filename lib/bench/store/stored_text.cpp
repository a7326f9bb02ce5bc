#include "store/stored_text.hpp"

#include <algorithm>
#include <cstdint>

#include "base/input_error.hpp"

namespace avoidbench {
namespace {

using nlohmann::json;

/// Bytes of the character at the beginning of `text`; 0 where that is no UTF-8.
std::size_t character_size(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned first = byte(0);
  if (first < 0x80) return 1;
  const std::size_t size = first >= 0xF0 ? 4 : first >= 0xE0 ? 3 : 2;
  if (first < 0xC2 || first > 0xF4 || size > text.size()) return 0;
  for (std::size_t i = 1; i < size; ++i) {
    if ((byte(i) & 0xC0U) != 0x80U) return 0;
  }
  const bool is_overlong = (first == 0xE0 && byte(1) < 0xA0) || (first == 0xF0 && byte(1) < 0x90);
  const bool is_no_character =
      (first == 0xED && byte(1) > 0x9F) || (first == 0xF4 && byte(1) > 0x8F);
  return is_overlong || is_no_character ? 0 : size;
}

/// The deepest nesting of brackets and braces outside strings.
/// Looked at before parsing: what is nested a million deep would overflow the call stack.
std::size_t depth_of(std::string_view text) {
  std::size_t depth = 0, deepest = 0;
  bool is_in_string = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (is_in_string) {
      if (c == '\\') ++i;
      if (c == '"') is_in_string = false;
    } else if (c == '"') {
      is_in_string = true;
    } else if (c == '[' || c == '{') {
      deepest = std::max(deepest, ++depth);
    } else if ((c == ']' || c == '}') && depth > 0) {
      --depth;
    }
  }
  return deepest;
}

/// Paths become part of SQL and of columns' names: letters, digits and few signs only.
bool is_path(const json& path) {
  if (!path.is_string()) return false;
  const std::string& text = path.get_ref<const std::string&>();
  return !text.empty() && std::all_of(text.begin(), text.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
           c == '.' || c == '-';
  });
}

/// The element of this name; null where there is none.
json element(const json& object, const char* name) {
  const auto found = object.find(name);
  return found == object.end() ? json() : *found;
}

}  // namespace

void throw_damaged(const std::filesystem::path& path, std::string_view table, std::string_view key,
                   std::string_view what) {
  constexpr std::size_t kMost = 40;
  throw InputError(InputProblem{.file = path.string(),
                                .message = "damaged: table " + std::string(table) + ", row " +
                                           // Keys are shown by their beginning, which is enough to
                                           // name a trial.
                                           as_utf8(key.substr(0, key.size() == 64 ? 12 : kMost)) +
                                           ": " + std::string(what)});
}

bool is_utf8(std::string_view text) {
  while (!text.empty()) {
    const std::size_t size = character_size(text);
    if (size == 0) return false;
    text.remove_prefix(size);
  }
  return true;
}

std::string as_utf8(std::string_view text) {
  std::string clean;
  while (!text.empty()) {
    const std::size_t size = character_size(text);
    clean += size == 0 ? std::string_view("\uFFFD") : text.substr(0, size);
    text.remove_prefix(std::max<std::size_t>(size, 1));
  }
  return clean;
}

json stored_object(const std::string& text) {
  constexpr std::size_t kMostDepth = 64;
  if (depth_of(text) > kMostDepth) throw BadText("JSON that is nested too deep");
  json object = json::parse(text, nullptr, false);
  if (!object.is_object()) throw BadText("not a JSON object");
  return object;
}

namespace {

/// Whether what warnings read of a sweep's base trial has its types. What is missing is null.
bool has_base_types(const json& base) {
  if (base.is_null()) return true;
  if (!base.is_object()) return false;
  const json latency = element(base, "latency"), rates = element(base, "rates");
  if (!(latency.is_null() || latency.is_object()) || !(rates.is_null() || rates.is_object())) {
    return false;
  }
  const auto has = [](const json& block, const char* name, auto is_type) {
    return !block.contains(name) || is_type(block.at(name));
  };
  const auto is_text = [](const json& value) { return value.is_string(); };
  const auto is_number = [](const json& value) { return value.is_number(); };
  return has(latency, "mode", is_text) && has(latency, "ms", is_number) &&
         has(rates, "plan_hz", is_number);
}

}  // namespace

/// Types and sizes are checked once here, so that readers of specs can multiply them without a
/// thought.
json stored_sweep(const std::string& text) {
  constexpr double kMostTrials = 1e15;
  json spec = stored_object(text);
  const json trials = element(spec, "trials"), planners = element(spec, "planners");
  const json axes = element(spec, "axes"), until = element(spec, "until");
  const json trial_count = element(spec, "trial_count");
  // What is missing is null, and allowed.
  const bool has_types =
      (trials.is_null() || trials.is_number_integer()) &&
      (!spec.contains("trial_count") || trial_count.is_number_integer()) &&
      (planners.is_null() || planners.is_array()) && (axes.is_null() || axes.is_array()) &&
      (until.is_null() || until.is_string()) && has_base_types(element(spec, "base"));
  if (!has_types) throw BadText("that of a sweep whose parts have other types");
  double count = 1.0;  // an axis without values counts as one with one: no part is too large
  if (!trials.is_null()) count *= std::max(1.0, trials.get<double>());
  count *= static_cast<double>(std::max<std::size_t>(1, planners.size()));
  for (const json& axis : axes) {
    const json values = axis.is_object() ? element(axis, "values") : json();
    if (!values.is_array() || !is_path(element(axis, "path"))) {
      throw BadText("that of a sweep with an invalid axis");
    }
    count *= static_cast<double>(std::max<std::size_t>(1, values.size()));
  }
  const auto is_below_zero = [](const json& number) {
    return !number.is_null() && number.get<double>() < 0.0;
  };
  // trial_count stands there only where missions are listed, and counts those of the planners.
  if (planners.empty() && !trial_count.is_null() && trial_count.get<double>() > 0.0) {
    throw BadText("that of a sweep with trials and no planners");
  }
  const bool is_negative = is_below_zero(trials) || is_below_zero(trial_count);
  if (!trial_count.is_null()) count = std::max(count, trial_count.get<double>());
  if (is_negative || count > kMostTrials) throw BadText("that of a sweep of too many trials");
  return spec;
}

}  // namespace avoidbench
