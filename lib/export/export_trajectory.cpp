#include "export/export_trajectory.hpp"

#include "avoidbench/planner.h"
#include "geometry/pose.hpp"
#include "plugin/command_check.hpp"
#include "store/record_format.hpp"
#include "table/csv.hpp"
#include "text/number_text.hpp"

namespace avoidbench {

std::string trajectory_csv(std::span<const Sample> samples) {
  std::string csv = csv_header(
      "time_s x_m y_m z_m vx_mps vy_mps vz_mps ax_mps2 ay_mps2 az_mps2 qw qx qy qz yaw_rad "
      "rate_x_body_radps rate_y_body_radps rate_z_body_radps reference_x_m reference_y_m "
      "reference_z_m rotor_power_w clearance_m");
  for (const Sample& s : samples) {
    const Eigen::Quaterniond& q = s.q_world_body;
    CsvRow row;
    row.add(s.time_s).add(s.position_world).add(s.velocity_world).add(s.acceleration_world);
    row.add(q.w()).add(q.x()).add(q.y()).add(q.z()).add(yaw_of(q)).add(s.rates_body_radps);
    row.add(s.reference_world).add(s.rotor_power_w).add(s.clearance_m);
    csv += row.line();
  }
  return csv;
}

/// The trajectory format of TUM's RGB-D benchmark, which evo and other tools read: seconds, metres,
/// quaternion with w last.
std::string trajectory_tum(std::span<const Sample> samples) {
  std::string tum = "# timestamp tx ty tz qx qy qz qw\n";
  for (const Sample& s : samples) {
    const Eigen::Quaterniond& q = s.q_world_body;
    tum += shortest(s.time_s);
    for (const double value : {s.position_world.x(), s.position_world.y(), s.position_world.z(),
                               q.x(), q.y(), q.z(), q.w()}) {
      tum += " " + shortest(value);
    }
    tum += "\n";
  }
  return tum;
}

std::string trajectory_text(std::span<const Sample> samples, TrajectoryFormat format) {
  return format == TrajectoryFormat::tum ? trajectory_tum(samples) : trajectory_csv(samples);
}

/// As planner.h numbers them; what a damaged row says otherwise is an error, too.
std::string_view plan_status_text(std::int32_t status) {
  switch (status) {
    case AB_OK:
      return "command";
    case AB_NO_PLAN:
      return "no_plan";
    case AB_GIVE_UP:
      return "gave_up";
    default:
      return "error";
  }
}

std::string plan_calls_csv(std::span<const PlanCall> calls) {
  std::string csv = csv_header("call_index time_s status command_kind cpu_time_s wall_time_s");
  for (std::size_t i = 0; i < calls.size(); ++i) {
    const PlanCall& call = calls[i];
    const std::string kind = call.status == AB_OK ? command_kind_text(call.command_kind) : "";
    CsvRow row;
    row.add_value(TableValue(static_cast<std::int64_t>(i))).add(call.time_s);
    row.add(plan_status_text(call.status)).add(std::string_view(kind));
    row.add(call.cpu_time_s).add(call.wall_time_s);
    csv += row.line();
  }
  return csv;
}

}  // namespace avoidbench
