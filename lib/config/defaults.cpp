#include "config/defaults.hpp"

#include <algorithm>
#include <cmath>

#include "trial/trial_spec.hpp"
#include "yaml/yaml_reader.hpp"

namespace avoidbench {
namespace {

std::string range_text(Range range) {
  const bool below = std::isfinite(range.lowest), above = std::isfinite(range.highest);
  if (below && above) {
    return " [" + number_text(range.lowest) + ", " + number_text(range.highest) + "]";
  }
  if (below) return " At least " + number_text(range.lowest) + ".";
  return above ? " At most " + number_text(range.highest) + "." : "";
}

std::string text_value(const std::string& text) {
  const auto is_plain = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
           c == '-' || c == '.' || c == '/';
  };
  const bool begins_as_word =
      !text.empty() && ((text[0] >= 'a' && text[0] <= 'z') || (text[0] >= 'A' && text[0] <= 'Z'));
  if (begins_as_word && std::all_of(text.begin(), text.end(), is_plain)) return text;
  return nlohmann::json(text).dump();  // a JSON string is a YAML one
}

template <class T>
std::string value_text(T& value);

/// Writes a spec on one line: {name: value, …}.
struct FlowPrinter {
  std::string text;

  template <class T>
  void field(std::string_view name, T& value, Range, std::string_view) {
    text += (text.empty() ? "" : ", ") + std::string(name) + ": " + value_text(value);
  }
  template <class T>
  void field(std::string_view name, T& value, std::string_view doc) {
    field(name, value, Range{}, doc);
  }
  template <class Variant>
  void variant(std::string_view name, Variant& value, std::string_view) {
    text += (text.empty() ? "" : ", ") + std::string(name) + ": " + std::string(kind(value));
    std::visit([this](auto& held) { visit(*this, held); }, value);
  }
};

template <class T>
std::string value_text(T& value) {
  if constexpr (TextEnum<T>) {
    return std::string(text(value));
  } else if constexpr (detail::IsSequence<T>::value) {
    std::string all;
    for (auto& element : value) all += (all.empty() ? "" : ", ") + value_text(element);
    return "[" + all + "]";
  } else if constexpr (Visitable<T, FlowPrinter>) {
    FlowPrinter printer;
    visit(printer, value);
    return "{" + printer.text + "}";
  } else if constexpr (std::is_same_v<T, std::string>) {
    return text_value(value);
  } else if constexpr (std::is_same_v<T, bool>) {
    return value ? "true" : "false";
  } else if constexpr (std::is_integral_v<T>) {
    return std::to_string(value);
  } else {
    return number_text(value);
  }
}

/// Writes a spec as a block, one commented line a field.
class BlockPrinter {
 public:
  /// `shows_other_kinds`: the fields of variants' other kinds too, commented out.
  explicit BlockPrinter(std::string indent, bool shows_other_kinds = true)
      : indent_(std::move(indent)), shows_other_kinds_(shows_other_kinds) {}
  std::string text;

  template <class T>
  void field(std::string_view name, T& value, Range range, std::string_view doc) {
    std::string comment = std::string(doc) + range_text(range);
    if constexpr (TextEnum<T>) comment += one_of(enum_texts<T>());
    if constexpr (Visitable<T, BlockPrinter> && !detail::IsSequence<T>::value && !TextEnum<T>) {
      line(std::string(name) + ":", comment);
      BlockPrinter inner(indent_ + "  ");
      visit(inner, value);
      text += inner.text;
    } else if constexpr (detail::IsSequence<T>::value) {
      if constexpr (Visitable<typename T::value_type, BlockPrinter>) {
        line(std::string(name) + (value.empty() ? ": []" : ":"), comment);
        for (auto& element : value) text += indent_ + "  - " + value_text(element) + "\n";
      } else {
        line(std::string(name) + ": " + value_text(value), comment);
      }
    } else {
      line(std::string(name) + ": " + value_text(value), comment);
    }
  }
  template <class T>
  void field(std::string_view name, T& value, std::string_view doc) {
    field(name, value, Range{}, doc);
  }
  template <class Variant>
  void variant(std::string_view name, Variant& value, std::string_view doc) {
    std::vector<std::string> kinds;
    kind_names<Variant, 0>(kinds);
    line(std::string(name) + ": " + std::string(kind(value)), std::string(doc) + one_of(kinds));
    std::visit([this](auto& held) { visit(*this, held); }, value);
    if (shows_other_kinds_) other_kinds<Variant, 0>(name, value);
  }

  void line(const std::string& content, const std::string& comment) {
    constexpr std::size_t kCommentColumn = 36;
    std::string padded = indent_ + content;
    padded.resize(std::max(padded.size() + 2, kCommentColumn), ' ');
    text += padded + "# " + comment + "\n";
  }

 private:
  static std::string one_of(const std::vector<std::string>& words) {
    std::string all;
    for (const std::string& word : words) all += (all.empty() ? " (" : " | ") + word;
    return all + ")";
  }

