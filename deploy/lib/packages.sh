# shellcheck shell=bash
# need_packages NEED...: whatever deploy/packages.txt lists under these needs and this machine lacks is named and
# installed through apt-get. Quick and silent when nothing is missing.

# Prints "package why" for each package of these needs that is not here.
missing_packages() {
  local installed name need unless why
  installed=" $(dpkg-query -W -f='${Package} ${db:Status-Status}\n' | awk '$2 == "installed" { printf "%s ", $1 }')"
  while read -r name need unless why; do
    [[ -n $name && $name != '#'* && " $* " == *" $need "* ]] || continue
    [[ $installed == *" $name "* ]] && continue
    any_command "${unless//|/ }" && continue
    printf '%s %s\n' "$name" "$why"
  done <deploy/packages.txt
}

any_command() {
  local name
  for name in $1; do
    if [[ $name != - ]] && command -v "$name" >/dev/null; then return 0; fi
  done
  return 1
}

need_packages() {
  if ! command -v apt-get >/dev/null || ! command -v dpkg-query >/dev/null; then
    note "no apt-get here: what deploy/packages.txt lists is taken as installed"
    return
  fi
  local missing names as_root=()
  missing=$(missing_packages "$@")
  [[ -n $missing ]] || return 0
  names=$(awk '{ print $1 }' <<<"$missing" | xargs)

  headline "installing through apt-get"
  awk '{ name = $1; sub(/^[^ ]+ /, ""); printf "   %-20s %s\n", name, $0 }' <<<"$missing"
  if ((EUID != 0)); then
    as_root=(sudo)
    [[ -t 0 ]] || as_root+=(-n)
    if ! command -v sudo >/dev/null || ! "${as_root[@]}" true 2>/dev/null; then
      fail "not root, and no sudo: please ask an administrator to run: apt-get install $names"
    fi
  fi
  as_root+=(env DEBIAN_FRONTEND=noninteractive apt-get -o DPkg::Lock::Timeout=300 -q)
  "${as_root[@]}" update || note "apt-get update complained (see above): going on with the package lists that are there"
  # shellcheck disable=SC2086 # one word a package
  "${as_root[@]}" install -y --no-install-recommends $names </dev/null ||
    fail "apt-get could not install: $names (see above)"
}
