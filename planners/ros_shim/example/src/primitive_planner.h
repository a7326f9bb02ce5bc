#ifndef ROS_EXAMPLE_PRIMITIVE_PLANNER_H
#define ROS_EXAMPLE_PRIMITIVE_PLANNER_H

#include <cv_bridge/cv_bridge.h>
#include <geometry_msgs/PoseStamped.h>
#include <message_filters/subscriber.h>
#include <message_filters/sync_policies/approximate_time.h>
#include <message_filters/synchronizer.h>
#include <nav_msgs/Odometry.h>
#include <ros/ros.h>
#include <ros_example/Primitive.h>
#include <sensor_msgs/Image.h>

#include <array>
#include <map>
#include <memory>
#include <vector>

namespace ros_example {

struct Vector {
  double x = 0.0, y = 0.0, z = 0.0;
};

/// Position, velocity and acceleration of the last set point.
struct Motion {
  Vector position, velocity, acceleration;
};

/// Plans quintics over a fan of headings and picks one that stays clear of what was seen.
class PrimitivePlanner {
 public:
  void init(ros::NodeHandle& nh);

 private:
  enum State { INIT, WAIT_GOAL, FLY, ARRIVED };

  void goalCallback(const geometry_msgs::PoseStampedConstPtr& msg);
  void odomCallback(const nav_msgs::Odometry& msg);
  void depthCallback(const sensor_msgs::ImageConstPtr& image,
                     const geometry_msgs::PoseStampedConstPtr& pose);
  void fsmCallback(const ros::TimerEvent& event);
  void changeState(State state);
  void plan();
  Motion motionNow() const;
  Primitive primitiveTo(const Motion& from, const Vector& velocity, double duration,
                        double height) const;
  std::vector<Vector> obstaclesNear(const Vector& position) const;
  static double clearance(const Primitive& primitive, const std::vector<Vector>& obstacles);
  void publish(Primitive primitive, int kind);

  ros::Subscriber goal_sub_, odom_sub_;
  ros::Publisher primitive_pub_;
  ros::Timer fsm_timer_;
  typedef message_filters::sync_policies::ApproximateTime<sensor_msgs::Image,
                                                          geometry_msgs::PoseStamped>
      Policy;
  std::shared_ptr<message_filters::Subscriber<sensor_msgs::Image>> image_sub_;
  std::shared_ptr<message_filters::Subscriber<geometry_msgs::PoseStamped>> pose_sub_;
  std::shared_ptr<message_filters::Synchronizer<Policy>> sync_;

  double fx_ = 0.0, fy_ = 0.0, cx_ = 0.0, cy_ = 0.0;
  double max_speed_ = 1.0, margin_ = 0.5, replan_period_ = 0.2, memory_time_ = 4.0;
  State state_ = INIT;
  bool have_odom_ = false, have_goal_ = false, have_primitive_ = false;
  nav_msgs::Odometry odom_;
  Vector goal_;
  Primitive primitive_;
  ros::Time last_plan_;
  std::map<std::array<int, 3>, ros::Time> seen_;  // cells with something in them, and since when
};

/// A coordinate of a primitive and its first two derivatives.
void evaluate(const Primitive& primitive, double t, Motion& motion);

}  // namespace ros_example

#endif
