#include "base/digest.hpp"

#include <nettle/hmac.h>
#include <nettle/sha2.h>

#include <bit>
#include <new>
#include <vector>

#include "base/check.hpp"
#include "base/input_file.hpp"
#include "base/poll.hpp"

namespace avoidbench {
namespace {

static_assert(std::endian::native == std::endian::little, "x86-64 only");

sha256_ctx* context(std::array<std::byte, 128>& state) {
  // The header has room for the state and knows nothing of nettle.
  static_assert(sizeof(sha256_ctx) <= 128 && std::is_trivially_copyable_v<sha256_ctx>);
  return std::launder(reinterpret_cast<sha256_ctx*>(state.data()));
}

std::string in_hex(std::span<const std::uint8_t> bytes) {
  constexpr std::string_view kDigits = "0123456789abcdef";
  std::string text;
  text.reserve(2 * bytes.size());
  for (const std::uint8_t byte : bytes) {
    text += kDigits[byte >> 4U];
    text += kDigits[byte & 15U];
  }
  return text;
}

const std::uint8_t* bytes_of(std::string_view text) {
  return reinterpret_cast<const std::uint8_t*>(text.data());
}

}  // namespace

Digest::Digest() { sha256_init(new (state_.data()) sha256_ctx); }

Digest& Digest::add_bytes(std::span<const std::byte> bytes) {
  sha256_update(context(state_), bytes.size(), reinterpret_cast<const std::uint8_t*>(bytes.data()));
  return *this;
}

Digest& Digest::add(std::string_view text) {
  // The length first: "ab", "c" and "a", "bc" are different.
  add(static_cast<std::uint64_t>(text.size()));
  return add_bytes(std::as_bytes(std::span(text)));
}

Digest& Digest::add(std::uint64_t value) { return add_bytes(std::as_bytes(std::span(&value, 1))); }

Digest& Digest::add(double value) { return add(std::bit_cast<std::uint64_t>(value)); }

/// Takes the state's end: sha256_digest() begins anew.
std::string Digest::hex() {
  std::array<std::uint8_t, SHA256_DIGEST_SIZE> bytes{};
  sha256_digest(context(state_), bytes.size(), bytes.data());
  return in_hex(bytes);
}

std::string sha256(std::string_view bytes) {
  return Digest().add_bytes(std::as_bytes(std::span(bytes))).hex();
}

std::string hmac_sha256(std::string_view key, std::string_view message) {
  hmac_sha256_ctx context{};
  hmac_sha256_set_key(&context, key.size(), bytes_of(key));
  hmac_sha256_update(&context, message.size(), bytes_of(message));
  std::array<std::uint8_t, SHA256_DIGEST_SIZE> bytes{};
  hmac_sha256_digest(&context, bytes.size(), bytes.data());
  return in_hex(bytes);
}

std::string file_digest(const std::filesystem::path& path) {
  InputFile file(path, kMostFileBytes);
  Digest digest;
  std::vector<char> buffer(1 << 16);
  // A piece that is not full is the last one.
  for (std::size_t count = buffer.size(); count == buffer.size();) {
    poll_caller();
    count = file.read(buffer);
    digest.add_bytes(std::as_bytes(std::span(buffer.data(), count)));
  }
  return digest.hex();
}

}  // namespace avoidbench
