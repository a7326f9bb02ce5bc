-- The database of results: one file, read by anything that reads SQLite. Names carry their units, as in the sweep files
-- and the program; NULL is "not defined" (a metric of the finished trials, in a trial that failed). Start with the views
-- latest_trials, planner_summary, map_summary and plan_call_table of views.sql. A name
-- in braces stands for a REAL column for each row of metric_definitions.
PRAGMA application_id = 1635140206;  -- "avBn"
PRAGMA user_version = 1;             -- of this schema

CREATE TABLE runs (
  -- One row an invocation of `avoidbench run`: where trials come from. Nothing here is part of a result.
  run_id INTEGER PRIMARY KEY,
  started_at TEXT NOT NULL,       -- ISO 8601, UTC
  program_version TEXT NOT NULL,
  git_hash TEXT NOT NULL,
  compiler TEXT NOT NULL,
  flags TEXT NOT NULL,
  host TEXT NOT NULL,
  cpu TEXT NOT NULL,
  isa TEXT NOT NULL,
  command_line TEXT NOT NULL,
  shard TEXT NOT NULL DEFAULT '',  -- "2/3" where it flew the second third of its sweep only
  sandbox TEXT NOT NULL DEFAULT ''  -- what shut the planners in; '' where an older program flew it
) STRICT;

CREATE TABLE sweeps (
  -- One row a sweep. A changed sweep file under the same name is a new revision: its trials are not mixed with the
  -- former ones, and a trial that both ask for is flown once and belongs to both.
  sweep TEXT NOT NULL,            -- name in the sweep file
  revision INTEGER NOT NULL,      -- from 1
  spec_json TEXT NOT NULL,        -- everything resolved, defaults included
  PRIMARY KEY (sweep, revision)
) STRICT, WITHOUT ROWID;

CREATE TABLE planners (
  -- One row a planner as configured: another file or other parameters are another row.
  planner_key TEXT PRIMARY KEY,   -- SHA-256 of the columns below
  label TEXT NOT NULL,            -- name in reports
  name TEXT NOT NULL,             -- as the planner calls itself
  version TEXT NOT NULL,
  file_digest TEXT NOT NULL,      -- SHA-256 of the library; '' of real flights (`avoidbench import`)
  parameters_json TEXT NOT NULL,
  is_privileged INTEGER NOT NULL CHECK (is_privileged IN (0, 1))  -- 1: it sees the world itself
) STRICT, WITHOUT ROWID;

CREATE TABLE maps (
  -- One row a map as one body flies it, with its environment metrics (`avoidbench metrics` has the definitions).
  map_key TEXT PRIMARY KEY,
  generator TEXT NOT NULL,
  map_seed INTEGER NOT NULL,      -- 64 bits; seeds of 2^63 and more show as negative
  spec_json TEXT NOT NULL,        -- of the map: json_extract(spec_json, '$.poisson_radius_m')
  world_digest TEXT NOT NULL,     -- SHA-256 of the world's triangles and obstacles
  obstacle_count INTEGER NOT NULL,
  triangle_count INTEGER NOT NULL,
  traversability REAL,
  traversability_normalized_ratio REAL,  -- of an empty map of the same size; 1 is free
  relative_gap_size REAL,         -- NULL where obstacles are not a Poisson-disc field
  obstacle_density_1pm2 REAL,
  free_volume_ratio REAL
) STRICT, WITHOUT ROWID;

CREATE TABLE missions (
  -- One row a mission of a map: start, last goal and the length of the shortest way between them, through all goals of
  -- mission_legs. World frame, ENU, z up; NULL where the map has no free place for a start or goal.
  map_key TEXT NOT NULL REFERENCES maps,
  mission_index INTEGER NOT NULL,
  start_x_m REAL,
  start_y_m REAL,
  start_z_m REAL,
  goal_x_m REAL,
  goal_y_m REAL,
  goal_z_m REAL,
  start_yaw_rad REAL,
  reference_length_m REAL,        -- d_min: shortest collision-free path of the body; NULL where invalid
  traversability_obstruction REAL,  -- TO, VO and AOL of FlightBench along the reference path; NULL where invalid
  view_occlusion REAL,
  angle_over_length_1pm REAL,
  is_valid INTEGER NOT NULL CHECK (is_valid IN (0, 1)),  -- 0: can't be flown by anyone, never flown, never counted
  invalid_reason TEXT NOT NULL,
  PRIMARY KEY (map_key, mission_index)
) STRICT, WITHOUT ROWID;

