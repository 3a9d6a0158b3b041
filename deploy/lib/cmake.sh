# shellcheck shell=bash
# Configuring and building one of the presets of CMakePresets.json.

# One compiler a core, but no more than the memory holds: a file full of Asio takes 1.5 GiB.
jobs() {
  awk -v cores="$(nproc)" '
    /^MemAvailable:/ { fit = int($2 / (1.5 * 1024 * 1024)) }
    END { n = fit && fit < cores ? fit : cores; print n < 1 ? 1 : n }' /proc/meminfo
}

check_compiler() {
  local cxx=${CXX:-c++} name=g++ least=12 version
  command -v "$cxx" >/dev/null || fail "the C++ compiler $cxx is not here"
  if "$cxx" --version | grep -q clang; then name=clang++ least=14; fi
  version=$("$cxx" -dumpversion)
  ((${version%%.*} >= least)) || fail "$cxx is $name $version, and posed needs g++ 12 or clang++ 14: name another with CXX=..."
}

# Clones of one project at different places share what was compiled.
export CCACHE_BASEDIR=$PWD CCACHE_NOHASHDIR=1

# build_preset PRESET [CMAKE_OPTION...]
build_preset() {
  configure_preset "$@"
  build_targets "$1"
}

# configure_preset PRESET [CMAKE_OPTION...]: when it is new, or has changed, or when options are given.
configure_preset() {
  local preset=$1 dir=build/$1
  shift
  local fresh=()
  if [[ -f $dir/CMakeCache.txt ]] && { [[ CMakePresets.json -nt $dir/build.ninja ]] ||
    ! grep -qxF "CMAKE_HOME_DIRECTORY:INTERNAL=$PWD" "$dir/CMakeCache.txt"; }; then
    fresh=(--fresh) # the folder has been moved since, or the compiler may be another
  fi
  if [[ ! -f $dir/build.ninja || ${#fresh[@]} -gt 0 || $# -gt 0 ]]; then
    [[ $preset == asan ]] || check_compiler
    mkdir -p "$dir"
    cmake --preset "$preset" "${fresh[@]}" "$@" >"$dir/configure.log" 2>&1 || {
      cat "$dir/configure.log"
      fail "cmake could not configure $dir"
    }
  fi
}

# build_targets PRESET [TARGET...]: all of them when none is named.
build_targets() {
  local dir=build/$1
  shift
  cmake --build "$dir" --parallel "$(jobs)" ${1+--target "$@"} || fail "$dir did not build"
}
