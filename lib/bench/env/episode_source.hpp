#pragma once

#include <condition_variable>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "env/env_spec.hpp"
#include "metrics/map_record.hpp"
#include "trial/map_scene.hpp"

namespace avoidbench {

/// A mission of a map, as a body flies it.
struct MeasuredMission {
  MissionRecord record;
  /// The shortest free path to each goal in the world; empty where invalid.
  std::vector<std::vector<Eigen::Vector3d>> reference_legs;
};

/// A map that several flights share, and what was found out about its missions. Safe for several
/// threads.
class SharedMap {
 public:
  explicit SharedMap(const TrialSpec& setting);

  const Scene& scene() const { return map_.scene; }
  /// Measured when first asked for. Settings of one address are one setting.
  const MeasuredMission& mission(const TrialSpec& setting, std::int64_t index,
                                 const std::vector<Mission>& listed);

 private:
  MapScene map_;
  std::mutex mutex_;  // of what follows
  ClearanceGrid grid_;
  std::map<std::pair<const TrialSpec*, std::int64_t>, MeasuredMission> missions_;
};

/// One episode: a trial of the sweep, with what it is flown in.
struct Episode {
  std::int64_t ordinal =
      0;  ///< in its slot, from 0; of the invalid trials that were passed over, too
  std::int64_t round =
      0;  ///< in turn: how often the slot has flown its trials before; see EpisodeOrder
  TrialSpec spec;
  std::shared_ptr<SharedMap> map;
  const MeasuredMission* mission = nullptr;  ///< the map's
};

/// Says which trial is flown next in a slot, and makes maps ahead of time in a thread of its own.
/// What it says follows from the spec, the seed, the slot and the ordinal alone. Safe for several
/// threads.
class EpisodeSource {
 public:
  /// Throws InputError where a file of the sweep can't be read.
  explicit EpisodeSource(const EnvSpec& spec);
  ~EpisodeSource();
  EpisodeSource(const EpisodeSource&) = delete;
  EpisodeSource& operator=(const EpisodeSource&) = delete;

  const std::vector<PlannedTrial>& trials() const { return trials_; }

  /// Waits for the map where it is not made yet. Throws InputError where a map can't be made, or
  /// where no mission that was tried can be flown. `poll` is called before each try and while maps
  /// are made; what it throws ends the search.
  Episode episode(std::uint64_t seed, std::size_t slot, std::int64_t ordinal,
                  const std::function<void()>& poll = {});

  /// The same will be asked for soon.
  void prepare(std::uint64_t seed, std::size_t slot, std::int64_t ordinal);

 private:
  struct Request {
    std::uint64_t seed = 0;
    std::size_t slot = 0;
    std::int64_t ordinal = 0;
  };
  struct Entry;
  /// In turn: every `stride`-th trial from `first` on, `count` of them.
  struct SlotTrials {
    std::size_t first = 0, stride = 1, count = 1;
    std::int64_t first_round = 0;
  };

  const PlannedTrial& trial_of(const Request& request, std::int64_t attempt) const;
  SlotTrials trials_of(std::size_t slot) const;
  std::shared_ptr<SharedMap> map_of(const TrialSpec& setting);
  void forget_maps();
  void build_ahead(const std::stop_token& stop);

  EpisodeOrder order_;
  std::size_t slots_;
  std::size_t kept_maps_;
  std::vector<ListedMission> listed_;
  std::vector<PlannedTrial> trials_;
  std::map<const TrialSpec*, std::string> map_keys_;  // of the trials' settings

  std::mutex mutex_;  // of what follows
  std::map<std::string, std::shared_ptr<Entry>> maps_;
  std::uint64_t uses_ = 0;
  std::deque<Request> requests_;
  std::map<std::size_t, std::shared_ptr<SharedMap>> ahead_;  // by slot: kept until it is taken
  std::condition_variable_any requested_;
  std::jthread builder_;  // last: it ends before what it uses
};

}  // namespace avoidbench
