# shellcheck shell=bash
# Functions shared by the scripts of this folder. Source it; it runs nothing by itself.

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
log_folder=$root/build/log

say() { printf '%s\n' "$@"; }

# fail MESSAGE...: one line per argument to standard error, then exit 1.
fail() {
  printf '%s\n' "$@" >&2
  exit 1
}

# logged NAME COMMAND...: runs the command with its output in build/log/NAME.log. When it fails, shows the end of the
# log.
logged() {
  local name=$1
  shift
  mkdir -p "$log_folder"
  local log=$log_folder/$name.log
  if ! "$@" >"$log" 2>&1 </dev/null; then
    tail -n 40 "$log" >&2
    fail "" "Failed: $*" "Full log: $log"
  fi
}

# Shows ninja's progress: one updated line on a terminal, every 25th line elsewhere.
show_ninja_progress() {
  local line
  while IFS= read -r line; do
    [[ $line =~ ^\[([0-9]+)/([0-9]+)\] ]] || continue
    if [[ -t 1 ]]; then
      printf '\r  %s of %s ' "${BASH_REMATCH[1]}" "${BASH_REMATCH[2]}"
    elif ((BASH_REMATCH[1] > 0 && BASH_REMATCH[1] % 25 == 0 || BASH_REMATCH[1] == BASH_REMATCH[2])); then
      printf '  %s of %s\n' "${BASH_REMATCH[1]}" "${BASH_REMATCH[2]}"
    fi
  done
  if [[ -t 1 ]]; then printf '\r\033[K'; fi
}

# build_preset PRESET: configures build/PRESET if necessary, then builds what is out of date.
build_preset() {
  local preset=$1
  local folder=$root/build/$preset
  local cache=$folder/CMakeCache.txt
  if [[ -f $cache ]] && ! grep -qxF "CMAKE_HOME_DIRECTORY:INTERNAL=$root" "$cache"; then
    say "  build/$preset was configured for another source folder; it is deleted and configured again."
    rm -rf "$folder"
  fi
  if [[ ! -f $folder/build.ninja ]]; then
    logged "configure-$preset" cmake -S "$root" --preset "$preset"
  fi
  local log=$log_folder/build-$preset.log
  mkdir -p "$log_folder"
  if ! (cd "$root" && cmake --build --preset "$preset" --parallel "$(nproc)") 2>&1 </dev/null | tee "$log" |
    show_ninja_progress; then
    grep -nE 'FAILED:|error:|undefined reference' "$log" | head -n 20 >&2 || tail -n 40 "$log" >&2
    fail "" "Failed: the build of preset $preset." "Full log: $log"
  fi
}
