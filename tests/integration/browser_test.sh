#!/usr/bin/env bash
# The viewer in headless Chromium against the real daemon: browser_test.sh BUILD_DIR (with share/posed/viewer built).
# First a person's drags on the simulated tracker's daemon, then the whole line from an emulated LIBERTY's bytes.
set -euo pipefail
cd "$(dirname "$0")/../.."
build=${1:?usage: browser_test.sh BUILD_DIR}
data=$(mktemp -d)
daemon=
trap '[[ -z $daemon ]] || kill "$daemon" 2>/dev/null || true; rm -rf "$data"' EXIT

mkfifo "$data/out"
"$build/bin/posed" --listen 127.0.0.1:0 --tracker simulated --data "$data" --viewer.path "$build/share/posed/viewer" >"$data/out" &
daemon=$!
read -r line <"$data/out"
url=$(grep -oE 'http://[^ ]+' <<<"$line")

shots=build/test-shots
mkdir -p "$shots"
export CHROMIUM=${CHROMIUM:-$(command -v chromium || command -v google-chrome)}
POSED_URL=$url POSED_SHOT=$PWD/$shots/viewer.png npm --prefix client/web run --silent e2e
kill "$daemon"
wait "$daemon"
daemon=

status=0
POSED_SHOT=$PWD/$shots/liberty.png POSED_VIEWER=$PWD/$build/share/posed/viewer \
  python3 tests/integration/liberty_end_to_end.py "$build" --page || status=$?
((status == 77)) || exit "$status"
