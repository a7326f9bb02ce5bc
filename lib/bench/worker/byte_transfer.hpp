#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstring>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "avoidbench/planner.h"
#include "base/input_error.hpp"

/// What a worker reports, as the bytes of a Message: between processes of one program only.
namespace avoidbench {

template <class T>
concept Plain = std::is_trivially_copyable_v<T> && !std::is_pointer_v<T>;

/// Writes one after the other what a TransferReader takes in the same order. What is not plain has
/// a function `transfer(io, value)` beside it, for both.
class TransferWriter {
 public:
  template <Plain T>
  void operator()(const T& value) {
    const auto bytes = std::as_bytes(std::span(&value, 1));
    bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
  }
  template <Plain T>
  void operator()(const std::vector<T>& values) {
    (*this)(values.size());
    const auto bytes = std::as_bytes(std::span(values));
    bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
  }
  void operator()(const std::string& text) { (*this)(std::vector(text.begin(), text.end())); }
  void operator()(const Eigen::Vector3d& v) { (*this)(std::array{v.x(), v.y(), v.z()}); }
  template <class T>
  requires(!Plain<T>) void operator()(const std::vector<T>& values) {
    (*this)(values.size());
    for (const T& value : values) transfer(*this, value);
  }
  std::vector<std::byte> take() { return std::move(bytes_); }

 private:
  std::vector<std::byte> bytes_;
};

/// Trusts nothing: throws InputError where what comes makes no sense, and takes memory for what
/// came only.
class TransferReader {
 public:
  explicit TransferReader(std::span<const std::byte> bytes) : bytes_(bytes) {}
  template <Plain T>
  void operator()(T& value) {
    std::memcpy(&value, taken(sizeof value).data(), sizeof value);
  }
  template <Plain T>
  void operator()(std::vector<T>& values) {
    const std::span<const std::byte> bytes = taken(count(sizeof(T)) * sizeof(T));
    values.resize(bytes.size() / sizeof(T));
    if (!bytes.empty()) std::memcpy(values.data(), bytes.data(), bytes.size());
  }
  void operator()(std::string& text) {
    std::vector<char> letters;
    (*this)(letters);
    text.assign(letters.begin(), letters.end());
  }
  void operator()(Eigen::Vector3d& v) {
    std::array<double, 3> xyz{};
    (*this)(xyz);
    v = {xyz[0], xyz[1], xyz[2]};
    require(v.allFinite());
  }
  template <class T>
  requires(!Plain<T>) void operator()(std::vector<T>& values) {
    const std::size_t size = count(1);  // each takes at least a byte
    for (std::size_t i = 0; i < size; ++i) transfer(*this, values.emplace_back());
  }
  void finish() const { require(bytes_.empty()); }
  static void require(bool makes_sense) {
    if (!makes_sense) throw InputError("what the worker recorded makes no sense");
  }

 private:
  std::size_t count(std::size_t element_bytes) {
    std::size_t number = 0;
    (*this)(number);
    require(number <= bytes_.size() / element_bytes);
    return number;
  }
  std::span<const std::byte> taken(std::size_t size) {
    require(size <= bytes_.size());
    const std::span<const std::byte> first = bytes_.first(size);
    bytes_ = bytes_.subspan(size);
    return first;
  }

  std::span<const std::byte> bytes_;
};

template <class Io, class... Parts>
void all(Io& io, Parts&... parts) {
  (io(parts), ...);
}

/// An enum whose last value is `last`.
template <class Enum>
void transfer_enum(TransferWriter& writer, Enum value, Enum) {
  writer(value);
}
template <class Enum>
void transfer_enum(TransferReader& reader, Enum& value, Enum last) {
  std::underlying_type_t<Enum> number{};
  reader(number);
  TransferReader::require(number >= 0 && number <= static_cast<std::underlying_type_t<Enum>>(last));
  value = static_cast<Enum>(number);
}

/// An address of the worker's is none here.
inline void transfer_command(TransferWriter& writer, ab_command command) {
  command.points = nullptr;
  writer(command);
}
inline void transfer_command(TransferReader& reader, ab_command& command) {
  reader(command);
  command.points = nullptr;
}

}  // namespace avoidbench
