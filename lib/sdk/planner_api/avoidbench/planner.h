/* The interface between avoidbench and a planner in a shared library, version 1. C99; needs only
 * <stdint.h>.
 *
 * SPDX-License-Identifier: MIT
 * Planners under any licence, including closed ones, may use this header and link with it.
 *
 * A planner's library exports one symbol, avoidbench_planner_v1, and nothing else of avoidbench. In
 * C++, write a plain class and let planner.hpp make the table; in C, fill an ab_planner yourself.
 *
 * Rules
 *   Units are SI; angles are radians. World frame: ENU, z up. Body frame: FLU, x forward. Camera
 * frame: RDF, z forward. Lidar frame: FLU. A quaternion q_a_b is (w, x, y, z) and takes coordinates
 * in b to coordinates in a. T_a_b likewise. Every struct begins with struct_size, set by the side
 * that fills it; the reader reads no further than that. The side that allocates memory frees it. A
 * pointer passed into a call is valid until that call returns. The host copies what plan() returns
 * by pointer immediately, but it must stay valid until the next call on that instance. No exception
 * may leave a call. A call that fails returns AB_ERROR after host->set_error(...). Several threads
 * may call different instances at the same time, but only one thread at a time calls an instance.
 * Use randomness only from ab_mission.seed and time only from the observation: after reset(), equal
 * inputs must give equal outputs.
 */
#ifndef AVOIDBENCH_PLANNER_H
#define AVOIDBENCH_PLANNER_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#define AVOIDBENCH_ABI_VERSION 1u

#if defined(_WIN32)
#define AB_EXPORT __declspec(dllexport)
#else
#define AB_EXPORT __attribute__((visibility("default")))
#endif

typedef int32_t ab_status;
#define AB_OK 0       /* a command was given */
#define AB_NO_PLAN 1  /* no command now: the host brakes and hovers, counts it, and asks again */
#define AB_ERROR (-1) /* the trial ends with planner_error and the text given to set_error */
/* The planner knows that it can't reach the goal: the trial ends with planner_gave_up. */
#define AB_GIVE_UP 2

/* ab_planner.needs: what the planner wants to see. */
#define AB_INPUT_STATE 1u
#define AB_INPUT_DEPTH 2u
#define AB_INPUT_STEREO 4u /* left and right, grey, 8 bits */
#define AB_INPUT_COLOR 8u  /* left, RGB, 8 bits */
#define AB_INPUT_IMU 16u
#define AB_INPUT_WORLD 32u  /* privileged: AB_WORLD_EXTENSION; marked in every table */
#define AB_INPUT_STATES 64u /* all states since the last call, not only the newest */
/* Only one camera of a rig: ab_setup.camera_count is 1. A sweep whose sensor has several cameras
 * names one (`camera: 0` in the planner's entry), or is refused before its first trial. */
#define AB_INPUT_ONE_CAMERA 128u
#define AB_INPUT_REFERENCE 4096u /* the last commanded state: where the vehicle should be */
#define AB_INPUT_TRACKS 16384u   /* moving objects, as a detector with a tracker reports them */
/* The points of lidars' sweeps. A planner that also declares images flies with either sensor. */
#define AB_INPUT_POINTS 8192u
/* The goal to reach now: missions may have several, in order, and the last one may move. A sweep
 * with such missions is refused before its first trial if a planner does not declare this. */
#define AB_INPUT_GOALS 32768u
/* The command of the planner below, if there is one. A planner that declares this is a filter: see
 * ab_observation.wanted. */
#define AB_INPUT_COMMAND 65536u
/* Also ab_planner.needs: what it does apart from computing and reading files. Planners fly in a
 * sandbox that refuses everything else; without these flags fork() and socket() fail. Writing to
 * files always fails. */
#define AB_USES_PROCESSES 256u /* starts programs and signals them */
#define AB_USES_DEVICES 512u   /* opens devices, as GPU drivers do, and writes to /dev/shm */
#define AB_USES_NETWORK 1024u  /* opens sockets */
/* It keeps state in global variables, like programs that were written to run once: a new process
 * flies each trial, in which one instance is made and reset once. */
#define AB_USES_GLOBALS 2048u

