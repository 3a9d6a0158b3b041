# shellcheck shell=bash
# Builds a preset and runs its tests through ctest.

# ctest_in PRESET [CTEST_OPTION...]
ctest_in() {
  local preset=$1 junit rc=0
  shift
  junit=$LOGS/$preset-${STEP:-ctest}.xml
  headline "ctest in build/$preset $*"
  ctest --test-dir "build/$preset" --output-on-failure --no-tests=error --parallel "$(nproc)" --timeout 300 \
    --output-junit "$junit" "$@" || rc=$?
  tally_junit "$junit" "$rc"
}

# ctest sums itself up in <testsuite name= tests="9" failures="0" disabled="0" skipped="1" ...>, maybe over several lines.
tally_junit() {
  local total=0 failed=0 skipped=0 name
  if [[ -f $1 ]]; then
    total=$(attribute tests "$1") failed=$(attribute failures "$1")
    skipped=$(($(attribute disabled "$1") + $(attribute skipped "$1")))
  fi
  tally passed $((total - failed - skipped))
  while read -r name; do tally failed 1 "$name"; done < <(cases fail "$1")
  while read -r name; do tally skipped 1 "$name"; done < <({ cases notrun "$1"; cases disabled "$1"; } | head -n "$skipped")
  if (($2 != 0 && failed == 0)); then tally failed 1 "ctest ended with $2"; fi
}

attribute() { tr '\n\t' '  ' <"$2" | sed -E "s/.*<testsuite [^>]*\\b$1=\"([0-9]+)\".*/\\1/"; }
cases() { grep -oE "<testcase name=\"[^\"]*\"[^>]*status=\"$1\"" "$2" 2>/dev/null | cut -d'"' -f2 || true; }
