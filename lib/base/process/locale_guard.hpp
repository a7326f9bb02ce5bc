#pragma once

#include <locale.h>

namespace avoidbench {

/// While it lives, a planner's code may run, in the process's locale as in any program; afterwards
/// this thread is in the locale "C", whatever the planner has set or sets later from a thread of
/// its own: numbers are written with a point, words compared byte by byte.
class LocaleGuard {
 public:
  LocaleGuard() { ::uselocale(LC_GLOBAL_LOCALE); }
  ~LocaleGuard() { ::uselocale(plain_locale()); }
  LocaleGuard(const LocaleGuard&) = delete;
  LocaleGuard& operator=(const LocaleGuard&) = delete;

 private:
  static locale_t plain_locale() {
    static const locale_t plain = ::newlocale(LC_ALL_MASK, "C", static_cast<locale_t>(nullptr));
    return plain;
  }
};

}  // namespace avoidbench
