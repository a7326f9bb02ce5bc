#!/usr/bin/env bash
# deb.sh SOURCE_FOLDER: the package of make_deb.sh installs on a Debian of this release with only its base system; there its program
# flies, verifies results of the frozen suite that another build flew, bit for bit, and builds and checks a planner in C++; and
# no link of its pages is dead. Exit code 77 as fresh_system.sh.
set -euo pipefail
cd "$1"

mkdir -p build
folder=$(mktemp -d build/deb_test.XXXXXX)
trap 'rm -rf "$folder"' EXIT
scripts/make_deb.sh "$folder" | tail -n 1
for track in depth stereo; do cp -r "results/suites/avoidbench-1/$track/dev/ego-4" "$folder/$track"; done
cp tests/setup/check_links.py "$folder/"
cat >"$folder/try.sh" <<'EOF'
set -eu
apt-get update -qq
apt-get install -y -qq ./avoidbench_*.deb g++ cmake >/dev/null 2>&1
avoidbench --version
for track in depth stereo; do avoidbench suite verify $track --sample 3% --quiet; done
python3 check_links.py /usr/share/avoidbench
cd /tmp
avoidbench run quick --set trials=1 --jobs 1
avoidbench report --page quick.html >/dev/null
avoidbench planners new swift
cmake -S swift -B swift/build -DCMAKE_PREFIX_PATH=/usr >/dev/null && cmake --build swift/build >/dev/null
avoidbench planners check swift/build/planners/swift.so
avoidbench planners new snake --kind python
avoidbench planners check snake/snake.py
echo "the package works here"
EOF
suite=$(. /etc/os-release && echo "$VERSION_CODENAME")
scripts/fresh_system.sh --bare "$folder" "$suite" sh try.sh
