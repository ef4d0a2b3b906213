#!/usr/bin/env bash
# Checks that the plugin's sources agree with the headers of MeshLab releases that this machine need not have: they are
# parsed with each, and nothing is built.
#
# Usage: scripts/check_meshlab_headers.sh FOLDER
# FOLDER holds a folder for each release, with MeshLab's ML_VERSION and src/common, and with vcglib (vcg, wrap), as they
# lie in its sources or with vcglib beside src. Ends with 77 where nothing can be checked, and says why.
set -euo pipefail

[[ $# == 1 ]] || {
  printf 'usage: %s FOLDER\n' "$0" >&2
  exit 2
}

nothing() {
  printf 'check_meshlab_headers: nothing is checked: %s\n' "$1"
  exit 77
}

root=$(dirname -- "$(dirname -- "$(readlink -f -- "${BASH_SOURCE[0]}")")")
shopt -s nullglob
releases=("$1"/*/ML_VERSION)
[[ ${#releases[@]} -gt 0 ]] || nothing "there are no headers of MeshLab releases in $1"
command -v pkg-config >/dev/null || nothing "there is no pkg-config to find the headers of Qt"
read -ra libraries < <(pkg-config --cflags Qt5Core Qt5Gui Qt5Widgets Qt5OpenGL Qt5Xml eigen3 | sed 's/-I */-isystem /g')
cd "$root"
failed=0
for release in "${releases[@]}"; do
  version=$(<"$release")
  api=${version:0:4}${version:5:2}
  source=${release%/ML_VERSION}
  vcglib=$source/src/vcglib
  [[ -d $vcglib/vcg ]] || vcglib=$source/vcglib
  adapter=api_2021_05
  if ((api < 202105)); then adapter=api_2020_09; fi
  if printf '%s\0' meshlab_plugin/*.cpp "meshlab_plugin/$adapter"/*.cpp |
    xargs -0 -n 1 -P "$(nproc)" "${CXX:-c++}" -std=c++20 -fsyntax-only -fPIC -Wall -Wextra -Wshadow -Wconversion \
      -Wno-sign-conversion -Wno-psabi -Werror -DMESHLAB_SCALAR=float "-DMESHLAB_VERSION=$version" \
      "-DSHBAKE_MESHLAB_API=$api" -I. -Icore -isystem "$source/src" -isystem "$vcglib" "${libraries[@]}"; then
    printf 'MeshLab %s: the sources agree with its headers\n' "$version"
  else
    printf 'MeshLab %s: the sources do not agree with its headers\n' "$version"
    failed=1
  fi
done
exit "$failed"
