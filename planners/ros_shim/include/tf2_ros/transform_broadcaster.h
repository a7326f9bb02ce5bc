#ifndef TF2_ROS_TRANSFORM_BROADCASTER_H
#define TF2_ROS_TRANSFORM_BROADCASTER_H

#include "tf/transform_broadcaster.h"

namespace tf2_ros {
using tf::TransformBroadcaster;
}  // namespace tf2_ros

#endif
