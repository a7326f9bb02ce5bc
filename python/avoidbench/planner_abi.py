"""The structs of avoidbench/planner.h for ctypes, and the table by which a class is flown as a planner."""

import ctypes as c
from typing import Any

AB_OK, AB_NO_PLAN, AB_ERROR, AB_GIVE_UP = 0, 1, -1, 2
SEES = {"state": 1, "depth": 2, "stereo": 4, "color": 8, "imu": 16, "states": 64, "one_camera": 128}
USES = {"processes": 256, "devices": 512, "network": 1024, "globals": 2048}
COMMANDS = {"position": 1, "velocity": 2, "acceleration": 4, "trajectory": 8, "rates": 16}
YAW_IS_RATE = 1
NUMBER, INTEGER, CHOICE, TEXT = 0, 1, 2, 3
ABI_VERSION = 1
FILES_EXTENSION = b"avoidbench.files/1"

Vector = c.c_double * 3
Quaternion = c.c_double * 4


class Host(c.Structure):
    _fields_ = [
        ("struct_size", c.c_uint32),
        ("abi_version", c.c_uint32),
        ("context", c.c_void_p),
        ("set_error", c.CFUNCTYPE(None, c.c_void_p, c.c_char_p)),
        ("log", c.CFUNCTYPE(None, c.c_void_p, c.c_int32, c.c_char_p)),
        ("get_extension", c.CFUNCTYPE(c.c_void_p, c.c_void_p, c.c_char_p)),
    ]


class ParameterStruct(c.Structure):
    _fields_ = [
        ("struct_size", c.c_uint32),
        ("kind", c.c_int32),
        ("name", c.c_char_p),
        ("unit", c.c_char_p),
        ("doc", c.c_char_p),
        ("lowest", c.c_double),
        ("highest", c.c_double),
        ("preset", c.c_double),
        ("choices", c.c_char_p),
        ("preset_text", c.c_char_p),
    ]


class Value(c.Structure):
    _fields_ = [("struct_size", c.c_uint32), ("reserved", c.c_uint32), ("number", c.c_double), ("text", c.c_char_p)]


class CameraStruct(c.Structure):
    _fields_ = [
        ("struct_size", c.c_uint32),
        ("width_px", c.c_int32),
        ("height_px", c.c_int32),
        ("reserved", c.c_uint32),
        ("fx_px", c.c_double),
        ("fy_px", c.c_double),
        ("cx_px", c.c_double),
        ("cy_px", c.c_double),
        ("position_body_m", Vector),
        ("q_body_camera", Quaternion),
        ("rate_hz", c.c_double),
        ("min_range_m", c.c_double),
        ("max_range_m", c.c_double),
        ("baseline_m", c.c_double),
    ]


class SetupStruct(c.Structure):
    _fields_ = [
        ("struct_size", c.c_uint32),
        ("value_count", c.c_uint32),
        ("values", c.POINTER(c.POINTER(Value))),
        ("max_speed_mps", c.c_double),
        ("max_acceleration_mps2", c.c_double),
        ("max_yaw_rate_radps", c.c_double),
        ("body_size_m", Vector),
        ("body_radius_m", c.c_double),
        ("plan_period_s", c.c_double),
        ("gravity_mps2", c.c_double),
        ("depth_camera", c.POINTER(CameraStruct)),
        ("camera_count", c.c_uint32),
        ("reserved", c.c_uint32),
        ("cameras", c.POINTER(c.POINTER(CameraStruct))),
    ]


class MissionStruct(c.Structure):
    _fields_ = [
        ("struct_size", c.c_uint32),
        ("reserved", c.c_uint32),
        ("seed", c.c_uint64),
        ("start_world_m", Vector),
        ("start_yaw_rad", c.c_double),
        ("goal_world_m", Vector),
        ("goal_radius_m", c.c_double),
        ("time_limit_s", c.c_double),
        ("lowest_world_m", Vector),
        ("highest_world_m", Vector),
        ("command_latency_s", c.c_double),
    ]


class StateStruct(c.Structure):
    _fields_ = [
        ("struct_size", c.c_uint32),
        ("reserved", c.c_uint32),
        ("time_s", c.c_double),
        ("position_world_m", Vector),
        ("velocity_world_mps", Vector),
        ("q_world_body", Quaternion),
        ("rates_body_radps", Vector),
    ]


class DepthStruct(c.Structure):
    _fields_ = [
        ("struct_size", c.c_uint32),
        ("width_px", c.c_int32),
        ("height_px", c.c_int32),
        ("reserved", c.c_uint32),
        ("time_s", c.c_double),
        ("fx_px", c.c_double),
        ("fy_px", c.c_double),
        ("cx_px", c.c_double),
        ("cy_px", c.c_double),
        ("position_world_m", Vector),
        ("q_world_camera", Quaternion),
        ("depth_m", c.POINTER(c.c_float)),
        ("camera", c.c_uint32),
        ("reserved2", c.c_uint32),
    ]


