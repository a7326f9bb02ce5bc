#include <string>

#include "avoidbench/planner.hpp"

// Logs any text and gives up with it.
class Shouts {
 public:
  static constexpr const char* name = "shouts";
  static constexpr const char* version = "1";
  static constexpr const char* summary = "Gives up with a text.";
  static constexpr std::uint32_t needs = AB_INPUT_STATE;
  static constexpr std::uint32_t commands = AB_COMMAND_VELOCITY;
  static constexpr std::array parameters{
      avoidbench::text_parameter("words", "walled in", "What it logs and gives as its reason.")};

  Shouts(const ab_setup& setup, const ab_host& host)
      : words_(avoidbench::Parameters<Shouts>(setup).text("words")) {
    host.log(host.context, AB_LOG_WARNING, words_.c_str());
  }
  void reset(const ab_mission&) {}
  std::optional<ab_command> plan(const ab_observation&) { avoidbench::give_up(words_); }

 private:
  std::string words_;
};

AVOIDBENCH_PLANNER(Shouts)
