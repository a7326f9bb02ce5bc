#include "render/device.hpp"

#include <string>

#include "base/check.hpp"
#include "base/input_error.hpp"
#include "render/ray_tracing_isa.hpp"

namespace avoidbench {

bool has_avx2() {
  // Needed where somebody asks before main().
  __builtin_cpu_init();
  return __builtin_cpu_supports("avx2") != 0;
}

std::string ray_tracing_isa() {
  // Embree's kernels of that name use fused multiply-add, too.
  return has_avx2() && __builtin_cpu_supports("fma") != 0 ? "avx2" : "sse4.2";
}

namespace embree {
namespace {

DeviceHandle new_device() {
  // One thread, since trials fly one a core. One instruction set, whose speed is known; hits do not
  // depend on it (tracing.hpp).
  const std::string settings = "threads=1,isa=" + ray_tracing_isa();
  DeviceHandle handle(rtcNewDevice(settings.c_str()));
  if (handle != nullptr) return handle;
  const RTCError error = rtcGetDeviceError(nullptr);
  AB_CHECK(error == RTC_ERROR_OUT_OF_MEMORY, "Embree error", static_cast<int>(error));
  throw InputError(
      "out of memory while starting the ray tracer: the system gives no more "
      "(ulimit -v, a container's limit, or fewer workers)");
}

}  // namespace

RTCDevice device() {
  static const DeviceHandle handle = new_device();
  return handle.get();
}

void check_errors(const char* doing) {
  // The first error since it was asked last.
  const RTCError error = rtcGetDeviceError(device());
  // The only one that a user can do something about.
  if (error == RTC_ERROR_OUT_OF_MEMORY) {
    throw InputError(std::string("out of memory while ") + doing +
                     ": take a smaller map, a larger poisson_radius_m, or fewer workers");
  }
  AB_CHECK(error == RTC_ERROR_NONE, doing, static_cast<int>(error));
}

}  // namespace embree
}  // namespace avoidbench
