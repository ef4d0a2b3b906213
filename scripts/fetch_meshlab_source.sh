#!/usr/bin/env bash
# Fetches the Debian source package that the installed MeshLab was built from, for its headers: Debian has no package of
# them. Nothing of it is built, and the system's own package sources stay as they are.
#
# Usage: scripts/fetch_meshlab_source.sh FOLDER
# Leaves the sources in FOLDER/source, and their version in FOLDER/version; does nothing when that version is there.
set -euo pipefail

die() {
  printf 'fetch_meshlab_source: %s\n' "$*" >&2
  exit 1
}

[[ $# == 1 ]] || die "usage: $0 FOLDER"
for tool in apt-get dpkg-query dpkg-source; do
  command -v "$tool" >/dev/null || die "there is no $tool: this works on Debian with the package dpkg-dev"
done
version=$(dpkg-query -W -f '${source:Version}' meshlab 2>/dev/null) || die "the package meshlab is not installed"
mkdir -p "$1"
folder=$(cd "$1" && pwd)
if [[ -f $folder/version && $(<"$folder/version") == "$version" && -d $folder/source ]]; then exit 0; fi

# A copy of the configured package sources that names source packages in place of binary ones.
apt=$folder/apt
rm -rf "$apt" "$folder/source" "$folder/version"
mkdir -p "$apt/parts" "$apt/lists/partial" "$apt/cache/archives/partial"
trap 'rm -rf "$apt"' EXIT
etc=/etc/apt
for file in "$etc"/sources.list "$etc"/sources.list.d/*.list; do
  [[ -f $file ]] && sed -n 's/^deb[[:space:]]/deb-src /p' "$file" >"$apt/parts/${file##*/}.list"
done
for file in "$etc"/sources.list.d/*.sources; do
  [[ -f $file ]] && sed 's/^Types:.*/Types: deb-src/' "$file" >"$apt/parts/${file##*/}"
done
options=(-q -o Dir::Etc::SourceList=/dev/null -o Dir::Etc::SourceParts="$apt/parts" -o Dir::State::Lists="$apt/lists"
  -o Dir::Cache="$apt/cache" -o APT::Sandbox::User= -o Acquire::Languages=none -o Acquire::Retries=2
  -o Acquire::http::Timeout=30 -o Acquire::https::Timeout=30)

# An update that fails in part (one source of several) may still leave all that is needed.
apt-get "${options[@]}" update || printf 'apt-get update failed; going on with what was fetched\n' >&2
cd "$apt"
apt-get "${options[@]}" source --download-only "meshlab=$version" || die "the source of meshlab $version cannot be fetched"
dpkg-source -q --no-check -x meshlab_*.dsc "$folder/source"
rm -f "$folder"/meshlab_* # dpkg-source leaves a copy of the archive beside what it unpacks
printf '%s\n' "$version" >"$folder/version"
