#include "sweep/key_maker.hpp"

#include <utility>

#include "base/digest.hpp"
#include "base/spec_json.hpp"
#include "sweep/recorded_latency.hpp"
#include "trial/periods.hpp"

namespace avoidbench {
namespace {

using nlohmann::json;

constexpr const char* kLaterVehicleFields[] = {"thrust_to_weight", "angular_acceleration_radps2"};

/// Of sensors of kind stereo_census, as they were without them.
const std::pair<const char*, json> kLaterCensusFields[] = {{"window", "9x7"},
                                                           {"uniqueness_percent", 0},
                                                           {"speckle_window_px", 0},
                                                           {"speckle_range_px", 2}};

bool is_census(const json& camera) {
  return camera.is_object() && camera.value("kind", json()) == "stereo_census";
}

/// Calls `change` with every camera of a sensor, itself the first.
template <class Sensor, class Change>
void for_each_camera(Sensor& sensor, Change change) {
  change(sensor);
  const auto more = sensor.find("more_cameras");
  if (more == sensor.end() || !more->is_array()) return;
  for (auto& camera : *more) change(camera);
}

/// A TrialSpec's JSON without what is no part of its key.
json keyed_json(const TrialSpec& spec) {
  // Where files lie says nothing of the result: their digests stand for them.
  json fields = spec_to_json(spec);
  fields["map"].erase("file");  // its file_digest stays
  fields["wind"]["field"].erase("file");
  fields["planner"].erase("file");
  fields["planner"].erase("plugin");
  fields["planner"].erase("files");  // file_digest is made of them
  forget_unused_latency(fields);
  forget_unused_later_fields(fields);
  // Before 2026-11-26 these flights had no such samples, and their jerks were other ones.
  if (adds_jerk_samples(spec.rates)) fields["rates"]["jerk_hz"] = kJerkRate_hz;
  return fields;
}

std::string key_of(std::string_view canonical) {
  // A program whose results differ has other keys.
  return Digest().add(canonical).add(std::uint64_t{kResultVersion}).hex();
}

}  // namespace

void forget_unused_later_fields(nlohmann::json& trial) {
  // Sweeps of before these fields keep their keys, byte for byte.
  if (trial.at("missions_digest") == "") trial.erase("missions_digest");
  nlohmann::json& sensor = trial.at("sensor");
  for_each_camera(sensor, [](json& camera) {
    if (!is_census(camera)) return;
    for (const auto& [field, before] : kLaterCensusFields) {
      if (camera.at(field) == before) camera.erase(field);
    }
  });
  if (sensor.at("more_cameras").empty()) sensor.erase("more_cameras");
  for (const char* field : kLaterVehicleFields) {
    if (trial.at("vehicle").at(field) == 0.0) trial.at("vehicle").erase(field);
  }
  if (trial.contains("planner")) forget_unused_planner_fields(trial.at("planner"));
}

void forget_unused_planner_fields(nlohmann::json& planner) {
  for (const char* field : {"command", "files"}) {
    if (planner.contains(field) && planner.at(field).empty()) planner.erase(field);
  }
  if (planner.value("camera", kAllCameras) == kAllCameras) planner.erase("camera");
}

void restore_later_fields(nlohmann::json& trial) {
  trial.emplace("missions_digest", "");
  if (trial.contains("sensor") && trial.at("sensor").is_object()) {
    for_each_camera(trial.at("sensor"), [](json& camera) {
      if (!is_census(camera)) return;
      for (const auto& [field, before] : kLaterCensusFields) camera.emplace(field, before);
    });
    trial.at("sensor").emplace("more_cameras", nlohmann::json::array());
  }
  if (trial.contains("vehicle") && trial.at("vehicle").is_object()) {
    for (const char* field : kLaterVehicleFields) trial.at("vehicle").emplace(field, 0.0);
  }
  if (trial.contains("planner") && trial.at("planner").is_object()) {
    trial.at("planner").emplace("command", nlohmann::json::array());
    trial.at("planner").emplace("files", nlohmann::json::array());
    trial.at("planner").emplace("camera", kAllCameras);
  }
}

/// The canonical text in three parts, between which the two fields of a single trial stand: a key
/// then costs two joins and a digest instead of a whole JSON.
KeyText::KeyText(const TrialSpec& setting) {
  const json fields = keyed_json(setting);
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
  json canonical = {{"map", spec_to_json(spec.map)},
                    {"map_seed", spec.map_seed},
                    {"seed", spec.seed},
                    {"mission", spec_to_json(spec.mission)},
                    {"body_size_m", spec.vehicle.body_size_m}};
  canonical["map"].erase("file");
  if (!spec.missions_digest.empty()) canonical["missions_digest"] = spec.missions_digest;
  return key_of(canonical.dump());
}

}  // namespace avoidbench
