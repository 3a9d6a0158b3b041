# shellcheck shell=bash
# run_step: one step of deploy/test from its headline to its row in the table. The logs go to the folder $logs.
logs=${logs:-build/test-logs}

# run_step STEP WHICH [FILTER]
run_step() {
  local step=$1 log=$logs/$1.log tally=$logs/$1.tally begun=$SECONDS rc=0 follower
  headline "$2 $step: $(sed -n '2s/^# *//p' "deploy/steps/$step")"
  : >"$tally"
  follow "$log" &
  follower=$!
  TALLY=$PWD/$tally LOGS=$PWD/$logs "deploy/steps/$step" "${3-}" >"$log" 2>&1 </dev/null || rc=$?
  kill "$follower" 2>/dev/null || true
  wait "$follower" 2>/dev/null || true
  [[ ! -t 1 ]] || printf '\r\033[K'

  if ((rc != 0)); then printf 'failed 1 deploy/steps/%s broke off with %d\n' "$step" "$rc" >>"$tally"; fi
  if [[ ! -s $tally ]]; then echo "failed 1 $step tested nothing" >>"$tally"; fi
  cat "$tally" >>"$logs/tally"
  row "$step" "$tally" $((SECONDS - begun)) | tee -a "$logs/table"
  if grep -q '^failed' "$tally"; then
    note "---- what failed, from $log"
    { what_failed "$log" || true; } | sed 's/^/   | /'
    note "---- its end"
    tail -n 15 "$log" | sed 's/^/   | /'
    note "---- just this step: ./deploy/test $step"
  fi
}

# Where a test, a compiler or a sanitizer complains, and a few lines on: a log's end seldom has it.
what_failed() {
  grep -nE -A 6 ': Failure$|^(FAILED|FAIL\b|not ok)|(error|runtime error|ERROR):|^SUMMARY: |\*\*\*(Failed|Timeout|Exception|Not Run)|^  ✗|^Traceback' "$1" |
    cut -c 1-240 | head -n 80
}

# The log's last line, again and again on a terminal, once a minute elsewhere.
follow() {
  local begun=$SECONDS line
  trap exit TERM
  while sleep 1; do
    line=$(tail -n 1 "$1" 2>/dev/null | tr -d '\r' | cut -c 1-100)
    if [[ -t 1 ]]; then
      printf '\r\033[K   %s' "$line"
    elif (((SECONDS - begun) % 60 == 59)); then
      note "$(duration $((SECONDS - begun))): $line"
    fi
  done
}

# STEP TALLY SECONDS: "dev   412 passed, 1 skipped   3 m 10 s", and below it what was skipped or failed, and why.
row() {
  awk -v step="$1" -v time="$(duration "$3")" '
    { sum[$1] += $2 }
    $1 != "passed" { word = $1; count = $2; $1 = $2 = ""; sub(/^ +/, "")
      about[++n] = (word == "skipped" ? "SKIPPED: " : "FAILED: ") $0 (count > 1 ? " (" count ")" : "") }
    END {
      text = sum["passed"] + 0 " passed"
      if (sum["failed"]) text = text ", " sum["failed"] " failed"
      if (sum["skipped"]) text = text ", " sum["skipped"] " skipped"
      printf "   %-8s %-40s %10s\n", step, text, time
      for (i = 1; i <= n; i++) printf "            %s\n", about[i] }' "$2"
}
