# shellcheck shell=bash
# SPDX-License-Identifier: BSD-3-Clause
# Sourced by samples/run and tests/run: what both need before their own work. Everything here does
# nothing, quickly, when it has been done before.

granular_source="$(CDPATH="" cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.." && pwd)"

# Debian's names. What the core and its tests need, and what the rest needs on top of it.
granular_core_packages=(
  binutils cmake g++ libbenchmark-dev libgtest-dev libzstd-dev locales ninja-build python3
  zlib1g-dev)
granular_plugin_packages=(
  libopenmpi-dev openmpi-bin paraview-dev python3-dev python3-paraview xvfb)

granular_say()
{
  printf -- '-- %s\n' "$*" >&2
}

# granular_as_root command...: as root, or through sudo.
granular_as_root()
{
  if [ "$(id -u)" -eq 0 ]; then
    "$@"
  else
    sudo "$@"
  fi
}

# granular_may_install: root, or sudo that works now or can ask somebody.
granular_may_install()
{
  [ "$(id -u)" -eq 0 ] && return 0
  command -v sudo >/dev/null || return 1
  sudo -n true 2>/dev/null || [ -t 0 ]
}

# granular_need package...: installs those that are missing.
granular_need()
{
  if ! command -v dpkg-query >/dev/null; then
    granular_say "not a Debian system: expecting that these are there by other names: $*"
    return 0
  fi
  local installed missing=() package
  installed="$(dpkg-query --show --showformat='${db:Status-Status} ${Package}\n' "$@" 2>/dev/null ||
    true)"
  for package in "$@"; do
    case $'\n'"$installed"$'\n' in
      *$'\n'"installed $package"$'\n'*) ;;
      *) missing+=("$package") ;;
    esac
  done
  [ "${#missing[@]}" -eq 0 ] && return 0

  if ! granular_may_install; then
    granular_say "these packages are missing, and only root may install them:"
    printf '  apt-get install --no-install-recommends %s\n' "${missing[*]}" >&2
    exit 1
  fi
  granular_say "installing ${missing[*]}"
  # Old package lists may still do, so a failing update is not the end.
  granular_as_root apt-get -q update || granular_say "apt-get update failed, going on"
  granular_as_root env DEBIAN_FRONTEND=noninteractive \
    apt-get -q install --yes --no-install-recommends "${missing[@]}"
}

# granular_configure preset [-Doption...]: sets granular_build, the build folder. ninja itself sees
# to changed CMake files; what it does not know of is the presets, this file, and a moved tree.
granular_configure()
{
  local preset="$1"
  shift
  granular_build="$granular_source/build/$preset"
  local stamp="$granular_build/configured"
  local wanted="$granular_source $*"
  if [ -f "$granular_build/build.ninja" ] && [ -f "$stamp" ] && [ "$(cat "$stamp")" = "$wanted" ] &&
    [ ! "$granular_source/CMakePresets.json" -nt "$stamp" ]; then
    return 0
  fi
  local fresh=()
  if [ -f "$granular_build/CMakeCache.txt" ] &&
    ! grep -qxF "CMAKE_HOME_DIRECTORY:INTERNAL=$granular_source" "$granular_build/CMakeCache.txt"; then
    fresh=(--fresh)
  fi
  rm -f "$stamp"
  granular_say "configuring build/$preset"
  (cd "$granular_source" && cmake --preset "$preset" "${fresh[@]}" "$@" >&2)
  printf '%s\n' "$wanted" >"$stamp"
}

granular_make()
{
  granular_say "building ${granular_build#"$granular_source"/}"
  ninja -C "$granular_build" -j "$(nproc)" >&2
}

# granular_set_up full|core-only: from a bare Debian 12 to a finished build. Strict in all cases, so
# that samples/run and tests/run share one build and a warning is seen wherever it arises.
granular_set_up()
{
  case "$1" in
    full)
      granular_need "${granular_core_packages[@]}" "${granular_plugin_packages[@]}"
      granular_configure release -DGRANULAR_STRICT=ON
      ;;
    core-only)
      granular_need "${granular_core_packages[@]}"
      granular_configure core-only
      ;;
  esac
  granular_make
}
