#!/usr/bin/env python3
"""Checks the files of `avoidbench export mcap` by mcap, mcap-ros2-support and rosbags of PyPI, against what is stored
and against what a planner says that it saw.

usage: check_mcap.py PROGRAM TELLING.so; exit code 77: the packages are not there"""

import csv
import pathlib
import shutil
import subprocess
import sys
import tempfile

try:
    import numpy
    from mcap.reader import make_reader
    from mcap.records import Statistics
    from mcap_ros2.decoder import DecoderFactory
    from rosbags.typesys import Stores, get_types_from_msg, get_typestore
except ImportError as error:
    print(f"passed over: {error}")
    sys.exit(77)

SWEEP = """sweep: flights
planners: [{plugin: ./telling.so}, ego]
trials: 1
maps: {generator: hall, area_m: [14, 20], poisson_radius_m: 5}
mission: {time_limit_s: 3}
sensor:
  width_px: 64
  height_px: 48
  delay_ms: 20
  more_mountings: [{yaw_deg: 90}]
  lidars: [{preset: velodyne_16, rate_hz: 10}]
odometry: {delay_ms: 15}
movers: {count: 3, kind: mixed, motion: mixed}
"""

STORED = {
    "/tf_static": "tf2_msgs/msg/TFMessage",
    "/tf": "tf2_msgs/msg/TFMessage",
    "/vehicle": "visualization_msgs/msg/Marker",
    "/path": "nav_msgs/msg/Path",
    "/map": "visualization_msgs/msg/MarkerArray",
    "/movers": "visualization_msgs/msg/MarkerArray",
    "/goal": "geometry_msgs/msg/PoseStamped",
    "/odometry": "nav_msgs/msg/Odometry",
    "/acceleration": "geometry_msgs/msg/AccelStamped",
    "/reference": "geometry_msgs/msg/PointStamped",
    "/clearance_m": "std_msgs/msg/Float64",
    "/rotor_power_w": "std_msgs/msg/Float64",
    "/planner/status": "std_msgs/msg/String",
    "/planner/cpu_time_s": "std_msgs/msg/Float64",
    "/events": "rcl_interfaces/msg/Log",
}
CAMERA = {
    "depth/image": "sensor_msgs/msg/Image",
    "depth/camera_info": "sensor_msgs/msg/CameraInfo",
    "depth/points": "sensor_msgs/msg/PointCloud2",
}
EYES = {
    f"{eye}/{what}": type_name
    for eye in ("left", "right", "color")
    for what, type_name in (("image", "sensor_msgs/msg/Image"), ("camera_info", "sensor_msgs/msg/CameraInfo"))
}
PLANNER = {"/planner/odometry": "nav_msgs/msg/Odometry", "/planner/log": "rcl_interfaces/msg/Log"}


class File:
    """A file as the reader and the decoder of PyPI have it: messages in the order of the file, by topic."""

    def __init__(self, path):
        self.raw, self.decoded, self.types, self.definitions, self.times = {}, {}, {}, {}, []
        decoders = DecoderFactory()
        with open(path, "rb") as stream:
            reader = make_reader(stream, validate_crcs=True, decoder_factories=[decoders])
            self.header = reader.get_header()
            self.summary = reader.get_summary()
            self.metadata = {record.name: record.metadata for record in reader.iter_metadata()}
            for schema, channel, message, decoded in reader.iter_decoded_messages(log_time_order=False):
                assert schema.encoding == "ros2msg" and channel.message_encoding == "cdr"
                assert message.log_time == message.publish_time
                self.times.append(message.log_time)
                self.types[channel.topic] = schema.name
                self.definitions[schema.name] = schema.data.decode()
                self.raw.setdefault(channel.topic, []).append((message.log_time, message.data))
                self.decoded.setdefault(channel.topic, []).append((message.log_time, decoded))


def ns(stamp):
    return stamp.sec * 1_000_000_000 + stamp.nanosec


