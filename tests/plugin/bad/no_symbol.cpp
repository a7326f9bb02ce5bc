#include "honest.hpp"

extern "C" AB_EXPORT int answer();
extern "C" AB_EXPORT int answer() { return honest::table().plan == nullptr ? 0 : 42; }
