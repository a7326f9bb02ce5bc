-- Views for people, made anew whenever the program opens the file for writing or adds a sweep. A name in braces stands
-- for columns: those of metric_definitions, and one for each thing that the file's sweeps vary.
CREATE VIEW trial_table AS
  -- One row a trial, sweep and revision, flat: for pandas, DuckDB, R or a spreadsheet. A trial of two revisions is there
  -- twice; latest_trials has it once. What a sweep varies is a column called by its path: "wind.gust.amplitude_mps".
  SELECT s.sweep, s.revision, p.label AS planner, m.generator, m.map_seed{axes},
         m.traversability, m.traversability_normalized_ratio, m.relative_gap_size,
         -- A map from a file is no field of obstacles.
         CASE WHEN m.generator IN ('mesh', 'point_cloud') THEN NULL ELSE m.obstacle_density_1pm2 END
           AS obstacle_density_1pm2,
         t.mission_index, i.start_x_m, i.start_y_m, i.start_z_m, i.goal_x_m, i.goal_y_m, i.goal_z_m,
         i.reference_length_m, i.traversability_obstruction, i.view_occlusion, i.angle_over_length_1pm,
         t.outcome, t.outcome = 'reached_goal' AS is_finished, t.reason,
         (SELECT e.cause FROM explanations e WHERE e.trial_key = t.trial_key) AS cause,  -- NULL where it is not told
         t.end_time_s{metrics},
         p.name AS planner_name, p.version AS planner_version, p.is_privileged, r.program_version, r.git_hash,
         t.attempt, t.map_key, t.planner_key,
         t.rowid AS trial_id,  -- for people: of this file, as long as it is not rebuilt
         t.trial_key
  FROM sweep_trials s
  JOIN trials t USING (trial_key)
  JOIN planners p USING (planner_key)
  JOIN maps m ON m.map_key = t.map_key
  JOIN missions i ON i.map_key = t.map_key AND i.mission_index = t.mission_index
  JOIN runs r USING (run_id);

CREATE VIEW latest_trials AS
  -- trial_table without former revisions: one row a trial of each sweep as it was flown last. Where several sweeps of a file
  -- share trials, choose one by sweep.
  SELECT t.* FROM trial_table t
  JOIN (SELECT sweep, max(revision) AS revision FROM sweeps GROUP BY sweep) USING (sweep, revision);

CREATE VIEW planner_summary AS
  -- One row a planner and sweep: rates over all trials, means over the trials each metric speaks of.
  SELECT s.sweep, s.revision, p.label AS planner, count(*) AS trial_count,
         sum(t.outcome = 'reached_goal') AS finished_count,
         avg(t.outcome = 'reached_goal') AS success_rate{metric_means},
         t.planner_key
  FROM sweep_trials s
  JOIN trials t USING (trial_key)
  JOIN planners p USING (planner_key)
  GROUP BY s.sweep, s.revision, t.planner_key
  ORDER BY s.sweep, s.revision, p.label;

CREATE VIEW map_summary AS
  -- One row a map: its environment metrics, missions, and how all planners together fared.
  SELECT m.generator, m.map_seed, m.obstacle_count, m.triangle_count, m.traversability,
         m.traversability_normalized_ratio, m.relative_gap_size,
         CASE WHEN m.generator IN ('mesh', 'point_cloud') THEN NULL ELSE m.obstacle_density_1pm2 END
           AS obstacle_density_1pm2,
         m.free_volume_ratio,
         (SELECT count(*) FROM missions i WHERE i.map_key = m.map_key) AS mission_count,
         (SELECT count(*) FROM missions i WHERE i.map_key = m.map_key AND NOT i.is_valid) AS invalid_mission_count,
         count(t.trial_key) AS trial_count,
         coalesce(sum(t.outcome = 'reached_goal'), 0) AS finished_count,
         avg(t.outcome = 'reached_goal') AS success_rate,
         m.map_key
  FROM maps m
  LEFT JOIN trials t ON t.map_key = m.map_key
  GROUP BY m.map_key
  ORDER BY m.traversability_normalized_ratio, m.map_key;

CREATE VIEW plan_call_table AS
  -- One row a call of a planner. Times are seconds; cpu_time_s and wall_time_s were measured on the host.
  SELECT c.trial_key, j.key AS call_index,
         json_extract(j.value, '$[0]') AS time_s,
         json_extract(j.value, '$[1]') AS cpu_time_s,
         json_extract(j.value, '$[2]') AS wall_time_s,
         json_extract(j.value, '$[3]') AS status,
         json_extract(j.value, '$[4]') AS command_kind,
         json_extract(j.value, '$[5]') AS latency_s  -- NULL: as latency of the trial's spec_json says
  FROM plan_calls c, json_each(c.calls_json) j;