/* ab_planner.commands: what the planner may return, and ab_command.kind: what it did return. */
#define AB_COMMAND_POSITION 1u     /* position_world_m, yaw */
#define AB_COMMAND_VELOCITY 2u     /* velocity_world_mps, yaw or yaw rate */
#define AB_COMMAND_ACCELERATION 4u /* acceleration_world_mps2, yaw or yaw rate */
#define AB_COMMAND_TRAJECTORY 8u   /* points[0 .. point_count): at least 2, times rising from 0 */
#define AB_COMMAND_RATES 16u       /* rates_body_radps, thrust_mps2 */

/* ab_command.flags */
#define AB_YAW_IS_RATE 1u /* use yaw_rate_radps, not yaw_rad */

/* ab_host.log */
#define AB_LOG_INFO 0
#define AB_LOG_WARNING 1

/* ab_parameter.kind */
#define AB_NUMBER 0  /* a double in [lowest, highest] */
#define AB_INTEGER 1 /* a whole number in [lowest, highest] */
#define AB_CHOICE 2  /* one word of `choices`, which are separated by '|' */
#define AB_TEXT 3    /* any text, e.g. a path */

/* What the host offers to one instance. Valid from create() until destroy(). */
typedef struct ab_host {
  uint32_t struct_size;
  uint32_t abi_version;
  void* context; /* first argument of the functions below */
  void (*set_error)(void* context, const char* text);
  /* A line of the log. Threads that the planner has started may call it, too. */
  void (*log)(void* context, int32_t level, const char* text);
  /* A further table by its name and version, e.g. AB_DEBUG_EXTENSION; null if this host does not
   * have it. */
  const void* (*get_extension)(void* context, const char* id);
} ab_host;

/* One parameter, declared up front so that a typo in a sweep file is found before the first trial.
 */
typedef struct ab_parameter {
  uint32_t struct_size;
  int32_t kind;
  const char* name; /* with its unit, as in YAML: "cruise_speed_mps" */
  const char* unit; /* "m/s"; "" for none */
  const char* doc;
  double lowest, highest, preset; /* numbers and integers */
  const char* choices;            /* AB_CHOICE: "safe|fast" */
  const char* preset_text;        /* AB_CHOICE and AB_TEXT */
} ab_parameter;

typedef struct ab_value {
  uint32_t struct_size;
  uint32_t reserved;
  double number;    /* AB_NUMBER, AB_INTEGER */
  const char* text; /* AB_CHOICE, AB_TEXT; else null */
} ab_value;

/* A camera: pinhole without distortion, pixel centres at whole coordinates. For a stereo camera,
 * the left eye; the right one is the same, baseline_m further along camera x. */
typedef struct ab_camera {
  uint32_t struct_size;
  int32_t width_px, height_px;
  uint32_t reserved;
  double fx_px, fy_px, cx_px, cy_px;
  double position_body_m[3]; /* of the camera's centre */
  double q_body_camera[4];
  double rate_hz;
  double min_range_m, max_range_m; /* depth beyond is +inf, nearer is NaN */
  double baseline_m;
} ab_camera;

/* A lidar: beams that sweep about its z axis. Its frame is FLU. */
typedef struct ab_lidar {
  uint32_t struct_size;
  uint32_t is_deskewed; /* 1: points are as seen from where the lidar is at the sweep's end,
                           by the odometry; 0: each as seen from where it was at the point's time */
  double position_body_m[3];
  double q_body_lidar[4];
  double rate_hz; /* of sweeps */
  double min_range_m, max_range_m;
  double lowest_elevation_rad, highest_elevation_rad; /* of its beams, above its xy plane */
  uint32_t shots; /* per sweep, including those without a return */
  uint32_t reserved;
} ab_lidar;

/* What one instance is made for. */
typedef struct ab_setup {
  uint32_t struct_size;
  uint32_t value_count;          /* as many as the planner declared, in the same order */
  const ab_value* const* values; /* value_count pointers */
  double max_speed_mps, max_acceleration_mps2, max_yaw_rate_radps;
  double body_size_m[3]; /* box, body FLU, centred */
  double body_radius_m;  /* of the ball around the box */
  double plan_period_s;
  double gravity_mps2;
  const ab_camera* depth_camera; /* cameras[0]; null if the planner sees no images */
  uint32_t camera_count;         /* 1, or more for a rig; 0 if the sensor is a lidar */
  uint32_t reserved;
  const ab_camera* const* cameras; /* camera_count pointers */
  /* Added later: older hosts end before this. */
  uint32_t lidar_count, reserved2; /* 0 unless AB_INPUT_POINTS is declared */
  const ab_lidar* const* lidars;   /* lidar_count pointers */
} ab_setup;

