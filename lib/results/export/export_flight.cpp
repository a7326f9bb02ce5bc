#include "export/export_flight.hpp"

#include <cmath>

#include "avoidbench/planner.h"
#include "base/number_text.hpp"
#include "geometry/pose.hpp"
#include "plugin/command_check.hpp"
#include "store/record_format.hpp"
#include "table/csv.hpp"

namespace avoidbench {
namespace {

/// What a planner answers: as we have it, as planner.h numbers it, in words.
struct Answer {
  PlanStatus status;
  std::int32_t number;
  std::string_view text;
};
constexpr Answer kAnswers[] = {{PlanStatus::command, AB_OK, "command"},
                               {PlanStatus::no_plan, AB_NO_PLAN, "no_plan"},
                               {PlanStatus::gave_up, AB_GIVE_UP, "gave_up"}};

/// The words for a status or a number. What a damaged row says otherwise is an error, too.
template <class Status>
std::string_view status_text(Status Answer::*member, Status status) {
  for (const Answer& answer : kAnswers) {
    if (answer.*member == status) return answer.text;
  }
  return "error";
}

}  // namespace

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

std::string plan_calls_csv(std::span<const PlanCall> calls) {
  std::string csv = csv_header("call_index time_s status command_kind cpu_time_s wall_time_s");
  for (std::size_t i = 0; i < calls.size(); ++i) {
    const PlanCall& call = calls[i];
    const std::string kind = call.status == AB_OK ? command_kind_text(call.command_kind) : "";
    CsvRow row;
    row.add_value(i).add(call.time_s);
    row.add(status_text(&Answer::number, call.status)).add(kind);
    row.add(call.cpu_time_s).add(call.wall_time_s);
    csv += row.line();
  }
  return csv;
}

CommandLine command_line(const PlanStep& step) {
  return {.time_s = step.time_s,
          .effect_s = step.effect_s,
          .cpu_time_s = step.result.cpu_time_s,
          .status = step.result.status,
          .command = step.result.command,
          .points = step.result.points};
}

/// One line a call. Of a trajectory it has the first point and the end.
std::string commands_csv(const std::vector<CommandLine>& calls) {
  std::string csv = csv_header(
      "time_s effect_s status cpu_ms kind x_m y_m z_m vx_mps vy_mps vz_mps ax_mps2 ay_mps2 az_mps2 "
      "yaw_rad yaw_rate_radps point_count duration_s end_x_m end_y_m end_z_m horizon_s");
  for (const CommandLine& call : calls) {
    const bool is_command = call.status == PlanStatus::command;
    // 0 is no kind: without a command, all columns of one stay empty.
    const std::uint32_t kind = is_command ? call.command.kind : 0;
    const ab_command& c = call.command;
    const ab_point* first = call.points.empty() ? nullptr : &call.points.front();
    const bool has_velocity = kind == AB_COMMAND_VELOCITY;
    CsvRow row;
    row.add(call.time_s).add(call.effect_s).add(status_text(&Answer::status, call.status));
    row.add(1000.0 * call.cpu_time_s).add(is_command ? command_kind_text(kind) : "");
    // Only what this kind of command says; other numbers in the struct mean nothing.
    row.add_vector(first != nullptr              ? first->position_world_m
                   : kind == AB_COMMAND_POSITION ? c.position_world_m
                                                 : nullptr);
    row.add_vector(first != nullptr ? first->velocity_world_mps
                   : has_velocity   ? c.velocity_world_mps
                                    : nullptr);
    row.add_vector(first != nullptr                  ? first->acceleration_world_mps2
                   : kind == AB_COMMAND_ACCELERATION ? c.acceleration_world_mps2
                                                     : nullptr);
    const double nothing = std::nan("");
    // Body rates turn the vehicle by themselves.
    const bool has_yaw = is_command && kind != AB_COMMAND_RATES;
    row.add(!has_yaw ? nothing : first != nullptr ? first->yaw_rad : c.yaw_rad);
    row.add(!has_yaw ? nothing : first != nullptr ? first->yaw_rate_radps : c.yaw_rate_radps);
    row.add(std::to_string(call.points.size()));
    row.add(first == nullptr ? nothing : call.points.back().time_s);
    row.add_vector(first == nullptr ? nullptr : call.points.back().position_world_m);
    row.add(is_command ? c.horizon_s : nothing);
    csv += row.line();
  }
  return csv;
}

}  // namespace avoidbench
