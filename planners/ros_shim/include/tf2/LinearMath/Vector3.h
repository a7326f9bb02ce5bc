#ifndef TF2_LINEARMATH_VECTOR3_H
#define TF2_LINEARMATH_VECTOR3_H

#include "tf2/LinearMath/Transform.h"

#endif
