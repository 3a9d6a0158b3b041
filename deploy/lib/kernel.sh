# shellcheck shell=bash
# tally_kernel_tests RUNNER KERNEL: tracker_kernel_test in the machine that RUNNER makes of KERNEL.
tally_kernel_tests() {
  local report rc=0 passed failed
  report=$LOGS/kernel-$(basename "$1").txt
  "$1" "$2" "$PWD/build/dev/bin/tracker_kernel_test" --gtest_color=no 2>&1 | tee "$report" || rc=$?
  passed=$(sed -nE 's/^\[  PASSED  \] ([0-9]+) tests?\..*/\1/p' "$report")
  failed=$(sed -nE 's/^\[  FAILED  \] ([0-9]+) tests?, listed below:.*/\1/p' "$report")
  tally passed "${passed:-0}"
  tally_failures "${failed:-0}" "$rc" tracker_kernel_test
}
