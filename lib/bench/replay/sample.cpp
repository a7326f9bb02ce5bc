#include "replay/sample.hpp"

#include <charconv>
#include <string_view>

#include "base/option_error.hpp"

namespace avoidbench {

double share_from(const std::string& text) {
  double share = -1.0;
  const char* const last = text.data() + text.size();
  const auto [end, error] = std::from_chars(text.data(), last, share);
  const std::string_view rest(end, static_cast<std::size_t>(last - end));
  if (rest == "%") share /= 100.0;
  const bool is_number = error == std::errc() && (rest.empty() || rest == "%");
  if (!is_number || !(share > 0.0 && share <= 1.0)) {
    throw OptionError(text + ": expected a share such as 1% or 0.01", "sample");
  }
  return share;
}

bool is_sampled(const std::string& key, double share) {
  // The key's first 32 bits are as good as random, and fixed: the sample of a share is the same on
  // every machine, and a larger share holds the smaller one's trials.
  const auto number = static_cast<double>(std::stoul(key.substr(0, 8), nullptr, 16));
  return number < share * 4294967296.0;
}

}  // namespace avoidbench
