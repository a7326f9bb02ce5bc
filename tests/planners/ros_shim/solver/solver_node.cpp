// Flies along the best angle that a solver with a time limit found. Its numbers are by
// dynamic_reconfigure.
#include <Eigen/Core>
#include <cmath>

#include <dynamic_reconfigure/server.h>
#include <geometry_msgs/PoseStamped.h>
#include <geometry_msgs/TwistStamped.h>
#include <nav_msgs/Odometry.h>
#include <ros/ros.h>
#include <solver/SolverConfig.h>

static_assert(EIGEN_WORLD_VERSION == 3 && EIGEN_MAJOR_VERSION == 3,
              "EIGEN of avoidbench_ros_planner comes before the Eigen that is installed");

extern "C" double nearest_angle(double wanted_rad, double budget_s);

class Solver {
 public:
  Solver() : node_("~") {
    commands_ = node_.advertise<geometry_msgs::TwistStamped>("command", 1);
    odometry_ = node_.subscribe("odometry", 1, &Solver::hear_odometry, this);
    goal_ = node_.subscribe("goal", 1, &Solver::hear_goal, this);
    dynamic_reconfigure::Server<solver::SolverConfig>::CallbackType callback =
        [this](solver::SolverConfig& config, uint32_t level) { configure(config, level); };
    server_.setCallback(callback);
  }

 private:
  void configure(solver::SolverConfig& config, uint32_t level) {
    if (level != ~0U) ROS_FATAL("level %u", level);
    config_ = config;
  }
  void hear_goal(const geometry_msgs::PoseStampedConstPtr& goal) { goal_pose_ = goal; }
  void hear_odometry(const nav_msgs::OdometryConstPtr& odometry) {
    if (!goal_pose_ || !config_.enabled) return;
    const auto& at = odometry->pose.pose.position;
    const Eigen::Vector2d way(goal_pose_->pose.position.x - at.x,
                              goal_pose_->pose.position.y - at.y);
    const double angle = nearest_angle(std::atan2(way.y(), way.x()), 1e-6 * config_.budget_us);
    geometry_msgs::TwistStamped command;
    command.header.stamp = ros::Time::now();
    command.header.frame_id = config_.frame;
    command.twist.linear.x = config_.speed * std::cos(angle);
    command.twist.linear.y = config_.speed * std::sin(angle);
    if (config_.way == solver::Solver_Straight) {
      command.twist.linear.z = goal_pose_->pose.position.z - at.z;
    }
    commands_.publish(command);
  }

  ros::NodeHandle node_;
  ros::Publisher commands_;
  ros::Subscriber odometry_, goal_;
  solver::SolverConfig config_;
  geometry_msgs::PoseStampedConstPtr goal_pose_;
  dynamic_reconfigure::Server<solver::SolverConfig> server_;
};

int main(int argc, char** argv) {
  ros::init(argc, argv, "solver_node");
  Solver solver;
  ros::spin();
}
