#include "statistics/limit_curve.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "base/math.hpp"
#include "base/normal_quantile.hpp"
#include "base/random.hpp"
#include "statistics/bootstrap.hpp"

namespace avoidbench {
namespace {

constexpr std::size_t kLevels = 41;
constexpr double kWanted = 0.9;
constexpr std::size_t kMaps = 30;

/// A planner whose rates are known.
struct Truth {
  double limit = 0.5, width = 0.08, lapse = 0.02;
  bool is_falling = true;
  double map_spread = 0.0;  ///< standard deviation of the maps' logits

  double rate(double u, double map_logit = 0.0) const {
    const double share = kWanted / (1.0 - lapse);
    const double along = (u - limit) / width * (is_falling ? -1.0 : 1.0);
    const double logit = math::log(share / (1.0 - share)) + along + map_logit;
    return (1.0 - lapse) / (1.0 + math::exp(-logit));
  }
};

Truth drawn_truth(RandomStream& random) {
  return {.limit = random.uniform(0.15, 0.85),
          .width = 0.015 * math::pow(8.0, random.uniform()),
          .lapse = random.uniform(0.0, 0.06),
          .is_falling = random.uniform() < 0.5};
}

/// Trials of a planner, flown map after map.
class Flights {
 public:
  Flights(Truth truth, std::uint64_t seed) : truth_(truth), random_(seed) {
    for (double& logit : map_logits_) logit = truth.map_spread * random_.normal();
  }

  void fly(std::size_t level) {
    fly_at(level, truth_.rate(static_cast<double>(level) / (kLevels - 1), map_logits_[next_map_]));
  }
  void fly_at(std::size_t level, double rate) {
    LimitCell& cell = cells_[{level, next_map_}];
    cell.level = level;
    cell.map = next_map_;
    ++cell.trials;
    if (random_.uniform() < rate) ++cell.successes;
    next_map_ = (next_map_ + 1) % kMaps;
    ++count_;
  }
  std::vector<LimitCell> cells() const {
    std::vector<LimitCell> all;
    for (const auto& [place, cell] : cells_) all.push_back(cell);
    return all;
  }
  std::size_t count() const { return count_; }

