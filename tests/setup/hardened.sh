#!/usr/bin/env bash
# hardened.sh PROGRAM LIBRARY…: each is bound at its start with its tables read-only after that, has no executable stack
# and checks its stack; the program also checks the sizes of what it copies (a library may copy nothing).
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
  [ "$file" != "$1" ] || expect "$file" "sizes of copies are not checked" '__(mem|str|read|poll|[a-z]*printf)[a-z]*_chk' "$symbols"
done
[ $problems -eq 0 ] && echo "$# files are hardened"
