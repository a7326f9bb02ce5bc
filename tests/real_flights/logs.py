"""Writes trajectories as logs of real vehicles, by PyPI's rosbags: independent of this program's readers."""

import csv
import sys
from pathlib import Path

try:
    import numpy as np
    from rosbags.rosbag1 import Writer as Bag1
    from rosbags.rosbag2 import StoragePlugin
    from rosbags.rosbag2 import Writer as Bag2
    from rosbags.typesys import Stores, get_typestore
except ImportError as error:
    print(f"skipped: {error}; scripts/python_venv.sh installs what is missing")
    sys.exit(77)

EPOCH_NS = 1_700_000_000_000_000_000


def read_tum(path):
    """Rows of (time s, x, y, z, qx, qy, qz, qw)."""
    return np.loadtxt(path, comments="#", ndmin=2)


def write_tum(path, rows):
    with open(path, "w", encoding="ascii") as file:
        file.write("# timestamp tx ty tz qx qy qz qw\n")
        for row in rows:
            file.write(" ".join(repr(float(value)) for value in row) + "\n")


def write_euroc(path, rows):
    with open(path, "w", encoding="ascii", newline="") as file:
        writer = csv.writer(file)
        names = ["p_RS_R_x [m]", "p_RS_R_y [m]", "p_RS_R_z [m]", "q_RS_w []", "q_RS_x []", "q_RS_y []", "q_RS_z []"]
        writer.writerow(["#timestamp [ns]", *names])
        for t, x, y, z, qx, qy, qz, qw in rows:
            writer.writerow([EPOCH_NS + round(t * 1e9), *map(repr, map(float, (x, y, z, qw, qx, qy, qz)))])


def odometry(store, row):
    types = store.types
    t, x, y, z, qx, qy, qz, qw = map(float, row)
    stamp_ns = EPOCH_NS + round(t * 1e9)
    stamp = types["builtin_interfaces/msg/Time"](sec=stamp_ns // 10**9, nanosec=stamp_ns % 10**9)
    header_type = types["std_msgs/msg/Header"]
    has_seq = "seq" in header_type.__dataclass_fields__
    header = header_type(**({"seq": 0} if has_seq else {}), stamp=stamp, frame_id="map")
    pose = types["geometry_msgs/msg/Pose"](
        position=types["geometry_msgs/msg/Point"](x=x, y=y, z=z),
        orientation=types["geometry_msgs/msg/Quaternion"](x=qx, y=qy, z=qz, w=qw),
    )
    zero = types["geometry_msgs/msg/Vector3"](x=0.0, y=0.0, z=0.0)
    return stamp_ns, types["nav_msgs/msg/Odometry"](
        header=header,
        child_frame_id="base_link",
        pose=types["geometry_msgs/msg/PoseWithCovariance"](pose=pose, covariance=np.zeros(36)),
        twist=types["geometry_msgs/msg/TwistWithCovariance"](
            twist=types["geometry_msgs/msg/Twist"](linear=zero, angular=zero), covariance=np.zeros(36)
        ),
    )


def write_bag1(path, rows):
    store = get_typestore(Stores.ROS1_NOETIC)
    with Bag1(path) as bag:
        connection = bag.add_connection("/odom", "nav_msgs/msg/Odometry", typestore=store)
        for row in rows:
            stamp_ns, message = odometry(store, row)
            bag.write(connection, stamp_ns, store.serialize_ros1(message, "nav_msgs/msg/Odometry"))


def write_bag2(folder, rows, plugin):
    store = get_typestore(Stores.ROS2_HUMBLE)
    with Bag2(folder, version=9, storage_plugin=plugin) as bag:
        connection = bag.add_connection("/odom", "nav_msgs/msg/Odometry", typestore=store)
        for row in rows:
            stamp_ns, message = odometry(store, row)
            bag.write(connection, stamp_ns, store.serialize_cdr(message, "nav_msgs/msg/Odometry"))


def write_db3(folder, rows):
    write_bag2(folder, rows, StoragePlugin.SQLITE3)


def write_mcap(folder, rows):
    write_bag2(folder, rows, StoragePlugin.MCAP)


WRITERS = {
    "tum": (write_tum, "{}.tum"),
    "euroc": (write_euroc, "{}.csv"),
    "bag": (write_bag1, "{}.bag"),
    "db3": (write_db3, "{}_db3"),
    "mcap": (write_mcap, "{}_mcap"),
}


def write_log(kind, folder, name, rows):
    """The log's file, or its folder."""
    write, pattern = WRITERS[kind]
    path = Path(folder) / pattern.format(name)
    write(path, rows)
    return path
