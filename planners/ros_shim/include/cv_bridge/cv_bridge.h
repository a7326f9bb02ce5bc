#ifndef CV_BRIDGE_CV_BRIDGE_H
#define CV_BRIDGE_CV_BRIDGE_H

#include <opencv2/core/core_c.h>
#include <cstring>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <stdexcept>
#include <string>

#include "ros_shim/pointer.h"
#include "sensor_msgs/Image.h"
#include "sensor_msgs/image_encodings.h"
#include "std_msgs/Header.h"

// Images of ROS as OpenCV's, over the real OpenCV: NEEDS opencv.
namespace cv_bridge {

class Exception : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// OpenCV's type of an encoding's pixels.
inline int getCvType(const std::string& encoding) {
  namespace names = sensor_msgs::image_encodings;
  int depth = 0;
  try {
    const int bits = names::bitDepth(encoding), channels = names::numChannels(encoding);
    const bool is_named = names::isColor(encoding) || names::isMono(encoding);
    const char kind = is_named ? 'U' : encoding.at(bits < 10 ? 1 : 2);
    if (bits == 8) {
      depth = kind == 'U' ? CV_8U : CV_8S;
    } else if (bits == 16) {
      depth = kind == 'U' ? CV_16U : CV_16S;
    } else if (bits == 32) {
      depth = kind == 'F' ? CV_32F : CV_32S;
    } else if (bits == 64) {
      depth = CV_64F;
    } else {
      throw Exception("Unrecognized image encoding [" + encoding + "]");
    }
    return CV_MAKETYPE(depth, channels);
  } catch (const std::exception&) {
    throw Exception("Unrecognized image encoding [" + encoding + "]");
  }
}

class CvImage;
using CvImagePtr = ros_shim::shared_ptr<CvImage>;
using CvImageConstPtr = ros_shim::shared_ptr<const CvImage>;

class CvImage {
 public:
  std_msgs::Header header;
  std::string encoding;
  cv::Mat image;

  CvImage() = default;
  CvImage(const std_msgs::Header& header_, const std::string& encoding_,
          const cv::Mat& image_ = cv::Mat())
      : header(header_), encoding(encoding_), image(image_) {}

  sensor_msgs::ImagePtr toImageMsg() const {
    sensor_msgs::ImagePtr message = ros_shim::make_shared<sensor_msgs::Image>();
    toImageMsg(*message);
    return message;
  }
  void toImageMsg(sensor_msgs::Image& message) const {
    message.header = header;
    message.encoding = encoding;
    message.height = static_cast<std::uint32_t>(image.rows);
    message.width = static_cast<std::uint32_t>(image.cols);
    message.is_bigendian = 0;
    const std::size_t row = static_cast<std::size_t>(image.cols) * image.elemSize();
    message.step = static_cast<std::uint32_t>(row);
    message.data.resize(row * static_cast<std::size_t>(image.rows));
    for (int y = 0; y < image.rows; ++y) {
      std::memcpy(message.data.data() + static_cast<std::size_t>(y) * row, image.ptr(y), row);
    }
  }

