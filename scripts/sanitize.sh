#!/usr/bin/env bash
# sanitize.sh [ROOM…|--all]: builds the tests of these rooms or planners (planners/ego) with address and
# undefined-behaviour sanitizers (build/asan) and runs them, without planners' longest flights. Without arguments it
# takes the two rooms with the most changed files (changed_files.sh) and a rotating sixteenth of all rooms. Tests
# labelled slow run only with --all.
#   --python [PYTEST ARGUMENTS…]    checks the Python extension instead, with the package's tests, which fly with the
#   program of build/release
set -euo pipefail
cd "$(dirname "$0")/.."

if [ "${1:-}" = --python ]; then
  shift
  [ -x build/release/avoidbench ] || { echo "build/release/avoidbench does not exist: build it first" >&2; exit 1; }
  scripts/python_venv.sh
  cmake --preset asan -DAVOIDBENCH_UNITY=ON -DAVOIDBENCH_PYTHON=ON "-DPython_EXECUTABLE=$PWD/build/venv/bin/python" >/dev/null
  cmake --build build/asan --parallel "$(nproc)" --target _core
  # The sanitizer's own memory grows, which test_env_leaks.py would report as a leak.
  [ $# -gt 0 ] || set -- python/tests --ignore=python/tests/test_ppo_slow.py --ignore=python/tests/test_env_leaks.py
  # Python itself is not sanitized, so the runtime is preloaded, and the C++ library, whose exceptions the runtime needs.
  # Leak detection is off, since Python leaves objects at its end. Tests handle crashes that they cause on purpose.
  exec env "LD_PRELOAD=$(clang++ -print-file-name=libclang_rt.asan-x86_64.so):$(clang++ -print-file-name=libstdc++.so.6)" \
    ASAN_OPTIONS=detect_leaks=0:handle_segv=0 UBSAN_OPTIONS=print_stacktrace=1 AVOIDBENCH_PROGRAM="$PWD/build/release/avoidbench" \
    PYTHONPATH="$PWD/build/asan/python" PYTHONDONTWRITEBYTECODE=1 build/venv/bin/python -m pytest -p no:cacheprovider "$@"
fi

mapfile -t rooms < <(grep -vE '^\s*(#|$)' lib/ORDER | cut -d: -f1 | cut -d/ -f2)
rooms+=(planners/*/)
tested=()
# Rooms with C++ tests only.
for room in "${rooms[@]%/}"; do compgen -G "tests/$room/*_test.cpp" >/dev/null && tested+=("$room"); done
tests_of() {
  case "$1" in
    planners/common) echo planner_common_tests ;;
    planners/*) echo "${1#planners/}_planner_tests" ;;
    *) echo "${1}_tests" ;;
  esac
}

fast="-*Slow.*"
case "${1:-}" in
  --all) fast="*" chosen=("${tested[@]}") ;;
  '')
    changed=$(scripts/changed_files.sh)
    most_changed=$(for room in "${tested[@]}"; do
        count=$(grep -cE "^(lib/[a-z]+/|tests/)?$room/.*\.(cpp|hpp|h|c|sql)$" <<<"$changed" || true)
        [ "$count" -eq 0 ] || echo "$count $room"
      done | sort -rn | head -n 2 | cut -d' ' -f2)
    mapfile -t chosen < <({ echo "$most_changed"; printf '%s\n' "${tested[@]}" | scripts/rotating_part.sh; } | grep . | sort -u || true)
    ;;
  *) chosen=("$@") ;;
esac
[ ${#chosen[@]} -eq 0 ] && { echo "no room changed"; exit 0; }

echo "rooms: ${chosen[*]}"
cmake --preset asan -DAVOIDBENCH_TESTS=ON -DAVOIDBENCH_UNITY=ON >/dev/null
targets=()
for room in "${chosen[@]}"; do targets+=("$(tests_of "$room")"); done
cmake --build build/asan --parallel "$(nproc)" --target "${targets[@]}"
# Embree's and OpenCV's own threads and caches live until the process ends.
export ASAN_OPTIONS=detect_leaks=1:strict_string_checks=1 UBSAN_OPTIONS=print_stacktrace=1
export LSAN_OPTIONS=suppressions=$PWD/tests/support/leaks.supp:print_suppressions=0
# Rooms run in parallel, one per processor. Each room's output is printed together, and a failure does not stop the
# others.
run_room() {
  local filter=$2 said
  [[ $1 == planners/* ]] && filter="-*Slow.*:*.Clears*:*.GetsOutOfADeadEnd"
  if said=$(cd build/asan/tests/"$1" && "./$(tests_of "$1")" --gtest_brief=1 --gtest_filter="$filter" 2>&1); then
    printf '== %s\n%s\n' "$1" "$said"
  else
    printf '== %s FAILED\n%s\n' "$1" "$said"
    return 1
  fi
}
export -f run_room tests_of
printf '%s\0' "${chosen[@]}" | xargs -0 -P "$(nproc)" -I{} bash -c 'run_room "$@"' run_room {} "$fast"
