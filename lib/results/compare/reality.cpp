#include "compare/reality.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "base/input_error.hpp"
#include "base/math.hpp"
#include "base/number_text.hpp"
#include "base/words.hpp"
#include "report/table_rows.hpp"
#include "statistics/bootstrap.hpp"
#include "statistics/ranks.hpp"
#include "statistics/rates.hpp"
#include "store/trial_table.hpp"

namespace avoidbench {
namespace {

/// Flights of one sweep, by planner and mission: real ones without the ending of their labels.
struct FlownSweep {
  std::string name;
  std::map<std::pair<std::string, std::int64_t>, TrialRow> trials;
  std::map<std::int64_t, Mission> missions;
};

std::string planner_of(const TrialListing& trial) {
  const std::string& label = trial.planner_label;
  const bool has_ending = trial.is_recorded && label.ends_with(kRealLabel);
  return has_ending ? label.substr(0, label.size() - kRealLabel.size()) : label;
}

/// The real or the simulated flights of the latest revision of the one sweep that has some. Real
/// ones may also have been added to their twin's.
FlownSweep read_flights(const Database& database, bool is_real) {
  std::map<std::string, SweepInfo> latest;
  for (const SweepInfo& sweep : database.read_sweeps()) {
    if (sweep.trial_count > 0) latest.insert_or_assign(sweep.name, sweep);
  }
  std::map<std::string, std::vector<TrialListing>> sweeps;
  for (const auto& [name, sweep] : latest) {
    std::vector<TrialListing> trials = database.list_trials(name, sweep.revision);
    const bool is_mixed = std::any_of(trials.begin(), trials.end(), [&](const auto& trial) {
      return trial.is_recorded != is_real;
    });
    std::erase_if(trials, [&](const TrialListing& trial) { return trial.is_recorded != is_real; });
    const bool is_shown_beside = is_real && is_mixed;
    if (!trials.empty() && !is_shown_beside) sweeps.emplace(name, std::move(trials));
  }
  if (sweeps.size() != 1) {
    refuse_file(database.path(), "has " + counted(sweeps.size(), "sweep") + " with " +
                                     (is_real ? "real" : "simulated") + " flights; expected one");
  }
  FlownSweep flown{.name = sweeps.begin()->first, .trials = {}, .missions = {}};
  TrialReader reader(database);
  for (const TrialListing& trial : sweeps.begin()->second) {
    auto row = reader.read(trial.key);
    if (!row) continue;
    flown.trials.insert_or_assign({planner_of(trial), trial.mission_index}, *std::move(row));
    flown.missions[trial.mission_index] = trial.mission;
  }
  return flown;
}

/// One mission, flown in reality and simulated.
struct Pair {
  const TrialRow *real = nullptr, *simulated = nullptr;
  std::int64_t mission = 0;
  double distance_m = 0.0;

