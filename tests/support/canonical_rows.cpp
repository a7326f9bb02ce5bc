#include "support/canonical_rows.hpp"

#include "base/number_text.hpp"
#include "store/record_format.hpp"
#include "store/schema_check.hpp"
#include "store/statement.hpp"

namespace avoidbench::test {
namespace {

/// One table: a query of the text columns first, then of the numbers.
struct Listing {
  std::string_view name;
  std::string sql;
  int text_count;
  int number_count;
};

std::string escaped(const std::string& text) {
  std::string line;
  for (const char c : text) {
    if (c == '\n') {
      line += "\\n";
    } else if (c == '\t') {
      line += "\\t";
    } else if (c == '\\') {
      line += "\\\\";
    } else {
      line += c;
    }
  }
  return line;
}

Listing trial_listing(const Database& db) {
  std::string metrics;
  int count = 2;
  for (const MetricRow& metric : db.metrics()) {
    if (metric.is_measured) continue;
    metrics += ", t." + sql_name(metric.name);
    ++count;
  }
  return {
      .name = "trial",
      .sql =
          "SELECT t.trial_key, t.map_key, t.planner_key, t.outcome, t.reason, r.samples_digest, "
          "c.calls_digest, t.mission_index, t.end_time_s" +
          metrics +
          " FROM trials t LEFT JOIN trajectories r USING (trial_key) LEFT JOIN plan_calls c "
          "USING (trial_key) ORDER BY t.trial_key",
      .text_count = 7,
      .number_count = count};
}

}  // namespace

std::string canonical_rows(const Database& db) {
  const Listing listings[] = {
      {.name = "metric",
       .sql = "SELECT name, version FROM metric_definitions ORDER BY name",
       .text_count = 1,
       .number_count = 1},
      {.name = "planner",
       .sql =
           "SELECT planner_key, label, name, version, file_digest, parameters_json FROM planners "
           "ORDER BY planner_key",
       .text_count = 6,
       .number_count = 0},
      {.name = "map",
       .sql = "SELECT map_key, generator, world_digest, obstacle_count, triangle_count, "
              "traversability, "
              "traversability_normalized_ratio, relative_gap_size, obstacle_density_1pm2, "
              "free_volume_ratio FROM maps ORDER BY map_key",
       .text_count = 3,
       .number_count = 7},
      {.name = "mission",
       .sql = "SELECT map_key, invalid_reason, mission_index, is_valid, start_x_m, start_y_m, "
              "start_z_m, "
              "goal_x_m, goal_y_m, goal_z_m, start_yaw_rad, reference_length_m, "
              "traversability_obstruction, view_occlusion, angle_over_length_1pm FROM missions "
              "ORDER BY map_key, mission_index",
       .text_count = 2,
       .number_count = 13},
      trial_listing(db),
      {.name = "event",
       .sql =
           "SELECT trial_key, kind, obstacle_kind, event_index, time_s, speed_mps, obstacle_index "
           "FROM events ORDER BY trial_key, event_index",
       .text_count = 3,
       .number_count = 4},
      {.name = "sweep_trial",
       .sql = "SELECT DISTINCT sweep, trial_key FROM sweep_trials ORDER BY sweep, trial_key",
       .text_count = 2,
       .number_count = 0}};

  std::string rows;
  for (const Listing& listing : listings) {
    Statement statement(db.handle(), db.path(), listing.sql);
    while (statement.step()) {
      rows += listing.name;
      for (int i = 0; i < listing.text_count; ++i) rows += '\t' + escaped(statement.free_text(i));
      for (int i = 0; i < listing.number_count; ++i) {
        rows += '\t' + shortest(statement.real(listing.text_count + i));
      }
      rows += '\n';
    }
  }
  return rows;
}

}  // namespace avoidbench::test