 private:
  Truth truth_;
  RandomStream random_;
  std::array<double, kMaps> map_logits_{};
  std::map<std::pair<std::size_t, std::size_t>, LimitCell> cells_;
  std::size_t next_map_ = 0, count_ = 0;
};

const LimitCurve& curve() {
  static const LimitCurve one(kLevels, kWanted);
  return one;
}

/// Of a direction that is known.
const LimitCurve& curve_that(bool is_falling) {
  static const LimitCurve falls(kLevels, kWanted, LimitDirection::falls);
  static const LimitCurve rises(kLevels, kWanted, LimitDirection::rises);
  return is_falling ? falls : rises;
}

bool is_done(const LimitEstimate& estimate, double width) {
  return estimate.state != LimitState::found || estimate.width() <= width;
}

/// Flies until the interval is as narrow, in batches of eight.
LimitEstimate search(Flights& flights, double width, std::size_t most = 1200,
                     const LimitCurve& fitted = curve()) {
  for (std::size_t i = 0; i < 9; ++i) {
    for (int k = 0; k < 2; ++k) flights.fly(i * (kLevels - 1) / 8);
  }
  while (true) {
    const LimitEstimate now = fitted.estimate(flights.cells());
    if (is_done(now, width) || flights.count() >= most) return now;
    const std::vector<std::int64_t> room(kLevels, 1'000'000);
    for (const std::size_t level : fitted.next(flights.cells(), 8, room)) flights.fly(level);
  }
}

/// Flies the same number of trials at each ninth of the levels, or each level, until it is as
/// narrow.
std::size_t trials_of_grid(Flights& flights, double width, std::size_t step,
                           std::size_t most = 4000) {
  while (flights.count() < most) {
    for (std::size_t level = 0; level < kLevels; level += step) flights.fly(level);
    if (flights.count() >= 18 && is_done(curve().estimate(flights.cells()), width)) break;
  }
  return flights.count();
}

struct Searches {
  int covered = 0, curves = 0;
  std::vector<double> trials;
};

Searches searches(int curves, double width, std::uint64_t seed, bool is_direction_known = false) {
  RandomStream random = stream(seed, "truths");
  Searches result;
  for (int i = 0; i < curves; ++i) {
    const Truth truth = drawn_truth(random);
    Flights flights(truth, random.bits());
    const LimitCurve& fitted = is_direction_known ? curve_that(truth.is_falling) : curve();
    const LimitEstimate found = search(flights, width, 1200, fitted);
    ++result.curves;
    result.trials.push_back(static_cast<double>(flights.count()));
    if (found.interval.lower <= truth.limit && truth.limit <= found.interval.upper)
      ++result.covered;
  }
  return result;
}

TEST(LimitCurveSlow, IntervalsHoldTheLimit) {
  const Searches found = searches(200, 0.12, 1);
  EXPECT_GE(found.covered, 186);
  EXPECT_LE(found.covered, 194);
}

TEST(LimitCurveSlow, IntervalsHoldTheLimitWhereTheDirectionIsKnown) {
  const Searches found = searches(200, 0.12, 1, true);
  EXPECT_GE(found.covered, 186);
  EXPECT_LE(found.covered, 194);
}

TEST(LimitCurve, IntervalsHoldTheLimit) {
  const Searches found = searches(30, 0.2, 2);
  EXPECT_GE(found.covered, 27);
}

TEST(LimitCurveSlow, IntervalsHoldTheLimitWhereMapsDiffer) {
  // The limit that is looked for is that of all maps together, which the spread of logits moves.
  const Truth middle{.limit = 0.5, .width = 0.06, .lapse = 0.02, .map_spread = 1.0};
  double low = 0.0, high = 1.0;
  for (int i = 0; i < 50; ++i) {
    const double u = 0.5 * (low + high);
    double mean = 0.0;
    // The logits' normal distribution by its quantiles.
    for (int k = 0; k < 200; ++k) mean += middle.rate(u, normal_quantile((k + 0.5) / 200)) / 200.0;
    (mean > kWanted ? low : high) = u;
  }
  RandomStream random = stream(3, "spread");
  int covered = 0;
  for (int i = 0; i < 100; ++i) {
    Flights flights(middle, random.bits());
    const LimitEstimate found = search(flights, 0.15);
    if (found.interval.lower <= low && low <= found.interval.upper) ++covered;
  }
  EXPECT_GE(covered, 91);
}

TEST(LimitCurveSlow, TakesHalfTheTrialsOfAGrid) {
  RandomStream random = stream(7, "truths");
  std::vector<double> of_all, of_ninth;
  for (int i = 0; i < 60; ++i) {
    const Truth truth = drawn_truth(random);
    Flights flights(truth, random.bits()), all(truth, random.bits()), few(truth, random.bits());
    search(flights, 0.12, 3000);
    const auto chosen = static_cast<double>(flights.count());
    of_all.push_back(chosen / static_cast<double>(trials_of_grid(all, 0.12, 1)));
    of_ninth.push_back(chosen / static_cast<double>(trials_of_grid(few, 0.12, 5)));
  }
  EXPECT_LE(quantile(of_all, 0.5), 0.5);
  EXPECT_LE(quantile(of_ninth, 0.5), 0.5);
}

TEST(LimitCurve, SaysThatSuccessIsAboveOrBelowEverywhere) {
  for (const double rate : {0.99, 0.3}) {
    Flights flights({}, 5);
    for (int k = 0; k < 20; ++k) {
      for (std::size_t level = 0; level < kLevels; level += 5) flights.fly_at(level, rate);
    }
    const LimitEstimate found = curve().estimate_whole(flights.cells());
    EXPECT_EQ(found.state, rate > kWanted ? LimitState::all_above : LimitState::all_below);
  }
}

TEST(LimitCurve, SaysThatSuccessDoesNotGoOneWay) {
  const auto dip = [](std::size_t level) { return level > 12 && level < 28 ? 0.4 : 0.97; };
  Flights flights({}, 6);
  for (int k = 0; k < 2; ++k) {
    for (std::size_t level = 0; level < kLevels; level += 5) flights.fly_at(level, dip(level));
  }
  for (int round = 0; round < 25; ++round) {
    const std::vector<std::int64_t> room(kLevels, 1'000'000);
    for (const std::size_t level : curve().next(flights.cells(), 8, room)) {
      flights.fly_at(level, dip(level));
    }
  }
  EXPECT_EQ(curve().estimate_whole(flights.cells()).state, LimitState::not_monotone);
}

/// What a known direction is for: flights that are all near the wanted rate tell no direction, and
/// without one no limit.
TEST(LimitCurve, AKnownDirectionDecidesWhatTrialsLeaveOpen) {
  const auto rate = [](std::size_t level) { return level < 24 ? 0.96 : 0.88; };
  Flights flights({}, 31);
  for (int k = 0; k < 10; ++k) {
    for (std::size_t level = 0; level < kLevels; level += 5) flights.fly_at(level, rate(level));
  }
  const LimitEstimate open = curve().estimate_whole(flights.cells());
  EXPECT_LT(open.interval.lower, 0.0);
  EXPECT_GT(open.interval.upper, 1.0);
  const LimitEstimate found = curve_that(true).estimate_whole(flights.cells());
  EXPECT_TRUE(found.is_falling);
  EXPECT_GT(found.interval.lower, 0.2);
  EXPECT_EQ(found.state, LimitState::found);
  // The rates of both curves are of the same trials.
  EXPECT_NEAR(found.rates[12], open.rates[12], 0.05);
}

TEST(LimitCurve, SaysThatSuccessDoesNotGoTheWayItIsKnownToGo) {
  Flights flights({.limit = 0.5, .width = 0.05}, 32);
  for (int k = 0; k < 10; ++k) {
    for (std::size_t level = 0; level < kLevels; level += 5) flights.fly(level);
  }
  const auto state = [&](LimitDirection direction) {
    return LimitCurve(kLevels, kWanted, direction).estimate_whole(flights.cells()).state;
  };
  EXPECT_EQ(state(LimitDirection::unknown), LimitState::found);
  EXPECT_EQ(state(LimitDirection::falls), LimitState::found);
  EXPECT_EQ(state(LimitDirection::rises), LimitState::not_monotone);
}

/// As rarely as it says it takes a response that goes one way for one that does not.
TEST(LimitCurveSlow, MonotoneResponsesAreRarelyTakenForNone) {
  RandomStream random = stream(9, "truths");
  int wrong = 0;
  for (int i = 0; i < 100; ++i) {
    Flights flights(drawn_truth(random), random.bits());
    search(flights, 0.15, 400);
    if (curve().estimate_whole(flights.cells()).state == LimitState::not_monotone) ++wrong;
  }
  EXPECT_LE(wrong, 4);
}

TEST(LimitCurve, KeepsToTheRoomThereIs) {
  Flights flights({}, 8);
  for (std::size_t level = 0; level < kLevels; level += 5) flights.fly(level);
  std::vector<std::int64_t> room(kLevels, 0);
  room[17] = 2;
  room[30] = 1;
  std::vector<std::size_t> next = curve().next(flights.cells(), 8, room);
  std::sort(next.begin(), next.end());
  EXPECT_EQ(next, (std::vector<std::size_t>{17, 17, 30}));
}

TEST(LimitCurve, WithoutTrialsEverythingIsPossible) {
  const LimitEstimate nothing = curve().estimate_whole({});
  EXPECT_EQ(nothing.state, LimitState::found);
  EXPECT_EQ(nothing.trials, 0);
  EXPECT_LT(nothing.interval.lower, 0.0);
  EXPECT_GT(nothing.interval.upper, 1.0);
}

/// A planner that always succeeds goes farther than one that does not, whichever way success goes.
TEST(LimitContrast, APlannerWithoutALimitIsTheBetterOne) {
  std::vector<std::vector<LimitCell>> planners;
  Flights never_fails({}, 21), falls({.limit = 0.5, .width = 0.05}, 22);
  for (int k = 0; k < 15; ++k) {
    for (std::size_t level = 0; level < kLevels; level += 5) never_fails.fly_at(level, 1.0);
  }
  search(falls, 0.15);
  planners = {never_fails.cells(), falls.cells()};
  const std::vector<double> others = directions_of_others(curve(), planners);
  EXPECT_GT(others[0], 5.0);
  EXPECT_NEAR(others[1], 0.0, 1.0);
  EXPECT_EQ(curve().estimate(planners[0], others[0]).state, LimitState::all_above);
  const LimitContrast contrast =
      limit_contrast(limit_draws(curve(), planners[0], kMaps, 1, others[0]),
                     limit_draws(curve(), planners[1], kMaps, 1, others[1]));
  EXPECT_EQ(contrast.first_is_higher, 1.0);
  EXPECT_NEAR(contrast.difference, 0.5, 0.1);
}

TEST(LimitContrast, TellsTheHigherLimit) {
  Flights near({.limit = 0.35, .width = 0.05}, 11), far({.limit = 0.65, .width = 0.05}, 12);
  search(near, 0.15);
  search(far, 0.15);
  const std::vector<double> first = limit_draws(curve(), far.cells(), kMaps, 1);
  const std::vector<double> second = limit_draws(curve(), near.cells(), kMaps, 1);
  const LimitContrast contrast = limit_contrast(first, second);
  EXPECT_GT(contrast.first_is_higher, 0.99);
  EXPECT_LE(contrast.interval.lower, 0.3);
  EXPECT_GE(contrast.interval.upper, 0.3);
  const LimitContrast same = limit_contrast(first, first);
  EXPECT_DOUBLE_EQ(same.first_is_higher, 0.5);
  EXPECT_DOUBLE_EQ(same.difference, 0.0);
}

// Another choice is another sweep: `limit` flies what this says, and stores it.
TEST(LimitCurve, FliesTheLevelsOfEveryMachine) {
  const LimitCurve falls(kLevels, kWanted, LimitDirection::falls);
  const std::vector<std::int64_t> room(kLevels, 10);
  const std::vector<LimitCell> few{{.level = 4, .map = 0, .successes = 5, .trials = 5},
                                   {.level = 36, .map = 1, .successes = 1, .trials = 6}};
  EXPECT_EQ(falls.next(few, 6, room), (std::vector<std::size_t>{25, 25, 22, 21, 21, 20}));
  std::vector<LimitCell> more = few;
  more.push_back({.level = 20, .map = 2, .successes = 9, .trials = 10});
  EXPECT_EQ(falls.next(more, 6, room), (std::vector<std::size_t>{27, 25, 40, 9, 24, 24}));
  EXPECT_EQ(LimitCurve(kLevels, 0.5).next(more, 6, room),
            (std::vector<std::size_t>{32, 32, 32, 9, 33, 33}));
}

}  // namespace
}  // namespace avoidbench
