#include "sweep/key_maker.hpp"

#include "base/digest.hpp"
#include "base/spec_json.hpp"
#include "sweep/recorded_latency.hpp"
#include "sweep/sweep_spec.hpp"

namespace avoidbench {
namespace {

using nlohmann::json;

/// The fields' values one after the other, to tell equal specs from others in no time.
struct FieldBytes {
  std::string& bytes;

  template <class T>
  void field(std::string_view, T& value, Range, std::string_view) {
    append(value);
  }
  template <class T>
  void field(std::string_view, T& value, std::string_view) {
    append(value);
  }
  template <class Variant>
  void variant(std::string_view, Variant& value, std::string_view) {
    append_size(value.index());
    std::visit([this](auto& held) { visit(*this, held); }, value);
  }

  template <class T>
  void append(T& value) {
    if constexpr (std::is_arithmetic_v<T> || std::is_enum_v<T>) {
      bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
    } else if constexpr (std::is_same_v<T, std::string>) {
      append_size(value.size());
      bytes += value;
    } else if constexpr (detail::IsSequence<T>::value) {
      append_size(value.size());
      for (auto& element : value) append(element);
    } else {
      visit(*this, value);
    }
  }
  void append_size(std::size_t size) {
    bytes.append(reinterpret_cast<const char*>(&size), sizeof size);
  }
};

/// Takes out what is no part of a key, of those fields of a TrialSpec that are there.
void leave_out_unkeyed(json& fields) {
  if (fields.contains("map")) fields["map"].erase("file");  // its file_digest stays
  if (fields.contains("wind")) fields["wind"]["field"].erase("file");
  if (fields.contains("planner")) {
    fields["planner"].erase("file");
    fields["planner"].erase("plugin");
  }
  if (fields.contains("latency")) forget_unused_latency(fields);
}

/// Finds or makes the text of each field of a TrialSpec.
struct BlockTexts {
  std::map<std::string, KeyMaker::Block, std::less<>>& blocks;
  std::string bytes;

  template <class T>
  void field(std::string_view name, T& value, Range, std::string_view) {
    // A sweep varies few blocks over few values; an axis of thousands would only fill memory, so
    // that the texts are then made again.
    constexpr std::size_t kMostTexts = 256;
    bytes.clear();
    FieldBytes{bytes}.append(value);
    auto block = blocks.find(name);
    if (block == blocks.end()) block = blocks.emplace(std::string(name), KeyMaker::Block{}).first;
    auto& texts = block->second.texts;
    auto known = texts.find(bytes);
    if (known == texts.end()) {
      if (texts.size() == kMostTexts) texts.clear();
      json fields = {{std::string(name), detail::value_to_json(value)}};
      leave_out_unkeyed(fields);
      known = texts.emplace(bytes, fields.at(std::string(name)).dump()).first;
    }
    block->second.text = &known->second;
  }
  template <class T>
  void field(std::string_view name, T& value, std::string_view doc) {
    field(name, value, Range{}, doc);
  }
};

std::string key_of(std::string_view canonical) {
  return Digest().add(canonical).add(std::uint64_t{kResultVersion}).hex();
}

/// visit() takes a mutable spec; the visitors here only read.
template <class T>
T& readable(const T& value) {
  return const_cast<T&>(value);
}

}  // namespace

std::string KeyMaker::trial_key(const TrialSpec& spec) {
  BlockTexts texts{blocks_, {}};
  visit(texts, readable(spec));
  canonical_.clear();
  for (const auto& [name, block] : blocks_) {
    // As forget_unused_latency() does for a whole spec: keys must not depend on which of the two
    // ways made them.
    if (name == "latency_digest" && spec.latency.mode != LatencyMode::replay) continue;
    canonical_ += canonical_.empty() ? '{' : ',';
    canonical_ += '"';
    canonical_ += name;
    canonical_ += "\":";
    canonical_ += *block.text;
  }
  canonical_ += '}';
  return key_of(canonical_);
}

std::string KeyMaker::map_key(const TrialSpec& spec) {
  std::string bytes;
  FieldBytes writer{bytes};
  writer.append(readable(spec.map));
  writer.append(readable(spec.map_seed));
  writer.append(readable(spec.seed));
  writer.append(readable(spec.mission));
  writer.append(readable(spec.vehicle.body_size_m));
  if (map_key_.empty() || bytes != map_bytes_) {
    map_bytes_ = std::move(bytes);
    map_key_ = avoidbench::map_key(spec);
  }
  return map_key_;
}

std::string trial_key(const TrialSpec& spec) {
  json canonical = spec_to_json(spec);
  leave_out_unkeyed(canonical);
  return key_of(canonical.dump());
}

std::string map_key(const TrialSpec& spec) {
  json canonical = {{"map", spec_to_json(spec.map)},
                    {"map_seed", spec.map_seed},
                    {"seed", spec.seed},
                    {"mission", spec_to_json(spec.mission)},
                    {"body_size_m", spec.vehicle.body_size_m}};
  canonical["map"].erase("file");
  return key_of(canonical.dump());
}

}  // namespace avoidbench
