#include "honest.hpp"

BAD_PLANNER(table.name = "Bad Name"; table.commands = 1024)
