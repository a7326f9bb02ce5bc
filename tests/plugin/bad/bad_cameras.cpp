#include "honest.hpp"

BAD_PLANNER(table.needs = AB_INPUT_STATE | AB_INPUT_ONE_CAMERA; table.least_fov_x_rad = 3.2;
            table.least_fov_y_rad = 1.0)
