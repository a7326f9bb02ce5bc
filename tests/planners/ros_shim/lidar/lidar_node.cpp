// A node that flies by a lidar's points, as one is written for ROS: to the goal, and sideways past
// what is near. It ends the trial where its two topics of one lidar do not agree.
#include <geometry_msgs/PoseStamped.h>
#include <geometry_msgs/TwistStamped.h>
#include <nav_msgs/Odometry.h>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>
#include <pcl_conversions/pcl_conversions.h>
#include <ros/ros.h>
#include <sensor_msgs/PointCloud2.h>
#include <sensor_msgs/point_cloud2_iterator.h>
#include <std_msgs/UInt8MultiArray.h>

#include <algorithm>
#include <cmath>

namespace {

nav_msgs::OdometryConstPtr last_odometry;
pcl::PointCloud<pcl::PointXYZI> in_world;
geometry_msgs::Point goal;
bool has_goal = false;
int heard = 0, compared = 0, beats = 0;
ros::Publisher commands;

void take_goal(const geometry_msgs::PoseStampedConstPtr& message) {
  goal = message->pose.position;
  has_goal = true;
}

/// As the topics file writes it.
void take_target(const nav_msgs::OdometryConstPtr& target) {
  ROS_ASSERT(target->header.frame_id == "map" && target->child_frame_id == "target");
  ROS_ASSERT(target->header.stamp.toSec() >= 100.0);
  ROS_ASSERT(target->pose.pose.position.x == goal.x && target->pose.pose.position.y == goal.y);
  ROS_ASSERT(target->pose.covariance[0] == 1.0 && target->pose.covariance[35] == 3.0);
}

void take_beat(const std_msgs::UInt8MultiArrayConstPtr& beat) {
  ROS_ASSERT(beat->data.size() == 2 && beat->data[1] == 8);
  ++beats;
}

void take_world(const sensor_msgs::PointCloud2ConstPtr& cloud) {
  pcl::fromROSMsg(*cloud, in_world);
  ROS_ASSERT(cloud->header.frame_id == "world" && cloud->width > 1000);
  for (const pcl::PointXYZI& point : in_world.points) {
    ROS_ASSERT_MSG(point.z > -10.0F && point.z < 30.0F, "a point at z %f m", point.z);
    ROS_ASSERT(point.intensity > 0.0F && point.intensity <= 1.0F);
  }
}

/// The sweep's points lie alike about the vehicle in both topics.
void compare(const sensor_msgs::PointCloud2& in_body) {
  ROS_ASSERT(in_body.header.frame_id == "base_link" && in_body.width == in_world.points.size());
  const geometry_msgs::Point& place = last_odometry->pose.pose.position;
  sensor_msgs::PointCloud2ConstIterator<float> at(in_body, "x");
  for (std::size_t i = 0; i < in_world.points.size(); ++i, ++at) {
    const double x = in_world.points[i].x - place.x, y = in_world.points[i].y - place.y;
    const double z = in_world.points[i].z - place.z;
    const double there_m = std::sqrt(x * x + y * y + z * z);
    const double here_m = std::sqrt(at[0] * at[0] + at[1] * at[1] + at[2] * at[2]);
    ROS_ASSERT_MSG(std::abs(there_m - here_m) < 1e-3, "%f m and %f m", there_m, here_m);
  }
  ++compared;
}

/// Comes behind the odometry and the other topic of the same moment.
void take_body(const sensor_msgs::PointCloud2ConstPtr& cloud) {
  float last_s = -0.2F;
  for (sensor_msgs::PointCloud2ConstIterator<float> time(*cloud, "time"); time != time.end();
       ++time) {
    ROS_ASSERT_MSG(*time > last_s && *time <= 0.0F, "times of shots go up to the sweep's end");
    last_s = *time;
  }
  if (last_odometry && last_odometry->header.stamp == cloud->header.stamp) compare(*cloud);
}

void take_odometry(const nav_msgs::OdometryConstPtr& odometry) {
  last_odometry = odometry;
  if (!has_goal) return;
  // Since two seconds before the trial, ten times a second.
  ROS_ASSERT_MSG(heard != 29 || (beats > 26 && beats < 33), "%d beats", beats);
  ROS_ASSERT_MSG(++heard < 30 || compared > 5, "%d sweeps in %d calls", compared, heard);
  const geometry_msgs::Point& place = odometry->pose.pose.position;
  double x = goal.x - place.x, y = goal.y - place.y;
  const double away_m = std::max(std::hypot(x, y), 1e-3);
  x /= away_m, y /= away_m;
  double aside_x = 0.0, aside_y = 0.0;
  for (const pcl::PointXYZI& point : in_world.points) {
    const double px = point.x - place.x, py = point.y - place.y, d_m = std::hypot(px, py);
    if (d_m > 1.5 || std::abs(point.z - place.z) > 0.4 || d_m < 1e-3) continue;
    const double push = (1.5 - d_m) / 1.5;
    if (push * push <= aside_x * aside_x + aside_y * aside_y) continue;
    aside_x = -push * px / d_m, aside_y = -push * py / d_m;
  }
  geometry_msgs::TwistStamped command;
  command.header.stamp = odometry->header.stamp;
  // Past it on the left, so that nothing straight ahead stops it.
  command.twist.linear.x = 0.8 * x + 1.5 * aside_x + 0.8 * aside_y;
  command.twist.linear.y = 0.8 * y + 1.5 * aside_y - 0.8 * aside_x;
  command.twist.linear.z = goal.z - place.z;
  commands.publish(command);
}

}  // namespace

int main(int argc, char** argv) {
  ros::init(argc, argv, "lidar_node");
  ros::NodeHandle node;
  double range_m = 0.0, above_m = 0.0;
  node.getParam("range_m", range_m);
  node.getParam("above_m", above_m);
  ROS_ASSERT_MSG(range_m == 70.0 && above_m == 0.1, "parameters of mid360_like, not %f and %f",
                 range_m, above_m);
  commands = node.advertise<geometry_msgs::TwistStamped>("/cmd_vel", 1);
  const ros::Subscriber targets = node.subscribe("/target", 1, take_target);
  const ros::Subscriber beating = node.subscribe("/beat", 1, take_beat);
  const ros::Subscriber goals = node.subscribe("/goal", 1, take_goal);
  const ros::Subscriber body = node.subscribe("/points_body", 1, take_body);
  const ros::Subscriber world = node.subscribe("/points", 1, take_world);
  const ros::Subscriber odometry = node.subscribe("/odom", 1, take_odometry);
  ros::spin();
}
