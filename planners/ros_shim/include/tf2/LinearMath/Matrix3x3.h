#ifndef TF2_LINEARMATH_MATRIX3X3_H
#define TF2_LINEARMATH_MATRIX3X3_H

#include "tf2/LinearMath/Transform.h"

#endif
