-- Metrics of one's own, by SQL: avoidbench report --metrics-from example.sql
-- A column named trial_key, and one for each metric. The views trial_table and plan_call_table and the tables of the schema
-- can be read. `-- NAME: description` says what a metric is; "less is better" or "more is better" in it lets the report mark
-- the best.
-- detour_m: Way flown beyond the shortest, of finished trials [m]; less is better
-- slowest_call_ms: Longest call of the planner, by the clock on the wall [ms]; less is better
SELECT trial_key,
       CASE WHEN is_finished THEN path_length_m - reference_length_m END AS detour_m,  -- NULL: not defined
       (SELECT 1000 * max(wall_time_s) FROM plan_call_table c WHERE c.trial_key = t.trial_key) AS slowest_call_ms
FROM trial_table t
