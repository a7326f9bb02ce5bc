#!/usr/bin/env bash
# torn_comments.sh SOURCE_FOLDER: lint.sh finds comments behind code that go on in the next line, and no others.
set -euo pipefail

source=$1
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cp "$source/.clang-format" "$folder"
lint() { "$source/scripts/lint.sh" --format-only "$folder/a.hpp" >"$folder/output" 2>&1; }

cat >"$folder/a.hpp" <<'END'
struct Whole {
  int a = 0;   ///< one line
  int bc = 0;  // another
  /// Above its member, see "http://a.b".
  int e = 0;
  // And one
  // of two lines.
};
END
lint || { echo "whole comments were refused:"; cat "$folder/output"; exit 1; }

expect_torn() {  # expect_torn FIRST SECOND: two lines, of which the second goes on with the first one's comment
  printf 'struct Torn {\n%s\n%s\n};\n' "$1" "$2" >"$folder/a.hpp"
  if lint; then echo "not found: $1"; exit 1; fi
  grep -q 'a.hpp:3: ' "$folder/output" || { echo "not this line:"; cat "$folder/output"; exit 1; }
}
expect_torn '  int a = 0;  ///< what it is, and' '              ///< more of it'
expect_torn '  int a = 0;  // what it is, and' '              // more of it'
expect_torn '  const char* name = "Ω";  ///< what it is, and' '                           ///< more of it'
