#include <dlfcn.h>
#include <fcntl.h>
#include <sys/mman.h>
#include <sys/sendfile.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cstring>
#include <memory>
#include <new>
#include <stdexcept>
#include <string>
#include <vector>

#include "flight.hpp"

// An instance flies each trial with a copy of this very library that is loaded anew: globals and
// static variables, of which ROS nodes have many, begin as in a process that has just started, and
// two instances never share one.
namespace ros_shim {
namespace {

std::runtime_error system_error(const std::string& what) {
  return std::runtime_error(what + ": " + std::strerror(errno));
}

std::string own_file() {
  Dl_info info{};
  if (::dladdr(reinterpret_cast<const void*>(&own_file), &info) == 0 || info.dli_fname == nullptr) {
    throw std::runtime_error("the planner's library does not know its own file");
  }
  return info.dli_fname;
}

/// A copy of the library in memory, loaded. The loader knows libraries by their inode and by the
/// name they are opened by: each copy is a file of its own, and its descriptor, whose number is in
/// the name, stays open as long as the copy is there.
class LoadedCopy {
 public:
  LoadedCopy() {
    copy_file(own_file());
    path_ = "/proc/self/fd/" + std::to_string(file_);
    handle_ = ::dlopen(path_.c_str(), RTLD_NOW | RTLD_LOCAL);
    if (handle_ == nullptr) {
      const char* reason = ::dlerror();
      ::close(file_);
      throw std::runtime_error("the planner's library can't be loaded once more: " +
                               std::string(reason != nullptr ? reason : "unknown reason"));
    }
    using Function = const CopyTable* (*)();
    const auto function = reinterpret_cast<Function>(::dlsym(handle_, "ros_shim_copy_v1"));
    table_ = function != nullptr ? function() : nullptr;
  }
  ~LoadedCopy() {
    ::dlclose(handle_);
    // Some libraries never go, as where a thread still has something of theirs.
    void* still = ::dlopen(path_.c_str(), RTLD_NOW | RTLD_LOCAL | RTLD_NOLOAD);
    if (still == nullptr) {
      ::close(file_);
    } else {
      ::dlclose(still);
    }
  }
  LoadedCopy(const LoadedCopy&) = delete;
  LoadedCopy& operator=(const LoadedCopy&) = delete;
  const CopyTable& table() const { return *table_; }

 private:
  void copy_file(const std::string& from) {
    const int source = ::open(from.c_str(), O_RDONLY | O_CLOEXEC);
    if (source < 0) throw system_error("can't read " + from);
    file_ = ::memfd_create("ros_planner", MFD_CLOEXEC);
    struct stat status {};
    bool is_well = file_ >= 0 && ::fstat(source, &status) == 0;
    for (off_t left = status.st_size; is_well && left > 0;) {
      const ssize_t written = ::sendfile(file_, source, nullptr, static_cast<std::size_t>(left));
      is_well = written > 0;
      left -= written;
    }
    const std::runtime_error error = system_error("can't copy " + from + " to memory");
    ::close(source);
    if (is_well) return;
    if (file_ >= 0) ::close(file_);
    throw error;
  }

