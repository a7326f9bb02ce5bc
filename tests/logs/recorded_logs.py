#!/usr/bin/env python3
"""Recorded flights as others write them: ROS 1 bags and rosbag2 by rosbags, MCAP by mcap and mcap-ros2-support, ULog by
a writer of this file, which pyulog reads the same. Each is read by read_log and compared pose by pose.

    recorded_logs.py READ_LOG"""

import pathlib
import random
import shutil
import sqlite3
import struct
import subprocess
import sys
import tempfile

try:
    import mcap.reader
    import mcap.writer
    import mcap_ros2.writer
    import numpy
    import pyulog
    from rosbags import rosbag1, rosbag2
    from rosbags.typesys import Stores, get_types_from_msg, get_typestore
except ImportError as error:
    print(f"skipped: {error}")
    sys.exit(77)

READ_LOG = sys.argv[1]
ROS1 = get_typestore(Stores.ROS1_NOETIC)
ROS2 = get_typestore(Stores.ROS2_HUMBLE)
TRANSFORMS = "geometry_msgs/TransformStamped[] transforms"
for store in (ROS1, ROS2):
    if "tf2_msgs/msg/TFMessage" not in store.types:
        store.register(get_types_from_msg(TRANSFORMS, "tf2_msgs/msg/TFMessage"))
START_NS = 1_700_000_000_123_456_789


def read(path, *choice):
    """What read_log prints: its words by kind, poses as rows of an array; or its message."""
    run = subprocess.run([READ_LOG, str(path), *choice], capture_output=True, text=True, check=False)
    assert run.returncode in (0, 2), run
    if run.returncode == 2:
        return run.stderr.strip()
    lines = [line.partition(" ")[::2] for line in run.stdout.splitlines()]
    words = {kind: text for kind, text in lines if kind in ("format", "topic", "type", "attitude")}
    words["warnings"] = [text for kind, text in lines if kind == "warning"]
    poses = [text.split() for kind, text in lines if kind == "pose"]
    words["times"] = [int(pose[0]) for pose in poses]
    words["poses"] = numpy.array([[float(word) for word in pose[1:]] for pose in poses])
    return words


def turned(q, v):
    """v turned by q = (w, x, y, z): the definition q v q*, by matrices of the rotation."""
    w, x, y, z = q
    rotation = numpy.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
        ]
    )
    return rotation @ v


def rotation_of(q):
    return numpy.column_stack([turned(q, axis) for axis in numpy.eye(3)])


def flight(count=200):
    """Times in ns, positions, attitudes (w, x, y, z) and velocities in the body's frame, all at random."""
    draws = random.Random(5)
    rows = []
    for i in range(count):
        q = numpy.array([draws.gauss(0, 1) for _ in range(4)])
        rows.append(
            (
                START_NS + 5_000_000 * i + draws.randrange(1000),
                numpy.array([draws.uniform(-100, 100) for _ in range(3)]),
                q / numpy.linalg.norm(q),
                numpy.array([draws.uniform(-10, 10) for _ in range(3)]),
            )
        )
    return rows


def check_same(read_flight, rows, has_velocity, tolerance=1e-12):
    assert isinstance(read_flight, dict), read_flight
    assert read_flight["times"] == [time for time, *_ in rows], "times differ"
    poses = read_flight["poses"]
    assert poses.shape == (len(rows), 10 if has_velocity else 7), poses.shape
    for row, (_, position, q, velocity) in zip(poses, rows, strict=True):
        numpy.testing.assert_array_equal(row[:3], position)
        numpy.testing.assert_allclose(row[3:7], q, rtol=0, atol=tolerance)
        if has_velocity:
            numpy.testing.assert_allclose(row[7:], turned(q, velocity), rtol=0, atol=1e-11)