def check_whole(file):
    """Order, stamps, and the summary."""
    assert file.header.profile == "ros2" and file.header.library.startswith("avoidbench ")
    assert file.times == sorted(file.times) and file.times[0] == 0
    statistics: Statistics = file.summary.statistics
    assert statistics.message_count == len(file.times)
    assert (statistics.message_start_time, statistics.message_end_time) == (file.times[0], file.times[-1])
    counts = {file.summary.channels[i].topic: count for i, count in statistics.channel_message_counts.items()}
    assert counts == {topic: len(messages) for topic, messages in file.raw.items()}
    assert statistics.chunk_count == len(file.summary.chunk_indexes) > 0
    for topic, messages in file.decoded.items():
        for time, message in messages:
            if hasattr(message, "header"):
                if topic != "/command/trajectory":  # that of when it takes effect
                    assert ns(message.header.stamp) == time, topic
            elif hasattr(message, "stamp"):
                assert ns(message.stamp) == time, topic


def check_types(file):
    """The definitions are ROS's own, and ROS's own serialization gives the same bytes."""
    store = get_typestore(Stores.ROS2_HUMBLE)
    for name, definition in file.definitions.items():
        for part, (_, fields) in get_types_from_msg(definition, name).items():
            assert fields == store.fielddefs[part][1], f"{part}: {fields}\n{store.fielddefs[part][1]}"
    for topic, messages in file.raw.items():
        for _, data in messages[:20]:
            name = file.types[topic]
            assert store.serialize_cdr(store.deserialize_cdr(data, name), name) == data, topic


def rotation(q):
    w, x, y, z = q.w, q.x, q.y, q.z
    return numpy.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
            [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
            [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
        ]
    )


def xyz(v):
    return numpy.array([v.x, v.y, v.z])


def check_path(file, rows):
    """Odometry, transforms and the path are the stored ones, digit by digit."""
    body = [(t, m.transforms[0]) for t, m in file.decoded["/tf"] if m.transforms[0].child_frame_id == "base_link"]
    odometry = file.decoded["/odometry"]
    assert len(odometry) == len(rows) == len(body)
    for (time, message), (tf_time, transform), row in zip(odometry, body, rows):
        number = {name: float(text) if text else float("nan") for name, text in row.items()}
        assert time == tf_time == round(number["time_s"] * 1e9)
        pose, twist = message.pose.pose, message.twist.twist
        assert (message.header.frame_id, message.child_frame_id) == ("map", "base_link")
        place = [number[name] for name in ("x_m", "y_m", "z_m")]
        turn = [number[name] for name in ("qw", "qx", "qy", "qz")]
        for position, q in (
            (pose.position, pose.orientation),
            (transform.transform.translation, transform.transform.rotation),
        ):
            assert [position.x, position.y, position.z] == place
            assert [q.w, q.x, q.y, q.z] == turn
        velocity = rotation(pose.orientation) @ xyz(twist.linear)
        stored = [number[name] for name in row if name.startswith("v") and name.endswith("_mps")]
        assert numpy.allclose(velocity, stored, atol=1e-12), (velocity, stored)
    poses = file.decoded["/path"][0][1].poses
    by_time = dict(odometry)
    for pose in poses:
        assert xyz(pose.pose.position).tolist() == xyz(by_time[ns(pose.header.stamp)].pose.pose.position).tolist()
    assert ns(poses[-1].header.stamp) == odometry[-1][0]


def fnv(data):
    value = 0xCBF29CE484222325
    for byte in data:
        value = (value ^ byte) * 0x100000001B3 % 2**64
    return value


