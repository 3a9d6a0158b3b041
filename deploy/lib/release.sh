# shellcheck shell=bash
# What users run: optimised programs in build/release/bin, viewer and scenes in build/release/share/posed.
. deploy/lib/packages.sh
. deploy/lib/cmake.sh
. deploy/lib/viewer.sh

# build_release [CMAKE_OPTION...]
build_release() {
  need_packages build
  headline "programs: build/release/bin"
  if [[ ! -f build/release/CMakeCache.txt ]]; then
    set -- -DPOSED_TESTS=OFF -DPOSED_BENCH=OFF "$@"
  fi
  build_preset release "$@"
  viewer_build build/release
}
