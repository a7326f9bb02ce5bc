#include "honest.hpp"

BAD_PLANNER(static_cast<void>(table))
