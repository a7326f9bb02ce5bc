#include "export/export_commands.hpp"

#include <cmath>

#include "plugin/command_check.hpp"
#include "table/csv.hpp"

namespace avoidbench {
namespace {

std::string status_text(PlanStatus status) {
  switch (status) {
    case PlanStatus::command:
      return "command";
    case PlanStatus::no_plan:
      return "no_plan";
    case PlanStatus::gave_up:
      return "gave_up";
    case PlanStatus::error:
      break;
  }
  return "error";
}

}  // namespace

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
    row.add(call.time_s).add(call.effect_s).add(status_text(call.status));
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
