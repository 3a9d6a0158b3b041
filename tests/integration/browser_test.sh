#!/usr/bin/env bash
# The viewer in headless Chromium against the real daemon: browser_test.sh BUILD_DIR (with share/posed/viewer built).
# First what people do with the page, on daemons of its own, then the whole line from an emulated LIBERTY's bytes.
set -euo pipefail
cd "$(dirname "$0")/../.."
build=${1:?usage: browser_test.sh BUILD_DIR}
shots=build/test-shots
mkdir -p "$shots"
export CHROMIUM=${CHROMIUM:-$(command -v chromium || command -v google-chrome)}
status=0
POSED_BIN=$PWD/$build/bin POSED_VIEWER=$PWD/$build/share/posed/viewer POSED_SHOTS=$PWD/$shots npm --prefix client/web run --silent e2e || status=$?
((status == 0)) || exit "$status"

status=0
POSED_SHOT=$PWD/$shots/liberty.png POSED_VIEWER=$PWD/$build/share/posed/viewer \
  python3 tests/integration/liberty_end_to_end.py "$build" --page || status=$?
((status == 77)) || exit "$status"
