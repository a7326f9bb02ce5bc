#!/usr/bin/env bash
# lint.sh [FILE…|--all]: checks format and lint in every language. For C++ it runs clang-format and clang-tidy over the
# given sources (clang-tidy also over their neighbours), or over all. Without arguments clang-format checks all sources,
# clang-tidy what changed (changed_files.sh; for a changed header its folder) and a rotating sixteenth of the rest.
#   --format-only    no clang-tidy
#   --words          only wording (check_words.py), which the tests check, too
# clang-format and clang-tidy are used in version 14 only: others format differently and have other checks. Without
# them, lint.sh says so and checks C++ only for torn comments.
set -euo pipefail
cd "$(dirname "$0")/.."

version=14
format_only=0 all=0 asked=()
for argument in "$@"; do
  case "$argument" in
    --format-only) format_only=1 ;;
    --all) all=1 ;;
    --words) exec python3 scripts/check_words.py ;;
    -*) echo "usage: $0 [--format-only | --words] [--all | FILE…]" >&2; exit 2 ;;
    *) asked+=("$argument") ;;
  esac
done

# of_version PROGRAM: prints its name, with or without the number, if it has the required version; else says so.
of_version() {
  local program
  for program in "$1-$version" "$1"; do
    if command -v "$program" >/dev/null && "$program" --version | grep -q "version $version\."; then
      echo "$program"
      return
    fi
  done
  echo "no $1 of version $version found ($("$1" --version 2>/dev/null | grep -o 'version [0-9.]*' || echo none)): not checked" >&2
}

files=("${asked[@]}")
[ ${#files[@]} -gt 0 ] || mapfile -t files < <(git ls-files -- apps lib planners python tests | grep -E '\.(cpp|hpp|h|c)$' | grep -v apps/page/page_program.cpp)

# torn FILE…: comments behind code that continue on the next line, as clang-format leaves those that do not fit.
torn() {
  awk 'FNR == 1 { column = 0 }
       /^ *\/\/\/</ || (match($0, /^ +\/\//) && RLENGTH - 1 == column) { print FILENAME ":" FNR ": " $0; any = 1 }
       { column = match($0, /[^ \/] +\/\//) ? RSTART + RLENGTH - 2 : 0 }
       END { exit any }' "$@"
}

torn "${files[@]}" || { echo "put a comment that does not fit behind its code on the line above" >&2; exit 1; }
format=$(of_version clang-format)
if [ -n "$format" ]; then
  "$format" --dry-run --Werror "${files[@]}"
  echo "${#files[@]} files formatted"
fi

# In other languages all files are checked, if the tools are available: ruff from scripts/python_venv.sh, biome from the
# page's packages (scripts/bundle_page.sh), shellcheck from the package list `test`.
# checked PROGRAM LANGUAGE COMMAND…
checked() {
  command -v "$1" >/dev/null || { echo "no $(basename "$1") found: $2 not checked" >&2; return 0; }
  "${@:3}"
  echo "$2 checked"
}
if [ ${#asked[@]} -eq 0 ]; then
  mapfile -t python_files < <(git ls-files '*.py')
  mapfile -t shell_files < <(git ls-files '*.sh' .ci/run)
  ruff=build/venv/bin/ruff
  biome=build/page/node_modules/.bin/biome
  [ -x "$biome" ] || biome=biome
  checked "$ruff" Python "$ruff" format --check --quiet "${python_files[@]}"
  checked "$ruff" Python "$ruff" check --quiet "${python_files[@]}"
  checked "$biome" TypeScript "$biome" ci --colors=off --log-level=warn
  checked shellcheck shell shellcheck --severity=warning "${shell_files[@]}"
fi
[ $format_only = 0 ] || exit 0

tidy=$(of_version clang-tidy)
[ -n "$tidy" ] || exit 0
# A room's sources are checked together, since most of the time goes into shared headers.
# The Python extension's sources are included if the environment with nanobind exists (scripts/python_venv.sh).
python=OFF folders=(lib apps planners)
[ ! -x build/venv/bin/python ] || { python=ON; folders+=(python); }
# Units of deleted sources would stay in the folder.
[ ! -d build/tidy ] || find build/tidy -name 'unity_*.cxx' -delete
cmake --preset clang -B build/tidy -DAVOIDBENCH_UNITY=ON -DAVOIDBENCH_TESTS=OFF -DAVOIDBENCH_BENCH=OFF -DAVOIDBENCH_PYTHON=$python >/dev/null
mapfile -t every < <(find "${folders[@]/#/build/tidy/}" -name 'unity_*.cxx' | sort)
# units_with TEXT…: the units that include a path with one of these texts.
units_with() { [ $# -eq 0 ] || grep -lF "${@/#/-e}" "${every[@]}" || true; }
if [ ${#asked[@]} -gt 0 ]; then
  mapfile -t units < <(units_with "${asked[@]}")
elif [ $all = 1 ]; then
  units=("${every[@]}")
else
  # At most the twelve folders changed last; the rotation covers the others.
  mapfile -t changed < <(scripts/changed_files.sh | grep -E '^(lib|apps|planners|python)/.*\.(cpp|hpp|h|c)$' |
    sed -E 's|/[^/]*$|/|' | awk '!seen[$0]++ && ++count <= 12')
  mapfile -t units < <({ units_with "${changed[@]}"; printf '%s\n' "${every[@]}" | scripts/rotating_part.sh; } | sort -u)
fi
[ ${#units[@]} -gt 0 ] || { echo "nothing to check"; exit 0; }
tidy_unit() {
  # Units include sources on purpose.
  "$tidy" --quiet --config-file=.clang-tidy --checks=-bugprone-suspicious-include -p build/tidy \
    '--header-filter=/(lib|apps|planners|python/src)/.*\.(cpp|hpp|h)$' "$1" 2> >(grep -v 'warnings\? generated' >&2)
}
export -f tidy_unit
export tidy
printf '%s\n' "${units[@]}" | xargs -P "$(nproc)" -I{} bash -c 'tidy_unit {}'
echo "$(cat "${units[@]}" | grep -c '^#include') files tidy (${#units[@]} of ${#every[@]} units)"
