# shellcheck shell=bash
# Sourced by ./run, ./check and scripts: finds the project, installs what is missing, builds. bash 5.
# Every function may be called from any directory.

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

# find_missing_packages LIST…: fills the array missing_packages with the names in the files LIST (in
# the project's folder) that are not installed.
find_missing_packages() {
  local -a wanted
  mapfile -t wanted < <(cd "$palpa_root" && cat "$@" | sed -e 's/#.*//' -e 's/[[:space:]]*$//' -e '/^$/d' | sort -u)
  # dpkg-query fails if it does not know one of the names; its output is still complete.
  mapfile -t missing_packages < <(comm -23 <(printf '%s\n' "${wanted[@]}") \
    <(dpkg-query -W -f='${db:Status-Status} ${Package}\n' "${wanted[@]}" 2>/dev/null |
      sed -n 's/^installed //p' | sort -u))
}

# install_packages [LIST…]: packages.txt without arguments.
install_packages() {
  local -a lists=("${@:-packages.txt}")
  command -v dpkg-query >/dev/null ||
    fail "this is not a Debian system; install what ${lists[*]} lists by other means"
  find_missing_packages "${lists[@]}"
  [[ ${#missing_packages[@]} -gt 0 ]] || return 0
  say "installing ${missing_packages[*]}"
  export DEBIAN_FRONTEND=noninteractive
  as_root apt-get -qq update || fail "apt-get update failed: is the package mirror reachable?"
  as_root apt-get -qq install -y --no-install-recommends "${missing_packages[@]}" ||
    fail "apt-get could not install ${missing_packages[*]}; see its message above"
  find_missing_packages "${lists[@]}"
  [[ ${#missing_packages[@]} -eq 0 ]] || fail "still not installed: ${missing_packages[*]}"
}

# configure_preset NAME: configures build/NAME.
configure_preset() {
  say "configuring $1"
  (cd "$palpa_root" && cmake --preset "$1" >"$palpa_root/.configure.log" 2>&1) || {
    cat "$palpa_root/.configure.log" >&2
    rm -f "$palpa_root/.configure.log"
    fail "CMake could not configure the preset $1"
  }
  rm -f "$palpa_root/.configure.log"
}

# build_preset NAME [TARGET…]: configures build/NAME when needed and builds the targets, or everything.
build_preset() {
  local preset=$1
  local -a targets=()
  [[ $# -eq 1 ]] || targets=(--target "${@:2}")
  [[ -f $palpa_root/build/$preset/build.ninja ]] || configure_preset "$preset"
  say "building $preset"
  (cd "$palpa_root" && cmake --build --preset "$preset" "${targets[@]}") || fail "the preset $preset does not build"
}

# replace_between PAGE NAME FUNCTION: what the function prints replaces what stands in the page
# between the marks of NAME, <!-- NAME of scripts/SCRIPT --> and <!-- end of NAME -->.
replace_between() {
  local page=$1 name=$2 text
  text=$("$3")
  TEXT=$text awk -v name="$name" -v script="$(basename "$0")" '
    index($0, "<!-- end of " name " -->") { print ENVIRON["TEXT"] "\n"; inside = 0 }
    !inside { print }
    index($0, "<!-- " name " of scripts/" script " -->") { inside = 1 }' "$page" >"$page.new"
  mv "$page.new" "$page"
}

# machine_lines: date, machine, system and commit of a measurement, as lines "what;value".
machine_lines() {
  date -u '+date;%Y-%m-%d %H:%M UTC'
  echo "machine;$(sed -n 's/^model name[^:]*: //p' /proc/cpuinfo | head -n 1), $(nproc) cores, $(awk '/MemTotal/ { printf "%.0f GiB", $2 / 1048576 }' /proc/meminfo)"
  echo "system;$(. /etc/os-release && echo "$PRETTY_NAME"), $("${CXX:-c++}" --version | head -n 1)"
  echo "commit;$(git -c safe.directory="$palpa_root" -C "$palpa_root" rev-parse --short HEAD 2>/dev/null || echo unknown)"
}
