#include "primitive_planner.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace ros_example {
namespace {

const double kCell = 0.2;  // m

int cellOf(double x) { return static_cast<int>(std::floor(x / kCell)); }

double along(const Vector& a, const Vector& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

Vector minus(const Vector& a, const Vector& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }

double evaluatePolynomial(const boost::array<double, 6>& c, double t, int derivative) {
  if (derivative == 0) return c[0] + t * (c[1] + t * (c[2] + t * (c[3] + t * (c[4] + t * c[5]))));
  if (derivative == 1) {
    return c[1] + t * (2 * c[2] + t * (3 * c[3] + t * (4 * c[4] + t * 5 * c[5])));
  }
  return 2 * c[2] + t * (6 * c[3] + t * (12 * c[4] + t * 20 * c[5]));
}

/// From p, v, a to the velocity `v1` without acceleration after T, of the least squared jerk where
/// the end's position is free; or to the position `p1` too.
boost::array<double, 6> quintic(double p, double v, double a, const double* p1, double v1,
                                double T) {
  const double dv = v1 - v - a * T, da = -a;
  if (p1 == nullptr) {
    const double c3 = (6 * dv - 2 * da * T) / (T * T) / 6.0;
    const double c4 = (-12 * dv + 6 * da * T) / (T * T * T) / 24.0;
    return {{p, v, a / 2, c3, c4, 0.0}};
  }
  const double dp = *p1 - p - v * T - 0.5 * a * T * T;
  const double alpha = (720 * dp - 360 * T * dv + 60 * T * T * da) / (T * T * T * T * T);
  const double beta =
      (-360 * T * dp + 168 * T * T * dv - 24 * T * T * T * da) / (T * T * T * T * T);
  const double gamma =
      (60 * T * T * dp - 24 * T * T * T * dv + 3 * T * T * T * T * da) / (T * T * T * T * T);
  return {{p, v, a / 2, gamma / 6, beta / 24, alpha / 120}};
}

}  // namespace

void evaluate(const Primitive& primitive, double t, Motion& motion) {
  const double in = std::min(std::max(t, 0.0), primitive.duration);
  Vector* parts[3] = {&motion.position, &motion.velocity, &motion.acceleration};
  for (int derivative = 0; derivative < 3; ++derivative) {
    parts[derivative]->x = evaluatePolynomial(primitive.x, in, derivative);
    parts[derivative]->y = evaluatePolynomial(primitive.y, in, derivative);
    parts[derivative]->z = evaluatePolynomial(primitive.z, in, derivative);
  }
}

void PrimitivePlanner::init(ros::NodeHandle& nh) {
  nh.param("camera/fx", fx_, 0.0);
  nh.param("camera/fy", fy_, 0.0);
  nh.param("camera/cx", cx_, 0.0);
  nh.param("camera/cy", cy_, 0.0);
  nh.param("planner/max_speed", max_speed_, 1.0);
  nh.param("planner/margin", margin_, 0.5);
  nh.param("planner/replan_period", replan_period_, 0.2);
  nh.param("planner/memory_time", memory_time_, 4.0);
  if (fx_ <= 0.0) ROS_ERROR("camera/fx is not set: nothing will be seen");

  goal_sub_ = nh.subscribe("goal", 1, &PrimitivePlanner::goalCallback, this);
  odom_sub_ = nh.subscribe("odom", 1, &PrimitivePlanner::odomCallback, this,
                           ros::TransportHints().tcpNoDelay());
  image_sub_.reset(new message_filters::Subscriber<sensor_msgs::Image>(nh, "depth", 10));
  pose_sub_.reset(
      new message_filters::Subscriber<geometry_msgs::PoseStamped>(nh, "camera_pose", 10));
  sync_.reset(new message_filters::Synchronizer<Policy>(Policy(10), *image_sub_, *pose_sub_));
  sync_->registerCallback(boost::bind(&PrimitivePlanner::depthCallback, this, _1, _2));
  primitive_pub_ = nh.advertise<Primitive>("/primitive", 10);
  fsm_timer_ = nh.createTimer(ros::Duration(0.01), &PrimitivePlanner::fsmCallback, this);
}

void PrimitivePlanner::goalCallback(const geometry_msgs::PoseStampedConstPtr& msg) {
  goal_ = {msg->pose.position.x, msg->pose.position.y, msg->pose.position.z};
  have_goal_ = true;
  ROS_INFO("goal at (%.1f, %.1f, %.1f)", goal_.x, goal_.y, goal_.z);
}

void PrimitivePlanner::odomCallback(const nav_msgs::Odometry& msg) {
  odom_ = msg;
  have_odom_ = true;
}

void PrimitivePlanner::depthCallback(const sensor_msgs::ImageConstPtr& image,
                                     const geometry_msgs::PoseStampedConstPtr& pose) {
  const cv_bridge::CvImageConstPtr depth =
      cv_bridge::toCvShare(image, sensor_msgs::image_encodings::TYPE_16UC1);
  const geometry_msgs::Quaternion& q = pose->pose.orientation;
  const geometry_msgs::Point& p = pose->pose.position;
  for (int v = 0; v < depth->image.rows; v += 4) {
    const uint16_t* row = depth->image.ptr<uint16_t>(v);
    for (int u = 0; u < depth->image.cols; u += 4) {
      if (row[u] == 0 || row[u] > 8000) continue;
      const double z = row[u] / 1000.0;
      const Vector c{(u - cx_) / fx_ * z, (v - cy_) / fy_ * z, z};
      const Vector t{2 * (q.y * c.z - q.z * c.y), 2 * (q.z * c.x - q.x * c.z),
                     2 * (q.x * c.y - q.y * c.x)};
      const Vector w{p.x + c.x + q.w * t.x + q.y * t.z - q.z * t.y,
                     p.y + c.y + q.w * t.y + q.z * t.x - q.x * t.z,
                     p.z + c.z + q.w * t.z + q.x * t.y - q.y * t.x};
      seen_[{cellOf(w.x), cellOf(w.y), cellOf(w.z)}] = image->header.stamp;
    }
  }
  // What lies beside is remembered for a while.
  for (auto cell = seen_.begin(); cell != seen_.end();) {
    const bool is_old = (image->header.stamp - cell->second).toSec() > memory_time_;
    cell = is_old ? seen_.erase(cell) : std::next(cell);
  }
}

std::vector<Vector> PrimitivePlanner::obstaclesNear(const Vector& position) const {
  std::vector<Vector> near;
  for (const auto& cell : seen_) {
    const Vector centre{(cell.first[0] + 0.5) * kCell, (cell.first[1] + 0.5) * kCell,
                        (cell.first[2] + 0.5) * kCell};
    const Vector d = minus(centre, position);
    if (along(d, d) < 36.0 && std::abs(d.z) < 1.5) near.push_back(centre);
  }
  return near;
}

void PrimitivePlanner::changeState(State state) {
  static const char* const names[] = {"INIT", "WAIT_GOAL", "FLY", "ARRIVED"};
  ROS_INFO_STREAM("[FSM] " << names[state_] << " -> " << names[state]);
  state_ = state;
}

void PrimitivePlanner::fsmCallback(const ros::TimerEvent&) {
  switch (state_) {
    case INIT:
      if (have_odom_) changeState(WAIT_GOAL);
      ROS_WARN_COND(!have_odom_ && fx_ <= 0.0, "no odometry");
      break;
    case WAIT_GOAL:
      if (have_goal_) changeState(FLY);
      break;
    case FLY: {
      if (have_primitive_ && (ros::Time::now() - last_plan_).toSec() < replan_period_) break;
      plan();
      const Vector to = minus(goal_, motionNow().position);
      if (std::sqrt(along(to, to)) < 0.3) changeState(ARRIVED);
      break;
    }
    case ARRIVED:
      ROS_INFO_THROTTLE(5.0, "arrived");
      break;
  }
}

Motion PrimitivePlanner::motionNow() const {
  Motion motion;
  const geometry_msgs::Point& p = odom_.pose.pose.position;
  motion.position = {p.x, p.y, p.z};
  // Primitives begin where the last one is now: set points without jumps.
  if (have_primitive_) {
    evaluate(primitive_, (ros::Time::now() - primitive_.header.stamp).toSec(), motion);
  }
  return motion;
}

Primitive PrimitivePlanner::primitiveTo(const Motion& from, const Vector& velocity, double duration,
                                        double height) const {
  Primitive primitive;
  primitive.duration = duration;
  primitive.x =
      quintic(from.position.x, from.velocity.x, from.acceleration.x, nullptr, velocity.x, duration);
  primitive.y =
      quintic(from.position.y, from.velocity.y, from.acceleration.y, nullptr, velocity.y, duration);
  primitive.z =
      quintic(from.position.z, from.velocity.z, from.acceleration.z, &height, 0.0, duration);
  return primitive;
}

/// The least distance to what was seen, up to 1.5 m.
double PrimitivePlanner::clearance(const Primitive& primitive,
                                   const std::vector<Vector>& obstacles) {
  double least = 1.5 * 1.5;
  for (double t = 0.1; t <= primitive.duration; t += 0.1) {
    Motion motion;
    evaluate(primitive, t, motion);
    for (const Vector& point : obstacles) {
      const Vector d = minus(point, motion.position);
      least = std::min(least, along(d, d));
    }
  }
  return std::sqrt(least);
}

void PrimitivePlanner::plan() {
  last_plan_ = ros::Time::now();
  const Motion from = motionNow();
  const Vector to = minus(goal_, from.position);
  const double left = std::sqrt(to.x * to.x + to.y * to.y);
  const double duration = 1.6, height = from.position.z + std::max(-0.6, std::min(0.6, to.z));
  if (left < 0.2) {
    publish(primitiveTo(from, Vector(), duration, height), Primitive::BRAKING);
    return;
  }
  const double base = atan2(to.y, to.x);
  const std::vector<Vector> obstacles = obstaclesNear(from.position);
  bool found = false;
  double best_cost = 0.0;
  Primitive best;
  const double fastest = std::min(max_speed_, 0.7 * left);
  for (int turn = -8; turn <= 8; ++turn) {
    const double heading = base + 0.2 * turn;
    for (const double share : {1.0, 0.6, 0.3}) {
      const double speed = share * fastest;
      const Primitive tried =
          primitiveTo(from, {speed * cos(heading), speed * sin(heading), 0.0}, duration, height);
      const double clear = clearance(tried, obstacles);
      if (clear < margin_) continue;
      Motion end;
      evaluate(tried, duration, end);
      const Vector rest = minus(goal_, end.position);
      const double cost = std::sqrt(rest.x * rest.x + rest.y * rest.y) + 0.05 * std::abs(turn) +
                          0.8 * std::max(0.0, 1.0 - clear);
      if (found && cost >= best_cost) continue;
      found = true;
      best_cost = cost;
      best = tried;
    }
  }
  if (!found) {
    ROS_WARN_THROTTLE(1.0, "no way is free: braking");
    best = primitiveTo(from, Vector(), 0.8, from.position.z);
  }
  int kind = Primitive::BRAKING;
  if (found) kind = Primitive::FLYING;
  publish(best, kind);
}

void PrimitivePlanner::publish(Primitive primitive, int kind) {
  primitive.header.stamp = ros::Time::now();
  primitive.header.frame_id = "world";
  primitive.kind = kind;
  primitive.id = primitive_.id + 1;
  primitive_ = primitive;
  have_primitive_ = true;
  primitive_pub_.publish(primitive);
}

}  // namespace ros_example
