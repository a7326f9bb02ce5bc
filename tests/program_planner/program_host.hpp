#pragma once

#include <string>
#include <vector>

#include "avoidbench/planner.h"
#include "program_planner/program_planner.hpp"

namespace avoidbench {

/// The host of one instance, that keeps what it is told.
struct KeepingHost {
  KeepingHost() {
    table.struct_size = sizeof table;
    table.abi_version = AVOIDBENCH_ABI_VERSION;
    table.context = this;
    table.set_error = [](void* context, const char* text) {
      static_cast<KeepingHost*>(context)->error = text;
    };
    table.log = [](void* context, std::int32_t level, const char* text) {
      static_cast<KeepingHost*>(context)->log.push_back(std::to_string(level) + " " + text);
    };
    table.get_extension = [](void*, const char*) -> const void* { return nullptr; };
  }
  KeepingHost(const KeepingHost&) = delete;
  KeepingHost& operator=(const KeepingHost&) = delete;

  ab_host table{};
  std::string error;
  std::vector<std::string> log;
};

inline std::filesystem::path program_file_of(const std::string& name) {
  return std::filesystem::path(PROGRAMS) / name;
}

/// The program that breaks the protocol in one way.
inline PlannerSource hostile_source(const std::string& way) {
  return {program_file_of("hostile"), {kFileWord, way}};
}

}  // namespace avoidbench
