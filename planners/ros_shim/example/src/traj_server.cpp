#include <geometry_msgs/PoseStamped.h>
#include <quadrotor_msgs/PositionCommand.h>
#include <ros/ros.h>
#include <ros_example/Primitive.h>

#include <cmath>
#include <vector>

#include "primitive_planner.h"

// Globals, as such nodes have them.
ros::Publisher cmd_pub;
quadrotor_msgs::PositionCommand cmd;
ros_example::Primitive primitive;
bool have_primitive = false;
double last_yaw = 0.0, max_yaw_rate = 1.5;
std::vector<geometry_msgs::Point> way;  // what was commanded, for people

void primitiveCallback(const ros_example::PrimitiveConstPtr& msg) {
  if (!have_primitive) ROS_INFO("first primitive");
  primitive = *msg;
  have_primitive = true;
}

void cmdCallback(const ros::TimerEvent&) {
  if (!have_primitive) return;
  const ros::Time now = ros::Time::now();
  static ros::Time last = now;
  const double t = (now - primitive.header.stamp).toSec();
  ros_example::Motion motion;
  ros_example::evaluate(primitive, t, motion);
  if (t > primitive.duration) motion.velocity = motion.acceleration = ros_example::Vector();

  // Looks where it flies, turning at a limited rate.
  const double dt = (now - last).toSec();
  last = now;
  double yaw_rate = 0.0;
  if (motion.velocity.x * motion.velocity.x + motion.velocity.y * motion.velocity.y > 0.04) {
    double turn = atan2(motion.velocity.y, motion.velocity.x) - last_yaw;
    while (turn > M_PI) turn -= 2 * M_PI;
    while (turn < -M_PI) turn += 2 * M_PI;
    const double most = max_yaw_rate * dt;
    turn = std::min(std::max(turn, -most), most);
    last_yaw += turn;
    if (dt > 0.0) yaw_rate = turn / dt;
  }

  cmd.header.stamp = now;
  cmd.header.frame_id = "world";
  cmd.trajectory_flag = quadrotor_msgs::PositionCommand::TRAJECTORY_STATUS_READY;
  cmd.trajectory_id = primitive.id;
  cmd.position.x = motion.position.x;
  cmd.position.y = motion.position.y;
  cmd.position.z = motion.position.z;
  cmd.velocity.x = motion.velocity.x;
  cmd.velocity.y = motion.velocity.y;
  cmd.velocity.z = motion.velocity.z;
  cmd.acceleration.x = motion.acceleration.x;
  cmd.acceleration.y = motion.acceleration.y;
  cmd.acceleration.z = motion.acceleration.z;
  cmd.yaw = last_yaw;
  cmd.yaw_dot = yaw_rate;
  way.push_back(cmd.position);
  cmd_pub.publish(cmd);
}

int main(int argc, char** argv) {
  ros::init(argc, argv, "traj_server");
  ros::NodeHandle node;
  ros::NodeHandle nh("~");
  nh.param("start_yaw", last_yaw, 0.0);
  nh.getParam("max_yaw_rate", max_yaw_rate);

  ros::Subscriber sub = node.subscribe("primitive", 10, primitiveCallback);
  cmd_pub = node.advertise<quadrotor_msgs::PositionCommand>("position_cmd", 50);
  ros::Timer timer = node.createTimer(ros::Duration(0.01), cmdCallback);

  ROS_INFO("[traj_server] ready");
  ros::spin();
  ROS_INFO("[traj_server] %zu set points", way.size());
  return 0;
}
