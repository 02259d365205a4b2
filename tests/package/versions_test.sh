#!/usr/bin/env bash
# Upgrades a daemon from the version before to this one, back, and again, with data of both, and calls each with the
# client of the other.
#   tests/package/versions_test.sh NEW [OLD]   # folders with the programs of this version and of the one before
# Without OLD it builds the last release, or without one the commit before the last change of the API, the result file
# or the solver (tests/server/data/versions.csv).
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
new=$(cd "$1" && pwd)
folder=$(mktemp -d)
daemon=
finish() {
  [[ -z $daemon ]] || kill "$daemon" 2>/dev/null || true
  wait
  rm -rf "$folder"
}
trap finish EXIT

if [[ -n ${2:-} ]]; then
  old=$(cd "$2" && pwd)
else
  before=$(git -C "$root" describe --tags --abbrev=0 --match 'v*' HEAD^ 2>/dev/null ||
    git -C "$root" log -1 --format=%H^ -- tests/server/data/versions.csv)
  git clone -q "$root" "$folder/source"
  git -C "$folder/source" checkout -q "$(git -C "$root" rev-parse "$before^{commit}")"
  cmake -S "$folder/source" -B "$folder/build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DBUILD_TESTING=OFF \
    >"$folder/build.log"
  cmake --build "$folder/build" --target cellcrushd cellcrush >>"$folder/build.log"
  old=$folder/build/bin
fi
export CELLCRUSH_SERVER=unix:$folder/socket

start() {  # start PROGRAMS [DATA]
  "$1/cellcrushd" --listen "$CELLCRUSH_SERVER" --http none --data "${2:-$folder/data}" --workers 1 \
    --checkpoint-interval 1 >>"$folder/daemon.log" 2>&1 &
  daemon=$!
  for ((i = 0; i < 300; ++i)); do
    if "$1/cellcrush" list >/dev/null 2>&1; then return; fi
    sleep 0.1
  done
  tail "$folder/daemon.log"
  exit 1
}
stop() {
  kill "$daemon"
  wait "$daemon"
  daemon=
}
# Stops the daemon once a job has a checkpoint, which comes every second.
stop_amid() {  # stop_amid PROGRAMS JOB
  until [[ $("$1/cellcrush" show "$2" --json | jq '.progress.step // 0 | tonumber') -gt 0 ]]; do sleep 0.2; done
  sleep 1.5
  stop
}
expect() {  # expect WHAT IS WANTED
  [[ $2 == "$3" ]] || { echo "$1 is \"$2\", not \"$3\""; tail -20 "$folder/daemon.log"; exit 1; }
  echo "ok: $1 is $2"
}
plateau='.summary.plateau_stress_impact_mpa'
# Everything that a user reads of a job, with a client.
digest() {  # digest PROGRAMS JOB
  rm -rf "$folder/fetched"
  "$1/cellcrush" fetch "$2" -o "$folder/fetched" >/dev/null
  "$1/cellcrush" show "$2" --json | jq -j -c "[.state, .note // \"\", $plateau, .summary.step_count]"
  echo " $(cksum <"$folder/fetched/history.csv")"
}
sweep_of() { "$1/cellcrush" sweep preset:hexagon-small --over loading.speed_m_per_s=50,80,110 --json | jq -r .name; }
table_of() { "$1/cellcrush" table "$2" --json | jq -c "[.rows[].result$plateau]"; }

echo "from $("$old/cellcrushd" --version | head -1) to $("$new/cellcrushd" --version | head -1)"
start "$old"
first=$("$old/cellcrush" submit preset:hexagon-small --json | jq -r .name)
"$old/cellcrush" watch "$first" >/dev/null
of_first=$(digest "$old" "$first")
expect "the old job as the new client reads it" "$(digest "$new" "$first")" "$of_first"
sweep=$(sweep_of "$new")
"$old/cellcrush" wait "$sweep" >/dev/null
table=$(table_of "$old" "$sweep")
running=$("$old/cellcrush" submit preset:papka-kyriakides-1 --json | jq -r .name)
waiting=$("$old/cellcrush" submit preset:hexagon-small --json | jq -r .name)
stop_amid "$old" "$running"

"$old/cellcrushd" backup "$folder/of-old" --data "$folder/data" >/dev/null
start "$new"
expect "the old job after the upgrade" "$(digest "$new" "$first")" "$of_first"
expect "the old sweep after the upgrade" "$(table_of "$new" "$sweep")" "$table"
"$old/cellcrush" wait "$running" "$waiting" >/dev/null
expect "what ran and waited meanwhile" \
  "$("$new/cellcrush" list --json | jq -r '[.jobs[].state] | unique | join(",")')" SUCCEEDED
expect "the waiting job against the first" "$("$new/cellcrush" show "$waiting" --json | jq "$plateau")" \
  "$("$new/cellcrush" show "$first" --json | jq "$plateau")"
grep -h "resumes at step\|begin again\|Restarted" "$folder/daemon.log" | tail -1
"$new/cellcrush" note "$first" "of the old version" >/dev/null
of_first=$(digest "$new" "$first")
second=$("$new/cellcrush" submit preset:hexagon-small --set loading.speed_m_per_s=70 --json | jq -r .name)
"$new/cellcrush" watch "$second" >/dev/null
of_second=$(digest "$new" "$second")
expect "the new job as the old client reads it" "$(digest "$old" "$second")" "$of_second"
later=$("$new/cellcrush" submit preset:papka-kyriakides-1 --json | jq -r .name)
stop_amid "$new" "$later"

"$new/cellcrushd" backup "$folder/of-new" --data "$folder/data" >/dev/null
start "$old"
expect "the old job after the downgrade" "$(digest "$old" "$first")" "$of_first"
expect "the new job after the downgrade" "$(digest "$old" "$second")" "$of_second"
expect "the sweep after the downgrade" "$(table_of "$old" "$sweep")" "$table"
"$new/cellcrush" wait "$later" >/dev/null
expect "the job that ran meanwhile against that of before" "$("$old/cellcrush" show "$later" --json | jq "$plateau")" \
  "$("$old/cellcrush" show "$running" --json | jq "$plateau")"
stop
start "$new"
expect "the number of jobs after a second upgrade" "$("$new/cellcrush" list --json | jq '.jobs | length')" 8
stop
"$new/cellcrushd" verify "$folder/data" >/dev/null

"$new/cellcrushd" restore "$folder/of-old" --data "$folder/restored-old" >/dev/null
start "$new" "$folder/restored-old"
expect "the sweep in a backup of the old version" "$(table_of "$new" "$sweep")" "$table"
stop
"$old/cellcrushd" restore "$folder/of-new" --data "$folder/restored-new" >/dev/null
start "$old" "$folder/restored-new"
expect "the new job in a backup of the new version" "$(digest "$old" "$second")" "$of_second"
stop
echo "all is as it should be"
