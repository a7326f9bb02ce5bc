#include "sweep/shard.hpp"

#include <charconv>
#include <cstdlib>
#include <optional>

#include "base/option_error.hpp"

namespace avoidbench {
namespace {

/// A whole number and nothing else.
std::optional<std::int64_t> number_from(const std::string& text) {
  std::int64_t number = 0;
  const char* end = text.data() + text.size();
  const auto [at, error] = std::from_chars(text.data(), end, number);
  if (error != std::errc{} || at != end || text.empty()) return std::nullopt;
  return number;
}

std::optional<std::int64_t> number_of(const char* variable) {
  const char* text = std::getenv(variable);
  return text != nullptr ? number_from(text) : std::nullopt;
}

[[noreturn]] void fail(const std::string& text, const std::string& reason) {
  throw OptionError(text + ": " + reason, "shard");
}

/// This task's place among `count` shards, from 1.
std::int64_t task_index(const std::string& text, std::optional<std::int64_t> count) {
  // Slurm, PBS, and indexed jobs of Kubernetes, which count from 0.
  if (const auto task = number_of("SLURM_ARRAY_TASK_ID")) {
    // An array of fewer tasks flies some of the shards again: they keep their numbers.
    if (count && number_of("SLURM_ARRAY_TASK_COUNT").value_or(*count) != *count) return *task;
    // Arrays may begin at any number.
    return *task - number_of("SLURM_ARRAY_TASK_MIN").value_or(1) + 1;
  }
  if (const auto task = number_of("PBS_ARRAY_INDEX")) return *task;
  if (const auto task = number_of("JOB_COMPLETION_INDEX")) return *task + 1;
  fail(text, "none of SLURM_ARRAY_TASK_ID, PBS_ARRAY_INDEX and JOB_COMPLETION_INDEX is set");
}

}  // namespace

Shard shard_from(const std::string& text) {
  const std::size_t slash = text.find('/');
  const std::string first = text.substr(0, slash);
  const bool has_count = slash != std::string::npos;
  const auto given = has_count ? number_from(text.substr(slash + 1)) : std::nullopt;
  if (has_count && (!given || *given < 1)) fail(text, "expected I/N, auto or auto/N");
  Shard shard;
  if (first == "auto") {
    shard.index = task_index(text, given);
    const auto count = has_count ? given : number_of("SLURM_ARRAY_TASK_COUNT");
    if (!count) fail(text, "how many there are is not known: write auto/N");
    shard.count = *count;
  } else {
    const auto index = number_from(first);
    if (!index || !has_count) fail(text, "expected I/N, auto or auto/N");
    shard = {.index = *index, .count = *given};
  }
  if (shard.index < 1 || shard.index > shard.count) {
    fail(text, "there is no shard " + std::to_string(shard.index) + " of " +
                   std::to_string(shard.count) + "; they count from 1");
  }
  return shard;
}

std::string text(const Shard& shard) {
  if (shard.count == 1) return "";
  return std::to_string(shard.index) + "/" + std::to_string(shard.count);
}

}  // namespace avoidbench