typedef struct ab_mission {
  uint32_t struct_size;
  uint32_t reserved;
  uint64_t seed;
  double start_world_m[3];
  double start_yaw_rad;
  double goal_world_m[3];
  double goal_radius_m; /* the goal is reached within this horizontal distance */
  double time_limit_s;
  /* Added later: older hosts end before this. */
  double lowest_world_m[3], highest_world_m[3]; /* the map's box, from ground to ceiling: the trial
                                                   ends when the vehicle's centre leaves it */
  double command_latency_s; /* from a call to when its command acts; NaN if it is measured: as long
                               as the call takes */
  /* Added later: older hosts end before this. All goals, to be reached in this order; the first is
   * goal_world_m, and the trial ends at the last. A moving goal is at its place at the start. */
  uint32_t goal_count, reserved2;
  const double* goals_world_m; /* 3 numbers a goal */
} ab_mission;

typedef struct ab_state {
  uint32_t struct_size;
  uint32_t reserved;
  double time_s; /* since the start of the trial; in the past if the odometry has a delay */
  double position_world_m[3];
  double velocity_world_mps[3];
  double q_world_body[4];
  double rates_body_radps[3];
} ab_state;

typedef struct ab_depth_image {
  uint32_t struct_size;
  int32_t width_px, height_px;
  uint32_t reserved;
  double time_s; /* of exposure */
  double fx_px, fy_px, cx_px, cy_px;
  double position_world_m[3]; /* of the camera, at exposure */
  double q_world_camera[4];
  const float*
      depth_m;     /* height x width, row-major, along camera z; +inf: no return; NaN: invalid */
  uint32_t camera; /* index into ab_setup.cameras */
  uint32_t reserved2;
} ab_depth_image;

/* An 8-bit picture, sRGB encoded. */
typedef struct ab_picture {
  uint32_t struct_size;
  int32_t width_px, height_px;
  uint32_t channels; /* 1: grey; 3: red, green, blue */
  uint32_t camera;   /* index into ab_setup.cameras */
  uint32_t reserved;
  double time_s; /* the middle of the exposure */
  double fx_px, fy_px, cx_px, cy_px;
  double position_world_m[3]; /* of this eye, at that time */
  double q_world_camera[4];
  const uint8_t* pixels; /* height x width x channels, row-major */
} ab_picture;

/* Two grey pictures of one moment, rectified: what the left eye sees in column x, the right one
 * sees in column x - fx * baseline_m / depth of the same row. */
typedef struct ab_stereo_pair {
  uint32_t struct_size;
  uint32_t reserved;
  double baseline_m;
  const ab_picture* left;
  const ab_picture* right;
} ab_stereo_pair;

/* The hit of a lidar's shot. Points lie in an array, so this struct never grows within ABI 1. */
typedef struct ab_lidar_point {
  float position_lidar_m[3];
  float time_s;    /* of the shot, after the sweep's end: at most 0 */
  float intensity; /* reflectance times the cosine of incidence, 0 to 1 */
} ab_lidar_point;

/* A sweep of a lidar. */
typedef struct ab_cloud {
  uint32_t struct_size;
  uint32_t lidar;             /* index into ab_setup.lidars */
  double time_s;              /* of the sweep's end */
  double position_world_m[3]; /* of the lidar, at that time */
  double q_world_lidar[4];
  uint32_t point_count, miss_count;
  const ab_lidar_point* points; /* in the order of the shots */
  const float* misses_lidar;    /* unit directions, 3 numbers each, of shots without a return:
                                   nothing is there, or it is too far, too dark or too flat */
} ab_cloud;

/* Samples lie in an array, so this struct never grows within ABI 1. */
typedef struct ab_imu_sample {
  double time_s;
  double rates_body_radps[3];
  double specific_force_body_mps2[3]; /* acceleration less gravity: (0, 0, 9.81) at rest */
} ab_imu_sample;