  int file_ = -1;
  std::string path_;
  void* handle_ = nullptr;
  const CopyTable* table_ = nullptr;
};

/// As much of a struct as both sides know; the rest is zero.
template <class Struct>
Struct known_part(const Struct& from) {
  Struct copy{};
  std::memcpy(&copy, &from, std::min<std::size_t>(sizeof(Struct), from.struct_size));
  copy.struct_size = sizeof(Struct);
  return copy;
}

/// An ab_setup that outlives the call it came with.
class OwnSetup {
 public:
  explicit OwnSetup(const ab_setup& setup) : setup_(known_part(setup)) {
    texts_.reserve(setup_.value_count);
    values_.reserve(setup_.value_count);
    for (std::uint32_t i = 0; i < setup_.value_count; ++i) {
      values_.push_back(known_part(*setup_.values[i]));
      texts_.emplace_back(values_.back().text != nullptr ? values_.back().text : "");
      if (values_.back().text != nullptr) values_.back().text = texts_.back().c_str();
    }
    if (setup_.camera_count == 0 && setup_.depth_camera != nullptr) {
      cameras_.push_back(known_part(*setup_.depth_camera));
    }
    for (std::uint32_t i = 0; i < setup_.camera_count; ++i) {
      cameras_.push_back(known_part(*setup_.cameras[i]));
    }
    for (std::uint32_t i = 0; i < setup_.lidar_count; ++i) {
      lidars_.push_back(known_part(*setup_.lidars[i]));
    }
    for (const ab_value& value : values_) value_pointers_.push_back(&value);
    for (const ab_camera& camera : cameras_) camera_pointers_.push_back(&camera);
    for (const ab_lidar& lidar : lidars_) lidar_pointers_.push_back(&lidar);
    setup_.values = value_pointers_.data();
    setup_.cameras = camera_pointers_.data();
    setup_.camera_count = static_cast<std::uint32_t>(cameras_.size());
    setup_.lidars = lidar_pointers_.data();
    setup_.depth_camera = cameras_.empty() ? nullptr : cameras_.data();
  }
  OwnSetup(const OwnSetup&) = delete;
  OwnSetup& operator=(const OwnSetup&) = delete;
  const ab_setup& setup() const { return setup_; }

 private:
  ab_setup setup_;
  std::vector<ab_value> values_;
  std::vector<std::string> texts_;
  std::vector<ab_camera> cameras_;
  std::vector<ab_lidar> lidars_;
  std::vector<const ab_value*> value_pointers_;
  std::vector<const ab_camera*> camera_pointers_;
  std::vector<const ab_lidar*> lidar_pointers_;
};

class Instance {
 public:
  Instance(const ab_host& host, const ab_setup& setup) : host_(&host), setup_(setup) {}
  ~Instance() { end(); }
  Instance(const Instance&) = delete;
  Instance& operator=(const Instance&) = delete;

  ab_status reset(const ab_mission& mission) {
    end();
    try {
      copy_ = std::make_unique<LoadedCopy>();
    } catch (const std::exception& error) {
      host_->set_error(host_->context, error.what());
      return AB_ERROR;
    }
    const ab_mission own = known_part(mission);
    flight_ = copy_->table().begin(host_, &setup_.setup(), &own);
    return flight_ != nullptr ? AB_OK : AB_ERROR;
  }
  ab_status plan(const ab_observation& seen, ab_command& command) {
    if (flight_ == nullptr) {
      host_->set_error(host_->context, "no trial has begun");
      return AB_ERROR;
    }
    return copy_->table().plan(flight_, &seen, &command);
  }

 private:
  void end() {
    if (flight_ != nullptr) copy_->table().end(flight_);
    flight_ = nullptr;
    copy_.reset();
  }

  const ab_host* host_;
  OwnSetup setup_;
  std::unique_ptr<LoadedCopy> copy_;
  void* flight_ = nullptr;
};

}  // namespace

void* create(const ab_host* host, const ab_setup* setup) {
  try {
    return new Instance(*host, *setup);
  } catch (const std::exception& error) {
    host->set_error(host->context, error.what());
    return nullptr;
  }
}

void destroy(void* instance) { delete static_cast<Instance*>(instance); }

ab_status reset(void* instance, const ab_mission* mission) {
  return static_cast<Instance*>(instance)->reset(*mission);
}

ab_status plan(void* instance, const ab_observation* observation, ab_command* command) {
  return static_cast<Instance*>(instance)->plan(*observation, *command);
}

}  // namespace ros_shim

extern "C" AB_EXPORT const ab_planner* avoidbench_planner_v1(std::uint32_t host_api) {
  return host_api == AVOIDBENCH_ABI_VERSION ? &ros_shim::planner_table : nullptr;
}
