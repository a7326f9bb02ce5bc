#include "honest.hpp"

/// Not bad: it says that it handles one camera, and how much that has to see.
BAD_PLANNER(table.needs |= AB_INPUT_ONE_CAMERA; table.least_fov_x_rad = 1.5;
            table.least_fov_y_rad = 1.0)
