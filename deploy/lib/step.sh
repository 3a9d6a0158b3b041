# shellcheck shell=bash
# The head of every script in deploy/steps: they run from the top of the tree and tell what came out to the file $TALLY
# (a line "passed 12", "failed 1 WHAT" or "skipped 1 WHY"). Run by hand they tell it to the terminal.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
. deploy/lib/say.sh
. deploy/lib/cmake.sh
TALLY=${TALLY:-/dev/stderr}
LOGS=${LOGS:-$PWD/build/test-logs}
mkdir -p "$LOGS"

tally() { # passed|failed|skipped NUMBER [WHAT]
  if (($2 > 0)); then printf '%s\n' "$*" >>"$TALLY"; fi
}

# tally_failures NUMBER STATUS RUNNER: a runner that counted no failure and yet did not end well is one.
tally_failures() {
  local count=$1
  if (($1 == 0 && $2 != 0)); then count=1; fi
  tally failed "$count" "$3"
}

# A step, or the rest of it, that cannot run here.
skip() {
  tally skipped 1 "$*"
  exit 0
}

# check WHAT COMMAND...: counts as one test. Status 77 is one that cannot run here, and has said why.
check() {
  local what=$1 status=0
  shift
  headline "$what"
  "$@" || status=$?
  case $status in
    0) tally passed 1 ;;
    77) tally skipped 1 "$what" ;;
    *) tally failed 1 "$what" ;;
  esac
}
