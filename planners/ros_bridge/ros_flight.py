"""Flights of real ROS nodes: a master, the bridge's own node in this process, the clock, and one trial after the
other."""

import difflib
import math
import os
import statistics
import threading
import time
from xmlrpc.client import ServerProxy

import rosgraph
import roslib.message
import rospy
from commands import Commands
from live_file import evaluated, given_by
from observations import Observations, time_of
from ros_processes import Nodes, StartProblem, environment, start_master
from rosgraph_msgs.msg import Clock

NAME = "avoidbench"
FIRST_S = 100  # ROS time when the clock begins, at the earliest
NEXT = f"/{NAME}/next_clock_s"  # a parameter: on a running master's nodes ROS time never goes back
LOOK_S = 0.02
TELL_EACH_S = 10.0


class RosFlight:
    def __init__(self, live_file, setup):
        self._file, self._live, self._setup = live_file, live_file.live, setup
        self._wait = threading.Condition()
        self._problem = None
        self._arrived = (0.0, 0)  # of the newest command: when on the wall's clock, and its stamp
        self._now_ns = FIRST_S * 10**9
        self._period_ns = max(1000000, round(1e9 * setup.plan_period_s))
        self._round_trips_s, self._calls, self._tell_at_s = [], 0, TELL_EACH_S
        self._commands = Commands(live_file.command, setup.plan_period_s, setup.gravity_mps2)
        self._master_process = None
        uri = os.environ.get("ROS_MASTER_URI", "http://localhost:11311")
        if self._live.has_own_master:
            self._master_process, uri = start_master(self._live.start_wait_s)
        os.environ.update(environment(uri, self._live.has_own_master))
        self._master = rosgraph.Master(f"/{NAME}")
        if not self._live.has_own_master:
            self._look_at_master(uri)
        self._nodes = Nodes(live_file, uri)
        self._is_started = False
        message = roslib.message.get_message_class(live_file.command.type)
        if message is None:
            raise StartProblem(
                str(
                    live_file.command.values["type"].problem(
                        f"there is no Python class of {live_file.command.type}: is its package installed, or its "
                        f"workspace sourced?"
                    )
                )
            )
        self._master.setParam("/use_sim_time", True)
        # Of the clock only the nodes know: this node waits for the wall's.
        rospy.init_node(NAME, argv=[NAME], disable_rostime=True, disable_rosout=True, disable_signals=True)
        self._clock = rospy.Publisher("/clock", Clock, queue_size=1000, tcp_nodelay=True)
        self._observations = Observations(live_file.published, setup)
        self._command = rospy.Subscriber(live_file.command.topic, message, self._take, queue_size=100, tcp_nodelay=True)

    def _look_at_master(self, uri):
        try:
            self._master.getPid()
        except OSError:
            raise StartProblem(
                f"no master answers at {uri} (ROS_MASTER_URI): start roscore and the nodes before the run"
            ) from None
        try:
            node = self._master.lookupNode(f"/{NAME}")
            ServerProxy(node).getPid(f"/{NAME}")
        except (OSError, rosgraph.MasterException):
            return
        raise StartProblem(f"another flight uses the master at {uri}: nodes that run already fly with --jobs 1")

    # What the nodes say.

    def _take(self, message):
        with self._wait:
            try:
                self._commands.take(message, self._now_ns)
            except (ValueError, AttributeError) as problem:
                self._problem = problem
            header = getattr(message, "header", None)
            self._arrived = (time.monotonic(), header.stamp.to_nsec() if header is not None else 0)
            self._wait.notify_all()

    def _check(self):
        self._nodes.check()
        if self._problem is not None:
            raise self._problem

    # The clock.

    def _tick(self, to_ns):
        self._now_ns = to_ns
        self._clock.publish(Clock(clock=time_of(to_ns)))

    def _move_to(self, to_ns, rate, samples=()):
        """In steps, each with its pause, so that timers of nodes run; samples, as (ROS time, what publishes it), come
        at their times."""
        begin, begin_ns, step_ns = time.monotonic(), self._now_ns, round(1e9 * self._live.clock_step_s)
        i = 0
        while self._now_ns < to_ns or i < len(samples):
            due_ns = min(self._now_ns + step_ns, to_ns)
            if i < len(samples) and samples[i][0] <= due_ns:
                due_ns = max(self._now_ns, samples[i][0])
            if due_ns > self._now_ns:
                self._tick(due_ns)
            while i < len(samples) and samples[i][0] <= self._now_ns:
                samples[i][1]()
                i += 1
            if rate > 0.0:
                pause_s = begin + 1e-9 * (self._now_ns - begin_ns) / rate - time.monotonic()
                if pause_s > 0.0:
                    time.sleep(pause_s)
            elif i == len(samples) and self._now_ns >= to_ns:
                break
            self._check()

    # The start of a trial.

    def _set_parameters(self, mission):
        given = given_by(self._setup, mission)
        own = [self._setup.parameters[one.name] for one in self._file.parameters]
        leaves = [
            *self._nodes.launch_parameters.items(),
            *((name, evaluated(value, given, own)) for name, value in self._file.leaves),
        ]
        for name, value in leaves:
            if isinstance(value, int) and not isinstance(value, bool) and not -(2**31) <= value < 2**31:
                value = float(value)  # the parameter server has whole numbers of 32 bits
            self._master.setParam(name, value)

    def _missing(self):
        """Who is not there yet, in words; "" where all are."""
        heard, said = self._file.topics_to_wait_for()
        _, subscribers, _ = self._master.getSystemState()
        registered = {topic: len([name for name in names if name != f"/{NAME}"]) for topic, names in subscribers}
        missing = [
            f"nobody publishes {topic} ({self._file.command.type})"
            for topic in said
            if self._command.get_num_connections() == 0
        ]
        missing += [
            f"nobody subscribes to {topic}"
            for topic in heard
            if self._observations.connections(topic)
            < max(1, registered.get(rosgraph.names.resolve_name(topic, "/"), 0))
        ]
        return ", ".join(dict.fromkeys(missing))

    def _near(self, missing):
        """Topics of the nodes that are named like missing ones."""
        publishers, subscribers, _ = self._master.getSystemState()
        topics = {topic for topic, names in publishers + subscribers if set(names) - {f"/{NAME}"}} - {
            "/rosout",
            "/clock",
        }
        near = sorted(
            {
                one
                for word in missing.split()
                if word.startswith("/")
                for one in difflib.get_close_matches(word, topics, 3, 0.5)
            }
        )
        return (
            f"; there is {', '.join(near)}" if near else f"; the nodes have {', '.join(sorted(topics)) or 'no topics'}"
        )

    def _wait_for_nodes(self):
        """They start while the clock goes with the wall's, and the vehicle hovers."""
        end, missing = time.monotonic() + self._live.start_wait_s, "?"
        shown_ns = 0
        while missing:
            self._move_to(self._now_ns + round(1e9 * LOOK_S), 1.0)
            if self._now_ns - shown_ns >= self._period_ns:
                self._observations.publish_start(1e-9 * (self._now_ns - self._base_ns))
                shown_ns = self._now_ns
            missing = self._missing()
            if missing and time.monotonic() > end:
                raise StartProblem(
                    f"after {self._live.start_wait_s:g} s (live: start_wait_s) {missing}{self._near(missing)}"
                )

    def begin(self, mission):
        """A trial: parameters, nodes, and lead_s in which the vehicle hovers."""
        if math.isnan(mission.command_latency_s) and self._live.clock_rate > 0.0:
            raise StartProblem(
                "latency: {mode: measured} would count the pauses of the clock: "
                "take latency: {ms: …}, or live: {clock_rate: 0}"
            )
        with self._wait:
            self._commands.forget()
        self._set_parameters(mission)
        if self._master.hasParam(NEXT):
            self._now_ns = max(self._now_ns, round(1e9 * self._master.getParam(NEXT)))
        self._base_ns = self._now_ns
        self._observations.begin(self._base_ns, mission)
        if not self._is_started:
            self._nodes.start()
            self._is_started = True
        self._wait_for_nodes()
        lead_ns = round(1e9 * self._file.lead_s)
        self._base_ns = math.ceil((self._now_ns + lead_ns) / 1e9) * 10**9
        self._observations.begin(self._base_ns, mission)
        self._master.setParam(NEXT, 1e-9 * self._base_ns + mission.time_limit_s + 10.0)
        for at_ns in range(self._base_ns - lead_ns, self._base_ns, self._period_ns):
            self._move_to(at_ns, self._live.clock_rate)
            self._observations.publish_start(1e-9 * (at_ns - self._base_ns))
        self._calls, self._round_trips_s, self._tell_at_s = 0, [], TELL_EACH_S

    # A call.

    def _is_answered(self, asked, stamp_ns):
        arrived, command_ns = self._arrived
        return arrived > asked and (command_ns == 0 or command_ns >= stamp_ns)

    def _wait_for_answer(self, asked, stamp_ns):
        """Until a command came that is of this observation or later, or for answer_wait_s."""
        end = asked + self._live.answer_wait_s
        with self._wait:
            while not self._is_answered(asked, stamp_ns) and time.monotonic() < end:
                self._wait.wait(min(LOOK_S, max(0.0, end - time.monotonic())))
                self._check()
            if self._is_answered(asked, stamp_ns):
                self._round_trips_s.append(self._arrived[0] - asked)

    def plan(self, seen):
        call_s = seen.time_s if math.isnan(seen.call_time_s) else seen.call_time_s
        to_ns = max(self._now_ns, self._observations.ns_of(call_s))
        self._move_to(to_ns, self._live.clock_rate, self._observations.samples(seen))
        asked = time.monotonic()
        self._observations.publish(seen, to_ns)
        self._wait_for_answer(asked, self._observations.ns_of(seen.time_s))
        self._check()
        self._calls += 1
        if call_s >= self._tell_at_s:
            self._tell(call_s)
        with self._wait:
            return self._commands.answer(self._now_ns, seen.q_world_body)

    def _tell(self, call_s):
        self._tell_at_s = call_s + TELL_EACH_S
        times_ms = [1e3 * one for one in self._round_trips_s]
        text = f"{len(times_ms)} of {self._calls} calls were answered in time"
        if times_ms:
            text += f", after {statistics.median(times_ms):.1f} ms (median; most {max(times_ms):.1f} ms)"
        print(f"[ros_bridge] until {call_s:.1f} s {text}", flush=True)

    def end(self):
        self._nodes.end()
        if self._master_process is not None:
            self._master_process.kill()
            self._master_process.wait()
