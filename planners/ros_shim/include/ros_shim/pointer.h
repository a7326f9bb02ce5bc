#ifndef ROS_SHIM_POINTER_H
#define ROS_SHIM_POINTER_H

// The pointers and fixed arrays of messages. In ROS 1 they are boost's; they are so here where its
// headers are installed, and the standard library's elsewhere. Planner sources that name boost
// themselves need its headers anyway.
#if !defined(ROS_SHIM_NO_BOOST) && defined(__has_include)
#if __has_include(<boost/shared_ptr.hpp>) && __has_include(<boost/array.hpp>)
#define ROS_SHIM_HAS_BOOST 1
#endif
#endif

#ifdef ROS_SHIM_HAS_BOOST
#include <boost/array.hpp>
#include <boost/bind.hpp>
#include <boost/enable_shared_from_this.hpp>
#include <boost/function.hpp>
#include <boost/make_shared.hpp>
#include <boost/shared_ptr.hpp>
#endif
#include <array>
#include <cstddef>
#include <functional>
#include <memory>
#include <utility>

namespace ros_shim {

#ifdef ROS_SHIM_HAS_BOOST
template <class T>
using shared_ptr = boost::shared_ptr<T>;
template <class T, std::size_t count>
using array = boost::array<T, count>;
template <class T, class... Arguments>
shared_ptr<T> make_shared(Arguments&&... arguments) {
  return boost::make_shared<T>(std::forward<Arguments>(arguments)...);
}
template <class T, class U>
shared_ptr<T> cast_pointer(const shared_ptr<U>& pointer) {
  return boost::static_pointer_cast<T>(pointer);
}
#else
template <class T>
using shared_ptr = std::shared_ptr<T>;
template <class T, std::size_t count>
using array = std::array<T, count>;
template <class T, class... Arguments>
shared_ptr<T> make_shared(Arguments&&... arguments) {
  return std::make_shared<T>(std::forward<Arguments>(arguments)...);
}
template <class T, class U>
shared_ptr<T> cast_pointer(const shared_ptr<U>& pointer) {
  return std::static_pointer_cast<T>(pointer);
}
#endif

/// A message of any type.
using AnyMessage = shared_ptr<const void>;

}  // namespace ros_shim

#endif