CREATE TABLE mission_legs (
  -- One row a goal of missions that have several, in the order in which they are to be reached; the last is that in
  -- missions. Files of older programs lack this table.
  map_key TEXT NOT NULL,
  mission_index INTEGER NOT NULL,
  leg_index INTEGER NOT NULL,     -- from 0
  goal_x_m REAL NOT NULL,
  goal_y_m REAL NOT NULL,
  goal_z_m REAL NOT NULL,
  reference_length_m REAL,        -- of the shortest path to it from where that to the goal before it ends; NULL where invalid
  PRIMARY KEY (map_key, mission_index, leg_index),
  FOREIGN KEY (map_key, mission_index) REFERENCES missions
) STRICT, WITHOUT ROWID;

CREATE TABLE sweep_missions (
  -- The missions that a sweep asks for, those that turned out invalid included.
  sweep TEXT NOT NULL,
  revision INTEGER NOT NULL,
  map_key TEXT NOT NULL,
  mission_index INTEGER NOT NULL,
  PRIMARY KEY (sweep, revision, map_key, mission_index),
  FOREIGN KEY (sweep, revision) REFERENCES sweeps,
  FOREIGN KEY (map_key, mission_index) REFERENCES missions
) STRICT, WITHOUT ROWID;

CREATE TABLE metric_definitions (
  -- One row a metric: a column of the same name in the table trials. A changed definition has another version; values
  -- of two versions are never in one database.
  name TEXT PRIMARY KEY,
  position INTEGER NOT NULL,      -- order in reports
  version INTEGER NOT NULL,
  unit TEXT NOT NULL,
  doc TEXT NOT NULL,
  formula TEXT NOT NULL,
  source TEXT NOT NULL,
  better TEXT NOT NULL CHECK (better IN ('less', 'more', 'neither')),
  population TEXT NOT NULL CHECK (population IN ('all', 'finished')),  -- trials it speaks of; NULL for the others
  is_measured INTEGER NOT NULL CHECK (is_measured IN (0, 1))  -- 1: from the host's clock, differs from run to run
) STRICT, WITHOUT ROWID;

CREATE TABLE trials (
  -- One row a finished trial, failed ones too. Its metrics are those of metric_definitions.
  trial_key TEXT PRIMARY KEY,     -- SHA-256 of spec_json (without paths) and of the program's result version
  map_key TEXT NOT NULL,
  mission_index INTEGER NOT NULL,
  planner_key TEXT NOT NULL REFERENCES planners,
  outcome TEXT NOT NULL,          -- reached_goal, collided, left_bounds, timed_out, planner_gave_up, planner_error,
                                  -- planner_crashed or planner_hung
  reason TEXT NOT NULL,           -- one line for people
  end_time_s REAL,                -- simulated
  attempt INTEGER NOT NULL,       -- 1, and one more each time it was flown anew; the last one is kept
  run_id INTEGER NOT NULL REFERENCES runs,
  wall_time_s REAL,               -- it took on the host; NULL where a worker died
  flight_digest TEXT,             -- SHA-256 of the counts and digests in trajectories and plan_calls and of all events
  row_digest TEXT,                -- SHA-256 of the columns that have a value, with their names; without attempt and
                                  -- run_id
{metrics}  spec_json TEXT NOT NULL,        -- all that determines the trial: enough to fly it again. Last, since it is long
                                  -- and most readers want what stands before it
  FOREIGN KEY (map_key, mission_index) REFERENCES missions
) STRICT;

CREATE TABLE sweep_trials (
  -- Which finished trials belong to a sweep: a sweep takes over the trials of another one that it asks for too.
  sweep TEXT NOT NULL,
  revision INTEGER NOT NULL,
  trial_key TEXT NOT NULL REFERENCES trials,
  PRIMARY KEY (sweep, revision, trial_key),
  FOREIGN KEY (sweep, revision) REFERENCES sweeps
) STRICT, WITHOUT ROWID;