class PictureStruct(c.Structure):
    _fields_ = [
        ("struct_size", c.c_uint32),
        ("width_px", c.c_int32),
        ("height_px", c.c_int32),
        ("channels", c.c_uint32),
        ("camera", c.c_uint32),
        ("reserved", c.c_uint32),
        ("time_s", c.c_double),
        ("fx_px", c.c_double),
        ("fy_px", c.c_double),
        ("cx_px", c.c_double),
        ("cy_px", c.c_double),
        ("position_world_m", Vector),
        ("q_world_camera", Quaternion),
        ("pixels", c.POINTER(c.c_uint8)),
    ]


class StereoStruct(c.Structure):
    _fields_ = [
        ("struct_size", c.c_uint32),
        ("reserved", c.c_uint32),
        ("baseline_m", c.c_double),
        ("left", c.POINTER(PictureStruct)),
        ("right", c.POINTER(PictureStruct)),
    ]


class ImuStruct(c.Structure):
    _fields_ = [("time_s", c.c_double), ("rates_body_radps", Vector), ("specific_force_body_mps2", Vector)]


class ObservationStruct(c.Structure):
    _fields_ = [
        ("struct_size", c.c_uint32),
        ("depth_count", c.c_uint32),
        ("state", c.POINTER(StateStruct)),
        ("depth", c.POINTER(c.POINTER(DepthStruct))),
        ("stereo_count", c.c_uint32),
        ("color_count", c.c_uint32),
        ("stereo", c.POINTER(c.POINTER(StereoStruct))),
        ("color", c.POINTER(c.POINTER(PictureStruct))),
        ("imu_count", c.c_uint32),
        ("reserved", c.c_uint32),
        ("imu", c.POINTER(ImuStruct)),
        ("time_s", c.c_double),
        ("state_count", c.c_uint32),
        ("reserved2", c.c_uint32),
        ("states", c.POINTER(c.POINTER(StateStruct))),
    ]


class PointStruct(c.Structure):
    _fields_ = [
        ("time_s", c.c_double),
        ("position_world_m", Vector),
        ("velocity_world_mps", Vector),
        ("acceleration_world_mps2", Vector),
        ("jerk_world_mps3", Vector),
        ("yaw_rad", c.c_double),
        ("yaw_rate_radps", c.c_double),
    ]


class CommandStruct(c.Structure):
    _fields_ = [
        ("struct_size", c.c_uint32),
        ("kind", c.c_uint32),
        ("flags", c.c_uint32),
        ("point_count", c.c_uint32),
        ("position_world_m", Vector),
        ("velocity_world_mps", Vector),
        ("acceleration_world_mps2", Vector),
        ("yaw_rad", c.c_double),
        ("yaw_rate_radps", c.c_double),
        ("rates_body_radps", Vector),
        ("thrust_mps2", c.c_double),
        ("points", c.POINTER(PointStruct)),
        ("horizon_s", c.c_double),
    ]


Create = c.CFUNCTYPE(c.c_void_p, c.POINTER(Host), c.POINTER(SetupStruct))
Destroy = c.CFUNCTYPE(None, c.c_void_p)
Reset = c.CFUNCTYPE(c.c_int32, c.c_void_p, c.POINTER(MissionStruct))
Plan = c.CFUNCTYPE(c.c_int32, c.c_void_p, c.POINTER(ObservationStruct), c.POINTER(CommandStruct))
GetExtension = c.CFUNCTYPE(c.c_void_p, c.c_void_p, c.c_char_p)


class PlannerStruct(c.Structure):
    _fields_ = [
        ("struct_size", c.c_uint32),
        ("abi_version", c.c_uint32),
        ("name", c.c_char_p),
        ("version", c.c_char_p),
        ("summary", c.c_char_p),
        ("needs", c.c_uint32),
        ("commands", c.c_uint32),
        ("parameter_count", c.c_uint32),
        ("reserved", c.c_uint32),
        ("parameters", c.POINTER(c.POINTER(ParameterStruct))),
        ("create", Create),
        ("destroy", Destroy),
        ("reset", Reset),
        ("plan", Plan),
        ("get_extension", GetExtension),
        ("profile_count", c.c_uint32),
        ("reserved2", c.c_uint32),
        ("profiles", c.c_void_p),
        ("least_fov_x_rad", c.c_double),
        ("least_fov_y_rad", c.c_double),
    ]


class FilesStruct(c.Structure):
    _fields_ = [("struct_size", c.c_uint32), ("file_count", c.c_uint32), ("files", c.POINTER(c.c_char_p))]


STRUCTS: dict[str, Any] = {
    "ab_host": Host,
    "ab_parameter": ParameterStruct,
    "ab_value": Value,
    "ab_camera": CameraStruct,
    "ab_setup": SetupStruct,
    "ab_mission": MissionStruct,
    "ab_state": StateStruct,
    "ab_depth_image": DepthStruct,
    "ab_picture": PictureStruct,
    "ab_stereo_pair": StereoStruct,
    "ab_imu_sample": ImuStruct,
    "ab_observation": ObservationStruct,
    "ab_point": PointStruct,
    "ab_command": CommandStruct,
    "ab_planner": PlannerStruct,
    "ab_files": FilesStruct,
}
"""By the names in planner.h."""