/* Points lie in an array, so this struct never grows within ABI 1. */
typedef struct ab_point {
  double time_s; /* after the moment at which the command takes effect; the first is 0 */
  double position_world_m[3];
  double velocity_world_mps[3];
  double acceleration_world_mps2[3];
  double jerk_world_mps3[3];
  double yaw_rad;
  double yaw_rate_radps;
} ab_point;

/* ab_track.kind */
#define AB_TRACK_OTHER 0u
#define AB_TRACK_PERSON 1u
#define AB_TRACK_BOX 2u
#define AB_TRACK_BALL 3u
#define AB_TRACK_POLE 4u

/* Something that moves. Tracks lie in an array, so this struct never grows within ABI 1. */
typedef struct ab_track {
  uint32_t id; /* an object keeps its id in all observations of a trial */
  uint32_t kind;
  double time_s; /* of the scan: place and velocity are those of this moment */
  double center_world_m[3];
  double velocity_world_mps[3];
  double size_m[3]; /* of its box in its own frame, z up */
} ab_track;

/* Numbers are finite; lengths, speeds and so on are at most 1e6, yaws at most 1e5 in size. Anything
 * else is an error of the planner. */
typedef struct ab_command {
  uint32_t struct_size;
  uint32_t kind;
  uint32_t flags;
  uint32_t point_count;
  double position_world_m[3];
  double velocity_world_mps[3];
  double acceleration_world_mps2[3];
  double yaw_rad;
  double yaw_rate_radps;
  double rates_body_radps[3];
  double thrust_mps2; /* collective, mass-normalised: 9.81 hovers */
  const ab_point* points;
  double horizon_s; /* how long the planner considers this command safe; then the host brakes;
                       0: forever */
} ab_command;

typedef struct ab_observation {
  uint32_t struct_size;
  uint32_t depth_count;  /* images since the last call, newest first; 0 if there is no new one */
  const ab_state* state; /* always there */
  const ab_depth_image* const*
      depth; /* depth_count pointers; none unless AB_INPUT_DEPTH is declared */
  /* As depth: newest first, since the last call, none unless declared. */
  uint32_t stereo_count, color_count;
  const ab_stereo_pair* const* stereo; /* AB_INPUT_STEREO */
  const ab_picture* const* color;      /* AB_INPUT_COLOR */
  uint32_t imu_count;
  uint32_t reserved;
  const ab_imu_sample* imu; /* AB_INPUT_IMU; imu_count samples, oldest first */
  /* Added later: older hosts end before this. */
  double time_s; /* of this call; state->time_s is older if the odometry has a delay */
  uint32_t state_count, reserved2;
  const ab_state* const* states; /* AB_INPUT_STATES: since the last call, at the IMU's rate, oldest
                                    first; state_count pointers */
  /* Added later: older hosts end before this. AB_INPUT_REFERENCE: where the vehicle should be at
   * this call by the commands so far, which is where a smooth trajectory begins; relative to the
   * odometry's estimate. time_s is that of this call. Null while rates are commanded. */
  const ab_point* reference;
  /* Added later: older hosts end before this. AB_INPUT_POINTS: sweeps that ended since the last
   * call, newest first; cloud_count pointers. */
  uint32_t cloud_count, reserved3;
  const ab_cloud* const* clouds;
  /* Added later: older hosts end before this. AB_INPUT_GOALS: the goal to reach now, an index into
   * ab_mission.goals_world_m, and where it is at this call. Zeros unless declared. */
  uint32_t goal_index, reserved4;
  double goal_world_m[3];
  /* Added later: older hosts end before this. AB_INPUT_TRACKS: the complete newest scan, at each
   * call; track_count tracks in no meaningful order, in the world frame of the odometry's
   * estimate. */
  uint32_t track_count, reserved5;
  const ab_track* tracks;
  /* Added later: older hosts end before this. AB_INPUT_COMMAND, for a filter, which a sweep names
   * together with a planner: the planner's command for the same observation; null if the planner
   * has no plan. The vehicle gets the filter's answer, under the same rules as any planner's. To
   * let the command pass, return a copy of it, which may use the same points. AB_NO_PLAN brakes
   * regardless of the planner's command. The kind is one of ab_planner.commands: for a filter,
   * these are both the kinds that it accepts and those that it returns, and a planner with other
   * kinds is refused before the first trial. */
  const ab_command* wanted;
} ab_observation;

