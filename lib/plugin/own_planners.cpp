#include "plugin/own_planners.hpp"

#include <map>
#include <mutex>

#include "base/input_error.hpp"
#include "plugin/planner_table.hpp"

namespace avoidbench {
namespace {

struct OwnPlanners {
  std::mutex mutex;
  std::map<std::filesystem::path, const ab_planner*> tables;
};

OwnPlanners& own_planners() {
  static OwnPlanners planners;
  return planners;
}

std::filesystem::path plain(const std::filesystem::path& file) {
  return std::filesystem::absolute(file).lexically_normal();
}

}  // namespace

void register_own_planner(const std::filesystem::path& file, const ab_planner& table) {
  require_sound_table(file, table);
  OwnPlanners& planners = own_planners();
  const std::lock_guard lock(planners.mutex);
  planners.tables[plain(file)] = &table;
}

const ab_planner* own_planner(const std::filesystem::path& file) {
  OwnPlanners& planners = own_planners();
  const std::lock_guard lock(planners.mutex);
  const auto found = planners.tables.find(plain(file));
  return found == planners.tables.end() ? nullptr : found->second;
}

}  // namespace avoidbench
