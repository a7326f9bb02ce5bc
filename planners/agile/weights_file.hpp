#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace agile {

struct Tensor {
  std::vector<std::size_t> shape;
  std::vector<float> values;  ///< row-major, all finite
};

/// A file of weights in the safetensors format, read whole: eight bytes that tell the length of a
/// JSON header, the header, and the tensors one after the other, all of F16. Its `__metadata__`
/// gives "format" as "agile/1".
class WeightsFile {
 public:
  /// Throws std::runtime_error with the file's name where it can't be read, is no regular file or
  /// larger than 64 MiB, or where header and data don't agree: tensors must fill the data without
  /// gap or overlap. Never waits, as for a pipe's writer.
  explicit WeightsFile(std::filesystem::path file);

  /// The tensor of this name, whose sizes must be `shape`; 0 stands for 1 … 4096. Throws as the
  /// constructor where it is missing, has another shape or a value that is not finite.
  Tensor take(const std::string& name, const std::vector<std::size_t>& shape);

  /// Throws where the file holds a tensor that was not taken.
  void check_all_taken() const;

 private:
  struct Entry {
    std::uint64_t begin = 0, end = 0;  ///< in data, bytes
    std::vector<std::size_t> shape;
    bool is_taken = false;
  };

  std::string read_bytes() const;
  void read_header();
  void check_coverage() const;
  [[noreturn]] void refuse(const std::string& what) const;

  std::filesystem::path file_;
  std::string bytes_;
  std::size_t data_begin_ = 0;  ///< in bytes_
  std::map<std::string, Entry> entries_;
};

/// An IEEE half as the same number in single precision; infinities and NaN too.
float from_half(std::uint16_t half);

}  // namespace agile
