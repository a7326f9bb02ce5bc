#ifndef PCL_POINT_CLOUD_H
#define PCL_POINT_CLOUD_H

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "ros_shim/pointer.h"

namespace pcl {

template <class T>
using shared_ptr = ros_shim::shared_ptr<T>;

struct PCLHeader {
  std::uint32_t seq = 0;
  std::uint64_t stamp = 0;  ///< microseconds
  std::string frame_id;
};

template <class PointT>
class PointCloud {
 public:
  using PointType = PointT;
  using VectorType = std::vector<PointT>;
  using Ptr = ros_shim::shared_ptr<PointCloud<PointT>>;
  using ConstPtr = ros_shim::shared_ptr<const PointCloud<PointT>>;
  using iterator = typename VectorType::iterator;
  using const_iterator = typename VectorType::const_iterator;

  PCLHeader header;
  VectorType points;
  std::uint32_t width = 0, height = 0;
  bool is_dense = true;

  PointCloud() = default;
  PointCloud(std::uint32_t width_, std::uint32_t height_, const PointT& value = PointT())
      : points(std::size_t{width_} * height_, value), width(width_), height(height_) {}

  std::size_t size() const { return points.size(); }
  bool empty() const { return points.empty(); }
  bool isOrganized() const { return height > 1; }
  void reserve(std::size_t count) { points.reserve(count); }
  void resize(std::size_t count) {
    points.resize(count);
    if (std::size_t{width} * height != count) set_row();
  }
  void clear() {
    points.clear();
    width = height = 0;
  }
  void push_back(const PointT& point) {
    points.push_back(point);
    set_row();
  }
  template <class... Arguments>
  PointT& emplace_back(Arguments&&... arguments) {
    points.emplace_back(std::forward<Arguments>(arguments)...);
    set_row();
    return points.back();
  }
  iterator erase(iterator at) {
    const iterator next = points.erase(at);
    set_row();
    return next;
  }
  void swap(PointCloud& other) { std::swap(*this, other); }
  iterator begin() { return points.begin(); }
  iterator end() { return points.end(); }
  const_iterator begin() const { return points.begin(); }
  const_iterator end() const { return points.end(); }
  PointT& operator[](std::size_t i) { return points[i]; }
  const PointT& operator[](std::size_t i) const { return points[i]; }
  PointT& at(std::size_t i) { return points.at(i); }
  const PointT& at(std::size_t i) const { return points.at(i); }
  PointT& at(int column, int row) { return points.at(index(column, row)); }
  const PointT& at(int column, int row) const { return points.at(index(column, row)); }
  PointT& operator()(std::size_t column, std::size_t row) { return points[row * width + column]; }
  PointT& front() { return points.front(); }
  PointT& back() { return points.back(); }
  Ptr makeShared() const { return ros_shim::make_shared<PointCloud<PointT>>(*this); }
  PointCloud& operator+=(const PointCloud& other) {
    points.insert(points.end(), other.points.begin(), other.points.end());
    is_dense = is_dense && other.is_dense;
    set_row();
    return *this;
  }
  PointCloud operator+(const PointCloud& other) const { return PointCloud(*this) += other; }

 private:
  void set_row() {
    width = static_cast<std::uint32_t>(points.size());
    height = 1;
  }
  std::size_t index(int column, int row) const {
    return static_cast<std::size_t>(row) * width + static_cast<std::size_t>(column);
  }
};

}  // namespace pcl

#endif
