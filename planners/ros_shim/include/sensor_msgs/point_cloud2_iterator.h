#ifndef SENSOR_MSGS_POINT_CLOUD2_ITERATOR_H
#define SENSOR_MSGS_POINT_CLOUD2_ITERATOR_H

#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <type_traits>

#include "sensor_msgs/PointCloud2.h"

namespace sensor_msgs {
namespace point_cloud2_detail {

inline std::uint32_t size_of(std::uint8_t type) {
  switch (type) {
    case PointField::INT8:
    case PointField::UINT8:
      return 1;
    case PointField::INT16:
    case PointField::UINT16:
      return 2;
    case PointField::FLOAT64:
      return 8;
    default:
      return 4;
  }
}

}  // namespace point_cloud2_detail

/// One field of all points of a cloud. `V` is the field's type, const or not.
template <class V, class Cloud>
class PointCloud2IteratorOf {
 public:
  using Byte =
      typename std::conditional<std::is_const<V>::value, const std::uint8_t, std::uint8_t>::type;

  PointCloud2IteratorOf(Cloud& cloud, const std::string& name) : step_(cloud.point_step) {
    for (const auto& field : cloud.fields) {
      if (field.name != name) continue;
      at_ = cloud.data.data() + field.offset;
      end_ = cloud.data.data() + cloud.data.size() + field.offset;
      return;
    }
    throw std::runtime_error("Field " + name + " does not exist");
  }
  V& operator*() const { return *reinterpret_cast<V*>(at_); }
  V& operator[](std::size_t i) const { return *(reinterpret_cast<V*>(at_) + i); }
  PointCloud2IteratorOf& operator++() {
    at_ += step_;
    return *this;
  }
  PointCloud2IteratorOf& operator+=(int count) {
    at_ += count * static_cast<std::ptrdiff_t>(step_);
    return *this;
  }
  PointCloud2IteratorOf operator+(int count) const {
    PointCloud2IteratorOf moved = *this;
    return moved += count;
  }
  bool operator==(const PointCloud2IteratorOf& other) const { return at_ == other.at_; }
  bool operator!=(const PointCloud2IteratorOf& other) const { return at_ != other.at_; }
  PointCloud2IteratorOf end() const {
    PointCloud2IteratorOf last = *this;
    last.at_ = end_;
    return last;
  }

 private:
  Byte* at_ = nullptr;
  Byte* end_ = nullptr;
  std::uint32_t step_;
};
template <class V>
using PointCloud2Iterator = PointCloud2IteratorOf<V, PointCloud2>;
template <class V>
using PointCloud2ConstIterator = PointCloud2IteratorOf<const V, const PointCloud2>;

/// Gives a cloud its fields and its size.
class PointCloud2Modifier {
 public:
  explicit PointCloud2Modifier(PointCloud2& cloud) : cloud_(cloud) {}
  std::size_t size() const { return std::size_t{cloud_.width} * cloud_.height; }
  void resize(std::size_t count) {
    cloud_.width = static_cast<std::uint32_t>(count);
    cloud_.height = 1;
    cloud_.row_step = cloud_.width * cloud_.point_step;
    cloud_.data.resize(count * cloud_.point_step);
  }
  void clear() { resize(0); }
  /// "xyz" alone: x, y and z as float32, with four bytes behind them as in ROS.
  void setPointCloud2FieldsByString(int count, const char* names, ...) {
    if (count != 1 || std::string(names) != "xyz") {
      throw std::runtime_error("setPointCloud2FieldsByString knows \"xyz\" alone");
    }
    setPointCloud2Fields(3, "x", 1, PointField::FLOAT32, "y", 1, PointField::FLOAT32, "z", 1,
                         PointField::FLOAT32);
    cloud_.point_step = 16;
    resize(size());
  }
  /// count times: name, number of elements, type.
  template <class... Rest>
  void setPointCloud2Fields(int, const Rest&... rest) {
    cloud_.fields.clear();
    cloud_.point_step = 0;
    add(rest...);
    resize(size());
  }

 private:
  void add() {}
  template <class Count, class Type, class... Rest>
  void add(const char* name, Count count, Type type, const Rest&... rest) {
    PointField field;
    field.name = name;
    field.count = static_cast<std::uint32_t>(count);
    field.datatype = static_cast<std::uint8_t>(type);
    field.offset = cloud_.point_step;
    cloud_.point_step += field.count * point_cloud2_detail::size_of(field.datatype);
    cloud_.fields.push_back(field);
    add(rest...);
  }

  PointCloud2& cloud_;
};

}  // namespace sensor_msgs

#endif
