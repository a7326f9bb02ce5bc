#ifndef SENSOR_MSGS_IMAGE_ENCODINGS_H
#define SENSOR_MSGS_IMAGE_ENCODINGS_H

#include <cstdlib>
#include <stdexcept>
#include <string>

namespace sensor_msgs {
namespace image_encodings {

const std::string RGB8 = "rgb8", RGBA8 = "rgba8", RGB16 = "rgb16", RGBA16 = "rgba16";
const std::string BGR8 = "bgr8", BGRA8 = "bgra8", BGR16 = "bgr16", BGRA16 = "bgra16";
const std::string MONO8 = "mono8", MONO16 = "mono16";
const std::string TYPE_8UC1 = "8UC1", TYPE_8UC2 = "8UC2", TYPE_8UC3 = "8UC3", TYPE_8UC4 = "8UC4";
const std::string TYPE_8SC1 = "8SC1", TYPE_8SC3 = "8SC3";
const std::string TYPE_16UC1 = "16UC1", TYPE_16UC3 = "16UC3", TYPE_16SC1 = "16SC1";
const std::string TYPE_32SC1 = "32SC1", TYPE_32FC1 = "32FC1", TYPE_32FC2 = "32FC2";
const std::string TYPE_32FC3 = "32FC3", TYPE_32FC4 = "32FC4", TYPE_64FC1 = "64FC1";

inline bool isColor(const std::string& encoding) {
  return encoding == RGB8 || encoding == BGR8 || encoding == RGBA8 || encoding == BGRA8 ||
         encoding == RGB16 || encoding == BGR16 || encoding == RGBA16 || encoding == BGRA16;
}
inline bool isMono(const std::string& encoding) { return encoding == MONO8 || encoding == MONO16; }
inline bool hasAlpha(const std::string& encoding) {
  return encoding == RGBA8 || encoding == BGRA8 || encoding == RGBA16 || encoding == BGRA16;
}
inline int numChannels(const std::string& encoding) {
  if (isMono(encoding)) return 1;
  if (isColor(encoding)) return hasAlpha(encoding) ? 4 : 3;
  const std::size_t at = encoding.find('C');
  if (at == std::string::npos || at + 1 >= encoding.size()) {
    throw std::runtime_error("Unknown encoding " + encoding);
  }
  return std::atoi(encoding.c_str() + at + 1);
}
inline int bitDepth(const std::string& encoding) {
  if (isMono(encoding) || isColor(encoding)) {
    return encoding.find("16") != std::string::npos ? 16 : 8;
  }
  const int bits = std::atoi(encoding.c_str());
  if (bits == 0) throw std::runtime_error("Unknown encoding " + encoding);
  return bits;
}

}  // namespace image_encodings
}  // namespace sensor_msgs

#endif
