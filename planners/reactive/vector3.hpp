#pragma once

#include <cmath>

namespace reactive {

struct Vector3 {
  double x = 0.0, y = 0.0, z = 0.0;
};

inline Vector3 operator+(const Vector3& a, const Vector3& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
inline Vector3 operator-(const Vector3& a, const Vector3& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
inline Vector3 operator*(double s, const Vector3& v) { return {s * v.x, s * v.y, s * v.z}; }
inline double dot(const Vector3& a, const Vector3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline double norm(const Vector3& v) { return std::sqrt(dot(v, v)); }
inline double horizontal_norm(const Vector3& v) { return std::sqrt(v.x * v.x + v.y * v.y); }
inline bool is_finite(const Vector3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

/// `v` at length one; `otherwise` where v is too short to have a direction.
inline Vector3 direction(const Vector3& v, const Vector3& otherwise) {
  const double length = norm(v);
  return length > 1e-9 ? (1.0 / length) * v : otherwise;
}

inline Vector3 vector3(const double (&v)[3]) { return {v[0], v[1], v[2]}; }

}  // namespace reactive
