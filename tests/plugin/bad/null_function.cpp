#include "honest.hpp"

BAD_PLANNER(table.plan = nullptr)
