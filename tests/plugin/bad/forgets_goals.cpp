#include "honest.hpp"

// It says that it heeds further goals, and flies along x whatever is shown.
BAD_PLANNER(table.needs |= AB_INPUT_GOALS)
