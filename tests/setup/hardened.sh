#!/usr/bin/env bash
# hardened.sh FILE…: each program or library is bound at its start with its tables read-only after that, has no executable stack, and checks
# its stack and the sizes of what it copies.
set -euo pipefail

problems=0
expect() {
  grep -qE "$3" <<<"$4" || { echo "PROBLEM  $1: $2"; problems=$((problems + 1)); }
}
for file in "$@"; do
  segments=$(readelf --wide --program-headers "$file")
  expect "$file" "no read-only tables (RELRO)" 'GNU_RELRO' "$segments"
  expect "$file" "an executable stack" 'GNU_STACK .* RW ' "$segments"
  expect "$file" "not bound at its start (NOW)" 'BIND_NOW|FLAGS.* NOW' "$(readelf --wide --dynamic "$file")"
  symbols=$(readelf --wide --dyn-syms "$file")
  expect "$file" "stacks are not checked" '__stack_chk_fail' "$symbols"
  expect "$file" "sizes of copies are not checked" '__[a-z]+_chk\b' "${symbols//__stack_chk_fail/}"
done
[ $problems -eq 0 ] && echo "$# files are hardened"
