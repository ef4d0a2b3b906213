#!/usr/bin/env bash
# Builds shbake and runs all its tests, ending with ctest's summary. Options are handed to ctest: ./test.sh -R base
set -euo pipefail

root=$(dirname -- "$(readlink -f -- "${BASH_SOURCE[0]}")")
# shellcheck source=scripts/setup.sh
. "$root/scripts/setup.sh"

lockBuild
ensurePackages
addMeshLabPlugin || say "the MeshLab plugin is neither built nor tested; all else is"
build ci all
unlockBuild
cd "$root"
exec ctest --preset ci --parallel "$(nproc)" "$@"
