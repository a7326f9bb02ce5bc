# Sourced by scripts of tests, which have $program: goes to a folder that goes at the end.
folder=$(mktemp -d)
trap 'rm -rf "$folder"; kill "${busy:-}" 2>/dev/null || true' EXIT
cd "$folder"

# same_rows SWEEP: one and two workers give the same rows, one.db and two.db, and stored trials fly again bit for bit.
same_rows() {
  "$program" run "$1" --jobs 1 --db one.db --quiet
  "$program" run "$1" --jobs 2 --db two.db --quiet
  "$program" compare one.db two.db --exact
  "$program" replay one.db --verify
}
