#!/usr/bin/env python3
"""check_generators.py SHIM: make_messages.py, make_configs.py and make_planner.py on good and on bad files; each
problem is told with its place."""

import pathlib
import subprocess
import sys
import tempfile

shim = pathlib.Path(sys.argv[1])
failures = []


def expect(what, condition, seen=""):
    if not condition:
        failures.append(f"{what}\n{seen}")


def run(script, *words):
    done = subprocess.run(
        [sys.executable, "-B", shim / script, *map(str, words)], capture_output=True, text=True, timeout=20
    )
    return done.returncode, done.stderr.strip(), done.stdout


# .msg text -> the problem, as line:column: text
BAD_MESSAGES = {
    "float64": '1:1: "float64" without a name',
    "float64 x\n\nfloat64 x": '3:9: "x" is there already',
    "float64 2x": '1:9: "2x" is no name: letters, digits and _, a letter first',
    "float64[-1] x": '1:1: "float64[-1]" is no type: as float64, geometry_msgs/Point, uint8[] or float64[9]',
    "float64[0] x": "1:1: an array of no elements",
    "  Poimt p": "1:3: there is no message own_msgs/Poimt: is its package among MESSAGES?",
    "geometry_msgs/Poimt p": "1:1: there is no message geometry_msgs/Poimt: is its package among MESSAGES?",
    "uint8 A=256": "1:9: 256 is not of uint8: from 0 to 255",
    "uint8 A = 1.5": '1:11: "1.5" is no whole number',
    "int32 class": '1:7: "class" is a word of C++',
    "float64 x 5": '1:11: "5" behind the name; ROS 1 has no defaults',
    "uint8 A=": "1:9: a constant without a value",
    "time T=1": "1:8: a constant can't be a time",
    "uint8[2] A=1": "1:1: a constant is of a built-in type and no array",
    "Bad inner": "1:1: own_msgs/Bad contains itself",
    "= 1": "1:1: a type and a name come before =",
}
GOOD_MESSAGE = """# all that there is
bool YES=true
int8 LOW = -128   # a comment
uint64 MOST=18446744073709551615
float32 HALF=0.5
string WORDS= "quoted" # and all that is left
Header header
time stamp
duration[] periods
char c
byte b
geometry_msgs/Point[3] corners
Other[] others
string name
"""
BAD_SERVICES = {
    "bool a\n": "2:1: no --- between the request and the response",
    "bool a\n---\n---\n": "3:1: a second ---: a service has a request and a response",
    "bool a\n---\nboool b\n": "3:1: there is no message named_srvs/boool: is its package among MESSAGES?",
}
BAD_CONFIGS = {
    "gen.add('a', double_t, 0, 'a', 'fast')\n": "3: default of a is 'fast', which is no double",
    "gen.add('a', int_t, 0, 'a', 1.5)\n": "3: default of a is 1.5, which is no int",
    "gen.add('a', int_t, 0, 'a', 2**31)\n": "3: default of a is 2147483648, which is beyond 32 bits",
    "gen.add('a', int_t, 0, 'a', float('inf'))\n": "3: OverflowError: cannot convert float infinity to integer",
    "gen.add('a', bool_t, 0, 'a', 2)\n": "3: default of a is 2, which is no bool",
    "gen.add('a', double_t, 0, 'a', 1, 3, 2)\n": "3: min of a is above its max",
    "gen.add('a', str_t, 0, 'a', 'b', max='c')\n": '3: "a" is a text: it has no min and no max',
    "gen.add('a', str_t, 0, 'a', 'b\\0c')\n": "3: default of a has a character that can't stand in a text",
    "gen.add('a', 'float', 0, 'a')\n": '3: "float" is no type: int_t, double_t, str_t, bool_t',
    "gen.add('a b', int_t, 0, 'a')\n": '3: "a b" is no name of a parameter: letters, digits and _, a letter first',
    "gen.add('class', int_t, 0, 'a')\n": '3: "class" is a word of C++',
    "g = gen.add_group('G')\ngen.add('a', int_t, 0, 'a')\ng.add('a', int_t, 0, 'a')\n": '5: "a" is there already',
    "gen.const('A', int_t, 1, 'a')\ngen.const('A', int_t, 1, 'a')\n": '4: "A" is there already',
    "gen.add('a', int_t, 'x', 'a')\n": "3: the level of a is 'x', which is no int",
    "gen.add('a')\n": "3: TypeError: ",
    "print 'a'\n": "3: Missing parentheses in call to 'print'. ",
    "def f():\n  f()\n\nf()\n": "4: RecursionError: ",
    "import no_such_module\n": "3: ModuleNotFoundError: No module named 'no_such_module'",
    "pass\n": "3: it ends without generate(PACKAGE, node, name)",
    "exit(gen.generate('own pkg', 'node', 'Bad'))\n": '3: "own pkg" is no name of a package: ',
    "gen.generate('own', 'n', 'A')\ngen.generate('own', 'n', 'B')\n": "4: a second generate()",
}
CONFIG = "from dynamic_reconfigure.parameter_generator_catkin import *\ngen = ParameterGenerator()\n"
GOOD_CONFIG = """#!/usr/bin/env python
PACKAGE = 'named_cfgs'
import roslib; roslib.load_manifest(PACKAGE)
from math import pi
from dynamic_reconfigure.parameter_generator_catkin import *
gen = ParameterGenerator()
print("of no interest")
sizes = gen.enum([gen.const("Small", int_t, 0, "a"), gen.const("Words", str_t, '"b"', "b")], "Sizes")
gen.add("size", int_t, 1, "", 0, 0, 3, edit_method=sizes)
angles = gen.add_group("Angles", type="tab", state=False).add_group("Inner")
angles.add("angle", double_t, -1, "", 0.5 * pi, -pi)
gen.add("none", bool_t, 2, "")
exit(gen.generate(PACKAGE, "a_node", "Good"))
"""
GOOD_TOPICS = """nodes:
  - name: planner
    params: {gain: "${2 * max_speed_mps}"}
publish:
  odometry: {topic: /odom}
command: {topic: /cmd, type: geometry_msgs/Twist}
"""
# (what is replaced, by what) -> the problem
BAD_TOPICS = {
    ("  odometry: {topic: /odom}", "  odometri: {topic: /odom}"): '5:3: "odometri" is none of odometry, ',
    ("topic: /odom}", "topic: /odom, frames: a}"): '5:28: there is no "frames" here; did you mean frame?',
    ("topic: /odom}", "topic: /odom, all_states: 1}"): '5:40: "1" is neither true nor false',
    ("publish:", "world: {yaw: 1}\npublish:"): '4:9: there is no "yaw" here; did you mean yaw_rad?',
    ("publish:", "world: {x_m: left}\npublish:"): "4:14: x_m is a number, or ${…} of numbers",
    ("publish:", 'world: {x_m: "${start_q_m}"}\npublish:'): '4:14: "start_q_m" is nothing that a trial gives: ',
    ("name: planner", "name: other"): "2:11: no source other.cpp among SOURCES",
    ("max_speed_mps}", "max_sped_mps}"): '3:20: "max_sped_mps" is nothing that a trial gives: ',
    ("2 * max_speed_mps", "2 **"): '3:20: "2 **" is no expression',
    ("geometry_msgs/Twist", "geometry_msgs/Point"): "6:30: Point is none of PositionCommand, ",
    ("type: geometry_msgs/Twist", "type: Twist"): '6:30: "Twist" is no type of a message, as geometry_msgs/Twist',
    ("publish:", "publis:"): '4:1: there is no "publis" here; did you mean publish?',
    ("nodes:", "lead_s: soon\nnodes:"): '1:9: "soon" is no number',
    ("nodes:", "compute_clock_us: 0\nnodes:"): "1:19: 0 is not from 0.001 to ",
    (
        "nodes:",
        "parameters: [{name: compute_clock_us, default: 1, lowest: 1, highest: 9, doc: d}]\nnodes:",
    ): "1:21: each ROS planner has compute_clock_us: compute_clock_us: N sets its default",
    ("  odometry: {topic: /odom}", "  odometry: {topic: /odom"): "6:",
    ("  odometry: {topic: /odom}", "  cloud: {topic: /p, lidar: -1}"): "5:29: -1 is not from 0 to ",
    ("  odometry: {topic: /odom}", "  cloud: {topic: /p, lidar: top}"): '5:29: "top" is no number',
    (
        "  odometry: {topic: /odom}",
        "  cloud: {topic: /p, lidar: 0, points_in: map}",
    ): '5:43: "map" is none of world, body, lidar',
    (
        "  odometry: {topic: /odom}",
        "  cloud: {topic: /p, points_in: body}",
    ): "5:33: points_in is of a lidar's cloud: lidar: N says of which one",
    (
        "  odometry: {topic: /odom}",
        "  cloud: {topic: /p, lidar: 0, stride_px: 2}",
    ): "5:43: stride_px is of a depth image's cloud, and this one is a lidar's",
    ("command: {topic: /cmd,", "command: {ahead: 1, topic: /cmd,"): '6:11: there is no "ahead" here',
    ("  odometry: {topic: /odom}", "  message: {topic: /m}"): "5:20: a message has a type",
    ("  odometry: {topic: /odom}", "  message: {topic: /m, type: Empty}"): '5:30: "Empty" is no type of a message',
    (
        "  odometry: {topic: /odom}",
        "  message: {topic: /m, type: std_msgs/Empty, fields: {a b: 1}}",
    ): '5:55: "a b" is no name of a field',
    (
        "  odometry: {topic: /odom}",
        "  message: {topic: /m, type: std_msgs/Empty, when: soon}",
    ): '5:52: "soon" is none of goal, start',
    (
        "  odometry: {topic: /odom}",
        "  message: {topic: /m, type: std_msgs/Empty, every_s: 0}",
    ): "5:55: 0 is not from 0.001 to ",
}
PARAMETER = "parameters: [{name: a, default: %s, lowest: %s, highest: 9, doc: d}]\nnodes:"
ALIASES = "".join(f"      a{i}: &a{i} [{', '.join([f'*a{i - 1}'] * 10)}]\n" for i in range(1, 9))
NOT_BOUNDED = {
    ('params: {gain: "${2 * max_speed_mps}"}', "params: &p {gain: *p}"): "3:13: this contains itself",
    (
        'params: {gain: "${2 * max_speed_mps}"}',
        "params:\n      a0: &a0 [1, 1, 1, 1, 1, 1, 1, 1, 1, 1]\n" + ALIASES,
    ): "4:37: with its aliases the file has more than 50000 values",
    ('"${2 * max_speed_mps}"', "[" * 3000 + "]" * 3000): "3:66: this nests more than 50 deep",
    ('"${2 * max_speed_mps}"', "{a: " * 3000 + "1" + "}" * 3000): "3:201: this nests more than 50 deep",
    ("2 * max_speed_mps", "-" * 100_000 + "1"): "3:20: an expression has 1000 characters at most",
    ("2 * max_speed_mps", "-" * 900 + "1"): "3:20: this expression nests more than 100 deep",
    ("2 * max_speed_mps", "1+" * 400 + "1"): "3:20: this expression nests more than 100 deep",
    ("2 * max_speed_mps", "(" * 400 + "1" + ")" * 400): f'3:20: "{"(" * 57}..." is no expression',
    ("2 * max_speed_mps", "1" + "0" * 400): "3:20: a number in this expression is beyond the greatest number",
    ("2 * max_speed_mps", "1e999"): "3:20: a number in this expression is beyond the greatest number",
    ("nodes:", PARAMETER % ("1" * 5000, 0)): f"1:33: {'1' * 57}... is beyond the greatest number, 1.8e308",
    ("nodes:", PARAMETER % ("1" + "0" * 400, 0)): f"1:33: 1{'0' * 56}... is beyond the greatest number, 1.8e308",
    ("nodes:", PARAMETER % ("1e999", 0)): "1:33: 1e999 is beyond the greatest number, 1.8e308",
    ("nodes:", PARAMETER % (".nan", 0)): "1:33: nan is not finite",
    ("nodes:", PARAMETER % ("1", ".nan")): "1:44: nan is not finite",
    ("nodes:", PARAMETER % ("1", "-.inf")): "1:44: -inf is not finite",
    ("nodes:", 'version: "a\\0b"\nnodes:'): "1:10: the character U+0000 can't stand in a text",
    ("nodes:", 'summary: "\\ud83d"\nnodes:'): "1:10: the character U+D83D can't stand in a text",
    ("nodes:", 'summary: "\\UFFFFFFFF"\nnodes:'): "1:1: ",
    ("nodes:", 'summary: "\\U00110000"\nnodes:'): "1:1: ",
    ("nodes:", "#" * 300_000 + "\nnodes:"): " more than 256 KiB are no topics file",
}

