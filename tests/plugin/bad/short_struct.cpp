#include "honest.hpp"

BAD_PLANNER(table.struct_size = 40)
