#ifndef TF2_LINEARMATH_QUATERNION_H
#define TF2_LINEARMATH_QUATERNION_H

#include "tf2/LinearMath/Transform.h"

#endif
