#pragma once

#include <string>

namespace avoidbench {

/// A share from "1%", "0.01" or "1". Throws InputError for what is none above 0 and up to 1.
double share_from(const std::string& text);

/// Whether a sample of this share has the trial of this key: by the key's first 32 bits, so that a
/// larger sample has all trials of a smaller one.
bool is_sampled(const std::string& key, double share);

}  // namespace avoidbench
