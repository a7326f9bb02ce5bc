#!/usr/bin/env bash
# lint.sh [FILE…|--all]: format and lint of every language; of C++ clang-format and clang-tidy over the given sources
# (clang-tidy over their neighbours too), or over all. Without arguments clang-tidy looks at what changed (changed_files.sh; of a changed header at its folder) and
# at a rotating sixteenth of the rest.
#   --format-only    no clang-tidy
# Both of version 14 only: others format otherwise and have other checks. Without it only torn comments are found, which
# is said.
set -euo pipefail
cd "$(dirname "$0")/.."

version=14
format_only=0 all=0 asked=()
for argument in "$@"; do
  case "$argument" in
    --format-only) format_only=1 ;;
    --all) all=1 ;;
    -*) echo "usage: $0 [--format-only] [--all | FILE…]" >&2; exit 2 ;;
    *) asked+=("$argument") ;;
  esac
done

# of_version PROGRAM: its name, with or without the number, where it is of the wanted version; else says so.
of_version() {
  local program
  for program in "$1-$version" "$1"; do
    if command -v "$program" >/dev/null && "$program" --version | grep -q "version $version\."; then
      echo "$program"
      return
    fi
  done
  echo "no $1 of version $version here ($("$1" --version 2>/dev/null | grep -o 'version [0-9.]*' || echo none)): not checked" >&2
}

files=("${asked[@]}")
[ ${#files[@]} -gt 0 ] || mapfile -t files < <(git ls-files -- apps lib planners python tests | grep -E '\.(cpp|hpp|h|c)$')

# torn FILE…: comments behind code that go on in the next line, as clang-format leaves those that do not fit.
torn() {
  awk 'FNR == 1 { column = 0 }
       /^ *\/\/\/</ || (match($0, /^ +\/\//) && RLENGTH - 1 == column) { print FILENAME ":" FNR ": " $0; any = 1 }
       { column = match($0, /[^ \/] +\/\//) ? RSTART + RLENGTH - 2 : 0 }
       END { exit any }' "$@"
}

torn "${files[@]}" || { echo "a comment that does not fit behind its code goes on the line above it" >&2; exit 1; }
format=$(of_version clang-format)
if [ -n "$format" ]; then
  "$format" --dry-run --Werror "${files[@]}"
  echo "${#files[@]} files formatted"
fi

# Of the other languages all files are looked at, where their tools are: ruff of scripts/python_venv.sh, biome of the
# page's packages (npm ci in build/*/page), shellcheck of the package list `test`.
# checked PROGRAM LANGUAGE COMMAND…
checked() {
  command -v "$1" >/dev/null || { echo "no $(basename "$1") here: $2 not checked" >&2; return 0; }
  "${@:3}"
  echo "$2 checked"
}
if [ ${#asked[@]} -eq 0 ]; then
  mapfile -t python_files < <(git ls-files '*.py')
  mapfile -t shell_files < <(git ls-files '*.sh' .ci/run)
  ruff=build/venv/bin/ruff
  # Of the build that is there: CI lints after it built with clang, before it builds with g++.
  biome=$(compgen -G 'build/*/page/node_modules/.bin/biome' | head -n 1 || true)
  biome=${biome:-biome}
  checked "$ruff" Python "$ruff" format --check --quiet "${python_files[@]}"
  checked "$ruff" Python "$ruff" check --quiet "${python_files[@]}"
  checked "$biome" TypeScript "$biome" ci --colors=off --log-level=warn
  checked shellcheck shell shellcheck --severity=warning "${shell_files[@]}"
fi
[ $format_only = 0 ] || exit 0

tidy=$(of_version clang-tidy)
[ -n "$tidy" ] || exit 0
# A room's sources together, as most of the time goes into the headers that they share.
# The extension's sources too, where the Python environment is there that has nanobind (scripts/python_venv.sh).
python=OFF folders=(lib apps planners)
[ ! -x build/venv/bin/python ] || { python=ON; folders+=(python); }
# Units of sources that are gone stay in the folder.
[ ! -d build/tidy ] || find build/tidy -name 'unity_*.cxx' -delete
cmake --preset clang -B build/tidy -DAVOIDBENCH_UNITY=ON -DAVOIDBENCH_TESTS=OFF -DAVOIDBENCH_BENCH=OFF -DAVOIDBENCH_PYTHON=$python >/dev/null
mapfile -t every < <(find "${folders[@]/#/build/tidy/}" -name 'unity_*.cxx' | sort)
# units_with TEXT…: the units in whose includes one of these stands.
units_with() { [ $# -eq 0 ] || grep -lF "${@/#/-e}" "${every[@]}" || true; }
if [ ${#asked[@]} -gt 0 ]; then
  mapfile -t units < <(units_with "${asked[@]}")
elif [ $all = 1 ]; then
  units=("${every[@]}")
else
  # Of many folders those that changed last: the rotation comes to the others.
  mapfile -t changed < <(scripts/changed_files.sh | grep -E '^(lib|apps|planners|python)/.*\.(cpp|hpp|h|c)$' |
    sed -E 's|/[^/]*$|/|' | awk '!seen[$0]++ && ++count <= 12')
  mapfile -t units < <({ units_with "${changed[@]}"; printf '%s\n' "${every[@]}" | scripts/rotating_part.sh; } | sort -u)
fi
[ ${#units[@]} -gt 0 ] || { echo "nothing to check"; exit 0; }
tidy_unit() {
  # Sources that are included are what is meant here.
  "$tidy" --quiet --config-file=.clang-tidy --checks=-bugprone-suspicious-include -p build/tidy \
    '--header-filter=/(lib|apps|planners|python/src)/.*\.(cpp|hpp|h)$' "$1" 2> >(grep -v 'warnings\? generated' >&2)
}
export -f tidy_unit
export tidy
printf '%s\n' "${units[@]}" | xargs -P "$(nproc)" -I{} bash -c 'tidy_unit {}'
echo "$(cat "${units[@]}" | grep -c '^#include') files tidy (${#units[@]} of ${#every[@]} units)"