def check_seen(file):
    """Images and sweeps are, by their digests, those that the planner says that it saw."""
    told = {}
    for _, line in file.decoded["/planner/log"]:
        what, index, time_s, digest = line.msg.split()
        told.setdefault((what, int(index)), []).append((round(float(time_s) * 1e9), int(digest, 16)))
    assert told.pop(("reset", 0))
    topics = {key: f"/camera_{key[1]}/{key[0]}/image" for key in told}
    topics[("points", 0)] = "/lidar_0/points"
    assert len(topics) == 9  # two cameras with four kinds of images, and a lidar
    for key, topic in topics.items():
        seen = [(time, bytes(message.data)) for time, message in file.decoded[topic]]
        assert len(seen) > 20, topic
        step = max(1, len(seen) // 6)
        expected = sorted(told[key])
        assert [time for time, _ in seen] == [time for time, _ in expected], topic
        for (_, data), (_, digest) in list(zip(seen, expected))[::step]:
            assert fnv(data) == digest, topic


def distances(points, triangles):
    """From each point to the nearest triangle (k x 3 x 3)."""
    a, b, c = triangles[:, 0], triangles[:, 1], triangles[:, 2]
    least = []
    for p in points:
        ab, ac, ap = b - a, c - a, p - a
        normal = numpy.cross(ab, ac)
        squared = numpy.maximum((normal**2).sum(1), 1e-30)
        v = (numpy.cross(ap, ac) * normal).sum(1) / squared
        w = (numpy.cross(ab, ap) * normal).sum(1) / squared
        inside = (v >= 0) & (w >= 0) & (v + w <= 1)
        plane = numpy.abs((ap * normal).sum(1)) / numpy.sqrt(squared)
        nearest = numpy.where(inside, plane, numpy.inf)
        for begin, end in ((a, b), (b, c), (c, a)):
            way = end - begin
            along = ((p - begin) * way).sum(1) / numpy.maximum((way**2).sum(1), 1e-30)
            foot = begin + numpy.clip(along, 0, 1)[:, None] * way
            nearest = numpy.minimum(nearest, numpy.linalg.norm(p - foot, axis=1))
        least.append(nearest.min())
    return numpy.array(least)


def check_geometry(file):
    """By the frames alone, what was measured lies on the map: transforms, intrinsics and mesh fit together."""
    triangles = numpy.array(
        [[p.x, p.y, p.z] for marker in file.decoded["/map"][0][1].markers for p in marker.points]
    ).reshape(-1, 3, 3)
    poses = {time: message.pose.pose for time, message in file.decoded["/odometry"]}
    mountings = {t.child_frame_id: t.transform for t in file.decoded["/tf_static"][0][1].transforms}
    for topic, most_m in (("/camera_0/depth/points", 0.02), ("/camera_1/depth/points", 0.02), ("/lidar_0/points", 0.1)):
        time, cloud = [(t, m) for t, m in file.decoded[topic] if t in poses and m.width > 20][-1]
        fields = [field.name for field in cloud.fields]
        points = numpy.frombuffer(bytes(cloud.data), dtype=numpy.float32).reshape(-1, len(fields))[:, :3]
        points = points[:: max(1, len(points) // 100)].astype(float)
        mounting, pose = mountings[cloud.header.frame_id], poses[time]
        in_body = points @ rotation(mounting.rotation).T + xyz(mounting.translation)
        in_map = in_body @ rotation(pose.orientation).T + xyz(pose.position)
        off = distances(in_map, triangles)
        assert numpy.mean(off < most_m) > 0.8, (topic, numpy.sort(off))  # the others lie on movers
    frames = {t.child_frame_id for _, m in file.decoded["/tf"] for t in m.transforms}
    movers = file.decoded["/movers"][0][1].markers
    assert {marker.header.frame_id for marker in movers} == {"mover_0", "mover_1", "mover_2"} <= frames
    assert [field.name for field in file.decoded["/lidar_0/points"][0][1].fields] == [
        "x",
        "y",
        "z",
        "time",
        "intensity",
    ]


def check_commands(file):
    """A trajectory as poses and with all that it says."""
    paths, trajectories = file.decoded["/command/path"], file.decoded["/command/trajectory"]
    assert len(paths) == len(trajectories) > 5
    for (time, path), (_, trajectory) in zip(paths, trajectories):
        effect = ns(trajectory.header.stamp)
        assert effect >= time and len(path.poses) == len(trajectory.points) >= 2
        for pose, point in zip(path.poses, trajectory.points):
            assert abs(ns(pose.header.stamp) - effect - ns(point.time_from_start)) <= 1
            assert xyz(pose.pose.position).tolist() == xyz(point.transforms[0].translation).tolist()


def main():
    program, telling = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]).resolve()
    folder = pathlib.Path(tempfile.mkdtemp())
    shutil.copy(telling, folder / "telling.so")
    (folder / "flights.yaml").write_text(SWEEP)

    def avoidbench(*words, code=0):
        done = subprocess.run([program, *words], cwd=folder, capture_output=True, text=True)
        assert done.returncode == code, f"{words}: exit code {done.returncode}\n{done.stdout}{done.stderr}"
        return done

    avoidbench("run", "flights.yaml", "--db", "f.db", "--quiet", "--no-keep")
    listed = list(csv.DictReader(avoidbench("replay", "f.db", "--list", "--format", "csv").stdout.splitlines()))
    ids = {row["planner"]: row[next(iter(row))] for row in listed}
    for planner, trial in ids.items():
        avoidbench("export", "mcap", "f.db", trial, "--output", f"{planner}.mcap")
        avoidbench("export", "mcap", "f.db", trial, "--output", "again.mcap")
        assert (folder / f"{planner}.mcap").read_bytes() == (folder / "again.mcap").read_bytes()
        file = File(folder / f"{planner}.mcap")
        check_whole(file)
        check_types(file)
        rows = csv.DictReader(avoidbench("export", "trajectory", "f.db", trial).stdout.splitlines())
        check_path(file, list(rows))
        check_geometry(file)
        is_telling = planner == "telling"
        cameras = {
            f"/camera_{i}/{topic}": name
            for i in range(2)
            for topic, name in ({**CAMERA, **EYES} if is_telling else CAMERA).items()
        }
        expected = {**STORED, **cameras, **PLANNER, "/lidar_0/points": "sensor_msgs/msg/PointCloud2"}
        if is_telling:
            expected["/imu"] = "sensor_msgs/msg/Imu"
            expected["/command/velocity"] = "geometry_msgs/msg/TwistStamped"
            check_seen(file)
        else:
            expected["/command/path"] = "nav_msgs/msg/Path"
            expected["/command/trajectory"] = "trajectory_msgs/msg/MultiDOFJointTrajectory"
            check_commands(file)
        optional = {"/contacts", "/planner/log"}
        found = {topic: name for topic, name in file.types.items() if topic not in optional}
        assert found == {t: n for t, n in expected.items() if t not in optional}, sorted(
            set(found.items()) ^ set(expected.items())
        )
        assert file.metadata["avoidbench"]["planner"] == planner
        assert str(folder) not in str(file.metadata)

        # Only what is stored: the same messages, byte for byte, and nothing that is not.
        avoidbench("export", "mcap", "f.db", trial, "--stored-only", "--output", "stored.mcap")
        stored = File(folder / "stored.mcap")
        check_whole(stored)
        assert stored.raw == {topic: file.raw[topic] for topic in stored.raw}
        assert set(stored.raw) == {t for t in file.raw if t in STORED or t == "/contacts"}

    # A flight that differs is none of the stored trial's.
    trial = ids["telling"]
    done = avoidbench("export", "mcap", "f.db", trial, "--library", "straight_line", "--output", "other.mcap", code=1)
    assert "no file is written" in done.stderr, done.stderr
    # Without the planner.
    (folder / "telling.so").unlink()
    done = avoidbench("export", "mcap", "f.db", trial, "--output", "other.mcap", code=2)
    assert "--stored-only" in done.stderr, done.stderr
    done = avoidbench("export", "mcap", "f.db", trial, "--stored-only", "--output", "other.mcap")
    assert "left out" in done.stderr, done.stderr
    assert sorted(path.name for path in folder.glob("*.part*")) == []
    shutil.rmtree(folder)
    print("read as written, by others' readers")


if __name__ == "__main__":
    main()
