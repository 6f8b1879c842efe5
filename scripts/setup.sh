# shellcheck shell=bash
# Sourced by ./run and ./check: finds the project, installs what is missing, builds. bash 5.
# Every function may be called from any directory; nothing is done twice.

palpa_root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)

say() { printf '== %s\n' "$*"; }

fail() {
  printf '%s: %s\n' "$(basename "$0")" "$*" >&2
  exit 1
}

as_root() {
  if [[ $EUID -eq 0 ]]; then
    "$@"
  elif command -v sudo >/dev/null; then
    sudo --preserve-env=DEBIAN_FRONTEND "$@"
  else
    fail "packages must be installed: run this as root, install sudo, or install them yourself:" \
      "apt-get install ${missing_packages[*]}"
  fi
}

# Fills the array missing_packages with those of packages.txt that are not installed.
find_missing_packages() {
  local -a wanted
  mapfile -t wanted < <(sed -e 's/#.*//' -e 's/[[:space:]]*$//' -e '/^$/d' "$palpa_root/packages.txt" | sort -u)
  # dpkg-query fails when it does not know one of the names: that is an answer, not an error.
  mapfile -t missing_packages < <(comm -23 <(printf '%s\n' "${wanted[@]}") \
    <(dpkg-query -W -f='${db:Status-Status} ${Package}\n' "${wanted[@]}" 2>/dev/null |
      sed -n 's/^installed //p' | sort -u))
}

install_packages() {
  command -v dpkg-query >/dev/null ||
    fail "this is not a Debian system; install what packages.txt lists by other means"
  find_missing_packages
  [[ ${#missing_packages[@]} -gt 0 ]] || return 0
  say "installing ${missing_packages[*]}"
  export DEBIAN_FRONTEND=noninteractive
  as_root apt-get -qq update || fail "apt-get update failed: is the package mirror reachable?"
  as_root apt-get -qq install -y --no-install-recommends "${missing_packages[@]}" ||
    fail "apt-get could not install ${missing_packages[*]}; see its message above"
  find_missing_packages
  [[ ${#missing_packages[@]} -eq 0 ]] || fail "still not installed: ${missing_packages[*]}"
}

# build_preset NAME: configures build/NAME when needed and builds everything in it.
build_preset() {
  local preset=$1
  if [[ ! -f $palpa_root/build/$preset/build.ninja ]]; then
    say "configuring $preset"
    (cd "$palpa_root" && cmake --preset "$preset" >"$palpa_root/.configure.log" 2>&1) || {
      cat "$palpa_root/.configure.log" >&2
      rm -f "$palpa_root/.configure.log"
      fail "CMake could not configure the preset $preset"
    }
    rm -f "$palpa_root/.configure.log"
  fi
  say "building $preset"
  (cd "$palpa_root" && cmake --build --preset "$preset") || fail "the preset $preset does not build"
}
