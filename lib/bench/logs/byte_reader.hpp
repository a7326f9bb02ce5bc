#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/input_file.hpp"

namespace avoidbench {

/// Bytes that come one after another: a file's, or those that a chunk unpacks to.
class ByteSource {
 public:
  virtual ~ByteSource() = default;
  /// Puts some of what comes next into `bytes`, which is not empty, and returns how many; 0 only at
  /// the end.
  virtual std::size_t read(std::span<char> bytes) = 0;
};

/// Those of a file; of any size, since only a piece is ever held.
class FileBytes : public ByteSource {
 public:
  explicit FileBytes(const std::filesystem::path& file) : file_(file, ~std::uint64_t{0}) {}
  std::size_t read(std::span<char> bytes) override { return file_.read(bytes); }

 private:
  InputFile file_;
};

/// Thrown where a file ends before what it began with does.
struct CutOff {
  std::uint64_t position = 0;  ///< up to where it can be used, bytes
};

/// Reads little-endian numbers and texts off a source and knows where it is.
class ByteReader {
 public:
  /// Of a file, which throws CutOff where it ends early.
  ByteReader(ByteSource& source, std::filesystem::path file);
  /// Of what the chunk at `chunk_position` of the file unpacks to. To end early is damage.
  ByteReader(ByteSource& source, const ByteReader& file, std::uint64_t chunk_position);

  const std::filesystem::path& file() const { return file_; }
  std::uint64_t position() const { return position_; }
  bool at_end() { return peek(1).empty(); }
  /// What comes next, fewer than `count` bytes only at the end; `count` at most kMostPeeked. Valid
  /// until the next call.
  std::string_view peek(std::size_t count);
  static constexpr std::size_t kMostPeeked = 4096;

  /// As ByteSource::read().
  std::size_t read_some(std::span<char> bytes);
  template <class T>
  T number() {
    static_assert(std::endian::native == std::endian::little);
    char bytes[sizeof(T)];
    read(bytes);
    T value;
    std::memcpy(&value, bytes, sizeof value);
    return value;
  }
  /// The caller has bounded `size`.
  std::string text(std::size_t size);
  void skip(std::uint64_t count);
  /// A line with its end, which only the last may lack; nothing at the end of the file. A line of
  /// more than `most_bytes` is damage.
  std::optional<std::string> line(std::size_t most_bytes);

  /// Throws InputError: what is wrong at a position.
  [[noreturn]] void damaged(std::uint64_t position, const std::string& what) const;
  /// The same for what may also be the end of a file whose last bytes were never written: where
  /// only zeros follow, CutOff.
  [[noreturn]] void damaged_unless_zeros(std::uint64_t position, const std::string& what);
  /// The source has ended early.
  [[noreturn]] void ended() const;

 private:
  void read(std::span<char> bytes);

  ByteSource& source_;
  std::filesystem::path file_;
  std::optional<std::uint64_t> chunk_position_;
  std::vector<char> buffer_;
  std::size_t begin_ = 0, end_ = 0;  ///< what of the buffer was not taken yet
  std::uint64_t position_ = 0;       ///< of begin_ in the source
};

}  // namespace avoidbench
