#include "env/episode_source.hpp"

#include <algorithm>
#include <stdexcept>

#include "base/check.hpp"
#include "base/poll.hpp"
#include "base/random.hpp"
#include "sweep/listed_missions.hpp"

namespace avoidbench {
namespace {

/// As many trials in a row whose missions can't be flown are taken for all of them.
constexpr std::int64_t kMostAttempts = 1000;

std::vector<PlannedTrial> trials_for(SweepSpec sweep, const std::string& policy) {
  // The policy stands in the keys as the only planner, whatever the sweep lists.
  PlannerChoice pilot;
  pilot.plugin = pilot.label = policy;
  sweep.planners = {pilot};
  return expand(sweep);
}

}  // namespace

SharedMap::SharedMap(const TrialSpec& setting)
    : map_(setting), grid_(map_.scene, map_.world.bounds, kMapCell_m) {}

const MeasuredMission& SharedMap::mission(const TrialSpec& setting, std::int64_t index,
                                          const std::vector<Mission>& listed) {
  // Held while it measures: the search works in the grid, and who wants the same mission waits.
  const std::lock_guard lock(mutex_);
  const std::pair key{&setting, index};
  if (const auto known = missions_.find(key); known != missions_.end()) return known->second;
  MeasuredMission measured;
  measured.record =
      make_mission_record(setting, map_.scene, grid_, index, listed, &measured.reference_legs);
  return missions_.emplace(key, std::move(measured)).first->second;
}

/// A map that is made once, by the first who needs it.
struct EpisodeSource::Entry {
  std::mutex making;
  std::shared_ptr<SharedMap> map;  // null: not made yet
  std::uint64_t last_use = 0;      // guarded by the source's mutex
};

EpisodeSource::EpisodeSource(const EnvSpec& spec)
    : order_(spec.order),
      slots_(static_cast<std::size_t>(spec.slots)),
      kept_maps_(static_cast<std::size_t>(spec.kept_maps)),
      listed_(spec.sweep.missions),
      trials_(trials_for(spec.sweep, spec.policy)) {
  // trial_of() divides by their number.
  if (trials_.empty()) throw InputError("the sweep has no trials");
  for (const PlannedTrial& trial : trials_) {
    // Settings that differ in nothing of the scene share one map by this key.
    const auto [key, is_new] = map_keys_.try_emplace(trial.setting.get());
    if (is_new) key->second = map_scene_key(*trial.setting);
  }
  builder_ = std::jthread([this](const std::stop_token& stop) { build_ahead(stop); });
}

EpisodeSource::~EpisodeSource() = default;

EpisodeSource::SlotTrials EpisodeSource::trials_of(std::size_t slot) const {
  const std::size_t stride = std::min(slots_, trials_.size());
  const std::size_t first = slot % stride;
  // Of more slots than trials those beyond fly what others fly, too.
  return {.first = first,
          .stride = stride,
          .count = (trials_.size() - first + stride - 1) / stride,
          .first_round = static_cast<std::int64_t>(slot / stride)};
}

const PlannedTrial& EpisodeSource::trial_of(const Request& request, std::int64_t attempt) const {
  if (order_ == EpisodeOrder::in_turn) {
    const SlotTrials own = trials_of(request.slot);
    const auto place = static_cast<std::size_t>(request.ordinal + attempt) % own.count;
    // A slot none of whose trials can be flown takes others': by then its round is not 0.
    const std::size_t more = static_cast<std::size_t>(attempt) / own.count;
    return trials_[(own.first + place * own.stride + more) % trials_.size()];
  }
  // Each number opens a stream of its own. Drawn one after the other from one stream, an episode
  // would depend on which slot came first.
  std::uint64_t seed = stream_seed(request.seed, "episode");
  seed = stream_seed(seed, static_cast<std::uint64_t>(request.slot));
  seed = stream_seed(seed, static_cast<std::uint64_t>(request.ordinal));
  seed = stream_seed(seed, static_cast<std::uint64_t>(attempt));
  return trials_[RandomStream(seed).below(trials_.size())];
}

std::shared_ptr<SharedMap> EpisodeSource::map_of(const TrialSpec& setting) {
  std::shared_ptr<Entry> entry;
  {
    const std::lock_guard lock(mutex_);
    std::shared_ptr<Entry>& known = maps_[map_keys_.at(&setting)];
    if (known == nullptr) known = std::make_shared<Entry>();
    entry = known;
    entry->last_use = ++uses_;
    forget_maps();
  }
  // Not under the source's lock: others get their maps while this one is made.
  const std::lock_guard lock(entry->making);
  if (entry->map == nullptr) entry->map = std::make_shared<SharedMap>(setting);
  return entry->map;
}

/// Of more maps than are kept, those not used for longest. Flights keep theirs.
void EpisodeSource::forget_maps() {
  // The map that was just asked for was used last, so it stays.
  while (maps_.size() > std::max<std::size_t>(kept_maps_, 1)) {
    maps_.erase(std::min_element(maps_.begin(), maps_.end(), [](const auto& a, const auto& b) {
      return a.second->last_use < b.second->last_use;
    }));
  }
}

Episode EpisodeSource::episode(std::uint64_t seed, std::size_t slot, std::int64_t ordinal,
                               const std::function<void()>& poll) {
  std::optional<PollScope> polled;  // maps take seconds to make
  if (poll) polled.emplace(poll);
  for (std::int64_t attempt = 0; attempt < kMostAttempts; ++attempt) {
    if (poll) poll();
    const PlannedTrial& trial = trial_of({seed, slot, ordinal}, attempt);
    const TrialSpec& setting = *trial.setting;
    std::shared_ptr<SharedMap> map = map_of(setting);
    const MeasuredMission& mission =
        map->mission(setting, trial.mission_index, missions_of(listed_, setting));
    if (!mission.record.is_valid) continue;
    Episode found{
        .ordinal = ordinal, .spec = trial.spec(), .map = std::move(map), .mission = &mission};
    // In turn the trials that were passed over are done with. At random the attempts are drawn by
    // themselves, and ordinals stay a slot's count of episodes.
    if (order_ == EpisodeOrder::in_turn) {
      const SlotTrials own = trials_of(slot);
      found.ordinal += attempt;
      found.round = own.first_round + found.ordinal / static_cast<std::int64_t>(own.count);
    }
    return found;
  }
  throw InputError("none of " + std::to_string(kMostAttempts) +
                   " missions of the sweep can be flown: `avoidbench maps` says why not");
}

void EpisodeSource::prepare(std::uint64_t seed, std::size_t slot, std::int64_t ordinal) {
  {
    const std::lock_guard lock(mutex_);
    requests_.push_back({seed, slot, ordinal});
  }
  requested_.notify_one();
}

void EpisodeSource::build_ahead(const std::stop_token& stop) {
  while (true) {
    Request request;
    {
      std::unique_lock lock(mutex_);
      if (!requested_.wait(lock, stop, [this] { return !requests_.empty(); })) return;
      if (stop.stop_requested()) return;
      // In the order asked: nobody's map waits for that of a later request.
      request = requests_.front();
      requests_.pop_front();
    }
    try {
      // Asked before each try: an end waits for one map at most.
      const auto heed_end = [&stop] {
        if (stop.stop_requested()) throw std::runtime_error("nobody waits for this map");
      };
      std::shared_ptr<SharedMap> map =
          episode(request.seed, request.slot, request.ordinal, heed_end).map;
      const std::lock_guard lock(mutex_);
      ahead_[request.slot] = std::move(map);  // else others may push it out before it is flown
    } catch (const std::exception&) {
      // Whoever asks for the episode itself is told.
    }
  }
}

}  // namespace avoidbench
