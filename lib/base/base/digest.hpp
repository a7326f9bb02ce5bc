#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace avoidbench {

/// SHA-256 fed piece by piece. Numbers enter as little-endian bytes, so that a digest is the same
/// on every machine.
class Digest {
 public:
  Digest();
  Digest& add_bytes(std::span<const std::byte> bytes);
  Digest& add(
      std::string_view text);  ///< with its length, so that ("ab", "c") and ("a", "bc") differ
  Digest& add(std::uint64_t value);
  Digest& add(double value);

  template <class T>
  Digest& add_array(std::span<const T> values) {
    return add_bytes(std::as_bytes(values));
  }

  /// 64 lower-case hexadecimal digits. The digest starts again afterwards.
  std::string hex();

 private:
  alignas(16) std::array<std::byte, 128> state_{};
};

/// SHA-256 of these bytes alone, as sha256sum gives it.
std::string sha256(std::string_view bytes);

/// HMAC-SHA256 (RFC 2104) of the message, 64 lower-case hexadecimal digits.
std::string hmac_sha256(std::string_view key, std::string_view message);

/// SHA-256 of a regular file's bytes. Throws InputError when it can't be read.
std::string file_digest(const std::filesystem::path& path);

}  // namespace avoidbench
