#ifndef ROS_ROS_H
#define ROS_ROS_H

// What a ROS 1 planner uses of roscpp, over avoidbench's simulated time: one thread, no master, no
// network, the same order of callbacks in every run. See docs/ros.md.

// What roscpp's headers bring along.
#include <climits>
#include <cmath>
#include <condition_variable>
#include <cstdarg>
#include <cstdio>
#include <iomanip>
#include <iostream>
#include <list>
#include <map>
#include <mutex>
#include <set>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "ros/assert.h"
#include "ros/console.h"
#include "ros/duration.h"
#include "ros/init.h"
#include "ros/message_event.h"
#include "ros/node_handle.h"
#include "ros/param.h"
#include "ros/publisher.h"
#include "ros/rate.h"
#include "ros/service.h"
#include "ros/service_client.h"
#include "ros/service_server.h"
#include "ros/spinner.h"
#include "ros/subscriber.h"
#include "ros/this_node.h"
#include "ros/time.h"
#include "ros/timer.h"
#include "ros/topic.h"

#define ROS_VERSION_MAJOR 1
#define ROS_VERSION_MINOR 16
#define ROS_VERSION_PATCH 0
#define ROS_VERSION_COMBINED(major, minor, patch) (((major) << 20) | ((minor) << 10) | (patch))
#define ROS_VERSION ROS_VERSION_COMBINED(ROS_VERSION_MAJOR, ROS_VERSION_MINOR, ROS_VERSION_PATCH)
#define ROS_VERSION_MINIMUM(major, minor, patch) \
  (ROS_VERSION >= ROS_VERSION_COMBINED(major, minor, patch))

#endif
