"""Structs and constants of planner.h and process_protocol.h, written from them by python/generate_layouts.py. Fields as
name:type, with NumPy's names of types; a pointer is an offset in the segment (u8)."""

import numpy as np


def _struct(fields: str) -> np.dtype[np.void]:
    """Laid out as a C compiler does."""
    return np.dtype([(name, form) for name, form in (field.split(":") for field in fields.split())], align=True)


AVOIDBENCH_ABI_VERSION = 1
AB_OK = 0
AB_NO_PLAN = 1
AB_ERROR = -1
AB_GIVE_UP = 2
AB_INPUT_STATE = 1
AB_INPUT_DEPTH = 2
AB_INPUT_STEREO = 4
AB_INPUT_COLOR = 8
AB_INPUT_IMU = 16
AB_INPUT_WORLD = 32
AB_INPUT_STATES = 64
AB_INPUT_ONE_CAMERA = 128
AB_INPUT_REFERENCE = 4096
AB_INPUT_TRACKS = 16384
AB_INPUT_POINTS = 8192
AB_INPUT_GOALS = 32768
AB_INPUT_COMMAND = 65536
AB_USES_PROCESSES = 256
AB_USES_DEVICES = 512
AB_USES_NETWORK = 1024
AB_USES_GLOBALS = 2048
AB_COMMAND_POSITION = 1
AB_COMMAND_VELOCITY = 2
AB_COMMAND_ACCELERATION = 4
AB_COMMAND_TRAJECTORY = 8
AB_COMMAND_RATES = 16
AB_YAW_IS_RATE = 1
AB_LOG_INFO = 0
AB_LOG_WARNING = 1
AB_NUMBER = 0
AB_INTEGER = 1
AB_CHOICE = 2
AB_TEXT = 3
AB_TRACK_OTHER = 0
AB_TRACK_PERSON = 1
AB_TRACK_BOX = 2
AB_TRACK_BALL = 3
AB_TRACK_POLE = 4
AB_DEBUG_EXTENSION = "avoidbench.debug/1"
AB_DRAW_POINTS = 1
AB_DRAW_LINE = 2
AB_DRAW_SEGMENTS = 3
AB_DRAW_TEXT = 4
AB_FILES_EXTENSION = "avoidbench.files/1"
AB_CHECK_EXTENSION = "avoidbench.check/1"
AB_MAP_EXTENSION = "avoidbench.map/1"
AB_PLACE_UNKNOWN = 0
AB_PLACE_FREE = 1
AB_PLACE_OCCUPIED = 2
AB_WORLD_EXTENSION = "avoidbench.world/1"
AB_PROCESS_PROTOCOL = 1
AB_PROCESS_MAGIC = "avoidben"
AB_PROCESS_VARIABLE = "AVOIDBENCH_PLANNER_FDS"
AB_PROCESS_HELLO = 1
AB_PROCESS_CREATE = 2
AB_PROCESS_RESET = 3
AB_PROCESS_PLAN = 4
AB_PROCESS_DESTROY = 5

