"""Reads catkin packages: which there are, what each executable and library is made of, what they depend on. CMake files
are read, not run: conditions are taken to hold, and words with variables of others are left out."""

import functools
import pathlib
import re
from xml.etree import ElementTree

SKIPPED = {"build", "devel", "install", "logs", ".git"}
SOURCES = {".cpp", ".cc", ".cxx", ".c"}
COMMAND = re.compile(r"(\w+)\s*\(((?:[^()\"]|\"[^\"]*\"|\((?:[^()]|\([^()]*\))*\))*)\)")
WORD = re.compile(r'"([^"]*)"|([^\s"]+)')
INCLUDE = re.compile(r'#\s*include\s*[<"]([^>"]+)[>"]')
MAIN = re.compile(r"\bint\s+main\s*\(")
# What avoidbench_ros_planner() compiles against anyway, or what is of no use there.
WITHOUT = {"catkin", "Eigen3", "Eigen", "Threads", "OpenMP", "cmake_modules", "cmake_utils", "PkgConfig"}


class Package:
    def __init__(self, name, folder):
        self.name, self.folder = name, folder
        self.executables, self.libraries = {}, {}  # target -> sources
        self.linked = {}  # target -> words of target_link_libraries
        self.depends, self.finds = set(), {}  # packages; of find_package name -> components
        self.includes, self.definitions, self.standard = [], [], 0
        self.has_messages = any(any(folder.glob(one)) for one in ("msg/*.msg", "srv/*.srv", "cfg/*.cfg"))


def find_packages(workspace):
    """All packages below a folder, by name; of two of one name that which lies less deep."""
    packages = {}
    for file in sorted(workspace.rglob("package.xml"), key=lambda one: (len(one.parts), one)):
        inner = file.relative_to(workspace).parts[:-1]
        ignored = any((folder / "CATKIN_IGNORE").exists() for folder in (file.parent, *file.parents[: len(inner)]))
        if SKIPPED & set(inner) or ignored:
            continue
        text = file.read_text(errors="replace")
        name = re.search(r"<name>\s*([\w-]+)\s*</name>", text)
        if name and name[1] not in packages:
            packages[name[1]] = _package(name[1], file)
    return packages


def _package(name, file):
    package = Package(name, file.parent)
    try:
        for element in ElementTree.parse(file).getroot():
            if element.tag.endswith("depend") and element.text:
                package.depends.add(element.text.strip(" >\n\t"))
    except ElementTree.ParseError:
        pass  # what CMakeLists.txt names is known all the same
    if (file.parent / "CMakeLists.txt").exists():
        _read_cmake(package, file.parent, {"PROJECT_NAME": name})
    if (file.parent / "include").is_dir():
        package.includes.insert(0, file.parent / "include")
    package.includes = list(dict.fromkeys(package.includes))
    return package


def _words(text, variables):
    """The words of a command, with variables filled in; those with unknown ones are left out."""
    words = []
    for match in WORD.finditer(text):
        word = match[1] if match[1] is not None else match[2]
        for _ in range(5):  # ${${PROJECT_NAME}_X}
            word = re.sub(r"\$\{(\w+)\}", lambda name: variables.get(name[1], name[0]), word)
        if "$" not in word:
            words += word.split(";")
    return [word for word in words if word]


def _read_cmake(package, folder, variables):
    text = (folder / "CMakeLists.txt").read_text(errors="replace")
    text = re.sub(r"#\[\[.*?\]\]", "", text, flags=re.S)
    text = re.sub(r"#[^\n]*", "", text)
    variables["CMAKE_CURRENT_SOURCE_DIR"] = variables["CMAKE_CURRENT_LIST_DIR"] = str(folder)
    for own in ("PROJECT_SOURCE_DIR", "CMAKE_SOURCE_DIR"):
        variables.setdefault(own, str(folder))
    for match in COMMAND.finditer(text):
        _command(package, folder, match[1].lower(), _words(match[2], variables), variables)
    package.standard = max([package.standard, *_standards(text)])


def _standards(text):
    found = re.findall(r"-std=(?:c|gnu)\+\+(\w\w)|CMAKE_CXX_STANDARD\s+(\d\d)|cxx_std_(\d\d)", text)
    years = {"0x": 11, "1y": 14, "1z": 17, "2a": 20}
    return [years.get(one, 0) or int(one) for row in found for one in row if one in years or one.isdigit()]


def _sources(folder, words):
    return [
        (folder / one).resolve() for one in words if pathlib.Path(one).suffix in SOURCES and (folder / one).is_file()
    ]


