#!/usr/bin/env bash
# lint.sh [FILE…]: clang-format and clang-tidy over the given sources, or over those that changed (changed_files.sh) and a rotating
# eighth of the others. --all: over all. --format-only: no clang-tidy. Uses the compile commands of build/clang.
# Both of version 14 only: others format otherwise and have other checks. Without it only torn comments are found, which is said.
# Of very many changed files clang-tidy looks at the twenty changed last, so that a test run stays short.
set -euo pipefail
cd "$(dirname "$0")/.."

version=14 most_changed=20
format_only=0 all=0 rotating=0 files=()
for argument in "$@"; do
  case "$argument" in
    --all) all=1 ;;
    --format-only) format_only=1 ;;
    *) files+=("$argument") ;;
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

all_files() { git ls-files -- apps lib planners tests | grep -E '\.(cpp|hpp|h|c)$'; }
units_of() { grep -E '^(apps|lib|planners)/.*\.cpp$' || true; }

if [ $all = 1 ]; then
  mapfile -t files < <(all_files)
elif [ ${#files[@]} -eq 0 ]; then
  mapfile -t files < <(scripts/changed_files.sh | grep -E '^(apps|lib|planners|tests)/.*\.(cpp|hpp|h|c)$' || true)
  rotating=1
fi

# torn FILE…: comments behind code that go on in the next line, as clang-format leaves those that do not fit.
torn() {
  awk 'FNR == 1 { column = 0 }
       /^ *\/\/\/</ || (match($0, /^ +\/\//) && RLENGTH - 1 == column) { print FILENAME ":" FNR ": " $0; any = 1 }
       { column = match($0, /[^ \/] +\/\//) ? RSTART + RLENGTH - 2 : 0 }
       END { exit any }' "$@"
}

if [ ${#files[@]} -gt 0 ]; then
  torn "${files[@]}" || { echo "a comment that does not fit behind its code goes on the line above it" >&2; exit 1; }
fi
format=$(of_version clang-format)
if [ -n "$format" ] && [ ${#files[@]} -gt 0 ]; then
  "$format" --dry-run --Werror "${files[@]}"
  echo "${#files[@]} files formatted"
fi
[ $format_only = 0 ] || exit 0

tidy=$(of_version clang-tidy)
[ -n "$tidy" ] || exit 0
units=$(printf '%s\n' "${files[@]}" | units_of)
if [ $rotating = 1 ]; then
  units=$({ head -n $most_changed <<<"$units"; all_files | units_of | scripts/rotating_eighth.sh; } | grep . | sort -u || true)
fi
[ -n "$units" ] || { echo "nothing to check"; exit 0; }
[ -f build/clang/compile_commands.json ] || cmake --preset clang >/dev/null
xargs -P "$(nproc)" -n 4 "$tidy" --quiet -p build/clang <<<"$units"
echo "$(wc -l <<<"$units") files tidy"
