-- Custom metrics in SQL: avoidbench report --metrics-from example.sql
-- Return a column named trial_key and one for each metric. You can read the views trial_table and plan_call_table and the
-- schema's tables. `-- NAME: description` describes a metric; with "less is better" or "more is better" in it, the report
-- marks the best.
-- detour_m: Way flown beyond the shortest, of finished trials [m]; less is better
-- slowest_call_ms: Longest call of the planner, by the clock on the wall [ms]; less is better
SELECT trial_key,
       CASE WHEN is_finished THEN path_length_m - reference_length_m END AS detour_m,  -- NULL: not defined
       (SELECT 1000 * max(wall_time_s) FROM plan_call_table c WHERE c.trial_key = t.trial_key) AS slowest_call_ms
FROM trial_table t
