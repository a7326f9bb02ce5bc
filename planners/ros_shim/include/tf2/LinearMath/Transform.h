#ifndef TF2_LINEARMATH_TRANSFORM_H
#define TF2_LINEARMATH_TRANSFORM_H

#include "tf/transform_datatypes.h"

/// The classes of tf, which are the same.
namespace tf2 {
using tf::Matrix3x3;
using tf::Quaternion;
using tf::quatRotate;
using tf::Transform;
using tf::Vector3;
}  // namespace tf2

#endif
