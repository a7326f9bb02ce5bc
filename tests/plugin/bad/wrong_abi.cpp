#include "honest.hpp"

BAD_PLANNER(table.abi_version = 7)
