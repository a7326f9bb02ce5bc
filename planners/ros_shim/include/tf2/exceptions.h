#ifndef TF2_EXCEPTIONS_H
#define TF2_EXCEPTIONS_H

#include <stdexcept>
#include <string>

namespace tf2 {

class TransformException : public std::runtime_error {
 public:
  explicit TransformException(const std::string& text) : std::runtime_error(text) {}
};
class LookupException : public TransformException {
  using TransformException::TransformException;
};
class ConnectivityException : public TransformException {
  using TransformException::TransformException;
};
class ExtrapolationException : public TransformException {
  using TransformException::TransformException;
};
class InvalidArgumentException : public TransformException {
  using TransformException::TransformException;
};
class TimeoutException : public TransformException {
  using TransformException::TransformException;
};

}  // namespace tf2

#endif
