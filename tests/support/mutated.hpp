#pragma once

#include <string>

#include "base/random.hpp"

namespace avoidbench::test {

/// The text with up to `most_changes` places changed at random: a character replaced by or put in
/// from `special`, or a piece taken out or repeated.
inline std::string mutated(std::string text, std::uint64_t most_changes, const std::string& special,
                           RandomStream& random) {
  const std::uint64_t changes = random.below(most_changes + 1);
  for (std::uint64_t i = 0; i < changes && !text.empty(); ++i) {
    const std::size_t place = random.below(text.size());
    const std::size_t length = 1 + random.below(8);
    const std::uint64_t what = random.below(4);
    if (what == 0) text[place] = special[random.below(special.size())];
    if (what == 1) text.erase(place, length);
    if (what == 2) text.insert(place, text.substr(place, length));
    if (what == 3) text.insert(place, 1, special[random.below(special.size())]);
  }
  return text;
}

}  // namespace avoidbench::test
