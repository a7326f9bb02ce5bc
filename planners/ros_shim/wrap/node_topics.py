"""What the nodes of a launch file say and hear, read from their sources, and which of the nodes plan: those that the
command comes from, as far back as what avoidbench itself gives."""

import re

from workspace import program_of, text_of

ADVERTISE = re.compile(r"(\w+)\s*(?:\.|->)\s*advertise\s*<\s*([\w:]+)\s*>\s*\(\s*([^,;]+?)\s*,")
SUBSCRIBE = re.compile(r"(\w+)\s*(?:\.|->)\s*subscribe\s*(?:<\s*([\w:]+)[^;()]*?>)?\s*\(\s*([^,;]+?)\s*,([^;]*);")
FILTER = re.compile(r"Subscriber\s*<\s*([\w:]+)\s*>\s*\w*\s*[({]\s*\*?(\w+)\s*,\s*([^,;]+?)\s*,")
FILTER_NAME = re.compile(r"Subscriber\s*<\s*([\w:]+)\s*>\s*(\w+)\s*;")
PRIVATE = re.compile(r"NodeHandle\s+(\w+)\s*[({]\s*\"~\"|(\w+)\s*=\s*ros::NodeHandle\s*\(\s*\"~\"|(\w+)\(\s*\"~\"\s*\)")
PUBLIC = re.compile(r"NodeHandle\s+(\w+)\s*(?:;|\(\s*\))")
FUNCTION = re.compile(r"&\s*(?:\w+\s*::\s*)*(\w+)|^\s*(\w+)\s*[,)]")
# The beginning of a class's method, or of the class itself.
OWNER = re.compile(r"\b(\w+)\s*::\s*~?\w+\s*\([^;{}]*\)[^;{}]*\{|\bclass\s+(\w+)[^;{}()]*\{")
LITERAL = re.compile(r'(?:std::string\s*\(\s*)?"([^"]*)"\s*\)?')

# The commands that avoidbench takes, the most telling first.
COMMANDS = ["PositionCommand", "PositionTarget", "AttitudeTarget", "MultiDOFJointTrajectory", "TwistStamped", "Twist"]
# What avoidbench gives itself: a node that makes these is a driver, an estimator or a simulator.
GIVEN = {"nav_msgs/Odometry", "sensor_msgs/Image", "sensor_msgs/Imu"}
# Names of packages and nodes that stand beside a planner.
BESIDE = re.compile(
    r"sim|gazebo|rviz|visuali|render|generator|mock|sensing|fake|joy|control|px4|mavros|rqt|bag|take_?over"
)


class Topic:
    """One that a node says or hears. `name` is as ROS resolves it; `kind` is the message's type, or None if unknown."""

    def __init__(self, node, name, kind, place):
        self.node, self.name, self.kind, self.place = node, name, kind, place

    def last(self):
        return self.kind.rpartition("/")[2] if self.kind else ""


class NodeTopics:
    def __init__(self):
        self.says, self.hears = [], []
        self.unknown = []  # (what, place): names that the sources alone don't tell
        self.uses_tf = False


def resolved(node, name, is_private=False):
    """A name as roscpp makes it of what a node was given, without remappings."""
    if name.startswith("/"):
        return name
    space = node.namespace.rstrip("/")
    if name.startswith("~") or is_private:
        return f"{space}/{node.name}/{name.lstrip('~/')}"
    return f"{space}/{name}"


def remapped(node, name, may_be_private=False):
    """A name of the sources as it is after the launch file's remappings. Which handle a relative name belongs to, the
    sources don't always say: a remapping does."""
    table = {resolved(node, one): resolved(node, to) for one, to in node.remappings.items()}
    private, public = resolved(node, name, True), resolved(node, name)
    for one in (private, public) if may_be_private else (public, private):
        if one in table:
            return table[one]
    return private if may_be_private else public


def message_type(text):
    """nav_msgs::OdometryConstPtr -> nav_msgs/Odometry; None for what is no message."""
    text = re.sub(r"(::)?(ConstPtr|Ptr)$", "", text.strip())
    package, _, name = text.strip(":").rpartition("::")
    return f"{package}/{name}" if package and "::" not in package and package not in ("std", "boost", "Eigen") else None


def _callback_type(text, after):
    """The message's type by the parameter of the function that is named after the topic."""
    function = FUNCTION.search(after.partition(",")[2])
    if function is None:
        lambda_type = re.search(r"\(\s*(?:const\s+)?([\w:]+)", after)
        return message_type(lambda_type[1]) if lambda_type else None
    name = function[1] or function[2]
    for found in re.finditer(rf"\b{name}\s*\(\s*(?:const\s+)?(?:boost::shared_ptr<\s*)?(?:const\s+)?([\w:]+)", text):
        kind = message_type(found[1])
        if kind:
            return kind
    return None


