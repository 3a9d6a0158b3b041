# shellcheck shell=bash
# The web viewer: its npm packages, and the page that the daemon serves.

# npm ci, only when package-lock.json is another than the last time.
viewer_packages() {
  local stamp=client/web/node_modules/.installed-for now
  now="$(sha256sum <client/web/package-lock.json) node $(node --version)"
  if [[ -f $stamp && $(<"$stamp") == "$now" ]]; then return; fi
  headline "viewer: npm ci"
  (cd client/web && npm ci --no-audit --no-fund) || fail "npm ci failed in client/web"
  printf '%s\n' "$now" >"$stamp"
}

# viewer_build DIR: the page goes to DIR/share/posed/viewer, where DIR/bin/posed looks for it.
viewer_build() {
  local out=$PWD/$1/share/posed/viewer stamp=$PWD/$1/viewer.stamp
  if [[ -f $stamp && -f $out/index.html ]] && [[ -z $(viewer_newer_than "$stamp") ]]; then return; fi
  viewer_packages
  headline "viewer: npm run build"
  touch "$stamp.new"
  (cd client/web && npm run --silent build -- --outDir "$out" --emptyOutDir) || fail "the viewer did not build"
  mv "$stamp.new" "$stamp"
}

viewer_newer_than() {
  find client/web \( -name node_modules -o -name test -o -name e2e -o -name dist -o -name test-results \) -prune \
    -o -type f -newer "$1" -print -quit
}
