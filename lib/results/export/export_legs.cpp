#include "export/export_legs.hpp"

#include "base/math.hpp"
#include "metrics/legs.hpp"
#include "replay/stored_flight.hpp"
#include "table/csv.hpp"

namespace avoidbench {

std::string legs_csv_header() {
  return csv_header(
      "planner mission_index leg_index goal_x_m goal_y_m goal_z_m is_reached begin_s end_s time_s "
      "path_length_m reference_length_m path_optimality_pct average_goal_velocity_mps trial_key");
}

std::string legs_csv(const StoredTrial& stored) {
  std::string csv;
  for (const FlownLeg& leg : flown_legs(stored.spec, mission_of(stored), stored.row.record)) {
    const double time_s = leg.end_s - leg.begin_s, least_m = leg.reference_length_m;
    // As the metrics of whole flights: of legs that were flown to their end, and none where there
    // is nothing to divide by.
    const auto over = [&](double numerator, double denominator) {
      return leg.is_reached && denominator > 0.0 ? numerator / denominator : math::kNaN;
    };
    CsvRow row;
    row.add(stored.row.planner_label).add_value(stored.row.mission_index).add_value(leg.index);
    row.add(leg.goal_world).add_value(leg.is_reached ? 1 : 0);
    row.add(leg.begin_s).add(leg.end_s).add(time_s);
    row.add(leg.path_length_m).add(least_m);
    row.add(over(100.0 * (leg.path_length_m - least_m), least_m)).add(over(least_m, time_s));
    row.add(stored.row.key);
    csv += row.line();
  }
  return csv;
}

}  // namespace avoidbench
