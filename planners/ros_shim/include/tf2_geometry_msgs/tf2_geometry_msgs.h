#ifndef TF2_GEOMETRY_MSGS_TF2_GEOMETRY_MSGS_H
#define TF2_GEOMETRY_MSGS_TF2_GEOMETRY_MSGS_H

#include "geometry_msgs/PointStamped.h"
#include "geometry_msgs/PoseStamped.h"
#include "geometry_msgs/QuaternionStamped.h"
#include "geometry_msgs/TransformStamped.h"
#include "geometry_msgs/Vector3Stamped.h"
#include "tf2/LinearMath/Transform.h"

// Messages of geometry to numbers and back, and through transforms.
namespace tf2 {

inline void fromMsg(const geometry_msgs::Quaternion& from, Quaternion& to) {
  to = Quaternion(from.x, from.y, from.z, from.w);
}
inline void fromMsg(const geometry_msgs::Vector3& from, Vector3& to) {
  to = Vector3(from.x, from.y, from.z);
}
inline void fromMsg(const geometry_msgs::Point& from, Vector3& to) {
  to = Vector3(from.x, from.y, from.z);
}
inline void fromMsg(const geometry_msgs::Transform& from, Transform& to) {
  Quaternion q;
  fromMsg(from.rotation, q);
  to = Transform(q, Vector3(from.translation.x, from.translation.y, from.translation.z));
}
inline void fromMsg(const geometry_msgs::Pose& from, Transform& to) {
  Quaternion q;
  fromMsg(from.orientation, q);
  to = Transform(q, Vector3(from.position.x, from.position.y, from.position.z));
}
inline geometry_msgs::Quaternion toMsg(const Quaternion& from) {
  geometry_msgs::Quaternion to;
  tf::quaternionTFToMsg(from, to);
  return to;
}
inline geometry_msgs::Vector3 toMsg(const Vector3& from) {
  geometry_msgs::Vector3 to;
  to.x = from.x();
  to.y = from.y();
  to.z = from.z();
  return to;
}
inline geometry_msgs::Point& toMsg(const Vector3& from, geometry_msgs::Point& to) {
  to.x = from.x();
  to.y = from.y();
  to.z = from.z();
  return to;
}
inline geometry_msgs::Transform toMsg(const Transform& from) {
  geometry_msgs::Transform to;
  to.translation = toMsg(from.getOrigin());
  to.rotation = toMsg(from.getRotation());
  return to;
}
inline geometry_msgs::Pose& toMsg(const Transform& from, geometry_msgs::Pose& to) {
  toMsg(from.getOrigin(), to.position);
  to.orientation = toMsg(from.getRotation());
  return to;
}
template <class From, class To>
void convert(const From& from, To& to) {
  fromMsg(from, to);
}
inline void convert(const Quaternion& from, geometry_msgs::Quaternion& to) { to = toMsg(from); }
inline void convert(const Vector3& from, geometry_msgs::Vector3& to) { to = toMsg(from); }

inline Transform transform_of(const geometry_msgs::TransformStamped& message) {
  Transform transform;
  fromMsg(message.transform, transform);
  return transform;
}

inline void doTransform(const geometry_msgs::Point& in, geometry_msgs::Point& out,
                        const geometry_msgs::TransformStamped& transform) {
  Vector3 point;
  fromMsg(in, point);
  toMsg(transform_of(transform) * point, out);
}
inline void doTransform(const geometry_msgs::Vector3& in, geometry_msgs::Vector3& out,
                        const geometry_msgs::TransformStamped& transform) {
  Vector3 vector;
  fromMsg(in, vector);
  out = toMsg(quatRotate(transform_of(transform).getRotation(), vector));
}
inline void doTransform(const geometry_msgs::Quaternion& in, geometry_msgs::Quaternion& out,
                        const geometry_msgs::TransformStamped& transform) {
  Quaternion rotation;
  fromMsg(in, rotation);
  out = toMsg(transform_of(transform).getRotation() * rotation);
}
inline void doTransform(const geometry_msgs::Pose& in, geometry_msgs::Pose& out,
                        const geometry_msgs::TransformStamped& transform) {
  Transform pose;
  fromMsg(in, pose);
  toMsg(transform_of(transform) * pose, out);
}

/// With the transform's frame and time.
template <class Stamped, class Inner>
void do_stamped(const Stamped& in, Stamped& out, Inner Stamped::*inner,
                const geometry_msgs::TransformStamped& transform) {
  doTransform(in.*inner, out.*inner, transform);
  out.header.stamp = transform.header.stamp;
  out.header.frame_id = transform.header.frame_id;
}
inline void doTransform(const geometry_msgs::PointStamped& in, geometry_msgs::PointStamped& out,
                        const geometry_msgs::TransformStamped& transform) {
  do_stamped(in, out, &geometry_msgs::PointStamped::point, transform);
}
inline void doTransform(const geometry_msgs::Vector3Stamped& in, geometry_msgs::Vector3Stamped& out,
                        const geometry_msgs::TransformStamped& transform) {
  do_stamped(in, out, &geometry_msgs::Vector3Stamped::vector, transform);
}
inline void doTransform(const geometry_msgs::QuaternionStamped& in,
                        geometry_msgs::QuaternionStamped& out,
                        const geometry_msgs::TransformStamped& transform) {
  do_stamped(in, out, &geometry_msgs::QuaternionStamped::quaternion, transform);
}
inline void doTransform(const geometry_msgs::PoseStamped& in, geometry_msgs::PoseStamped& out,
                        const geometry_msgs::TransformStamped& transform) {
  do_stamped(in, out, &geometry_msgs::PoseStamped::pose, transform);
}

}  // namespace tf2

#endif
