#!/usr/bin/env bash
# Is one commit faster, smaller or more exact than another? Builds both in scratch folders and bakes the same meshes with
# both in turns (scripts/compare_builds.py), since what else the machine does changes from minute to minute.
#
# Usage: scripts/compare_commits.sh A B [MESH...]    A, B: commits; MESH: default: samples/scenes
set -euo pipefail

root=$(dirname -- "$(dirname -- "$(readlink -f -- "${BASH_SOURCE[0]}")")")
if [[ $# -lt 2 ]]; then
  sed -n '2,5s/^# \{0,1\}//p' "${BASH_SOURCE[0]}" >&2
  exit 2
fi
commits=("$1" "$2")
shift 2
meshes=("$@")
[[ $# -gt 0 ]] || meshes=("$root"/samples/scenes/*.obj)

ids=()
for commit in "${commits[@]}"; do
  ids+=("$(git -C "$root" rev-parse --verify --quiet "$commit^{commit}")") || {
    echo "compare_commits: '$commit' is no commit" >&2
    exit 2
  }
done
for mesh in "${meshes[@]}"; do
  [[ -f $mesh ]] || {
    echo "compare_commits: there is no mesh $mesh" >&2
    exit 2
  }
done

letters=(A B)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
for i in 0 1; do
  source=$work/$i
  mkdir "$source"
  git -C "$root" archive "${ids[i]}" | tar -x -C "$source"
  echo "building ${letters[i]}, ${commits[i]} ($(git -C "$root" log -1 --format='%h %s' "${ids[i]}"))" >&2
  if ! { cmake -S "$source" -B "$source/build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DSHBAKE_TESTS=OFF &&
    cmake --build "$source/build" --target shbake; } >"$work/log" 2>&1; then
    tail -n 25 "$work/log" >&2
    echo "compare_commits: ${commits[i]} cannot be built" >&2
    exit 1
  fi
done
python3 "$root/scripts/compare_builds.py" "$work/0/build/cli/shbake" "$work/1/build/cli/shbake" "${meshes[@]}"