/* Numbers lie in an array, so this struct never grows within ABI 1. */
typedef struct ab_named_number {
  const char* name; /* a parameter of kind AB_NUMBER or AB_INTEGER */
  double number;    /* within its range */
} ab_named_number;

/* Another set of defaults, such as that of a planner's authors: while the parameter `choice` has
 * the word `word`, the parameters named here default to these numbers. The host puts them into
 * ab_setup.values; the planner need not check `choice` for them. */
typedef struct ab_profile {
  uint32_t struct_size;
  uint32_t number_count;
  const char* choice; /* a parameter of kind AB_CHOICE: "preset" */
  const char* word;   /* one of its words: "published" */
  const ab_named_number* numbers;
} ab_profile;

/* The planner's table. Instances are opaque. */
typedef struct ab_planner {
  uint32_t struct_size;
  uint32_t abi_version;
  const char* name; /* [a-z0-9_]+ */
  const char* version;
  const char* summary; /* one line */
  uint32_t needs, commands;
  uint32_t parameter_count, reserved;
  const ab_parameter* const* parameters; /* parameter_count pointers */
  /* A new instance, or null after set_error. The host table outlives the instance. */
  void* (*create)(const ab_host* host, const ab_setup* setup);
  void (*destroy)(void* instance);
  /* Begins a trial: forget all earlier ones. */
  ab_status (*reset)(void* instance, const ab_mission* mission);
  /* One command for what is seen now. command->struct_size is set and the rest zero on entry. */
  ab_status (*plan)(void* instance, const ab_observation* observation, ab_command* command);
  /* A further table of the planner by its name and version, e.g. AB_FILES_EXTENSION, or null. May
   * be null itself. */
  const void* (*get_extension)(void* instance, const char* id);
  /* Added later: older hosts and planners end before this. */
  uint32_t profile_count, reserved2;
  const ab_profile* const* profiles; /* profile_count pointers; at most one for each word */
  /* Added later: older hosts and planners end before this. The angles that each camera's pixels
   * must cover, from edge to edge; a sweep with a narrower camera is refused before its first
   * trial. 0: any. */
  double least_fov_x_rad, least_fov_y_rad;
} ab_planner;

/* ---------------------------------------------------------------------------------------------
 * Extension "avoidbench.debug/1": drawings that help to find out why a flight failed. Get it by
 * host->get_extension(host->context, AB_DEBUG_EXTENSION), which returns an ab_debug, or null if the
 * host has none; valid as long as the host's own table. A drawing is shown from the plan() that
 * drew it until the next one; drawings of reset() are shown with the first plan(). Commands must
 * not depend on whether drawings are shown. */
#define AB_DEBUG_EXTENSION "avoidbench.debug/1"

/* ab_drawing.kind */
#define AB_DRAW_POINTS 1u   /* dots */
#define AB_DRAW_LINE 2u     /* a polyline through all points, not closed */
#define AB_DRAW_SEGMENTS 3u /* a line from each point of even index to the next one */
#define AB_DRAW_TEXT 4u     /* `label` next to the first point */

typedef struct ab_drawing {
  uint32_t struct_size;
  uint32_t kind;
  uint32_t color_rgb; /* 0xRRGGBB */
  uint32_t point_count;
  const double* points_world_m; /* 3 numbers a point */
  double size_px; /* diameter of dots, width of lines, in pixels of the picture; 0: the default */
  const char* label; /* its name in the legend: "obstacles"; may be null */
} ab_drawing;

typedef struct ab_debug {
  uint32_t struct_size;
  uint32_t reserved;
  void* context; /* first argument of the functions below */
  /* 1 if drawings are shown, else 0: do work that only serves drawings only then. Always 0 in
   * sweeps. May change between calls, not within one. */
  int32_t (*is_wanted)(void* context);
  /* The host copies the drawing immediately; does nothing if drawings are not shown. Points that
   * are not finite are left out (for segments, with their partner). Up to 200000 points of one
   * plan() are kept; more are dropped with a note in the log. Call it only during a call of the
   * planner and in the thread of that call. */
  void (*draw)(void* context, const ab_drawing* drawing);
} ab_debug;

