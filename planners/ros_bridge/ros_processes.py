"""A master of the flight's own and the nodes, as processes that end with the bridge."""

import ctypes
import os
import pathlib
import re
import select
import signal
import subprocess
import sys
import threading

HERE = pathlib.Path(__file__).resolve().parent
PR_SET_PDEATHSIG = 1
C_LIBRARY = ctypes.CDLL(None, use_errno=True)
COLOUR = re.compile(r"\x1b\[[0-9;]*m")
READER_WAIT_S = 0.3


class NodeEnded(Exception):
    """A node that should run has ended."""


class StartProblem(Exception):
    """The nodes do not come to where they can fly."""


def _die_with_parent():
    """In the child, before its program: SIGKILL when the bridge's thread ends that started it, which is the main
    one."""
    C_LIBRARY.prctl(PR_SET_PDEATHSIG, signal.SIGKILL)


def environment(master_uri, is_own):
    """The variables of nodes: no file of the user's is written, and with a master of one's own no other host is spoken
    to."""
    variables = {name: value for name, value in os.environ.items() if name != "AVOIDBENCH_PLANNER_FDS"}
    variables["ROS_MASTER_URI"] = master_uri
    # A folder that is there and that nobody can write to: what is said goes to the console.
    variables["ROS_LOG_DIR"] = variables["ROS_HOME"] = "/proc/self"
    variables["ROS_PYTHON_LOG_CONFIG_FILE"] = str(HERE / "console.conf")
    if is_own:
        variables.pop("ROS_HOSTNAME", None)
        variables["ROS_IP"] = "127.0.0.1"
    return variables


class Process:
    """One that was started: its lines go on to the bridge's output, each with its name."""

    def __init__(self, name, words, folder, variables, is_required=False):
        self.name, self.is_required = name, is_required
        self.was_refused = False
        try:
            self.process = subprocess.Popen(
                words,
                cwd=folder,
                env=variables,
                stdin=subprocess.DEVNULL,
                stdout=subprocess.PIPE,
                stderr=subprocess.STDOUT,
                preexec_fn=_die_with_parent,
            )
        except OSError as error:
            raise StartProblem(f"the node {name} can't be started: {words[0]}: {error.strerror}") from None
        self.reader = threading.Thread(target=self._read, daemon=True)
        self.reader.start()

    def _read(self):
        for line in self.process.stdout:
            text = COLOUR.sub("", line.decode("utf-8", errors="replace").rstrip())
            if text:
                self.was_refused = self.was_refused or "Permission denied" in text
                print(f"[{self.name}] {text}", flush=True)

    def problem(self):
        """Why it runs no more, or None. One that has done its work and says so by exit code 0 is fine, unless it is
        required."""
        code = self.process.poll()
        if code is None or (code == 0 and not self.is_required):
            return None
        self.reader.join(READER_WAIT_S)
        how = f"ended by signal {-code} ({signal.strsignal(-code)})" if code < 0 else f"ended with exit code {code}"
        hint = "; in the sandbox nodes write no files: run --no-sandbox lets them" if self.was_refused else ""
        return f"the node {self.name} {how}{hint}"

    def end(self):
        if self.process.poll() is None:
            self.process.kill()
        self.process.wait()


def start_master(wait_s):
    """The process and its URI."""
    process = subprocess.Popen(
        [sys.executable, str(HERE / "ros_master.py")],
        env=environment("http://127.0.0.1:0", True),
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE,
        preexec_fn=_die_with_parent,
    )
    ready, _, _ = select.select([process.stdout], [], [], wait_s)
    uri = process.stdout.readline().decode().strip() if ready else ""
    if not uri:
        process.kill()
        code = process.wait()
        how = "said nothing" if not ready else f"ended with exit code {code}"
        raise StartProblem(f"ROS's master {how}: is python3-rosmaster installed for {sys.executable}?")
    return process, uri


def _launched(words, folder, variables, place):
    """The nodes and parameters of a launch file, by roslaunch's own reader: ([(name, words, folder, variables,
    required)], parameters)."""
    os.environ.update(
        {name: variables[name] for name in ("ROS_MASTER_URI", "ROS_LOG_DIR", "ROS_HOME", "ROS_PYTHON_LOG_CONFIG_FILE")}
    )
    from roslaunch.config import ROSLaunchConfig
    from roslaunch.core import RLException, local_machine, setup_env
    from roslaunch.node_args import create_local_process_args
    from roslaunch.rlutil import resolve_launch_arguments
    from roslaunch.xmlloader import XmlLoader

    config = ROSLaunchConfig()
    try:
        words = [str(folder / words[0]), *words[1:]] if (folder / words[0]).is_file() else words
        file = resolve_launch_arguments(words)[0]
        loader = XmlLoader()
        loader.ignore_unset_args = False
        loader.load(file, config, argv=[word for word in words[1:] if ":=" in word], verbose=False)
        config.assign_machines()
        nodes = []
        for node in config.nodes:
            if node.machine_name not in (None, "", "localhost"):
                raise RLException(
                    f"{node.name} is for another machine, {node.machine_name}: all nodes of a flight run on this one"
                )
            command = create_local_process_args(node, local_machine())
            own = {**variables, **setup_env(node, local_machine(), variables["ROS_MASTER_URI"], env=variables)}
            name = f"{node.namespace}{node.name}".lstrip("/")
            nodes.append((name, command, folder, own, node.required))
    except Exception as problem:  # roslaunch has a dozen kinds
        raise StartProblem(str(place.problem(f"{words[0]}: {problem}"))) from None
    return nodes, {one.key: one.value for one in config.params.values()}


class Nodes:
    """All that a flight has started beside its master."""

    def __init__(self, live_file, master_uri):
        self._file = live_file
        self._variables = environment(master_uri, live_file.live.has_own_master)
        self._processes = []
        self._launch_nodes = []
        self.launch_parameters = {}
        if live_file.live.launch:
            self._launch_nodes, self.launch_parameters = _launched(
                live_file.live.launch, live_file.folder, self._variables, live_file.live.launch_place
            )

    def start(self):
        for node in self._file.nodes:
            if node.words:
                self._processes.append(
                    Process(node.full_name.lstrip("/"), node.words, self._file.folder, self._variables)
                )
        for node in self._launch_nodes:
            self._processes.append(Process(*node))

    def check(self):
        """Raises NodeEnded where one has ended that should run."""
        for process in self._processes:
            problem = process.problem()
            if problem is not None:
                raise NodeEnded(problem)

    def end(self):
        for process in self._processes:
            process.end()
        self._processes = []
