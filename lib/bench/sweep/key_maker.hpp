#pragma once

#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "sweep/sweep_spec.hpp"

namespace avoidbench {

/// A setting as canonical text, open where its trials differ: a trial's key is the digest of all of
/// it. Canonical JSON has its keys sorted, so that latency_digest comes before mission_index. A
/// field at its default is not in it, except mission_index.
class KeyText {
 public:
  explicit KeyText(const TrialSpec& setting);
  std::string trial_key(std::int64_t mission_index, const std::string& latency_digest) const;

 private:
  std::string before_digest_, before_index_, after_index_;
  bool has_digest_ = false;
};

/// The trial_key() and map_key() of many trials: what they follow from is made into text once for
/// each setting.
class KeyMaker {
 public:
  std::string trial_key(const PlannedTrial& trial);
  std::string map_key(const PlannedTrial& trial);

 private:
  struct Setting {
    std::shared_ptr<const TrialSpec> spec;  ///< kept, so that no other spec gets its address
    KeyText text;
    std::string map_key;  ///< "" until it was asked for
  };
  Setting& of(const PlannedTrial& trial);

  std::map<const TrialSpec*, Setting> settings_;
};

}  // namespace avoidbench
