#include "logs/byte_reader.hpp"

#include <algorithm>

#include "base/input_error.hpp"

namespace avoidbench {

constexpr std::size_t kBufferBytes = std::size_t{1} << 16U;

ByteReader::ByteReader(ByteSource& source, std::filesystem::path file)
    : source_(source), file_(std::move(file)), buffer_(kBufferBytes) {}

ByteReader::ByteReader(ByteSource& source, const ByteReader& file, std::uint64_t chunk_position)
    : source_(source), file_(file.file_), chunk_position_(chunk_position), buffer_(kBufferBytes) {}

std::string_view ByteReader::peek(std::size_t count) {
  if (end_ - begin_ < count && begin_ > 0) {
    std::copy(buffer_.data() + begin_, buffer_.data() + end_, buffer_.data());
    end_ -= begin_;
    begin_ = 0;
  }
  while (end_ - begin_ < count) {
    const std::size_t got = source_.read(std::span(buffer_).subspan(end_));
    if (got == 0) break;
    end_ += got;
  }
  return {buffer_.data() + begin_, std::min(count, end_ - begin_)};
}

std::size_t ByteReader::read_some(std::span<char> bytes) {
  if (begin_ == end_) {
    begin_ = 0;
    end_ = source_.read(buffer_);
  }
  const std::size_t count = std::min(bytes.size(), end_ - begin_);
  std::copy_n(buffer_.data() + begin_, count, bytes.data());
  begin_ += count;
  position_ += count;
  return count;
}

void ByteReader::read(std::span<char> bytes) {
  while (!bytes.empty()) {
    const std::size_t count = read_some(bytes);
    if (count == 0) ended();
    bytes = bytes.subspan(count);
  }
}

std::string ByteReader::text(std::size_t size) {
  std::string bytes(size, '\0');
  read(bytes);
  return bytes;
}

void ByteReader::skip(std::uint64_t count) {
  while (count > 0) {
    if (at_end()) ended();
    const std::uint64_t taken = std::min<std::uint64_t>(count, end_ - begin_);
    begin_ += taken;
    position_ += taken;
    count -= taken;
  }
}

std::optional<std::string> ByteReader::line(std::size_t most_bytes) {
  if (at_end()) return std::nullopt;
  const std::uint64_t start = position_;
  std::string text;
  while (!at_end()) {
    const std::string_view held(buffer_.data() + begin_, end_ - begin_);
    const std::size_t end = held.find('\n');
    const std::string_view taken = held.substr(0, end == held.npos ? end : end + 1);
    text += taken;
    if (text.size() > most_bytes) damaged(start, "a line without end");
    skip(taken.size());
    if (text.ends_with('\n')) break;
  }
  return text;
}

void ByteReader::damaged(std::uint64_t position, const std::string& what) const {
  std::string place = "damaged at byte " + std::to_string(chunk_position_.value_or(position));
  if (chunk_position_) {
    place += ", in the chunk there, at byte " + std::to_string(position) + " of what it unpacks to";
  }
  refuse_file(file_, place + ": " + what);
}

void ByteReader::damaged_unless_zeros(std::uint64_t position, const std::string& what) {
  while (!at_end()) {
    const std::span<const char> held(buffer_.data() + begin_, end_ - begin_);
    if (std::any_of(held.begin(), held.end(), [](char c) { return c != '\0'; })) {
      damaged(position, what);
    }
    skip(end_ - begin_);
  }
  if (chunk_position_) damaged(position, what);
  throw CutOff{position};
}

void ByteReader::ended() const {
  if (chunk_position_) damaged(position_, "it ends within a record");
  throw CutOff{position_};
}

}  // namespace avoidbench
