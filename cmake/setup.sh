# shellcheck shell=bash
# SPDX-License-Identifier: BSD-3-Clause
# Sourced by samples/run, tests/run, tests/fuzz/run, tests/tidy, tests/bench/run and packaging/deb: what they need before their own work.
# Everything here does nothing, quickly, when it has been done before.

granular_source="$(CDPATH="" cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.." && pwd)"

# Debian's names: what the core needs, the plugin and the samples on top of it, a VTK of its own, the tests, and the fuzz targets.
granular_core_packages=(cmake g++ libzstd-dev ninja-build python3 zlib1g-dev)
if [ "$(dpkg --print-architecture 2>/dev/null)" = amd64 ]; then
  granular_core_packages+=(libisal-dev) # Debian has it for this processor alone
fi
granular_plugin_packages=(
  libopenmpi-dev openmpi-bin paraview-dev python3-dev python3-paraview xauth xvfb)
granular_vtk_packages=(libopenmpi-dev libvtk9-dev openmpi-bin python3-dev python3-vtk9 xauth xvfb)
granular_test_packages=(binutils gfortran libbenchmark-dev libgtest-dev locales python3-jsonschema python3-matplotlib python3-numpy python3-scipy
  python3-setuptools python3-venv python3-wheel voro++)
granular_site_packages=(chromium doxygen mkdocs-material) # for packaging/site and its test, which is skipped without
granular_fuzz_packages=(clang libclang-rt-dev llvm)

# Warnings are errors on Debian 12, whose compiler is known; a newer one may have new warnings. GRANULAR_STRICT=ON or OFF in the environment
# says otherwise.
granular_strict="-DGRANULAR_STRICT=${GRANULAR_STRICT:-$(grep -qsx 'VERSION_CODENAME=bookworm' /etc/os-release && echo ON || echo OFF)}"

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
    apt-get -q install --yes --no-install-recommends --no-remove "${missing[@]}"
}

# granular_need_plugin [package...]: where Debian's ParaView uses Debian's VTK, the development files of VTK are another
# package. ParaView's window needs what Debian only recommends: Qt's driver for SQLite (0.3 MB) for its help, and Qt 6's plugin for
# SVG (0.2 MB) for its icons.
granular_need_plugin()
{
  granular_need "${granular_core_packages[@]}" "${granular_plugin_packages[@]}" "$@"
  command -v dpkg-query >/dev/null || return 0
  local more=() library
  if dpkg-query --show --showformat='${Depends}' paraview | grep -q libvtk9; then
    more+=("${granular_vtk_packages[@]}")
  fi
  local -A plugins=([libqt5sql5]=libqt5sql5-sqlite [libqt6sql6]=libqt6sql6-sqlite [libqt6svg6]=qt6-svg-plugins)
  for library in "${!plugins[@]}"; do
    # Debian 12 has Qt 6's plugin for SVG in the library
    if [ "$(dpkg-query --show --showformat='${db:Status-Status}' "$library" 2>/dev/null)" = installed ] &&
      apt-cache show "${plugins[$library]}" >/dev/null 2>&1; then
      more+=("${plugins[$library]}")
    fi
  done
  [ "${#more[@]}" -eq 0 ] || granular_need "${more[@]}"
}

# granular_is_configured preset [-Doption...]: sets granular_build, the build folder. ninja itself
# sees to changed CMake files; what it does not know of is the presets, this file, and a moved tree.
granular_is_configured()
{
  granular_build="$granular_source/build/$1"
  shift
  local stamp="$granular_build/configured"
  [ -f "$granular_build/build.ninja" ] && [ -f "$stamp" ] &&
    [ "$(cat "$stamp")" = "$granular_source $*" ] &&
    [ ! "$granular_source/CMakePresets.json" -nt "$stamp" ]
}

# granular_configure preset [-Doption...]: the same, done where it was not.
granular_configure()
{
  granular_is_configured "$@" && return 0
  local preset="$1"
  shift
  local stamp="$granular_build/configured"
  local fresh=()
  if [ -f "$granular_build/CMakeCache.txt" ] &&
    ! grep -qxF "CMAKE_HOME_DIRECTORY:INTERNAL=$granular_source" "$granular_build/CMakeCache.txt"; then
    fresh=(--fresh)
  fi
  rm -f "$stamp"
  granular_say "configuring build/$preset"
  (cd "$granular_source" && cmake --preset "$preset" "${fresh[@]}" "$@" >&2)
  printf '%s\n' "$granular_source $*" >"$stamp"
}

# granular_make [target...]
granular_make()
{
  granular_say "building ${granular_build#"$granular_source"/}"
  ninja -C "$granular_build" -j "$(nproc)" "$@" >&2
}

# granular_set_up samples|tests|plugin|benchmarks|vtk-samples|vtk|core-only|asan|tsan|damaged|fuzz|fuzz-coverage: from a bare Debian to a finished
# build. The first four share one; for samples the tests are not even configured, unless they were before.
granular_set_up()
{
  local tests=(release "$granular_strict" -DBUILD_TESTING=ON -DGRANULAR_BUILD_BENCH=ON)
  case "$1" in
    samples)
      granular_need_plugin
      granular_is_configured "${tests[@]}" ||
        granular_configure release "$granular_strict" -DBUILD_TESTING=OFF
      granular_make core/all plugin/all plugin/python/all
      ;;
    tests | plugin | benchmarks)
      granular_need_plugin "${granular_test_packages[@]}"
      ! apt-cache show clang-format-14 >/dev/null 2>&1 || granular_need clang-format-14 # not every suite has it
      granular_configure "${tests[@]}"
      case "$1" in
        tests) granular_make ;;
        plugin) granular_make core/all plugin/all plugin/python/all tests_vtk ;;
        benchmarks) granular_make core/all plugin/all plugin/python/all benchmarks ;;
      esac
      ;;
    vtk-samples)
      granular_need "${granular_core_packages[@]}" "${granular_vtk_packages[@]}"
      granular_is_configured vtk "$granular_strict" -DBUILD_TESTING=ON ||
        granular_configure vtk "$granular_strict" -DBUILD_TESTING=OFF
      granular_make core/all vtkGranular plugin/python/all
      ;;
    vtk)
      granular_need "${granular_core_packages[@]}" "${granular_vtk_packages[@]}" "${granular_test_packages[@]}"
      granular_configure vtk "$granular_strict" -DBUILD_TESTING=ON
      granular_make
      ;;
    core-only | asan | tsan | damaged)
      granular_need "${granular_core_packages[@]}" "${granular_test_packages[@]}"
      case "$1" in
        damaged) granular_configure asan "$granular_strict" && granular_make tests_fuzz ;;
        *) granular_configure "$1" "$granular_strict" && granular_make ;;
      esac
      ;;
    fuzz | fuzz-coverage)
      granular_need "${granular_core_packages[@]}" "${granular_test_packages[@]}" "${granular_fuzz_packages[@]}"
      granular_configure "$1"
      granular_make tests_fuzz
      ;;
  esac
}
