#ifndef TF_TRANSFORM_DATATYPES_H
#define TF_TRANSFORM_DATATYPES_H

#include <cmath>
#include <string>

#include "geometry_msgs/Quaternion.h"
#include "geometry_msgs/Transform.h"
#include "geometry_msgs/Vector3.h"
#include "ros/time.h"

// The parts of tf that planners use for numbers.
namespace tf {

class Vector3 {
 public:
  Vector3() : v_{0.0, 0.0, 0.0} {}
  Vector3(double x, double y, double z) : v_{x, y, z} {}
  double x() const { return v_[0]; }
  double y() const { return v_[1]; }
  double z() const { return v_[2]; }
  double getX() const { return v_[0]; }
  double getY() const { return v_[1]; }
  double getZ() const { return v_[2]; }
  void setX(double x) { v_[0] = x; }
  void setY(double y) { v_[1] = y; }
  void setZ(double z) { v_[2] = z; }
  void setValue(double x, double y, double z) { *this = Vector3(x, y, z); }
  double& operator[](int i) { return v_[i]; }
  const double& operator[](int i) const { return v_[i]; }
  Vector3 operator+(const Vector3& o) const { return {x() + o.x(), y() + o.y(), z() + o.z()}; }
  Vector3 operator-(const Vector3& o) const { return {x() - o.x(), y() - o.y(), z() - o.z()}; }
  Vector3 operator*(double s) const { return {s * x(), s * y(), s * z()}; }
  double dot(const Vector3& o) const { return x() * o.x() + y() * o.y() + z() * o.z(); }
  Vector3 cross(const Vector3& o) const {
    return {y() * o.z() - z() * o.y(), z() * o.x() - x() * o.z(), x() * o.y() - y() * o.x()};
  }
  double length2() const { return dot(*this); }
  double length() const { return std::sqrt(length2()); }

 private:
  double v_[3];
};
using Point = Vector3;

class Quaternion {
 public:
  Quaternion() : x_(0.0), y_(0.0), z_(0.0), w_(1.0) {}
  Quaternion(double x, double y, double z, double w) : x_(x), y_(y), z_(z), w_(w) {}
  double x() const { return x_; }
  double y() const { return y_; }
  double z() const { return z_; }
  double w() const { return w_; }
  double getX() const { return x_; }
  double getY() const { return y_; }
  double getZ() const { return z_; }
  double getW() const { return w_; }
  void setValue(double x, double y, double z, double w) { *this = Quaternion(x, y, z, w); }
  void setRPY(double roll, double pitch, double yaw);
  void setEuler(double yaw, double pitch, double roll) { setRPY(roll, pitch, yaw); }
  Quaternion inverse() const { return {-x_, -y_, -z_, w_}; }
  double length2() const { return x_ * x_ + y_ * y_ + z_ * z_ + w_ * w_; }
  Quaternion& normalize() {
    const double s = 1.0 / std::sqrt(length2());
    return *this = Quaternion(s * x_, s * y_, s * z_, s * w_);
  }
  Quaternion operator*(const Quaternion& o) const {
    return {w_ * o.x_ + x_ * o.w_ + y_ * o.z_ - z_ * o.y_,
            w_ * o.y_ + y_ * o.w_ + z_ * o.x_ - x_ * o.z_,
            w_ * o.z_ + z_ * o.w_ + x_ * o.y_ - y_ * o.x_,
            w_ * o.w_ - x_ * o.x_ - y_ * o.y_ - z_ * o.z_};
  }

 private:
  double x_, y_, z_, w_;
};

inline Vector3 quatRotate(const Quaternion& q, const Vector3& v) {
  const Vector3 axis(q.x(), q.y(), q.z());
  const Vector3 twice = axis.cross(v) * 2.0;
  return v + twice * q.w() + axis.cross(twice);
}

class Matrix3x3 {
 public:
  Matrix3x3() : Matrix3x3(Quaternion()) {}
  explicit Matrix3x3(const Quaternion& q) { setRotation(q); }
  void setRotation(const Quaternion& q) {
    for (int i = 0; i < 3; ++i) {
      const Vector3 column = quatRotate(q, Vector3(i == 0, i == 1, i == 2));
      for (int row = 0; row < 3; ++row) rows_[row][i] = column[row];
    }
  }
  Vector3& operator[](int row) { return rows_[row]; }
  const Vector3& operator[](int row) const { return rows_[row]; }
  Vector3 operator*(const Vector3& v) const {
    return {rows_[0].dot(v), rows_[1].dot(v), rows_[2].dot(v)};
  }
  void getRPY(double& roll, double& pitch, double& yaw, unsigned = 1) const;
  void getEulerYPR(double& yaw, double& pitch, double& roll, unsigned = 1) const {
    getRPY(roll, pitch, yaw);
  }

 private:
  Vector3 rows_[3];
};

class Transform {
 public:
  Transform() = default;
  explicit Transform(const Quaternion& q, const Vector3& origin = Vector3())
      : rotation_(q), origin_(origin) {}
  static Transform getIdentity() { return Transform(); }
  void setIdentity() { *this = Transform(); }
  const Vector3& getOrigin() const { return origin_; }
  Quaternion getRotation() const { return rotation_; }
  Matrix3x3 getBasis() const { return Matrix3x3(rotation_); }
  void setOrigin(const Vector3& origin) { origin_ = origin; }
  void setRotation(const Quaternion& q) { rotation_ = q; }
  Vector3 operator*(const Vector3& v) const { return quatRotate(rotation_, v) + origin_; }
  Transform operator*(const Transform& o) const {
    return Transform(rotation_ * o.rotation_, *this * o.origin_);
  }
  Transform inverse() const {
    const Quaternion back = rotation_.inverse();
    return Transform(back, quatRotate(back, origin_ * -1.0));
  }

 private:
  Quaternion rotation_;
  Vector3 origin_;
};
using Pose = Transform;

class StampedTransform : public Transform {
 public:
  ros::Time stamp_;
  std::string frame_id_, child_frame_id_;
  StampedTransform() = default;
  StampedTransform(const Transform& transform, const ros::Time& stamp, const std::string& frame,
                   const std::string& child)
      : Transform(transform), stamp_(stamp), frame_id_(frame), child_frame_id_(child) {}
};

double getYaw(const Quaternion& q);
double getYaw(const geometry_msgs::Quaternion& q);
Quaternion createQuaternionFromRPY(double roll, double pitch, double yaw);
inline Quaternion createQuaternionFromYaw(double yaw) {
  return createQuaternionFromRPY(0.0, 0.0, yaw);
}
inline void quaternionMsgToTF(const geometry_msgs::Quaternion& from, Quaternion& to) {
  to = Quaternion(from.x, from.y, from.z, from.w);
}
inline void quaternionTFToMsg(const Quaternion& from, geometry_msgs::Quaternion& to) {
  to.x = from.x();
  to.y = from.y();
  to.z = from.z();
  to.w = from.w();
}
inline geometry_msgs::Quaternion createQuaternionMsgFromRollPitchYaw(double roll, double pitch,
                                                                     double yaw) {
  geometry_msgs::Quaternion message;
  quaternionTFToMsg(createQuaternionFromRPY(roll, pitch, yaw), message);
  return message;
}
inline geometry_msgs::Quaternion createQuaternionMsgFromYaw(double yaw) {
  return createQuaternionMsgFromRollPitchYaw(0.0, 0.0, yaw);
}

}  // namespace tf

#endif