  using Ptr = CvImagePtr;
  using ConstPtr = CvImageConstPtr;
};

namespace detail {

/// OpenCV's view of a message's pixels.
inline cv::Mat view_of(const sensor_msgs::Image& message) {
  const int type = getCvType(message.encoding);
  const std::size_t row = message.width * static_cast<std::size_t>(CV_ELEM_SIZE(type));
  if (message.step < row || message.data.size() < std::size_t{message.step} * message.height) {
    throw Exception("Image is wrongly formed: its data is shorter than its height and step say");
  }
  return cv::Mat(static_cast<int>(message.height), static_cast<int>(message.width), type,
                 const_cast<std::uint8_t*>(message.data.data()), message.step);
}

/// OpenCV's code from one order of channels to another; -1 where they are the same.
inline int color_code(const std::string& from, const std::string& to) {
  namespace names = sensor_msgs::image_encodings;
  const auto base = [](const std::string& encoding) -> std::string {
    if (names::isMono(encoding)) return "mono";
    return encoding.substr(0, names::hasAlpha(encoding) ? 4 : 3);
  };
  const std::string a = base(from), b = base(to);
  if (a == b) return -1;
  struct Code {
    const char *from, *to;
    int code;
  };
  const Code codes[] = {
      {"rgb", "bgr", cv::COLOR_RGB2BGR},     {"bgr", "rgb", cv::COLOR_BGR2RGB},
      {"rgb", "mono", cv::COLOR_RGB2GRAY},   {"bgr", "mono", cv::COLOR_BGR2GRAY},
      {"mono", "rgb", cv::COLOR_GRAY2RGB},   {"mono", "bgr", cv::COLOR_GRAY2BGR},
      {"rgba", "rgb", cv::COLOR_RGBA2RGB},   {"rgba", "bgr", cv::COLOR_RGBA2BGR},
      {"bgra", "bgr", cv::COLOR_BGRA2BGR},   {"bgra", "rgb", cv::COLOR_BGRA2RGB},
      {"rgb", "rgba", cv::COLOR_RGB2RGBA},   {"bgr", "bgra", cv::COLOR_BGR2BGRA},
      {"rgba", "mono", cv::COLOR_RGBA2GRAY}, {"bgra", "mono", cv::COLOR_BGRA2GRAY},
      {"mono", "rgba", cv::COLOR_GRAY2RGBA}, {"mono", "bgra", cv::COLOR_GRAY2BGRA}};
  for (const Code& code : codes) {
    if (a == code.from && b == code.to) return code.code;
  }
  throw Exception("No conversion from [" + from + "] to [" + to + "]");
}

/// Pixels of one encoding as another: depths are converted without a scale, except named ones of 8
/// and 16 bits, as in ROS.
inline cv::Mat converted(const cv::Mat& image, const std::string& from, const std::string& to) {
  namespace names = sensor_msgs::image_encodings;
  const auto is_named = [](const std::string& encoding) {
    return names::isColor(encoding) || names::isMono(encoding);
  };
  if (to.empty() || from == to) return image.clone();
  const int type = getCvType(to);
  cv::Mat result = image;
  if (is_named(from) && is_named(to)) {
    const int code = color_code(from, to);
    if (code >= 0) {
      cv::Mat turned;
      cv::cvtColor(result, turned, code);
      result = turned;
    }
    const int bits_from = names::bitDepth(from), bits_to = names::bitDepth(to);
    cv::Mat scaled;
    const double scale = bits_from == bits_to ? 1.0
                         : bits_from == 8     ? 65535.0 / 255.0
                                              : 255.0 / 65535.0;
    result.convertTo(scaled, CV_MAT_DEPTH(type), scale);
    return scaled;
  }
  if (CV_MAT_CN(type) != image.channels()) {
    throw Exception("[" + from + "] and [" + to + "] have other numbers of channels");
  }
  cv::Mat other;
  result.convertTo(other, CV_MAT_DEPTH(type));
  return other;
}

}  // namespace detail

inline CvImagePtr toCvCopy(const sensor_msgs::Image& message,
                           const std::string& encoding = std::string()) {
  const CvImagePtr made = ros_shim::make_shared<CvImage>();
  made->header = message.header;
  made->encoding = encoding.empty() ? message.encoding : encoding;
  made->image = detail::converted(detail::view_of(message), message.encoding, made->encoding);
  return made;
}
inline CvImagePtr toCvCopy(const sensor_msgs::ImageConstPtr& message,
                           const std::string& encoding = std::string()) {
  return toCvCopy(*message, encoding);
}
/// Nobody may write into it; the pixels are the message's where its encoding is the wanted one,
/// which lives as long as the image.
inline CvImageConstPtr toCvShare(const sensor_msgs::ImageConstPtr& message,
                                 const std::string& encoding = std::string()) {
  if (!encoding.empty() && encoding != message->encoding) return toCvCopy(*message, encoding);
  CvImage view(message->header, message->encoding, detail::view_of(*message));
  return CvImageConstPtr(new CvImage(view), [message](const CvImage* image) { delete image; });
}
inline CvImageConstPtr toCvShare(const sensor_msgs::Image& message,
                                 const ros_shim::shared_ptr<const void>& keeps,
                                 const std::string& encoding = std::string()) {
  if (!encoding.empty() && encoding != message.encoding) return toCvCopy(message, encoding);
  CvImage view(message.header, message.encoding, detail::view_of(message));
  return CvImageConstPtr(new CvImage(view), [keeps](const CvImage* image) { delete image; });
}
inline CvImagePtr cvtColor(const CvImageConstPtr& source, const std::string& encoding) {
  const CvImagePtr made = ros_shim::make_shared<CvImage>();
  made->header = source->header;
  made->encoding = encoding;
  made->image = detail::converted(source->image, source->encoding, encoding);
  return made;
}

}  // namespace cv_bridge

#endif
