#include <optional>
#include <stdexcept>

#include "avoidbench/planner.hpp"

// Sound as a library, but can't fly as it lies there.
namespace {

class FailsCheck {
 public:
  static constexpr const char* name = "fails_check";
  static constexpr std::uint32_t needs = AB_INPUT_STATE;
  static constexpr std::uint32_t commands = AB_COMMAND_VELOCITY;
  static void check() { throw std::runtime_error("weights.bin ends after 12 of 40 bytes"); }

  explicit FailsCheck(const ab_setup&) {}
  void reset(const ab_mission&) {}
  std::optional<ab_command> plan(const ab_observation&) { return std::nullopt; }
};

}  // namespace

AVOIDBENCH_PLANNER(FailsCheck)