CREATE TABLE trajectories (
  -- The flown path of a trial: sample_count samples of 22 little-endian 64-bit floats: time_s; position_world x y z, m;
  -- velocity_world x y z, m/s; acceleration_world x y z, m/s²; q_world_body w x y z; rates_body x y z, rad/s;
  -- reference_world x y z, m (NaN: no commanded position); clearance_m; rotor_power_w.
  -- Stored number by number, of each the eight bytes of all samples apart, lowest first, and packed by zlib. In Python:
  --   planes = numpy.frombuffer(zlib.decompress(samples), 'u1').reshape(22, 8, sample_count)
  --   samples = planes.transpose(2, 0, 1).copy().view('<f8')[..., 0]
  -- `avoidbench export trajectory` writes them as CSV or for evaluation tools (TUM).
  trial_key TEXT PRIMARY KEY REFERENCES trials,
  sample_count INTEGER NOT NULL,
  samples_digest TEXT NOT NULL,   -- SHA-256 of the samples, one after the other: equal flights have equal digests
  samples BLOB NOT NULL
) STRICT;

CREATE TABLE plan_calls (
  -- The planner's calls in a trial, as one JSON array a trial since there are thousands: [[time_s, cpu_time_s,
  -- wall_time_s, status, command_kind], …]; where latency is measured or replayed, each with a sixth number latency_s,
  -- after which the command took effect. The view plan_call_table has one row a call.
  trial_key TEXT PRIMARY KEY REFERENCES trials,
  call_count INTEGER NOT NULL,
  calls_digest TEXT NOT NULL,     -- SHA-256 of time, status and command kind: what does not differ from run to run
  calls_json TEXT NOT NULL
) STRICT;

CREATE TABLE events (
  -- What happened in a trial beside its end: each touch with a surface.
  trial_key TEXT NOT NULL REFERENCES trials,
  event_index INTEGER NOT NULL,   -- from 0, in order of time
  kind TEXT NOT NULL CHECK (kind IN ('collision')),
  time_s REAL NOT NULL,           -- simulated
  speed_mps REAL,
  obstacle_index INTEGER NOT NULL,  -- of the world's obstacles; -1 for ground, walls and what is no obstacle
  obstacle_kind TEXT NOT NULL,
  PRIMARY KEY (trial_key, event_index)
) STRICT, WITHOUT ROWID;

CREATE TABLE what_ifs (
  -- One row a trial flown again with one thing changed (`avoidbench explain DB --what-if`). The flight itself is not kept:
  -- it is the same whenever it is flown.
  trial_key TEXT NOT NULL REFERENCES trials,  -- of the trial as it was
  change TEXT NOT NULL,           -- what was changed: true_depth, no_wind, …
  outcome TEXT NOT NULL,          -- as in trials
  reason TEXT NOT NULL,           -- one line for people
  end_time_s REAL,                -- simulated
  program_version TEXT NOT NULL,  -- `version git_hash` of what flew it
  planner_digest TEXT NOT NULL,   -- SHA-256 of the planner that flew it
  record_digest TEXT NOT NULL,    -- SHA-256 of the flight: outcome, samples, calls, touches
  row_digest TEXT NOT NULL,       -- SHA-256 of the columns above that have a value, with their names
  PRIMARY KEY (trial_key, change)
) STRICT, WITHOUT ROWID;

CREATE TABLE explanations (
  -- One row a failed trial of which `avoidbench explain` has told the cause.
  trial_key TEXT PRIMARY KEY REFERENCES trials,
  cause TEXT NOT NULL,            -- moved_into, tracking, out_of_view, …: docs/explain.md
  facts_json TEXT NOT NULL,       -- what was measured, by name: {"contact_s": 3.21, …}
  rules_version INTEGER NOT NULL, -- of the rules: an explanation by older ones is told anew
  record_digest TEXT NOT NULL,    -- SHA-256 of the flight it is of: outcome, samples, calls, touches
  row_digest TEXT NOT NULL        -- SHA-256 of the columns above, with their names
) STRICT, WITHOUT ROWID;

CREATE INDEX trials_by_mission ON trials (map_key, mission_index);
CREATE INDEX sweep_trials_by_trial ON sweep_trials (trial_key);
