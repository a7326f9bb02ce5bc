#ifndef TF2_UTILS_H
#define TF2_UTILS_H

#include "tf2/LinearMath/Transform.h"

namespace tf2 {
using tf::getYaw;
}  // namespace tf2

#endif
