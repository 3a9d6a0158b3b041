# shellcheck shell=bash
# The sanitizers and libFuzzer come from clang: it compiles checked code in two thirds of g++'s time.

need_libfuzzer() {
  command -v clang++ >/dev/null || skip "clang++ is not here"
  printf '#include <stddef.h>\nextern "C" int LLVMFuzzerTestOneInput(const char*, size_t) { return 0; }\n' |
    clang++ -fsanitize=fuzzer,address -x c++ - -o "$LOGS/fuzz-probe" || skip "clang++ has no libFuzzer or no AddressSanitizer"
}
