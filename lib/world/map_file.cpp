#include "world/map_file.hpp"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <span>

#include "base/digest.hpp"

namespace avoidbench {

void fail_file(const std::string& file, std::string message, int line) {
  throw InputError(InputProblem{.file = file, .line = line, .message = std::move(message)});
}

std::string read_map_file(const std::string& file, std::uint64_t most_bytes) {
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(file, error);
  if (!std::filesystem::exists(status)) fail_file(file, "no such file");
  if (!std::filesystem::is_regular_file(status)) fail_file(file, "is no plain file");
  std::ifstream stream(file, std::ios::binary | std::ios::ate);
  if (!stream) fail_file(file, std::string("can't be read: ") + std::strerror(errno));
  const std::streamoff size = stream.tellg();
  if (size <= 0) fail_file(file, "is empty");
  if (static_cast<std::uint64_t>(size) > most_bytes) {
    fail_file(file, "is larger than " + std::to_string(most_bytes >> 20U) + " MiB");
  }
  std::string bytes(static_cast<std::size_t>(size), '\0');
  stream.seekg(0);
  if (!stream.read(bytes.data(), size)) fail_file(file, "can't be read to its end");
  return bytes;
}

std::string bytes_digest(std::string_view bytes) {
  return Digest().add_bytes(std::as_bytes(std::span(bytes.data(), bytes.size()))).hex();
}

std::string extension_of(const std::string& file) {
  const std::size_t dot = file.find_last_of("./");
  if (dot == std::string::npos || file[dot] == '/') return "";
  std::string extension = file.substr(dot + 1);
  for (char& c : extension) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return extension;
}

}  // namespace avoidbench