def _command(package, folder, name, words, variables):
    if not words:
        return
    first, rest = words[0], words[1:]
    if name == "project":
        variables["PROJECT_NAME"] = first
    elif name == "set":
        variables[first] = ";".join(rest)
    elif name == "file" and first.startswith("GLOB") and rest:
        find = folder.rglob if first.endswith("RECURSE") else folder.glob
        patterns = [one.removeprefix(str(folder) + "/") for one in rest[1:] if not one.startswith("CONFIGURE")]
        found = [file for one in patterns if not one.startswith("/") for file in sorted(find(one))]
        variables[rest[0]] = ";".join(map(str, found))
    elif name == "aux_source_directory" and rest:
        variables[rest[0]] = ";".join(map(str, sorted((folder / first).glob("*.c*"))))
    elif name in ("add_executable", "cuda_add_executable", "catkin_add_executable"):
        package.executables[first] = _sources(folder, rest)
    elif name in ("add_library", "cuda_add_library"):
        package.libraries[first] = _sources(folder, rest)
        if name.startswith("cuda") or any(one.endswith(".cu") for one in rest):
            package.finds["CUDA"] = []
    elif name == "target_link_libraries":
        package.linked.setdefault(first, []).extend(one for one in rest if one.upper() != one)
    elif name == "set_target_properties" and "OUTPUT_NAME" in rest[:-1]:
        if first in package.executables:
            package.executables[rest[rest.index("OUTPUT_NAME") + 1]] = package.executables[first]
    elif name == "find_package":
        components = rest[rest.index("COMPONENTS") + 1 :] if "COMPONENTS" in rest else []
        if first == "catkin":
            package.depends.update(components)
        elif first not in WITHOUT:
            package.finds[first] = components
    elif name in ("include_directories", "target_include_directories"):
        found = [(folder / one).resolve() for one in words if (folder / one).is_dir()]
        package.includes += [one for one in found if one.is_relative_to(package.folder)]
    elif name in ("add_definitions", "add_compile_definitions"):
        package.definitions += [one.removeprefix("-D") for one in words if re.fullmatch(r"(-D)?\w+(=\S*)?", one)]
    elif name == "target_compile_definitions":
        package.definitions += [one for one in rest if one not in ("PUBLIC", "PRIVATE", "INTERFACE")]
    elif name == "add_subdirectory" and (folder / first / "CMakeLists.txt").is_file():
        _read_cmake(package, (folder / first).resolve(), dict(variables))


def needed_packages(packages, name):
    """The packages of the workspace that this one depends on, itself first."""
    found, left = [], [name]
    while left:
        one = left.pop(0)
        if one in packages and one not in found:
            found.append(one)
            left += sorted(packages[one].depends)
    return found


class Program:
    """What a node is compiled of: `sources`, its executable's and those of the libraries that it reaches; of these and
    of the headers `files` are what it includes, from header to source of the same name."""

    def __init__(self, own, sources, files):
        self.own, self.sources, self.files = own, sources, files


def program_of(packages, node):
    """The program of a node, or None where its sources are not in the workspace."""
    own = packages[node.package].executables.get(node.program) if node.package in packages else None
    if not own:
        return None
    names = needed_packages(packages, node.package)
    headers = headers_of(packages, names)
    libraries = [one for name in names for one in packages[name].libraries.values()]
    by_stem = {}
    for source in [one for library in libraries for one in library]:
        by_stem.setdefault(source.stem, []).append(source)
    files, left = [], list(own)
    while left:
        file = left.pop(0)
        if file in files:
            continue
        files.append(file)
        for included in includes_of(file):
            left += [one for one in headers if str(one).endswith("/" + included)]
            left += by_stem.get(pathlib.Path(included).stem, [])
    # Of a library all or nothing: what its sources call of each other no header tells.
    sources = list(own)
    for library in libraries:
        if any(one in files for one in library):
            sources += [one for one in library if one not in sources and not has_main(one)]
    return Program(own, sources, files)


def has_main(source):
    return MAIN.search(text_of(source)) is not None


@functools.cache
def text_of(source):
    """Without comments, in the same lines: what is commented out subscribes to nothing."""
    text = source.read_text(errors="replace")
    return re.sub(r"//[^\n]*|/\*.*?\*/", lambda one: "\n" * one[0].count("\n"), text, flags=re.S)


@functools.cache
def includes_of(file):
    """What a file includes on every system: not what stands between #if and #endif, include guards aside."""
    found, depth, is_guarded = [], 0, False
    for line in text_of(file).splitlines():
        word = re.match(r"\s*#\s*(if|ifdef|ifndef|endif|include)\b", line)
        if word is None:
            continue
        if word[1] == "include":
            found += INCLUDE.findall(line) if depth == is_guarded else []
        elif word[1] == "endif":
            depth -= 1
        else:
            is_guarded = is_guarded or (word[1] == "ifndef" and depth == 0 and not found)
            depth += 1
    return found


def headers_of(packages, names):
    """All headers of these packages."""
    return [
        file
        for name in names
        for folder in packages[name].includes
        for file in sorted(folder.rglob("*.h*"))
        if file.suffix in (".h", ".hpp", ".hh", ".hxx")
    ]
