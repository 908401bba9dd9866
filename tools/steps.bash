# Copyright 2026 The Carpus authors
# SPDX-License-Identifier: Apache-2.0
#
# Sourced by ./run and ./test: numbered, timed steps that say what they do and what failed.
step_number=0
started=$SECONDS
step_names=()
step_starts=()

say() { printf '%s\n' "$*"; }

step() {
  step_number=$((step_number + 1))
  step_names+=("$1")
  step_starts+=("$SECONDS")
  printf '\n[%d] %s  (%d min %02d s since the start)\n' "$step_number" "$1" \
    $(((SECONDS - started) / 60)) $(((SECONDS - started) % 60))
}

# What each step took, for whoever wonders where the time went.
say_where_time_went() {
  local i ends=("${step_starts[@]:1}" "$SECONDS")
  for i in "${!step_names[@]}"; do
    printf '%5d s  %s\n' $((ends[i] - step_starts[i])) "${step_names[i]}"
  done
  printf '%5d s  in all\n' $((SECONDS - started))
}

fail() {
  printf 'carpus: %s\n' "$*" >&2
  exit 1
}

# fail, with what may be the reason where the disk has little room left: tools say it pages above, or not at all.
fail_maybe_full() {
  local free
  free=$(df -Pm . 2>/dev/null | awk 'NR == 2 { print $4 }')
  [ "${free:-$ROOM_MB}" -ge "$ROOM_MB" ] ||
    fail "$* Only $free MB are free on this disk, and it may take $ROOM_MB: make room, and start again."
  fail "$*"
}
# What a build of the program and of the page take, with what npm unpacks meanwhile.
ROOM_MB=500

require_debian_12() {
  local id="" version=""
  if [ -r /etc/os-release ]; then
    id=$(. /etc/os-release && echo "${ID:-}")
    version=$(. /etc/os-release && echo "${VERSION_ID:-}")
  fi
  [ "$id $version" = "debian 12" ] ||
    say "note: Carpus is built and tested on Debian 12; this is '${id:-unknown} ${version:-}'. Going on."
}

# build_targets PRESET TARGET...: configures the preset if that was never done, or packages came since
# (a library that was missing may be there now), or the presets changed; then builds.
build_targets() {
  local preset=$1
  shift
  local configured=build/$preset/.configured
  if [ ! -f "$configured" ] || [ /var/lib/dpkg/status -nt "$configured" ] || [ CMakePresets.json -nt "$configured" ]; then
    mkdir -p build
    cmake --preset "$preset" >"build/configure-$preset.log" 2>&1 || {
      tail -n 30 "build/configure-$preset.log" >&2
      fail "configuring the build failed; the reason is above."
    }
    touch "$configured"
  fi
  cmake --build "build/$preset" --target "$@" || fail_maybe_full "the build failed; the first error is above."
}

# Runs npm ci only when the lock file changed since it last succeeded. npm alone waits for minutes, in silence,
# where there is no network, and for hours where nobody answers; so the registry is asked for one small
# package first, unless npm's cache holds all.
install_web_packages() {
  local stamp=web/node_modules/.carpus-lock ci=(npm ci --no-audit --no-fund --loglevel=error)
  ! cmp -s web/package-lock.json "$stamp" || return 0
  say "installing the page's packages with npm (100 MB from the network the first time)"
  (cd web && "${ci[@]}" --offline >/dev/null 2>&1) || {
    (cd web && npm view iwer version --fetch-timeout=10000 --fetch-retries=1 --fetch-retry-mintimeout=1000 --loglevel=error >/dev/null) ||
      fail "npm reaches no registry (its reason is above), and the page's packages are not here yet. Connect this machine to the network, or tell npm of a mirror (npm config set registry https://...) or a proxy (npm config set https-proxy http://...), and start again."
    (cd web && "${ci[@]}") || fail_maybe_full "npm could not install the page's packages; the reason is above. Start again where it is the network."
  }
  cp web/package-lock.json "$stamp"
}

# Builds web/dist when a source is newer than the last build. Hints for who writes the page are left to
# `npm run build`: to who starts it they read like faults.
build_web() {
  if [ ! -f web/dist/index.html ] ||
    [ -n "$(find web/src web/public web/index.html web/package-lock.json web/vite.config.* -newer web/dist/index.html -print -quit 2>/dev/null)" ]; then
    (cd web && npm run --silent build -- --logLevel error) || fail_maybe_full "building the page failed; the reason is above."
  fi
}