/* ---------------------------------------------------------------------------------------------
 * Extension "avoidbench.files/1": further files that decide what the planner does: weights,
 * configurations, scripts. The host gets it by get_extension(NULL, AB_FILES_EXTENSION), before
 * there is an instance; the planner returns an ab_files, valid as long as its table, or null. The
 * files' digests are part of the digest that identifies the planner in trials. If a file changes
 * while a sweep runs, the run ends. A planner that has get_extension must therefore accept a null
 * instance. */
#define AB_FILES_EXTENSION "avoidbench.files/1"

typedef struct ab_files {
  uint32_t struct_size;
  uint32_t file_count;
  const char* const* files; /* file_count paths of regular files, '/' between folders, relative to
                               the folder of the planner's own file, which is not one of them */
} ab_files;

/* ---------------------------------------------------------------------------------------------
 * Extension "avoidbench.check/1": whether the planner can fly at all as installed: whether its
 * weights are intact and its device is present. The host gets it by get_extension(NULL,
 * AB_CHECK_EXTENSION), before there is an instance; the planner returns an ab_check or null. The
 * host calls it once before the first trial, in a separate process and for some seconds at most: a
 * problem is an error of the sweep, not of each of its trials. Not for planners that are programs,
 * which refuse by ending with a message. */
#define AB_CHECK_EXTENSION "avoidbench.check/1"

typedef struct ab_check {
  uint32_t struct_size;
  uint32_t reserved;
  /* The problem, one line, valid until the next call; null if there is none. */
  const char* (*problem)(void);
} ab_check;

/* ---------------------------------------------------------------------------------------------
 * Extension "avoidbench.map/1": the planner's knowledge of the space around it, which `avoidbench
 * explain` uses to find out why a flight failed. The host gets it by get_extension(instance,
 * AB_MAP_EXTENSION); the planner returns an ab_map, valid as long as the instance, or null. It is
 * called between calls of reset() and plan() and in their thread, and must not change commands. */
#define AB_MAP_EXTENSION "avoidbench.map/1"

/* What the planner knows of a place. */
#define AB_PLACE_UNKNOWN 0u
#define AB_PLACE_FREE 1u     /* it has seen that nothing is there */
#define AB_PLACE_OCCUPIED 2u /* a surface is there; not just too near for the vehicle */

typedef struct ab_map {
  uint32_t struct_size;
  uint32_t reserved;
  /* One AB_PLACE_… for each of point_count places, 3 numbers each, all finite. AB_OK, or AB_ERROR
   * if it can't answer. */
  ab_status (*look_up)(void* instance, const double* points_world_m, uint32_t point_count,
                       uint8_t* places);
} ab_map;

/* ---------------------------------------------------------------------------------------------
 * Extension "avoidbench.world/1": the map itself, for planners that declare AB_INPUT_WORLD, which
 * every table marks. Get it by host->get_extension(host->context, AB_WORLD_EXTENSION), which
 * returns an ab_world, or null for other planners and for planners that are programs. Call it in
 * reset() and in plan(), in the thread of the call; it answers for the mission of that trial.
 * Moving obstacles are at their places at the start. */
#define AB_WORLD_EXTENSION "avoidbench.world/1"

typedef struct ab_world {
  uint32_t struct_size;
  uint32_t reserved;
  void* context; /* first argument of the functions below */
  /* The distance from each of point_count places, 3 numbers each, to the nearest surface, at most
   * 2.5 m. It is unsigned: a place inside an obstacle has one, too. AB_OK, or AB_ERROR if a place
   * is not finite or no trial has begun. */
  ab_status (*distances)(void* context, const double* points_world_m, uint32_t point_count,
                         double* distances_m);
  /* The shortest path of a ball of radius_m from the start to within goal_radius_m of the goal, a
   * polyline that grazes the obstacles. Its points, 3 numbers each, are valid until the next call
   * of this function. For the vehicle's own radius, its length is d_min of the metrics. AB_OK;
   * AB_NO_PLAN if the ball has no path; AB_ERROR if the radius is not above 0 or no trial has
   * begun. */
  ab_status (*shortest_path)(void* context, double radius_m, const double** points_world_m,
                             uint32_t* point_count);
} ab_world;

/* The one exported symbol. `host_api` is the host's AVOIDBENCH_ABI_VERSION; return null if the
 * planner does not support it. */
AB_EXPORT const ab_planner* avoidbench_planner_v1(uint32_t host_api);

#ifdef __cplusplus
}
#endif

#endif
