#!/usr/bin/env bash
# Builds the plugins for this machine's MeshLab and installs them, or takes them away again: ./shbake meshlab
set -euo pipefail

root=$(dirname -- "$(dirname -- "$(readlink -f -- "${BASH_SOURCE[0]}")")")
# shellcheck source=scripts/setup.sh
. "$root/scripts/setup.sh"

usage() {
  cat <<'TEXT'
usage: ./shbake meshlab install [--prefix DIR]     build the plugins for MeshLab and install them
       ./shbake meshlab uninstall [--prefix DIR]   remove them
       ./shbake meshlab build                      build them only

MeshLab is expected in --prefix, /usr by default. Packages that are missing are installed first. docs/meshlab.md tells
what the plugins do.
TEXT
}

fail() {
  say "$1"
  say "see './shbake meshlab --help'"
  exit 2
}

action=${1:-}
[[ $# == 0 ]] || shift
prefix=/usr
while [[ $# -gt 0 ]]; do
  case $1 in
    --prefix)
      [[ -n ${2:-} ]] || fail "--prefix needs a folder"
      prefix=$(realpath -m -- "$2")
      shift 2
      ;;
    --help)
      action=--help
      shift
      ;;
    *) fail "unknown argument $1" ;;
  esac
done

buildPlugins() {
  lockBuild
  ensurePackages
  addMeshLabPlugin || die "the plugins cannot be built"
  build meshlab-plugin meshlab_plugin
  unlockBuild
}

# asOwner COMMAND...: runs it as root where the prefix belongs to root.
asOwner() {
  local folder=$prefix
  while [[ ! -e $folder ]]; do folder=$(dirname -- "$folder"); done
  if [[ -w $folder ]]; then
    "$@"
  elif command -v sudo >/dev/null; then
    sudo "$@"
  else
    die "$folder cannot be written and there is no sudo; run this as root"
  fi
}

# The files that an installation has put there.
installedFiles() {
  local file
  for file in "$prefix"/lib/*/meshlab/plugins/lib{filter_shbake,render_shrelight}.so \
    "$prefix"/lib/*/meshlab/lib/shbake/libshbake_map_file.so; do
    if [[ -e $file ]]; then printf '%s\n' "$file"; fi
  done
}

case $action in
  build) buildPlugins ;;
  install)
    buildPlugins
    asOwner cmake --install "$root/build/meshlab-plugin" --component meshlab --prefix "$prefix" \
      >"$root/build/meshlab-plugin.install.log" || die "installing failed"
    say "installed for the MeshLab in $prefix:"
    installedFiles >&2
    ;;
  uninstall)
    mapfile -t files < <(installedFiles)
    [[ ${#files[@]} -gt 0 ]] || die "there are no plugins of shbake in $prefix"
    if dpkg-query -S "${files[0]}" >/dev/null 2>&1; then
      die "the plugins were installed as a package: apt-get remove meshlab-plugin-shbake"
    fi
    asOwner rm -f -- "${files[@]}"
    for file in "${files[@]}"; do
      # The folders that only the module was in.
      if [[ $file == */lib/shbake/* ]]; then asOwner rmdir -p --ignore-fail-on-non-empty -- "${file%/*}" 2>/dev/null || true; fi
    done
    say "removed from $prefix:"
    printf '%s\n' "${files[@]}" >&2
    ;;
  --help | -h) usage ;;
  '') fail "no action is named: install, uninstall or build" ;;
  *) fail "unknown action $action" ;;
esac
