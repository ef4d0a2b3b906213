# shellcheck shell=bash
# Packages, configuring and building, shared by ./shbake and ./test.sh, which source it with $root set to the project's
# folder. All it says goes to stderr, since stdout belongs to the program; what tools print goes to a log in build/.
: "${root:?is set by the script that sources this one}"

say() { printf 'shbake: %s\n' "$*" >&2; }

die() {
  say "$@"
  exit 1
}

# One build at a time; a second one waits.
lockBuild() {
  mkdir -p "$root/build"
  exec 9>"$root/build/lock"
  flock 9
}

unlockBuild() { exec 9>&-; }

onTerminal() { [[ -t 0 && -t 2 ]]; }

# Files that list packages, and options for configuring: scripts that build more than the program add to them.
packageLists=("$root/packages.txt")
cmakeOptions=()

neededPackages() { sed -E -e 's/[[:space:]]*(#.*)?$//' -e '/^$/d' "${packageLists[@]}"; }

missingPackages() {
  local installed
  # shellcheck disable=SC2046 # one word a package
  installed=$(dpkg-query -W -f '${Package} ${db:Status-Status}\n' $(neededPackages) 2>/dev/null | sed -n 's/ installed$//p')
  comm -23 <(neededPackages | sort -u) <(sort -u <<<"$installed")
}

# failWithLog LOG WHAT: the end of the log, where to find all of it, and exit.
failWithLog() {
  tail -n 25 "$1" >&2
  die "$2 failed; the whole log is $1"
}

# Installs the Debian packages that are listed and missing; on other systems says what is needed and stops.
ensurePackages() {
  if ! command -v apt-get >/dev/null || ! command -v dpkg-query >/dev/null; then
    die "this is not Debian (no apt-get); install what these Debian packages hold, then run" \
      "'cmake --preset release && cmake --build --preset release': $(neededPackages | paste -sd ' ')"
  fi
  local missing command=()
  missing=$(missingPackages)
  [[ -n $missing ]] || return 0
  missing=${missing//$'\n'/ }
  if [[ $(id -u) != 0 ]]; then
    command -v sudo >/dev/null ||
      die "packages are missing and there is no sudo; as root, run: apt-get install --no-install-recommends $missing"
    command=(sudo)
  fi
  say "needs these Debian packages: $missing"
  if onTerminal; then
    local answer
    read -r -p "shbake: install them with apt-get now? [Y/n] " answer
    [[ $answer =~ ^([Yy].*)?$ ]] || die "not installed; run: apt-get install --no-install-recommends $missing"
  fi
  local log=$root/build/packages.log
  say "installing; log in ${log#"$root"/}"
  command+=(env DEBIAN_FRONTEND=noninteractive apt-get -o DPkg::Lock::Timeout=300)
  # An update that fails in part (one source of several) may still leave all that is needed.
  "${command[@]}" update >"$log" 2>&1 || say "apt-get update failed; going on with the package lists there are"
  # shellcheck disable=SC2086
  "${command[@]}" install -y --no-install-recommends $missing >>"$log" 2>&1 </dev/null ||
    failWithLog "$log" "apt-get install --no-install-recommends $missing"
}

# Passes ninja's output on to the log, and to a terminal as one line that counts.
countSteps() {
  local line
  while IFS= read -r line; do
    printf '%s\n' "$line" >>"$1"
    if [[ -t 2 && $line =~ ^\[[0-9]+/[0-9]+\] ]]; then printf '\r\033[Kshbake: building %s' "${BASH_REMATCH[0]}" >&2; fi
  done
  if [[ -t 2 ]]; then printf '\r\033[K' >&2; fi
}

# build PRESET TARGET...: configures and builds targets of a preset of CMakePresets.json.
build() {
  local preset=$1 folder=$root/build/$1 log=$root/build/$1.log
  shift
  # CMake refuses a cache that was made elsewhere: a project that was moved or copied starts afresh.
  if [[ -f $folder/CMakeCache.txt ]] && ! grep -qxF "CMAKE_HOME_DIRECTORY:INTERNAL=$root" "$folder/CMakeCache.txt"; then
    rm -rf "$folder"
  fi
  if [[ -d $folder ]]; then say "updating the $preset build; log in ${log#"$root"/}"; else
    say "building ($preset, the first time takes a few minutes); log in ${log#"$root"/}"
  fi
  (cd "$root" && cmake --preset "$preset" "${cmakeOptions[@]}") >"$log" 2>&1 </dev/null || failWithLog "$log" "configuring"
  NINJA_STATUS='[%f/%t] ' ninja -C "$folder" "$@" 2>&1 </dev/null | countSteps "$log" || failWithLog "$log" "building"
}

# Adds the MeshLab plugin to what is configured, with its packages and MeshLab's headers. Returns false, having said why,
# where these cannot be had.
addMeshLabPlugin() {
  local log=$root/build/meshlab-source.log list=$root/meshlab_plugin/packages.txt
  cmakeOptions+=(-DSHBAKE_MESHLAB=OFF)
  # In a shell of its own, which ends where a package cannot be installed.
  (packageLists+=("$list") && ensurePackages) || return 1
  if ! "$root/scripts/fetch_meshlab_source.sh" "$root/build/meshlab-source" >"$log" 2>&1 </dev/null; then
    tail -n 3 "$log" >&2
    say "MeshLab's source package, which holds its headers, cannot be fetched; the whole log is $log"
    return 1
  fi
  cmakeOptions+=(-DSHBAKE_MESHLAB=ON)
}