with tempfile.TemporaryDirectory() as name:
    folder = pathlib.Path(name)
    package = folder / "own_msgs" / "msg"
    package.mkdir(parents=True)
    stock = [word for one in sorted((shim / "messages").iterdir()) for word in ("--known", one)]
    for text, problem in BAD_MESSAGES.items():
        (package / "Bad.msg").write_text(text + "\n")
        code, said, _ = run("make_messages.py", "--out", folder / "out", *stock, package.parent)
        expect(f"{text!r}: exit code 1", code == 1, said)
        expect(f"{text!r}: {problem}", said == f"{(package / 'Bad.msg').resolve()}:{problem}", said)
    (package / "Bad.msg").unlink()

    (package / "Good.msg").write_text(GOOD_MESSAGE)
    (package / "Other.msg").write_text("float64 x\n")
    code, said, _ = run("make_messages.py", "--out", folder / "out", *stock, package.parent)
    expect("a good message", code == 0, said)
    header = (folder / "out/own_msgs/Good.h").read_text()
    for line in (
        "enum { YES = 1 };",
        "enum { LOW = -128 };",
        "18446744073709551615ULL",
        "= 0.5F;",
        r'"\042quoted\042 # and all that is left"',
        "::std_msgs::Header_<ContainerAllocator> header;",
        "ros::Time stamp;",
        "std::vector<ros::Duration> periods;",
        "std::uint8_t c{};",
        "std::int8_t b{};",
        "ros_shim::array<::geometry_msgs::Point_<ContainerAllocator>, 3> corners{};",
        "std::vector<::own_msgs::Other_<ContainerAllocator>> others;",
        '#include "own_msgs/Other.h"',
        "using GoodConstPtr = ros_shim::shared_ptr<const Good>;",
    ):
        expect(f"{line} in the header", line in header, header)
    (package.parent / "package.xml").write_text("<package><name>named_msgs</name></package>")
    _, _, listed = run("make_messages.py", "--list", package.parent)
    expect(
        "a package's name is in its package.xml", listed.split() == ["named_msgs/Good.h", "named_msgs/Other.h"], listed
    )
    services = folder / "named_srvs" / "srv"
    services.mkdir(parents=True)
    for text, problem in BAD_SERVICES.items():
        (services / "Bad.srv").write_text(text)
        code, said, _ = run("make_messages.py", "--out", folder / "out", *stock, services.parent)
        expect(f"{text!r}: {problem}", code == 1 and said == f"{(services / 'Bad.srv').resolve()}:{problem}", said)
    (services / "Bad.srv").unlink()
    (services / "Plan.srv").write_text("geometry_msgs/Point goal\n---\nbool good  # or not\nnav_msgs/Path path\n")
    code, said, _ = run("make_messages.py", "--out", folder / "out", *stock, services.parent)
    expect("a good service", code == 0, said)
    made = {name: (folder / f"out/named_srvs/{name}.h").read_text() for name in ("Plan", "PlanRequest", "PlanResponse")}
    expect("a request", "::geometry_msgs::Point_<ContainerAllocator> goal;" in made["PlanRequest"], made)
    expect("a response", "::nav_msgs::Path_<ContainerAllocator> path;" in made["PlanResponse"], made)
    expect("a service", "using Response = PlanResponse;" in made["Plan"], made)
    configs = folder / "named_cfgs" / "cfg"
    configs.mkdir(parents=True)
    words = ("make_configs.py", "--out", folder / "out", configs.parent)
    for text, problem in BAD_CONFIGS.items():
        (configs / "Bad.cfg").write_text(CONFIG + text)
        code, said, _ = run(*words)
        expect(
            f"{text!r}: {problem}", code == 1 and said.startswith(f"{(configs / 'Bad.cfg').resolve()}:{problem}"), said
        )
    (configs / "Bad.cfg").write_bytes(b"# dynamic_reconfigure\n\0")
    code, said, _ = run(*words)
    expect("no text", code == 1 and said.startswith(f"{(configs / 'Bad.cfg').resolve()}:"), said)
    (configs / "Bad.cfg").write_text("[of: something else]\n")
    (configs / "Good.cfg").write_text(GOOD_CONFIG)
    code, said, printed = run(*words)
    expect("a good configuration", code == 0 and not said and not printed, said + printed)
    header = (folder / "out/named_cfgs/GoodConfig.h").read_text()
    for line in (
        "namespace named_cfgs {",
        "const int Good_Small = 0;",
        r'const char* const Good_Words = "\042b\042";',
        "made.angle = 1.5707963267948966;",
        "made.angle = -3.141592653589793;",
        "made.angle = std::numeric_limits<double>::infinity();",
        "made.none = false;",
        "level |= 4294967295U;",
        'node.getParam("size", size);',
    ):
        expect(f"{line} in the configuration", line in header, header)
    code, said, _ = run("make_messages.py", "--out", folder / "out", *stock, configs.parent)
    expect("a package of configurations alone has no messages", code == 0, said)
    code, said, _ = run("make_messages.py", "--out", folder / "out", folder / "nowhere")
    expect("a folder that is not there", code == 1 and said.endswith("nowhere: no such folder"), said)

    source = folder / "planner.cpp"
    source.write_text("#include <ros/ros.h>\nint main(int argc, char** argv) {}\n")
    topics = folder / "topics.yaml"
    words = ("--name", "good", "--topics", topics, "--out", folder / "made", source)
    for (old, new), problem in {**BAD_TOPICS, **NOT_BOUNDED}.items():
        expect(f"{old!r} is in the topics", old in GOOD_TOPICS)
        topics.write_text(GOOD_TOPICS.replace(old, new))
        code, said, _ = run("make_planner.py", *words)
        expect(f"{new[:100]!r}: exit code 1", code == 1, said[-1000:])
        expect(f"{new[:100]!r}: {problem}", said.startswith(f"{topics}:{problem}"), said[-1000:])
    topics.write_text(GOOD_TOPICS.replace("nodes:", 'summary: "\U0001f600 ??/ \\"1\\""\nnodes:'))
    code, said, _ = run("make_planner.py", *words)
    made = (folder / "made/good_planner.cpp").read_text()
    expect("a text beyond ASCII, in UTF-8", code == 0 and r'"\360\237\230\200 \077\077/ \0421\042"' in made, made)
    topics.write_text(GOOD_TOPICS)
    code, said, _ = run("make_planner.py", *words)
    expect("good topics", code == 0, said)
    made = (folder / "made/good_planner.cpp").read_text()
    expect("an expression", 'set_parameter("/planner/gain", Value((2.0 * given.vehicle_max_speed_mps)));' in made, made)
    expect("a main of its own name", "ros_shim_main_planner" in (folder / "made/main_planner.h").read_text())
    expect("one state a call is all that it sees", "AB_INPUT_STATES" not in made, made)
    topics.write_text(GOOD_TOPICS.replace("topic: /odom", "topic: /odom, all_states: true"))
    run("make_planner.py", *words)
    made = (folder / "made/good_planner.cpp").read_text()
    expect("all states", "AB_INPUT_STATES" in made and '"/odom", "world", "body", false, true' in made, made)
    expect("no points where none are published", "AB_INPUT_POINTS" not in made, made)
    clouds = "cloud: [{topic: /a, lidar: 1, frame: velodyne, points_in: lidar}, {topic: /b, lidar: 0}]"
    topics.write_text(GOOD_TOPICS.replace("odometry: {topic: /odom}", clouds))
    code, said, _ = run("make_planner.py", *words)
    made = (folder / "made/good_planner.cpp").read_text()
    expect("clouds of lidars", code == 0, said)
    expect("points are all that is seen beside the state", "AB_INPUT_POINTS | AB_INPUT_STATE, " in made, made)
    for line in (
        'spec.sweeps.push_back({"/a", "velodyne", PointsIn::lidar, 1});',
        'spec.sweeps.push_back({"/b", "world", PointsIn::world, 0});',
    ):
        expect(line, line in made, made)
    topics.write_text(GOOD_TOPICS.replace("odometry: {topic: /odom}", "cloud: {topic: /a, stride_px: 2}"))
    run("make_planner.py", *words)
    made = (folder / "made/good_planner.cpp").read_text()
    expect("a cloud of a depth image", "AB_INPUT_DEPTH | AB_INPUT_STATE, " in made, made)
    expect("is none of a lidar", 'spec.clouds.push_back({"/a", "world", 2, 0});' in made, made)
    fields = 'message: {topic: /m, type: own_msgs/Set, fields: {id: 1,\n     to: {x: "${goal_x_m}"}, names: [a]}}'
    topics.write_text(GOOD_TOPICS.replace("odometry: {topic: /odom}", fields))
    code, said, _ = run("make_planner.py", *words)
    made = (folder / "made/good_planner.cpp").read_text()
    for line in (
        '#include "own_msgs/Set.h"',
        f'#line 5 "{topics}"\n    assign(message.id, Value(1));',
        f'#line 6 "{topics}"\n    assign(message.to.x, Value(given.goal_x_m));',
        'assign(message.names, Value::list_of({Value(std::string("a"))}));',
        'spec.messages.push_back({"/m", false, 0.0, &advertise_0});',
    ):
        expect(line, code == 0 and line in made, said + made)
    expect("a message with the goal sees goals", "AB_INPUT_GOALS" in made, made)
    source.write_text("int Main() {}  // int main(int argc, char** argv)\n")
    code, said, _ = run("make_planner.py", *words)
    expect("a source without main()", code == 1 and "has no int main(" in said, said)

print("\n".join(failures) if failures else "all as it should be")
sys.exit(1 if failures else 0)
