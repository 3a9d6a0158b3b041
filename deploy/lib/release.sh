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
  scenes build/release
  viewer_build build/release
}

# The built-in scenes stand where DIR/bin/posed looks for them.
scenes() {
  if [[ ! -d server/scene/templates ]]; then return; fi
  mkdir -p "$1/share/posed/scenes"
  cp -R server/scene/templates/. "$1/share/posed/scenes"
}
