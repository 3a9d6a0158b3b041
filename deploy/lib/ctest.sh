# shellcheck shell=bash
# Runs the tests of a built preset through ctest and tallies each.

# ctest_in PRESET [CTEST_OPTION...]
ctest_in() {
  local preset=$1 out rc=0 seconds=300
  shift
  [[ $preset != *san ]] || seconds=600 # sanitizers make a program several times as slow
  out=$LOGS/$preset-ctest.txt
  headline "ctest in build/$preset $*"
  ctest --test-dir "build/$preset" --output-on-failure --no-tests=error --parallel "$(nproc)" --timeout "$seconds" "$@" 2>&1 |
    tee "$out" || rc=$?
  ctest_tally "$out" >"$out.tally"
  gtest_skips "build/$preset/Testing/Temporary/LastTest.log" >>"$out.tally"
  cat "$out.tally" >>"$TALLY"
  if ((rc != 0)) && ! grep -q ^failed "$out.tally"; then tally failed 1 "ctest"; fi
}

# Reads ctest's closing words: "67% tests passed, 2 tests failed out of 6", then each that did not run or failed. Skipped
# ones are among the passed there, disabled ones in neither number.
ctest_tally() {
  awk '
    /% tests passed, [0-9]+ tests? failed out of [0-9]+/ { passed = $NF - $4; n = 0; word = "" }
    /^The following tests did not run:/ { word = "skipped" }
    /^The following tests FAILED:/ { word = "failed" }
    word && /^\t *[0-9]+ - / {
      passed -= /\(Skipped\)/
      sub(/^\t *[0-9]+ - /, "")
      line[++n] = word " 1 " $0
    }
    END {
      if (passed > 0) print "passed " passed
      for (i = 1; i <= n; i++) print line[i]
    }' "$1"
}

# A program of many cases passes when some of them are skipped: those are told too.
gtest_skips() { sed -nE 's/^\[  SKIPPED \] ([[:alnum:]_\/]+\.[[:alnum:]_\/]+)$/skipped 1 \1/p' "$1"; }