ab_host = _struct("struct_size:u4 abi_version:u4 context:u8 set_error:u8 log:u8 get_extension:u8")
ab_parameter = _struct(
    "struct_size:u4 kind:i4 name:u8 unit:u8 doc:u8 lowest:f8 highest:f8 preset:f8 choices:u8 preset_text:u8"
)
ab_value = _struct("struct_size:u4 reserved:u4 number:f8 text:u8")
ab_camera = _struct(
    "struct_size:u4 width_px:i4 height_px:i4 reserved:u4 fx_px:f8 fy_px:f8 cx_px:f8 cy_px:f8 position_body_m:3f8 "
    "q_body_camera:4f8 rate_hz:f8 min_range_m:f8 max_range_m:f8 baseline_m:f8"
)
ab_lidar = _struct(
    "struct_size:u4 is_deskewed:u4 position_body_m:3f8 q_body_lidar:4f8 rate_hz:f8 min_range_m:f8 max_range_m:f8 "
    "lowest_elevation_rad:f8 highest_elevation_rad:f8 shots:u4 reserved:u4"
)
ab_setup = _struct(
    "struct_size:u4 value_count:u4 values:u8 max_speed_mps:f8 max_acceleration_mps2:f8 max_yaw_rate_radps:f8 "
    "body_size_m:3f8 body_radius_m:f8 plan_period_s:f8 gravity_mps2:f8 depth_camera:u8 camera_count:u4 reserved:u4 "
    "cameras:u8 lidar_count:u4 reserved2:u4 lidars:u8"
)
ab_mission = _struct(
    "struct_size:u4 reserved:u4 seed:u8 start_world_m:3f8 start_yaw_rad:f8 goal_world_m:3f8 goal_radius_m:f8 "
    "time_limit_s:f8 lowest_world_m:3f8 highest_world_m:3f8 command_latency_s:f8 goal_count:u4 reserved2:u4 "
    "goals_world_m:u8"
)
ab_state = _struct(
    "struct_size:u4 reserved:u4 time_s:f8 position_world_m:3f8 velocity_world_mps:3f8 q_world_body:4f8 "
    "rates_body_radps:3f8"
)
ab_depth_image = _struct(
    "struct_size:u4 width_px:i4 height_px:i4 reserved:u4 time_s:f8 fx_px:f8 fy_px:f8 cx_px:f8 cy_px:f8 "
    "position_world_m:3f8 q_world_camera:4f8 depth_m:u8 camera:u4 reserved2:u4"
)
ab_picture = _struct(
    "struct_size:u4 width_px:i4 height_px:i4 channels:u4 camera:u4 reserved:u4 time_s:f8 fx_px:f8 fy_px:f8 cx_px:f8 "
    "cy_px:f8 position_world_m:3f8 q_world_camera:4f8 pixels:u8"
)
ab_stereo_pair = _struct("struct_size:u4 reserved:u4 baseline_m:f8 left:u8 right:u8")
ab_lidar_point = _struct("position_lidar_m:3f4 time_s:f4 intensity:f4")
ab_cloud = _struct(
    "struct_size:u4 lidar:u4 time_s:f8 position_world_m:3f8 q_world_lidar:4f8 point_count:u4 miss_count:u4 points:u8 "
    "misses_lidar:u8"
)
ab_imu_sample = _struct("time_s:f8 rates_body_radps:3f8 specific_force_body_mps2:3f8")
ab_point = _struct(
    "time_s:f8 position_world_m:3f8 velocity_world_mps:3f8 acceleration_world_mps2:3f8 jerk_world_mps3:3f8 yaw_rad:f8 "
    "yaw_rate_radps:f8"
)
ab_track = _struct("id:u4 kind:u4 time_s:f8 center_world_m:3f8 velocity_world_mps:3f8 size_m:3f8")
ab_command = _struct(
    "struct_size:u4 kind:u4 flags:u4 point_count:u4 position_world_m:3f8 velocity_world_mps:3f8 "
    "acceleration_world_mps2:3f8 yaw_rad:f8 yaw_rate_radps:f8 rates_body_radps:3f8 thrust_mps2:f8 points:u8 "
    "horizon_s:f8"
)
ab_observation = _struct(
    "struct_size:u4 depth_count:u4 state:u8 depth:u8 stereo_count:u4 color_count:u4 stereo:u8 color:u8 imu_count:u4 "
    "reserved:u4 imu:u8 time_s:f8 state_count:u4 reserved2:u4 states:u8 reference:u8 cloud_count:u4 reserved3:u4 "
    "clouds:u8 goal_index:u4 reserved4:u4 goal_world_m:3f8 track_count:u4 reserved5:u4 tracks:u8 wanted:u8"
)
ab_named_number = _struct("name:u8 number:f8")
ab_profile = _struct("struct_size:u4 number_count:u4 choice:u8 word:u8 numbers:u8")
ab_planner = _struct(
    "struct_size:u4 abi_version:u4 name:u8 version:u8 summary:u8 needs:u4 commands:u4 parameter_count:u4 reserved:u4 "
    "parameters:u8 create:u8 destroy:u8 reset:u8 plan:u8 get_extension:u8 profile_count:u4 reserved2:u4 profiles:u8 "
    "least_fov_x_rad:f8 least_fov_y_rad:f8"
)
ab_drawing = _struct("struct_size:u4 kind:u4 color_rgb:u4 point_count:u4 points_world_m:u8 size_px:f8 label:u8")
ab_debug = _struct("struct_size:u4 reserved:u4 context:u8 is_wanted:u8 draw:u8")
ab_files = _struct("struct_size:u4 file_count:u4 files:u8")
ab_check = _struct("struct_size:u4 reserved:u4 problem:u8")
ab_map = _struct("struct_size:u4 reserved:u4 look_up:u8")
ab_world = _struct("struct_size:u4 reserved:u4 context:u8 distances:u8 shortest_path:u8")
ab_process_header = _struct(
    "magic:S8 protocol:u4 abi_version:u4 segment_bytes:u8 answer_offset:u8 answer_bytes:u8 request_offset:u8 "
    "reserved:2u8"
)
ab_process_word = _struct("sequence:u4 kind:u4")
ab_process_request = _struct("sequence:u4 kind:u4 bytes:u8 body:u8 reserved:u8")
ab_process_answer = _struct("sequence:u4 kind:u4 status:i4 log_count:u4 bytes:u8 body:u8 error:u8 log:u8 reserved:2u8")
ab_process_log = _struct("level:i4 reserved:u4 text:u8")
ab_process_description = _struct("struct_size:u4 protocol:u4 planner:u8 files:u8")