  bool is_same_outcome() const { return real->record.outcome == simulated->record.outcome; }
};

bool is_success(const TrialRow& row) { return row.record.outcome == Outcome::reached_goal; }

std::map<std::string, std::vector<Pair>> pairs_of(const FlownSweep& real,
                                                  const FlownSweep& simulation,
                                                  const std::filesystem::path& file) {
  std::map<std::string, std::vector<Pair>> pairs;
  for (const auto& [key, row] : real.trials) {
    const auto found = simulation.trials.find(key);
    if (found == simulation.trials.end()) continue;
    const Mission &a = real.missions.at(key.second), &b = simulation.missions.at(key.second);
    if (a.start_world != b.start_world || a.goal_world != b.goal_world) {
      refuse_file(file,
                  "mission " + std::to_string(key.second) + " of its sweep " + simulation.name +
                      " differs from that of the real flight: it is not a twin of " + real.name);
    }
    pairs[key.first].push_back(
        {.real = &row,
         .simulated = &found->second,
         .mission = key.second,
         .distance_m = path_distance_m(row.record.samples, found->second.record.samples)});
  }
  if (pairs.empty()) {
    refuse_file(file, "has no trial of a planner and mission of " + real.name +
                          ": name the real flights' planners as the twin labels its own");
  }
  return pairs;
}

/// Missions are paired: both have the same shortest paths.
double contrast_over(const std::vector<Pair>& pairs, std::span<const std::size_t> drawn) {
  std::int64_t real = 0, simulated = 0;
  for (const std::size_t i : drawn) {
    real += is_success(*pairs[i].real) ? 1 : 0;
    simulated += is_success(*pairs[i].simulated) ? 1 : 0;
  }
  const auto count = static_cast<std::int64_t>(drawn.size());
  return contrast_factor(jeffreys_rate(simulated, count), 1.0, jeffreys_rate(real, count), 1.0);
}

RealityGap gap_of(const std::string& simulation, const std::string& planner,
                  const std::vector<Pair>& pairs, const std::vector<Pair>* first) {
  RealityGap gap{.simulation = simulation, .planner = planner};
  gap.pair_count = static_cast<std::int64_t>(pairs.size());
  std::vector<double> distances_m, ratios;
  for (const Pair& pair : pairs) {
    gap.same_outcome_count += pair.is_same_outcome() ? 1 : 0;
    gap.real_rate += is_success(*pair.real) ? 1.0 : 0.0;
    gap.simulated_rate += is_success(*pair.simulated) ? 1.0 : 0.0;
    if (!std::isnan(pair.distance_m)) distances_m.push_back(pair.distance_m);
    if (first == nullptr) continue;
    const auto same = std::find_if(first->begin(), first->end(), [&](const Pair& other) {
      return other.mission == pair.mission;
    });
    if (same == first->end()) continue;
    // As ratios: a flight that chose the other side of a tree must not outweigh all others.
    ratios.push_back(math::log(pair.distance_m / same->distance_m));
    gap.nearer_count += pair.distance_m < same->distance_m ? 1 : 0;
  }
  const auto count = static_cast<double>(pairs.size());
  gap.real_rate /= count;
  gap.simulated_rate /= count;
  std::vector<std::size_t> every(pairs.size());
  std::iota(every.begin(), every.end(), std::size_t{0});
  gap.contrast_factor = contrast_over(pairs, every);
  gap.contrast_interval = bca_interval(
      pairs.size(), [&](std::span<const std::size_t> drawn) { return contrast_over(pairs, drawn); },
      stream(1, "reality_gaps"));
  std::sort(distances_m.begin(), distances_m.end());
  gap.distance_m = quantile(distances_m, 0.5);
  gap.p = first == nullptr ? math::kNaN : wilcoxon_signed_rank(ratios).p;
  return gap;
}

Eigen::Vector3d position_at(std::span<const Sample> samples, double time_s) {
  const auto next =
      std::lower_bound(samples.begin(), samples.end(), time_s,
                       [](const Sample& sample, double time) { return sample.time_s < time; });
  if (next == samples.begin()) return samples.front().position_world;
  if (next == samples.end()) return samples.back().position_world;
  const Sample &a = *(next - 1), &b = *next;
  const double share = (time_s - a.time_s) / (b.time_s - a.time_s);
  return (1.0 - share) * a.position_world + share * b.position_world;
}

}  // namespace

double path_distance_m(std::span<const Sample> a, std::span<const Sample> b) {
  constexpr double kStep_s = 0.05;
  if (a.empty() || b.empty()) return math::kNaN;
  const double end_s = std::min(a.back().time_s, b.back().time_s);
  const auto steps = static_cast<std::int64_t>(std::floor(end_s / kStep_s));
  double sum_m = 0.0;
  for (std::int64_t step = 0; step <= steps; ++step) {
    const double time_s = static_cast<double>(step) * kStep_s;
    sum_m += (position_at(a, time_s) - position_at(b, time_s)).norm();
  }
  return sum_m / static_cast<double>(steps + 1);
}

std::vector<RealityGap> reality_gaps(const Database& real, std::span<const Database> simulations) {
  const FlownSweep flown = read_flights(real, true);
  std::vector<RealityGap> gaps;
  // What is compared with the first simulation points into its rows: those stay.
  std::vector<FlownSweep> sweeps;
  sweeps.reserve(simulations.size());
  std::map<std::string, std::vector<Pair>> first;
  for (const Database& database : simulations) {
    sweeps.push_back(read_flights(database, false));
    auto pairs = pairs_of(flown, sweeps.back(), database.path());
    const bool is_first = sweeps.size() == 1;
    for (const auto& [planner, of_planner] : pairs) {
      const auto base = first.find(planner);
      gaps.push_back(gap_of(database.path().stem().string(), planner, of_planner,
                            is_first || base == first.end() ? nullptr : &base->second));
    }
    if (is_first) first = std::move(pairs);
  }
  std::vector<double> p;
  for (const RealityGap& gap : gaps) p.push_back(gap.p);
  p = holm_adjusted(p);
  for (std::size_t i = 0; i < gaps.size(); ++i) gaps[i].p = p[i];
  return gaps;
}

Table reality_table(const std::vector<RealityGap>& gaps) {
  Table table = make_table(
      "reality", "Reality and simulations of it, mission by mission",
      {{.name = "simulation", .place = Place::key},
       planner_column(),
       {.name = "pair_count", .header = "pairs", .doc = "missions flown in both"},
       {.name = "same_outcome_count", .header = "same outcome"},
       {.name = "real_rate", .header = "SR real", .doc = "success rate"},
       {.name = "simulated_rate", .header = "SR simulated"},
       {.name = "contrast_factor",
        .header = "CF",
        .doc = "failures per metre, simulated over real (AvoidBench, eq. (10)), rates smoothed "
               "(Jeffreys), with its 95 % interval by bootstrap over missions (BCa); above 1 the "
               "simulation is harder"},
       {.name = "contrast_interval", .header = "95 % interval"},
       {.name = "distance_m",
        .header = "distance, m",
        .doc = "between the real and the simulated path at equal times, mean over a flight, "
               "median over missions"},
       {.name = "nearer_count",
        .header = "nearer",
        .doc = "missions on which it is nearer to reality than the first simulation"},
       {.name = "p",
        .doc = "that it is as near as the first simulation: Wilcoxon's signed-rank test of the "
               "distances' ratios, corrected (Holm)"}});
  const bool has_several = std::any_of(gaps.begin(), gaps.end(), [&](const RealityGap& gap) {
    return gap.simulation != gaps.front().simulation;
  });
  const auto digits = [](double value, int decimals) {
    return std::isnan(value) ? std::string("–") : fixed_digits(value, decimals);
  };
  for (const RealityGap& gap : gaps) {
    const Interval& interval = gap.contrast_interval;
    const bool is_first = std::isnan(gap.p);
    table.rows.push_back(make_row(
        gap.simulation, gap.planner, gap.pair_count, gap.same_outcome_count,
        digits(gap.real_rate, 3), digits(gap.simulated_rate, 3), digits(gap.contrast_factor, 2),
        "[" + digits(interval.lower, 2) + ", " + digits(interval.upper, 2) + "]",
        digits(gap.distance_m, 2), is_first ? std::string("–") : std::to_string(gap.nearer_count),
        gap.p < 0.0005 ? std::string("<0.001") : digits(gap.p, 3)));
  }
  if (!has_several) {
    for (const char* name : {"p", "nearer_count"}) drop_column(table, column_at(table, name));
  }
  return table;
}

}  // namespace avoidbench