class Ros:
    """Messages of either ROS by its store of types."""

    def __init__(self, store, is_ros1):
        self.store, self.is_ros1, self.types = store, is_ros1, store.types

    def make(self, name, **fields):
        return self.types[name](**fields)

    def stamp(self, time):
        return self.make("builtin_interfaces/msg/Time", sec=time // 10**9, nanosec=time % 10**9)

    def header(self, time, frame="map"):
        more = {"seq": 7} if self.is_ros1 else {}
        return self.make("std_msgs/msg/Header", stamp=self.stamp(time), frame_id=frame, **more)

    def vector(self, v, name="Vector3"):
        return self.make(f"geometry_msgs/msg/{name}", x=float(v[0]), y=float(v[1]), z=float(v[2]))

    def quaternion(self, q):
        return self.make("geometry_msgs/msg/Quaternion", w=float(q[0]), x=float(q[1]), y=float(q[2]), z=float(q[3]))

    def pose(self, position, q):
        return self.make(
            "geometry_msgs/msg/Pose", position=self.vector(position, "Point"), orientation=self.quaternion(q)
        )

    def with_covariance(self, kind, inner):
        field = "pose" if kind == "Pose" else "twist"
        return self.make(f"geometry_msgs/msg/{kind}WithCovariance", **{field: inner, "covariance": numpy.arange(36.0)})

    def transform(self, row, child, frame="map"):
        time, position, q, _ = row
        return self.make(
            "geometry_msgs/msg/TransformStamped",
            header=self.header(time, frame),
            child_frame_id=child,
            transform=self.make(
                "geometry_msgs/msg/Transform", translation=self.vector(position), rotation=self.quaternion(q)
            ),
        )

    def message(self, kind, row):
        """A message of a kind, its full name, and its bytes."""
        time, position, q, velocity = row
        header = self.header(time)
        if kind == "Odometry":
            name = "nav_msgs/msg/Odometry"
            twist = self.make("geometry_msgs/msg/Twist", linear=self.vector(velocity), angular=self.vector((7, 8, 9)))
            message = self.make(
                name,
                header=header,
                child_frame_id="base_link",
                pose=self.with_covariance("Pose", self.pose(position, q)),
                twist=self.with_covariance("Twist", twist),
            )
        elif kind == "PoseStamped":
            name = "geometry_msgs/msg/PoseStamped"
            message = self.make(name, header=header, pose=self.pose(position, q))
        elif kind == "PoseWithCovarianceStamped":
            name = "geometry_msgs/msg/PoseWithCovarianceStamped"
            message = self.make(name, header=header, pose=self.with_covariance("Pose", self.pose(position, q)))
        elif kind == "TransformStamped":
            name = "geometry_msgs/msg/TransformStamped"
            message = self.transform(row, "base_link")
        else:
            name = "tf2_msgs/msg/TFMessage"
            transforms = [self.transform(row, "camera", "base_link"), self.transform(row, "base_link")]
            message = self.make(name, transforms=transforms)
        serialize = self.store.serialize_ros1 if self.is_ros1 else self.store.serialize_cdr
        return name, bytes(serialize(message, name))


KINDS = ["Odometry", "PoseStamped", "PoseWithCovarianceStamped", "TransformStamped", "TFMessage"]
NOISE = ("std_msgs/msg/String", "/noise")


def write_bag(ros, writer, rows, kinds):
    """A topic of each kind, with the name of its kind, and one of no interest, interleaved."""
    connections = {}
    for kind in kinds:
        name, _ = ros.message(kind, rows[0])
        connections[kind] = writer.add_connection(f"/{kind}", name, typestore=ros.store)
    noise = writer.add_connection(NOISE[1], NOISE[0], typestore=ros.store)
    text = ros.make(NOISE[0], data="noise" * 1000)
    serialize = ros.store.serialize_ros1 if ros.is_ros1 else ros.store.serialize_cdr
    for row in rows:
        writer.write(noise, row[0] + 500, bytes(serialize(text, NOISE[0])))
        for kind in kinds:
            writer.write(connections[kind], row[0] + 1000, ros.message(kind, row)[1])


def check_kinds(path, rows, kinds, format_name):
    for kind in kinds:
        result = read(path, f"/{kind}", "base_link")
        check_same(result, rows, kind == "Odometry")
        assert result["format"] == format_name, result["format"]
        assert result["topic"] == f"/{kind}" and result["attitude"] == "1"
        assert result["type"].endswith(kind) and not result["warnings"], result["warnings"]
    message = read(path)
    assert "several topics have poses" in message and "/Odometry (nav_msgs/" in message, message
    message = read(path, "/TFMessage")
    assert "several child frames" in message and "camera (200 transforms)" in message, message
    message = read(path, "/TFMessage", "bas_link")
    assert "no child frame bas_link (did you mean base_link?)" in message, message
    message = read(path, "/Odometri")
    assert "no topic /Odometri (did you mean /Odometry?)" in message and "/noise" in message, message
    message = read(path, "/noise")
    assert "/noise can't be read as poses" in message, message


def test_ros1_bags(folder):
    rows = flight()
    formats = rosbag1.Writer.CompressionFormat
    for compression in (None, formats.BZ2, formats.LZ4):
        path = folder / f"{compression}.bag"
        writer = rosbag1.Writer(path)
        if compression is not None:
            writer.set_compression(compression)
        with writer:
            write_bag(Ros(ROS1, True), writer, rows, KINDS)
        check_kinds(path, rows, KINDS, "ROS 1 bag")
    whole = path.read_bytes()
    # Not closed: the header says so, and there is no index.
    index = struct.unpack("<Q", whole[whole.index(b"index_pos=") + 10 :][:8])[0]
    unindexed = whole[:index].replace(b"index_pos=" + struct.pack("<Q", index), b"index_pos=" + bytes(8))
    (folder / "unindexed.bag").write_bytes(unindexed)
    result = read(folder / "unindexed.bag", "/Odometry")
    check_same(result, rows, True)
    assert "was never closed" in result["warnings"][0]
    (folder / "cut.bag").write_bytes(whole[: index // 2])
    result = read(folder / "cut.bag", "/Odometry")
    check_same(result, rows[: len(result["times"])], True)
    assert 0 < len(result["times"]) < len(rows)
    assert f"is cut off at byte {index // 2}" in result["warnings"][0], result["warnings"]
    # Of the three only bzip2 has checksums.
    damaged = bytearray((folder / f"{formats.BZ2}.bag").read_bytes())
    damaged[len(damaged) // 2] ^= 0x40
    (folder / "damaged.bag").write_bytes(damaged)
    message = read(folder / "damaged.bag", "/Odometry")
    assert "damaged at byte" in message, message


def test_rosbag2(folder):
    rows = flight()
    for version in (8, 9):
        for plugin in (rosbag2.StoragePlugin.SQLITE3, rosbag2.StoragePlugin.MCAP):
            path = folder / f"{plugin.name}{version}"
            with rosbag2.Writer(path, version=version, storage_plugin=plugin) as writer:
                write_bag(Ros(ROS2, False), writer, rows, KINDS)
            is_mcap = plugin == rosbag2.StoragePlugin.MCAP
            format_name = "MCAP" if is_mcap else "rosbag2 (SQLite)"
            check_kinds(path, rows, KINDS, format_name)
            (file,) = path.glob("*.mcap" if is_mcap else "*.db3")
            check_kinds(file, rows, KINDS, format_name)
    for mode, hint in (("FILE", "zstd -d"), ("MESSAGE", "ros2 bag convert")):
        path = folder / f"packed_{mode}"
        writer = rosbag2.Writer(path, version=9, storage_plugin=rosbag2.StoragePlugin.SQLITE3)
        writer.set_compression(getattr(rosbag2.CompressionMode, mode), rosbag2.CompressionFormat.ZSTD)
        with writer:
            write_bag(Ros(ROS2, False), writer, rows, ["Odometry"])
        message = read(path)
        assert hint in message, message


def test_several_files(folder):
    """A recording that was split: its files by metadata.yaml, not by name."""
    rows = flight()
    names = []
    for part in range(2):
        path = folder / f"part{part}"
        with rosbag2.Writer(path, version=9, storage_plugin=rosbag2.StoragePlugin.SQLITE3) as writer:
            write_bag(Ros(ROS2, False), writer, rows[part * 100 : part * 100 + 100], ["Odometry"])
        names.append(f"part{part}/z{1 - part}.db3")
    both = folder / "both"
    both.mkdir()
    for part in range(2):
        shutil.copy(folder / f"part{part}/part{part}.db3", both / f"z{1 - part}.db3")
    listed = "\n".join(f"    - {name}" for name in names)
    metadata = f"rosbag2_bagfile_information:\n  version: 4\n  relative_file_paths:\n{listed}\n"
    (both / "metadata.yaml").write_text(metadata)
    check_same(read(both), rows, True)
    (both / "metadata.yaml").write_text("rosbag2_bagfile_information: {}\n")
    assert "relative_file_paths" in read(both)
    (both / "metadata.yaml").unlink()
    assert "without metadata.yaml" in read(both)


def test_db3_damage(folder):
    rows = flight()
    with rosbag2.Writer(folder / "r", version=9, storage_plugin=rosbag2.StoragePlugin.SQLITE3) as writer:
        write_bag(Ros(ROS2, False), writer, rows, ["Odometry"])
    file = folder / "r/r.db3"
    whole = file.read_bytes()
    (folder / "cut.db3").write_bytes(whole[: len(whole) // 2])
    message = read(folder / "cut.db3")
    assert "damaged (SQLite: " in message and ".recover" in message, message
    with sqlite3.connect(file) as connection:
        connection.execute("UPDATE messages SET data = x'00010000ff' WHERE id = 6")
    connection.close()
    message = read(file)
    assert "damaged at row 6 of messages: it is too short for its type" in message, message
    with sqlite3.connect(folder / "other.db3") as connection:
        connection.execute("CREATE TABLE topics (id)")
        connection.execute("CREATE VIEW messages AS SELECT 1 AS id, 2 AS topic_id, 3 AS timestamp, x'00' AS data")
    connection.close()
    assert "no tables topics and messages" in read(folder / "other.db3")


def write_mcap(path, rows, kinds, **options):
    """By the library of MCAP itself, in ROS 2's encoding."""
    ros = Ros(ROS2, False)
    with path.open("wb") as file:
        writer = mcap.writer.Writer(file, **options)
        writer.start("ros2", "test")
        channels = {}
        for kind in kinds:
            name, _ = ros.message(kind, rows[0])
            definition, _ = ROS2.generate_msgdef(name, ros_version=2)
            schema = writer.register_schema(name, "ros2msg", definition.encode())
            channels[kind] = writer.register_channel(f"/{kind}", "cdr", schema)
        for row in rows:
            for kind in kinds:
                writer.add_message(channels[kind], row[0] + 1000, ros.message(kind, row)[1], row[0])
        writer.add_attachment(0, 0, "a", "text/plain", b"x" * 1000)
        writer.finish()


def test_mcap(folder):
    rows = flight()
    kinds = KINDS
    compressions = mcap.writer.CompressionType
    for name, options in {
        "none": {"compression": compressions.NONE},
        "lz4": {"compression": compressions.LZ4, "chunk_size": 4000},
        "zstd": {"compression": compressions.ZSTD, "chunk_size": 100_000},
        "no_crc": {"compression": compressions.ZSTD, "enable_crcs": False},
        "unchunked": {"use_chunking": False},
    }.items():
        path = folder / f"{name}.mcap"
        write_mcap(path, rows, kinds, **options)
        for kind in kinds:
            result = read(path, f"/{kind}", "base_link")
            check_same(result, rows, kind == "Odometry")
            assert result["format"] == "MCAP" and not result["warnings"]
        whole = path.read_bytes()
        half = len(whole) // 2
        (folder / "cut.mcap").write_bytes(whole[:half])
        result = read(folder / "cut.mcap", "/Odometry")
        if isinstance(result, dict):
            check_same(result, rows[: len(result["times"])], True)
            assert f"is cut off at byte {half}" in result["warnings"][0], result["warnings"]
            assert len(result["times"]) < len(rows)
        else:  # one chunk, of which nothing can be unpacked yet
            assert f"is cut off at byte {half}" in result, result
        # One bit of a message's data, which only the checksum sees.
        if name in ("none", "lz4", "zstd"):
            damaged = bytearray(whole)
            with path.open("rb") as file:
                chunks = mcap.reader.make_reader(file).get_summary().chunk_indexes
            chunk = chunks[len(chunks) // 2]
            damaged[chunk.chunk_start_offset + chunk.chunk_length // 2] ^= 1
            (folder / "damaged.mcap").write_bytes(damaged)
            message = read(folder / "damaged.mcap", "/Odometry")
            assert isinstance(message, str) and "damaged at byte" in message, message


def test_mcap_of_ros1(folder):
    rows, ros = flight(), Ros(ROS1, True)
    with (folder / "ros1.mcap").open("wb") as file:
        writer = mcap.writer.Writer(file)
        writer.start("ros1", "test")
        schema = writer.register_schema("nav_msgs/Odometry", "ros1msg", b"")
        channel = writer.register_channel("/odom", "ros1", schema)
        for row in rows:
            writer.add_message(channel, row[0], ros.message("Odometry", row)[1], row[0])
        writer.finish()
    check_same(read(folder / "ros1.mcap"), rows, True)


ODOMETRY_DEFINITION = """uint64 timestamp
uint64 timestamp_sample
uint8 pose_frame
float32[3] position
float32[4] q
uint8 velocity_frame
float32[3] velocity
float32[3] angular_velocity
float32[3] position_variance
float32[3] orientation_variance
float32[3] velocity_variance
uint8 reset_counter
int8 quality
"""
LOCAL_POSITION_DEFINITION = """uint64 timestamp
uint64 timestamp_sample
bool xy_valid
bool z_valid
bool v_xy_valid
bool v_z_valid
float32 x
float32 y
float32 z
float32[2] delta_xy
uint8 xy_reset_counter
float32 delta_z
uint8 z_reset_counter
float32 vx
float32 vy
float32 vz
float32 heading
"""


def as_float(v):
    return [float(numpy.float32(x)) for x in v]


def enu(v):
    return numpy.array([v[1], v[0], -v[2]])


def check_ned(result, rows, has_attitude=True, has_body_velocity=False):
    """That poses of NED and FRD came out in ENU and FLU, by matrices."""
    assert isinstance(result, dict), result
    assert result["times"] == [time // 1000 * 1000 for time, *_ in rows]
    ned_from_enu = numpy.array([[0, 1, 0], [1, 0, 0], [0, 0, -1]])
    frd_from_flu = numpy.diag([1, -1, -1])
    for row, (_, position, q, velocity) in zip(result["poses"], rows, strict=True):
        numpy.testing.assert_array_equal(row[:3], enu(as_float(position)))
        if has_attitude:
            q32 = numpy.array(as_float(q))
            rotation = rotation_of(q32 / numpy.linalg.norm(q32))
            wanted = ned_from_enu.T @ rotation @ frd_from_flu
            numpy.testing.assert_allclose(rotation_of(row[3:7]), wanted, rtol=0, atol=1e-12)
        else:
            numpy.testing.assert_array_equal(row[3:7], [1, 0, 0, 0])
        v = numpy.array(as_float(velocity))
        wanted = enu(rotation @ v if has_body_velocity else v)
        numpy.testing.assert_allclose(row[7:], wanted, rtol=0, atol=1e-11)


def test_px4_of_ros2(folder):
    """By mcap-ros2-support, which writes CDR by the definitions given here."""
    rows = flight()
    with (folder / "px4.mcap").open("wb") as file, mcap_ros2.writer.Writer(file) as writer:
        odometry = writer.register_msgdef("px4_msgs/msg/VehicleOdometry", ODOMETRY_DEFINITION)
        position = writer.register_msgdef("px4_msgs/msg/VehicleLocalPosition", LOCAL_POSITION_DEFINITION)
        for row in rows:
            time, p, q, v = row
            common = {"timestamp": time // 1000, "timestamp_sample": time // 1000 - 5}
            p, q, v = as_float(p), as_float(q), as_float(v)
            zeros = [0.0, 0.0, 0.0]
            for topic, frame in (("/fmu/out/ned", 1), ("/fmu/out/body", 3)):
                message = {
                    **common,
                    "pose_frame": 1,
                    "position": p,
                    "q": q,
                    "velocity_frame": frame,
                    "velocity": v,
                    "angular_velocity": zeros,
                    "position_variance": zeros,
                    "orientation_variance": zeros,
                    "velocity_variance": zeros,
                    "reset_counter": 0,
                    "quality": 0,
                }
                writer.write_message(topic, odometry, message, time)
            message = {name: True for name in ("xy_valid", "z_valid", "v_xy_valid", "v_z_valid")}
            message |= {"x": p[0], "y": p[1], "z": p[2], "delta_xy": [5.0, 6.0], "xy_reset_counter": 1}
            message |= {"delta_z": 7.0, "z_reset_counter": 2, "vx": v[0], "vy": v[1], "vz": v[2], "heading": 0.5}
            writer.write_message("/fmu/out/position", position, common | message, time)
    check_ned(read(folder / "px4.mcap", "/fmu/out/ned"), rows)
    check_ned(read(folder / "px4.mcap", "/fmu/out/body"), rows, has_body_velocity=True)
    result = read(folder / "px4.mcap", "/fmu/out/position")
    check_ned(result, rows, has_attitude=False)
    assert result["attitude"] == "0"


# A small writer of ULog.


def ulog_record(kind, data):
    return struct.pack("<HB", len(data), ord(kind)) + data


def ulog_head(formats):
    head = b"ULog\x01\x12\x35\x01" + struct.pack("<Q", 112233)
    head += ulog_record("B", bytes(40))
    for text in formats:
        head += ulog_record("F", text.encode())
    return head + ulog_record("I", b"\x0achar[3] sys" + b"PX4")


def subscription(number, name, instance=0):
    return ulog_record("A", struct.pack("<BH", instance, number) + name.encode())


FORMATS = [
    "nested:uint16_t[3] a;bool b;",
    # x not at a multiple of four: ULog writes no gaps but those named.
    "vehicle_local_position:uint64_t timestamp;uint64_t timestamp_sample;nested[2] n;float x;float y;float z;"
    "float vx;float vy;float vz;bool xy_valid;bool z_valid;uint8_t xy_reset_counter;uint8_t[2] _padding0;",
    "vehicle_attitude:uint64_t timestamp;uint64_t timestamp_sample;float[4] q;uint8_t reset;uint8_t[7] _padding0;",
    "vehicle_odometry:uint64_t timestamp;float[3] position;float[4] q;uint8_t pose_frame;uint8_t velocity_frame;"
    "float[3] velocity;",
    "sensor_gyro:uint64_t timestamp;double x;",
]


def ulog_data(rows):
    data = []
    for i, (time, p, q, v) in enumerate(rows):
        us = time // 1000
        data.append(ulog_record("D", struct.pack("<HQQ4fB", 2, us, us - 3, *q, 0)))
        nested = struct.pack("<3HB3HB", 1, 2, 3, 1, 4, 5, 6, 0)
        body = struct.pack("<HQQ", 1, us, us - 3) + nested + struct.pack("<6f3B", *p, *v, 1, 1, i // 100)
        data.append(ulog_record("D", body))
        data.append(ulog_record("D", struct.pack("<HQ7f2B3f", 3, us, *p, *q, 1, 3, *v)))
        data.append(ulog_record("D", struct.pack("<HQd", 4, us, 0.5)))
        # A second instance with other numbers.
        data.append(ulog_record("D", struct.pack("<HQ7f2B3f", 5, us, 9, 9, 9, *q, 1, 1, 0, 0, 0)))
    return data


def ulog_bytes(rows, ids=(2, 4, 3, 5, 1)):
    names = {1: "vehicle_local_position", 2: "vehicle_attitude", 3: "vehicle_odometry", 4: "sensor_gyro"}
    subscriptions = [subscription(n, names.get(n, "vehicle_odometry"), 1 if n == 5 else 0) for n in ids]
    data = ulog_data(rows)
    middle = len(data) // 2
    lost = ulog_record("O", struct.pack("<H", 1500))
    logged = ulog_record("L", b"6" + struct.pack("<Q", 5) + b"hello")
    return ulog_head(FORMATS) + b"".join(subscriptions + data[:middle] + [lost, logged] + data[middle:])


def test_ulog(folder):
    rows = flight()
    path = folder / "log.ulg"
    path.write_bytes(ulog_bytes(rows))
    by_pyulog = pyulog.ULog(str(path)).get_dataset("vehicle_local_position").data
    assert list(by_pyulog["timestamp"]) == [time // 1000 for time, *_ in rows]
    numpy.testing.assert_array_equal(by_pyulog["x"], [numpy.float32(p[0]) for _, p, _, _ in rows])
    result = read(path)
    check_ned(result, rows)
    assert result["format"] == "ULog" and result["topic"] == "vehicle_local_position"
    numpy.testing.assert_array_equal(result["poses"][:, 0], by_pyulog["y"])
    numpy.testing.assert_array_equal(result["poses"][:, 2], -by_pyulog["z"].astype(float))
    assert any("jumped 1 time " in warning for warning in result["warnings"]), result["warnings"]
    assert any("lost data 1 time, 1.500 s" in warning for warning in result["warnings"])
    result = read(path, "vehicle_odometry")
    check_ned(result, rows, has_body_velocity=True)
    message = read(path, "vehicle_odometri")
    assert "did you mean vehicle_odometry?" in message and "sensor_gyro (200 messages)" in message, message
    assert "sensor_gyro can't be read as poses" in read(path, "sensor_gyro")
    # As pyulog writes it again.
    again = folder / "again.ulg"
    pyulog.ULog(str(path)).write_ulog(str(again))
    check_ned(read(again), rows)
    check_ned(read(again, "vehicle_odometry"), rows, has_body_velocity=True)
    whole = path.read_bytes()
    (folder / "zeros.ulg").write_bytes(whole + bytes(5000))
    result = read(folder / "zeros.ulg")
    check_ned(result, rows)
    assert any(f"is cut off at byte {len(whole)}" in warning for warning in result["warnings"])
    (folder / "noise.ulg").write_bytes(whole + bytes(5000) + b"x")
    assert f"damaged at byte {len(whole)}" in read(folder / "noise.ulg")


def test_text(folder):
    rows = flight()
    tum = "# timestamp tx ty tz qx qy qz qw\n"
    euroc = (
        "#timestamp, p_RS_R_x [m], p_RS_R_y [m], p_RS_R_z [m], q_RS_w [], q_RS_x [], q_RS_y [], q_RS_z [], v_RS_R_x\n"
    )
    for time, p, q, v in rows:
        tum += f"{time // 10**9}.{time % 10**9:09d} " + " ".join(repr(float(x)) for x in (*p, *q[1:], q[0])) + "\n"
        euroc += ",".join([str(time), *(repr(float(x)) for x in (*p, *q, *turned(q, v), 0, 0, 0))]) + "\r\n"
    (folder / "tum.txt").write_text(tum)
    (folder / "data.csv").write_text(euroc)
    result = read(folder / "tum.txt")
    check_same(result, rows, False)
    assert result["format"] == "TUM" and result["topic"] == ""
    result = read(folder / "data.csv")
    check_same(result, rows, True)
    assert result["format"] == "EuRoC CSV"


def main():
    for name, test in list(globals().items()):
        if name.startswith("test_"):
            with tempfile.TemporaryDirectory() as folder:
                test(pathlib.Path(folder))
            print(f"{name}: as written", flush=True)


main()