  template <class Variant, std::size_t index>
  static void kind_names(std::vector<std::string>& kinds) {
    if constexpr (index < std::variant_size_v<Variant>) {
      kinds.emplace_back(std::variant_alternative_t<index, Variant>::kind);
      kind_names<Variant, index + 1>(kinds);
    }
  }

  /// The fields of the kinds that `value` does not hold, commented out.
  template <class Variant, std::size_t index>
  void other_kinds(std::string_view name, const Variant& value) {
    if constexpr (index < std::variant_size_v<Variant>) {
      using Kind = std::variant_alternative_t<index, Variant>;
      if (value.index() != index) {
        BlockPrinter other(indent_ + "# ");
        other.text = other.indent_ + std::string(name) + ": " + std::string(Kind::kind) + "\n";
        Kind preset{};
        visit(other, preset);
        text += other.text;
      }
      other_kinds<Variant, index + 1>(name, value);
    }
  }

  std::string indent_;
  bool shows_other_kinds_;
};

template <class Spec>
void add_block(std::string& text, const std::string& name, Spec spec, const std::string& comment) {
  BlockPrinter printer("  ");
  visit(printer, spec);
  text += "\n# " + comment + "\n" + name + ":\n" + printer.text;
}

std::string sensor_names() {
  std::string all;
  for (const SensorSpec& sensor : sensor_presets()) all += (all.empty() ? "" : ", ") + sensor.name;
  return all;
}

template <class Spec>
std::string file_text(Spec spec, const std::string& header) {
  BlockPrinter printer("", false);
  visit(printer, spec);
  return header + printer.text;
}

}  // namespace

std::string sweep_defaults_yaml() {
  const TrialSpec trial;
  std::string text =
      "# A sweep with every key at its default; only 'sweep' and 'planners' must be given.\n"
      "# One value may be a list, or a range {from: 2.3, to: 5.8, count: 10} or {from, to, step}:\n"
      "# each combination of such values is flown. avoidbench run FILE --set "
      "maps.poisson_radius_m=3 changes keys.\n"
      "# include: FILE.yaml takes what this file does not say from another; config explain KEY "
      "says more about a key.\n";
  BlockPrinter top("");
  top.line("sweep: my_sweep", "Name of the result set: A-Z a-z 0-9 _ . -");
  top.line("seed: " + std::to_string(trial.seed), "Seed of missions and noise.");
  top.line("trials: 10", "Missions per map, the same for every planner. [1, 1000000]");
  text += top.text +
          "# until: success_rate ci<0.05     # A planner stops when its success rate is known to "
          "± 0.05. Left out: all are flown.\n"
          "\n# Names, or {plugin: NAME or ./FILE.so, label: …, parameters: {name: value or list}, "
          "max_speed_mps: …};\n"
          "# see avoidbench planners list, and planners describe NAME for the parameters.\n"
          "planners:\n  - straight_line\n  - reactive\n"
          "# max_speed_mps: 3               # Speed limit of all planners that are given none; a "
          "list compares speeds.\n";
  add_block(text, "maps", trial.map, "The maps.");
  BlockPrinter seeds("  ");
  seeds.line("seeds: [1]", "Map seeds as a list, or how many of them, from 1.");
  text += seeds.text;
  add_block(text, "vehicle", trial.vehicle,
            "A name (hummingbird, hummingbird_rotors, firefly, or that of vehicles/NAME.yaml "
            "beside the sweep's folder),\n"
            "# or fields that differ from those of `preset: NAME`, which is hummingbird where not "
            "given.");
  add_block(
      text, "sensor", trial.sensor,
      "A name (" + sensor_names() +
          ",\n# or that of sensors/NAME.yaml beside the sweep's folder), or fields that differ "
          "from those of `preset: NAME`,\n# which is depth_ideal where not given.");
  add_block(text, "imu", trial.imu,
            "The inertial measurement unit; the defaults are an ADIS16448's.");
  add_block(text, "odometry", trial.odometry,
            "How wrong the vehicle and its planner know where they are; all zero: not at all.");
  add_block(text, "latency", trial.latency, "What the planner sees at time t acts at t + latency.");
  add_block(text, "wind", trial.wind, "Wind and disturbances, added up; see docs/wind.md.");
  add_block(text, "mission", trial.mission, "The rules of a flight.");
  add_block(text, "rates", trial.rates,
            "How often things happen. Each period is a whole number of 1/36000 s.");
  text +=
      "\n# Any field above by its path, with the values to try:\n"
      "# axes:\n"
      "#   wind.mean_world_mps: [[0, 0, 0], [4, 0, 0]]\n"
      "axes: {}\n";
  return text;
}

std::string vehicle_yaml(const VehicleSpec& vehicle) {
  return file_text(vehicle, "# A vehicle; see `avoidbench config defaults`.\n");
}

std::string sensor_yaml(const SensorSpec& sensor) {
  return file_text(sensor, "# A sensor; see `avoidbench config defaults`.\n");
}

}  // namespace avoidbench
