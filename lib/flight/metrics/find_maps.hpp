#pragma once

#include <cstdint>
#include <functional>
#include <vector>

namespace avoidbench {

/// Which maps are wanted: those whose measure is near a value, by one parameter of the generator.
struct MapTarget {
  /// NaN: undefined.
  std::function<double(double parameter, std::uint64_t map_seed)> measure = {};
  double wanted = 0.0, within = 0.0;
  double lowest = 0.0, highest = 0.0;  ///< of the parameter
  std::int64_t count = 1;              ///< maps wanted
  std::int64_t most_seeds = 100;       ///< seeds 1 to this are tried
};

struct MapTried {
  double parameter = 0.0;
  std::uint64_t map_seed = 0;
  double value = 0.0;
  bool is_accepted = false;
};

struct MapsFound {
  double parameter = 0.0;  ///< the same for all, so that the seeds are one axis of a sweep
  std::vector<std::uint64_t> seeds;  ///< accepted ones, `count` of them or as many as there are
  std::vector<MapTried> tried;       ///< every map measured, in order
};

/// First the parameter at which the mean of seeds 1 to 3 is the wanted value, by bisection (the
/// measure is taken to rise or to fall with it); then seeds from 1 on, of which those within the
/// tolerance are kept. Throws InputError where the value lies beyond those at both ends.
MapsFound find_maps(const MapTarget& target);

}  // namespace avoidbench
