# shellcheck shell=bash
# SPDX-License-Identifier: BSD-3-Clause
# Sourced by packaging/portable and packaging/windows: the folder that both make.

# shellcheck source=cmake/setup.sh
. "$(dirname "${BASH_SOURCE[0]}")/../cmake/setup.sh"
cd "$granular_source"
SOURCE_DATE_EPOCH="${SOURCE_DATE_EPOCH:-$(git log -1 --format=%ct 2>/dev/null || date --reference=CHANGELOG.md +%s)}"
export SOURCE_DATE_EPOCH
packages=build/packages

# name_of_folder system: sets name and version; the build folder is configured.
name_of_folder()
{
  version="$(sed -n 's/^CMAKE_PROJECT_VERSION:STATIC=//p' "$granular_build/CMakeCache.txt")"
  name="vtk-granular-$version-$1"
}

# make_folder folder system libraries licences: the package with its libraries (a pattern below the prefix), the plugin, the licences of
# what is in it (a list of name=file), and something to open.
make_folder()
{
  local prefix="$granular_build/prefix" component each
  rm -rf "$prefix"
  mkdir -p "$1"
  for component in c python; do
    cmake --install "$granular_build" --prefix "$prefix" --component "$component" --strip >"$granular_build/install.log"
  done
  cp -r "$prefix"/lib/python3/dist-packages/vtkgranular "$1/"
  # shellcheck disable=SC2086 # a pattern
  cp --dereference "$prefix"/$3 "$1/vtkgranular/" # the names that programs are linked to
  mkdir "$1/vtkgranular/licences"
  for each in $4; do
    [ ! -e "${each#*=}" ] || cp "${each#*=}" "$1/vtkgranular/licences/${each%%=*}"
  done
  cp plugin/python/vtkgranular/portable/Granular.py samples/data/grains.dump LICENSE "$1/"
  sed "s/@system@/$2/" packaging/portable.txt >"$1/README.txt"
  chmod -R u=rwX,go=rX "$1"
  find "$1" -exec touch --no-dereference --date="@$SOURCE_DATE_EPOCH" {} +
}
