#include <nav_msgs/Odometry.h>
#include <ros/ros.h>

int main(int argc, char** argv) {
  ros::init(argc, argv, "hall_simulator");
  ros::NodeHandle node;
  ros::Publisher odometry = node.advertise<nav_msgs::Odometry>("/vio/odometry", 10);
  ros::spin();
}
