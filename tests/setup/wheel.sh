#!/usr/bin/env bash
# wheel.sh SOURCE_FOLDER: the wheel of make_wheel.sh needs nothing but a Python: installed in a Debian of this release
# with only its base system and python3-venv, its program flies and verifies results of the frozen suite that another
# build flew, bit for bit, and its extension makes the map that the program makes.
# Exit code 77 as fresh_system.sh.
set -euo pipefail
cd "$1"

mkdir -p build
folder=$(mktemp -d build/wheel_test.XXXXXX)
trap 'rm -rf "$folder"' EXIT
wheel=$(scripts/make_wheel.sh "$folder" | tail -n 1)
# Licence texts: a library's, one that this names, and one of headers alone.
build/venv/bin/python - "$wheel" <<'EOF'
import pathlib, sys, zipfile
names = zipfile.ZipFile(sys.argv[1]).namelist()
texts = {pathlib.PurePath(name).name for name in names if ".dist-info/licenses/of-others/" in name}
missing = {"libnettle8.txt", "LGPL.txt", "libyaml-cpp0.7.txt", "libeigen3-dev.txt", "nanobind.txt"} - texts
sys.exit(f"no licence texts in the wheel: {missing}" if missing else 0)
EOF
# Its dependencies travel along: the small system need not reach a package index.
build/venv/bin/python -m pip download --quiet --disable-pip-version-check --dest "$folder" "$wheel"
for track in depth stereo; do cp -r "results/suites/avoidbench-1/$track/dev/ego-4" "$folder/$track"; done
cat >"$folder/try.sh" <<'EOF'
set -eu
apt-get update -qq
apt-get install -y -qq --no-install-recommends python3-venv >/dev/null 2>&1
python3 -m venv /venv
/venv/bin/pip install --quiet --no-index --find-links . avoidbench
PATH=/venv/bin:$PATH
for track in depth stereo; do avoidbench suite verify $track --sample 3% --quiet; done
cd /tmp
avoidbench --version
avoidbench planners list | grep -q straight_line
avoidbench run quick --set trials=1 --jobs 1
program=$(avoidbench maps info hall --seed 2 --missions 0 2>/dev/null | awk '$1 == "digest" { print $2 }')
python=$(python -c 'import avoidbench; print(avoidbench.make_world("hall", seed=2).digest)')
[ -n "$program" ] && [ "$program" = "$python" ]
python -c 'import avoidbench; w = avoidbench.make_world("quick"); m = w.missions(1)
assert w.depth(avoidbench.look_at(m.starts_world, m.goals_world), sensor="stereo_sgm").shape == (1, 240, 320)'
python -c 'from avoidbench.portable_math import sin; assert sin(0.0) == 0.0'
echo "the wheel flies here"
EOF
suite=$(. /etc/os-release && echo "$VERSION_CODENAME")
scripts/fresh_system.sh --bare "$folder" "$suite" sh try.sh
