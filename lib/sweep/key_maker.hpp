#pragma once

#include <map>
#include <string>

#include "sweep/sweep_spec.hpp"

namespace avoidbench {

/// The trial_key() and map_key() of many trials, much faster one after the other than each by
/// itself: blocks of the spec that were seen before are not made into text again.
class KeyMaker {
 public:
  std::string trial_key(const PlannedTrial& trial) { return trial_key(trial.spec()); }
  std::string trial_key(const TrialSpec& spec);
  std::string map_key(const PlannedTrial& trial) { return map_key(*trial.setting); }
  std::string map_key(const TrialSpec& spec);

  /// Canonical text of one field of TrialSpec; for the visitor in key_maker.cpp.
  struct Block {
    std::map<std::string, std::string> texts;  // by the field's bytes
    const std::string* text = nullptr;         // of the trial at hand
  };

 private:
  std::map<std::string, Block, std::less<>> blocks_;  // by name: the order of canonical JSON
  std::string canonical_, map_bytes_, map_key_;       // of the last trial
};

}  // namespace avoidbench
