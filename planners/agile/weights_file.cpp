#include "weights_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <bit>
#include <cerrno>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <system_error>
#include <utility>

namespace agile {
namespace {

using nlohmann::json;

constexpr std::uint64_t kMostBytes = 64ULL << 20U;
constexpr std::uint64_t kMostHeaderBytes = 1ULL << 20U;  // ours has some 3 kB
constexpr std::size_t kLengthBytes = 8, kWidest = 4096;
constexpr std::string_view kFormat = "agile/1";

/// A text of the file's in a message: escaped, and short.
std::string quoted(const std::string& text) {
  constexpr std::size_t kMost = 60;
  std::string shown = json(text).dump(-1, ' ', true, json::error_handler_t::replace);
  if (shown.size() > kMost) shown = shown.substr(0, kMost) + "…\"";
  return shown;
}

std::string as_text(const std::vector<std::size_t>& shape, std::string_view for_zero) {
  std::string text = "[";
  for (std::size_t i = 0; i < shape.size(); ++i) {
    if (i > 0) text += ", ";
    text += shape[i] == 0 ? std::string(for_zero) : std::to_string(shape[i]);
  }
  return text + "]";
}

/// An open file, closed at the end.
class Descriptor {
 public:
  explicit Descriptor(int descriptor) : descriptor_(descriptor) {}
  ~Descriptor() {
    if (descriptor_ >= 0) ::close(descriptor_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  int get() const { return descriptor_; }

 private:
  int descriptor_;
};

std::optional<std::vector<std::uint64_t>> as_numbers(const json& list) {
  constexpr std::size_t kMostNumbers = 8;
  if (!list.is_array() || list.size() > kMostNumbers) return std::nullopt;
  std::vector<std::uint64_t> numbers;
  for (const json& number : list) {
    if (!number.is_number_unsigned()) return std::nullopt;
    numbers.push_back(number.get<std::uint64_t>());
  }
  return numbers;
}

/// Elements of a tensor; nothing where they are more than a file can hold.
std::optional<std::uint64_t> elements_of(const std::vector<std::uint64_t>& shape) {
  std::uint64_t elements = 1;
  for (const std::uint64_t size : shape) {
    if (size > kMostBytes || elements * size > kMostBytes) return std::nullopt;
    elements *= size;
  }
  return elements;
}

std::uint64_t byte_at(const std::string& bytes, std::size_t i) {
  return static_cast<unsigned char>(bytes[i]);
}

}  // namespace

float from_half(std::uint16_t half) {
  const std::uint32_t sign = (half & 0x8000U) << 16U;
  std::uint32_t exponent = (half >> 10U) & 31U;
  std::uint32_t fraction = half & 0x3FFU;
  if (exponent == 31U) return std::bit_cast<float>(sign | 0x7F800000U | fraction << 13U);
  if (exponent == 0U) {
    if (fraction == 0U) return std::bit_cast<float>(sign);
    // Subnormal: shifts its first bit to where normal numbers have theirs, which is not written.
    const auto shift = static_cast<std::uint32_t>(std::countl_zero(fraction)) - 21U;
    fraction = fraction << shift & 0x3FFU;
    return std::bit_cast<float>(sign | (113U - shift) << 23U | fraction << 13U);
  }
  exponent += 127U - 15U;
  return std::bit_cast<float>(sign | exponent << 23U | fraction << 13U);
}

WeightsFile::WeightsFile(std::filesystem::path file) : file_(std::move(file)) {
  bytes_ = read_bytes();
  read_header();
  check_coverage();
}

void WeightsFile::refuse(const std::string& what) const {
  throw std::runtime_error("weights " + file_.string() + ": " + what +
                           "; use the file that comes with the planner, or export it again");
}

std::string WeightsFile::read_bytes() const {
  struct ::stat status {};
  const auto refuse_errno = [this](const std::string& what) {
    refuse(what + ": " + std::generic_category().message(errno));
  };
  const auto check_regular = [&] {
    if (S_ISDIR(status.st_mode)) refuse("is a folder");
    if (!S_ISREG(status.st_mode)) refuse("is not a regular file");
  };
  // Looked at before it is opened: opening a device may do something.
  if (::stat(file_.c_str(), &status) != 0) refuse_errno("can't be opened");
  check_regular();
  const Descriptor descriptor(::open(file_.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY));
  if (descriptor.get() < 0) refuse_errno("can't be opened");
  if (::fstat(descriptor.get(), &status) != 0) refuse_errno("can't be read");
  check_regular();
  const auto size = static_cast<std::uint64_t>(status.st_size);
  if (size > kMostBytes) {
    refuse("has " + std::to_string(size) + " bytes, and more than 64 MiB can't be weights");
  }
  std::string bytes(static_cast<std::size_t>(size), '\0');
  std::size_t done = 0;
  while (done < bytes.size()) {
    const ::ssize_t got = ::read(descriptor.get(), bytes.data() + done, bytes.size() - done);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) refuse_errno("can't be read");
    if (got == 0) break;
    done += static_cast<std::size_t>(got);
  }
  bytes.resize(done);
  return bytes;
}

void WeightsFile::read_header() {
  if (bytes_.size() < kLengthBytes) {
    refuse("is truncated: it has " + std::to_string(bytes_.size()) + " bytes");
  }
  std::uint64_t length = 0;
  for (std::size_t i = 0; i < kLengthBytes; ++i) length |= byte_at(bytes_, i) << (8U * i);
  if (length > kMostHeaderBytes) {
    refuse("tells a header of " + std::to_string(length) + " bytes; it is no safetensors file");
  }
  if (length > bytes_.size() - kLengthBytes) {
    refuse("is truncated: it ends within its header of " + std::to_string(length) + " bytes");
  }
  data_begin_ = kLengthBytes + static_cast<std::size_t>(length);
  const char* text = bytes_.data() + kLengthBytes;
  const json header = json::parse(text, text + length, nullptr, false);
  if (!header.is_object()) refuse("its header is not a JSON object");  // a discarded one isn't too

  const auto metadata = header.find("__metadata__");
  if (metadata == header.end() || !metadata->is_object() || !metadata->contains("format") ||
      metadata->at("format") != kFormat) {
    refuse("its header does not give the format \"" + std::string(kFormat) + "\"");
  }
  const std::uint64_t data_bytes = bytes_.size() - data_begin_;
  for (const auto& [name, value] : header.items()) {
    if (name == "__metadata__") continue;
    const std::string what = "tensor " + quoted(name) + " ";
    if (!value.is_object() || !value.contains("dtype") || !value.contains("shape") ||
        !value.contains("data_offsets")) {
      refuse(what + "lacks dtype, shape or data_offsets");
    }
    const json& type = value.at("dtype");
    if (!type.is_string()) refuse(what + "has a dtype that is no text");
    if (type != "F16") {
      refuse(what + "has the dtype " + quoted(type.get<std::string>()) + " instead of F16");
    }
    const auto shape = as_numbers(value.at("shape"));
    const auto elements = shape ? elements_of(*shape) : std::nullopt;
    if (!elements) refuse(what + "has a shape that is no list of sizes");
    const auto offsets = as_numbers(value.at("data_offsets"));
    if (!offsets || offsets->size() != 2) {
      refuse(what + "has data_offsets that are not two offsets");
    }
    Entry entry{offsets->front(), offsets->back(), {shape->begin(), shape->end()}, false};
    if (entry.begin > entry.end) refuse(what + "ends before it begins");
    if (entry.end > data_bytes) {
      refuse(what + "ends at byte " + std::to_string(entry.end) + " of " +
             std::to_string(data_bytes) + " of data: the file is truncated, or its header wrong");
    }
    if (entry.end - entry.begin != 2 * *elements) {
      refuse(what + "has " + std::to_string(entry.end - entry.begin) + " bytes, and its shape " +
             as_text(entry.shape, "0") + " takes " + std::to_string(2 * *elements));
    }
    entries_.emplace(name, std::move(entry));
  }
}

void WeightsFile::check_coverage() const {
  std::vector<std::pair<std::uint64_t, std::uint64_t>> places;
  for (const auto& [name, entry] : entries_) places.emplace_back(entry.begin, entry.end);
  std::sort(places.begin(), places.end());
  std::uint64_t at = 0;
  for (const auto& [begin, end] : places) {
    if (begin < at) refuse("two of its tensors overlap at byte " + std::to_string(begin));
    if (begin > at) refuse("no tensor has the data at byte " + std::to_string(at));
    at = end;
  }
  if (at != bytes_.size() - data_begin_) {
    refuse("goes on behind its last tensor, at byte " + std::to_string(at) + " of the data");
  }
}

Tensor WeightsFile::take(const std::string& name, const std::vector<std::size_t>& shape) {
  const auto found = entries_.find(name);
  if (found == entries_.end()) refuse("tensor " + quoted(name) + " is missing");
  Entry& entry = found->second;
  const bool fits = std::equal(shape.begin(), shape.end(), entry.shape.begin(), entry.shape.end(),
                               [](std::size_t wanted, std::size_t size) {
                                 return wanted == 0 ? size >= 1 && size <= kWidest : size == wanted;
                               });
  if (!fits) {
    refuse("tensor " + quoted(name) + " has the shape " + as_text(entry.shape, "0") +
           ", which should be " + as_text(shape, "1…" + std::to_string(kWidest)));
  }
  entry.is_taken = true;
  Tensor tensor{entry.shape, {}};
  tensor.values.reserve(static_cast<std::size_t>(entry.end - entry.begin) / 2);
  const std::size_t end = data_begin_ + static_cast<std::size_t>(entry.end);
  for (std::size_t i = data_begin_ + static_cast<std::size_t>(entry.begin); i < end; i += 2) {
    const auto half = static_cast<std::uint16_t>(byte_at(bytes_, i) | byte_at(bytes_, i + 1) << 8U);
    tensor.values.push_back(from_half(half));
    if (!std::isfinite(tensor.values.back())) {
      refuse("tensor " + quoted(name) + " has a weight that is not finite, at " +
             std::to_string(tensor.values.size() - 1));
    }
  }
  return tensor;
}

void WeightsFile::check_all_taken() const {
  for (const auto& [name, entry] : entries_) {
    if (!entry.is_taken) refuse("tensor " + quoted(name) + " is none of this network's");
  }
}

}  // namespace agile
