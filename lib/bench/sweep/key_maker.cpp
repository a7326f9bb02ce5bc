#include "sweep/key_maker.hpp"

#include "base/digest.hpp"
#include "base/spec_json.hpp"
#include "sweep/recorded_latency.hpp"

namespace avoidbench {
namespace {

using nlohmann::json;

/// The fields of a trial's key but mission_index: those that say something and are not at their
/// defaults.
json keyed_json(const TrialSpec& spec) {
  TrialSpec keyed = without_unused_latency(spec);
  // Where files lie says nothing of the result: their digests stand for them.
  const auto forget_files = [](PluginChoice& plugin) {
    plugin.file.clear();
    plugin.plugin.clear();
    plugin.files.clear();  // file_digest is made of them
  };
  forget_files(keyed.planner);
  if (keyed.planner.filter) forget_files(*keyed.planner.filter);
  keyed.wind.field.file.clear();
  json fields = sparse_json(keyed);
  // Which kind of map has a file, the variant knows.
  if (fields.contains("map")) fields["map"].erase("file");
  return fields;
}

std::string key_of(std::string_view canonical) {
  // A program whose results differ has other keys.
  return Digest().add(canonical).add(std::uint64_t{kResultVersion}).hex();
}

}  // namespace

/// The canonical text in three parts, between which the two fields of a single trial stand: a key
/// then costs two joins and a digest instead of a whole JSON.
KeyText::KeyText(const TrialSpec& setting) {
  json fields = keyed_json(setting);
  // Each trial has its own.
  fields["mission_index"] = 0;
  if (setting.latency.mode == LatencyMode::replay) fields["latency_digest"] = "";
  std::string* part = &before_digest_;
  for (const auto& [name, value] : fields.items()) {
    *part += (before_digest_.empty() ? "{\"" : ",\"") + name + "\":";
    // By name: latency_digest comes before mission_index.
    if (name == "latency_digest") {
      part = &before_index_;
      has_digest_ = true;
    } else if (name == "mission_index") {
      part = &after_index_;
    } else {
      *part += value.dump();
    }
  }
  *part += '}';
}

std::string KeyText::trial_key(std::int64_t mission_index,
                               const std::string& latency_digest) const {
  return key_of(before_digest_ + (has_digest_ ? json(latency_digest).dump() : "") + before_index_ +
                std::to_string(mission_index) + after_index_);
}

KeyMaker::Setting& KeyMaker::of(const PlannedTrial& trial) {
  constexpr std::size_t kMostSettings = 1024;  // some 5 kB each
  const auto known = settings_.find(trial.setting.get());
  if (known != settings_.end()) return known->second;
  // All at once: trials of one setting follow each other, so hardly any is missed.
  if (settings_.size() == kMostSettings) settings_.clear();
  return settings_.emplace(trial.setting.get(), Setting{trial.setting, KeyText(*trial.setting), ""})
      .first->second;
}

std::string KeyMaker::trial_key(const PlannedTrial& trial) {
  return of(trial).text.trial_key(trial.mission_index, trial.latency_digest);
}

std::string KeyMaker::map_key(const PlannedTrial& trial) {
  Setting& setting = of(trial);
  if (setting.map_key.empty()) setting.map_key = avoidbench::map_key(*setting.spec);
  return setting.map_key;
}

std::string trial_key(const TrialSpec& spec) {
  return KeyText(spec).trial_key(spec.mission_index, spec.latency_digest);
}

std::string map_key(const TrialSpec& spec) {
  // Only what a map's record depends on: the world, the missions and the body that they are
  // measured for. Other axes share the map: makes_maps() of trial/map_fields.hpp says the same.
  json canonical = {{"map", sparse_json(spec.map)},
                    {"map_seed", spec.map_seed},
                    {"seed", spec.seed},
                    {"mission", sparse_json(spec.mission)},
                    {"body_size_m", spec.vehicle.body_size_m},
                    {"missions_digest", spec.missions_digest}};
  canonical["map"].erase("file");
  return key_of(canonical.dump());
}

}  // namespace avoidbench
