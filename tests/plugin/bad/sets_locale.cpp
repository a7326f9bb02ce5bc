#include <locale.h>

#include <atomic>
#include <locale>
#include <string>
#include <thread>

#include "avoidbench/planner.hpp"

// Flies along x and sets a locale whose numbers have a comma; LOCPATH names the folder that has it.
class SetsLocale {
 public:
  static constexpr const char* name = "sets_locale";
  static constexpr const char* version = "1";
  static constexpr const char* summary = "Flies along x in German.";
  static constexpr std::uint32_t needs = AB_INPUT_STATE;
  static constexpr std::uint32_t commands = AB_COMMAND_VELOCITY;
  static constexpr std::array parameters{avoidbench::choice_parameter(
      "how", "none", "none|setlocale|uselocale|global|thread", "How it sets the locale.")};

  SetsLocale(const ab_setup& setup, const ab_host&) {
    how_ = avoidbench::Parameters<SetsLocale>(setup).text("how");
    if (how_ != "thread") return;
    other_ = std::thread([this] {
      while (!is_over_) set();
    });
  }
  ~SetsLocale() {
    is_over_ = true;
    if (other_.joinable()) other_.join();
  }

  void reset(const ab_mission&) {}

  std::optional<ab_command> plan(const ab_observation&) {
    if (how_ == "setlocale") set();
    if (how_ == "global") std::locale::global(std::locale(kGerman));
    if (how_ == "uselocale") {
      static const locale_t german = ::newlocale(LC_ALL_MASK, kGerman, locale_t{});
      if (german == locale_t{}) avoidbench::give_up("no locale");
      ::uselocale(german);
    }
    const bool is_set = how_ == "none" || how_ == "thread" || *::localeconv()->decimal_point == ',';
    if (!is_set) avoidbench::give_up("the locale is not set");
    return avoidbench::make_velocity_command({1.0, 0.0, 0.0}, 0.0);
  }

 private:
  static constexpr const char* kGerman = "de_DE.UTF-8";

  static void set() {
    if (::setlocale(LC_ALL, kGerman) == nullptr) avoidbench::give_up("no locale");
  }

  std::string how_;
  std::atomic<bool> is_over_{false};
  std::thread other_;
};

AVOIDBENCH_PLANNER(SetsLocale)
