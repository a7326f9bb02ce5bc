# shellcheck shell=bash
# Sourced by scripts of tests: goes to a folder that goes at the end.
folder=$(mktemp -d)
busy=""  # a process that ends with the script
trap 'rm -rf "$folder"; [ -z "$busy" ] || kill "$busy" 2>/dev/null || true' EXIT
cd "$folder" || exit

# same_rows_under_load PROGRAM SWEEP: as same_rows, beside a process that is always busy.
same_rows_under_load() {
  (while :; do :; done) & busy=$!
  same_rows "$@"
  kill "$busy"
  busy=""
}

# same_rows PROGRAM SWEEP: one and two workers give the same rows, one.db and two.db, and stored trials fly again bit for
# bit.
same_rows() {
  "$1" run "$2" --jobs 1 --db one.db --quiet
  "$1" run "$2" --jobs 2 --db two.db --quiet
  "$1" compare one.db two.db --exact
  "$1" replay one.db --verify
}
