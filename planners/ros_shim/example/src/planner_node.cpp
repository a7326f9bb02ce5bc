#include <ros/ros.h>

#include "primitive_planner.h"

int main(int argc, char** argv) {
  ros::init(argc, argv, "planner_node");
  ros::NodeHandle nh("~");

  ros_example::PrimitivePlanner planner;
  planner.init(nh);

  ros::Duration(1.0).sleep();
  ros::spin();
}