def _name_of(expression, text, node):
    """The text of a topic's name: a literal, or a variable that is set to one or read from a parameter; or None."""
    literal = LITERAL.fullmatch(expression)
    if literal:
        return literal[1]
    variable = re.sub(r"^this->|\.c_str\(\)$", "", expression)
    if not re.fullmatch(r"\w+", variable):
        return None
    read = re.search(
        rf'(?:getParam|param)\s*(?:<[^>;]*>)?\s*\(\s*[^;"]*"([^"]+)"\s*,\s*(?:this->)?{variable}\s*(?:,\s*(?:std::string\s*\(\s*)?"([^"]*)")?',
        text,
    )
    if read:
        for name, value in node.params.items():
            if isinstance(value, str) and ("/" + name).endswith("/" + read[1].strip("~/")):
                return value
        if read[2] is not None:
            return read[2]
    found = re.search(rf'\b{variable}\s*(?:=|\{{|\()\s*"([^"]+)"', text)
    return found[1] if found else None


def _handles(text):
    """(private, public): the names of node handles that this text makes. A member that is assigned is neither."""
    private = {one for match in PRIVATE.findall(text) for one in match if one}
    public = {one for one in PUBLIC.findall(text) if not re.search(rf"\b{one}\s*(=[^=]|\(\s*\w)", text)}
    return private, public - private


class _Sources:
    """The sources that a node's executable reaches, without comments."""

    def __init__(self, program, node):
        self.node, self.own = node, set(program.own)
        self.texts = {file: text_of(file) for file in program.files}
        self.everything = "\n".join(self.texts.values())
        self.main_private, self.main_public = _handles("\n".join(self.texts[one] for one in program.own))
        self.filters = {name: kind for kind, name in FILTER_NAME.findall(self.everything)}

    def read(self, file, found):
        """Adds what one file says and hears."""
        text = self.texts[file]
        private, public = _handles("\n".join(one for other, one in self.texts.items() if other.stem == file.stem))

        def add(into, handle, expression, kind, at):
            if file not in self.own and self.is_of_unused_class(file, at):
                return
            place = f"{file}:{text.count(chr(10), 0, at) + 1}"
            name = _name_of(expression, self.everything, self.node)
            if name is None:
                found.unknown.append((f"{kind or 'a message'} on {expression}", place))
                return
            is_main = handle not in public and bool(self.main_private) and not self.main_public
            into.append(Topic(self.node, remapped(self.node, name, handle in private or is_main), kind, place))

        for match in ADVERTISE.finditer(text):
            add(found.says, match[1], match[3], message_type(match[2]), match.start())
        for match in SUBSCRIBE.finditer(text):
            if match[1] in self.filters:  # filter.subscribe(nh, "name", 1)
                name = match[4].split(",")[0].strip()
                add(found.hears, match[3], name, message_type(self.filters[match[1]]), match.start())
            else:
                kind = message_type(match[2]) if match[2] else _callback_type(self.everything, match[4])
                add(found.hears, match[1], match[3], kind, match.start())
        for match in FILTER.finditer(text):
            add(found.hears, match[2], match[3], message_type(match[1]), match.start())

    def is_of_unused_class(self, file, at):
        """Whether the function around this place is a member of a class that no other file names."""
        owner = None
        for match in OWNER.finditer(self.texts[file], 0, at):
            owner = match
        others = (one for other, one in self.texts.items() if other.stem != file.stem)
        return owner is not None and not any(re.search(rf"\b{owner[1] or owner[2]}\b", one) for one in others)


def topics_of(packages, node):
    """What a node says and hears, by the sources that its executable reaches; None where it has none."""
    program = program_of(packages, node)
    if program is None:
        return None
    found, sources = NodeTopics(), _Sources(program, node)
    found.uses_tf = re.search(r"\b(tf2_ros|tf)::TransformListener\b", sources.everything) is not None
    for file in sources.texts:
        sources.read(file, found)
    return found


def stands_beside(node):
    return BESIDE.search(node.package.lower()) or BESIDE.search(node.name.lower())


def command_of(topics):
    """The topic that commands come out at, of all nodes' topics; or None."""
    said = [one for node, each in topics.items() for one in each.says if not stands_beside(node)]
    for kind in COMMANDS:
        found = [one for one in said if one.last() == kind]
        if found:
            return found[0]
    found = [
        one
        for one in said
        if one.kind == "geometry_msgs/PoseStamped" and re.search("cmd|command|setpoint|target", one.name)
    ]
    return found[0] if found else None


def planning_nodes(topics, command):
    """The nodes that the command depends on, as far back as what avoidbench gives; in the launch file's order."""
    kept, left = {command.node}, [command.node]
    while left:
        for heard in topics[left.pop()].hears:
            for node, each in topics.items():
                says = [one for one in each.says if one.name == heard.name]
                makes_data = any(one.kind in GIVEN for one in each.says)
                if says and node not in kept and not makes_data and not stands_beside(node):
                    kept.add(node)
                    left.append(node)
    return [node for node in topics if node in kept]


def inputs_of(topics, nodes):
    """What these nodes hear and none of them says, one of each name."""
    said = {one.name for node in nodes for one in topics[node].says}
    found = {}
    for node in nodes:
        for one in topics[node].hears:
            if one.name not in said and (one.name not in found or found[one.name].kind is None):
                found[one.name] = one
    return list(found.values())
