#!/usr/bin/env bash
# lint.sh [FILE…]: clang-format and clang-tidy over the given sources, or over those that changed (changed_files.sh).
# --all: over all. --format-only: no clang-tidy. Uses the compile commands of build/clang.
# A change of very many files is looked at in part, so that a test run stays short: its 30 largest files.
set -euo pipefail
cd "$(dirname "$0")/.."

format_only=0 all=0 files=()
for argument in "$@"; do
  case "$argument" in
    --all) all=1 ;;
    --format-only) format_only=1 ;;
    *) files+=("$argument") ;;
  esac
done
sources=(apps lib planners tests)
if [ ${#files[@]} -eq 0 ]; then
  if [ $all = 1 ]; then list=(git ls-files -- "${sources[@]}"); else list=(scripts/changed_files.sh); fi
  mapfile -t files < <("${list[@]}" | grep -E '^(apps|lib|planners|tests)/.*\.(cpp|hpp|h|c)$' || true)
fi
[ ${#files[@]} -eq 0 ] && { echo "nothing to check"; exit 0; }

clang-format --dry-run --Werror "${files[@]}"
[ $format_only = 1 ] && { echo "${#files[@]} files formatted"; exit 0; }
mapfile -t units < <(printf '%s\n' "${files[@]}" | grep -E '^(lib|apps|planners)/.*\.cpp$' || true)
most=30
if [ $all = 0 ] && [ ${#units[@]} -gt $most ]; then
  echo "clang-tidy: $most of ${#units[@]} changed files, the largest; --all looks at all"
  mapfile -t units < <(wc -c "${units[@]}" | grep -v ' total$' | sort -rn | head -$most | awk '{print $2}')
fi
[ ${#units[@]} -eq 0 ] && exit 0
[ -f build/clang/compile_commands.json ] || cmake --preset clang >/dev/null
printf '%s\n' "${units[@]}" | xargs -P "$(nproc)" -n 4 clang-tidy --quiet -p build/clang
echo "${#files[@]} files formatted, ${#units[@]} tidy"
