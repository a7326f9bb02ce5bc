#!/usr/bin/env bash
# Writes a new planner to start from, which builds, flies and has a test: the files of planners/template with its name
# filled in. `avoidbench planners new` writes one outside this repository.
set -euo pipefail

usage() {
  cat <<'EOT'
usage: scripts/new_planner.sh NAME [--python]

Writes planners/NAME and tests/planners/NAME in this repository, built with everything else. With --python: a planner in Python, which
needs no build, a sweep that flies it, and its test.
NAME uses a-z, 0-9 and _ and begins with a letter. For a separate project: avoidbench planners new NAME
EOT
}

fail() {
  echo "new_planner.sh: $1" >&2
  exit 2
}

case "${1:-}" in
  -h | --help) usage; exit 0 ;;
  "") usage >&2; exit 2 ;;
esac
language=cpp
[ "$1" != --python ] || set -- "${@:2}" --python
if [ "${2:-}" = --python ]; then language=python; fi
[ $# -eq 1 ] || [ "$# $language" = "2 python" ] || { usage >&2; exit 2; }
name=$1
[[ $name =~ ^[a-z][a-z0-9_]*$ ]] || fail "invalid name '$name': use a-z, 0-9 and _, and begin with a letter"
case "$name" in
  avoidbench* | program | support | template | test | all | install | clean | help) fail "the build already uses the name '$name'" ;;
esac

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
class=$(sed -E 's/(^|_+)([a-z0-9])/\U\2/g; s/_//g' <<<"$name")
planner_folder=$root/planners/$name test_folder=$root/tests/planners/$name
for folder in "$planner_folder" "$test_folder"; do
  [ ! -e "$folder" ] || fail "$folder exists already; nothing was written"
done

# Writes the file $2 from the template $1, with the planner's names filled in.
write() { sed "s|@PLUGIN@|$plugin|g; s/@NAME@/$name/g; s/@CLASS@/$class/g" "$root/planners/template/$1" >"$2"; }

plugin=$name
[ $language = cpp ] || plugin=$name.py
mkdir -p "$planner_folder" "$test_folder"
if [ $language = python ]; then
  write planner.py.in "$planner_folder/$name.py"
  write README.md.in "$planner_folder/README.md"
  write sweep.yaml.in "$planner_folder/sweep.yaml"
  write repository_python_test_CMakeLists.txt.in "$test_folder/CMakeLists.txt"
  cat <<EOT
wrote planners/$name and tests/planners/$name. Next:
  build/release/avoidbench planners check planners/$name/$name.py
  build/release/avoidbench run planners/$name/sweep.yaml
  cmake --preset release && ctest --test-dir build/release -R ${name}_planner
EOT
  exit 0
fi
write planner.cpp.in "$planner_folder/$name.cpp"
write README.md.in "$planner_folder/README.md"
write repository_CMakeLists.txt.in "$planner_folder/CMakeLists.txt"
write repository_test_CMakeLists.txt.in "$test_folder/CMakeLists.txt"
write repository_test.cpp.in "$test_folder/${name}_test.cpp"
cat <<EOF
wrote planners/$name and tests/planners/$name. Next:
  cmake --preset release && cmake --build build/release --target $name ${name}_planner_tests
  ctest --test-dir build/release -R ${name}_planner
  build/release/avoidbench planners describe $name
EOF
