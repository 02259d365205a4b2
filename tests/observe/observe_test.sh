#!/usr/bin/env bash
# The rules and the dashboard of deploy/observe against the metrics of a daemon, which deploy/observe/start watches.
# All of it is on loopback, in a temporary folder.
#   tests/observe/observe_test.sh CELLCRUSHD CELLCRUSH
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
cellcrushd=$1
cellcrush=$2
observe=$root/deploy/observe
folder=$(mktemp -d)
processes=()
failures=0

# Metrics of a daemon with what this one lacks: a device, and targets of notices.
elsewhere=(cellcrush_device_info cellcrush_device_runs_total cellcrush_notices_total cellcrush_notices_behind)

finish() {
  for pid in "${processes[@]}"; do kill "$pid" 2>/dev/null || true; done
  wait
  rm -rf "$folder"
}
trap finish EXIT
trap 'exit 143' INT TERM

wrong() {
  printf '%s\n' "$@"
  failures=$((failures + 1))
}
# A failure after which nothing else can be tested.
give_up() {
  printf '%s\n' "$@"
  tail -n 20 "$folder"/*.log "$folder"/observe/*.log 2>/dev/null || true
  exit 1
}
# wait_for WHAT COMMAND...: until the command succeeds.
wait_for() {
  local what=$1 end=$((SECONDS + 30))
  shift
  while ((SECONDS < end)); do
    if "$@"; then return 0; fi
    sleep 0.1
  done
  give_up "After 30 s there is not: $what"
}
# refused WORDS COMMAND...: the command fails with these words.
refused() {
  local words=$1 output
  shift
  if output=$("$@" 2>&1); then wrong "not refused: $*"; fi
  [[ $output == *"$words"* ]] || wrong "$* is refused with \"$output\", not with \"$words\""
}
free_port() {
  local port
  while true; do
    port=$((20000 + RANDOM % 12000))
    (exec 3<>"/dev/tcp/127.0.0.1/$port") 2>/dev/null || break
  done
  echo "$port"
}
lines() { [[ -z $1 ]] || printf '%s\n' "$1"; }

# --- the files alone --------------------------------------------------------------------------------------------------

promtool check rules "$observe/alerts.yml" >"$folder/promtool.log" || give_up "promtool refuses the rules."
promtool test rules "$observe/alerts_test.yml" >"$folder/promtool.log" || give_up "A test of the rules fails."
amtool check-config "$observe/alertmanager.yml" >"$folder/amtool.log" || give_up "amtool refuses its settings."
jq --indent 2 . "$observe/dashboard.json" | cmp -s - "$observe/dashboard.json" ||
  wrong "dashboard.json is not as jq --indent 2 writes it."

# In the group of its name an alert fires for loud, and does not for quiet.
alerts=$(sed -n 's/^ *- alert: //p' "$observe/alerts.yml" | sort)
tested=$(awk '
  / - name: / { name = $3 }
  /series: |cellcrush_.*instance=/ && /instance="quiet"/ { quiet[name] = 1 }
  /exp_samples:|labels:/ && index($0, "alertname=\"" name "\", instance=\"loud\"") { loud[name] = 1 }
  END { for (name in loud) if (quiet[name]) print name }' "$observe/alerts_test.yml" | sort)
[[ $alerts == "$tested" ]] ||
  wrong "Alerts (<) and their tests (>) differ:" "$(diff <(lines "$alerts") <(lines "$tested"))"

# --- what start refuses -----------------------------------------------------------------------------------------------

prometheus=127.0.0.1:$(free_port)
alertmanager=127.0.0.1:$(free_port)
while [[ $alertmanager == "$prometheus" ]]; do alertmanager=127.0.0.1:$(free_port); done
nowhere=127.0.0.1:$(free_port)
start=("$observe/start" --data "$folder/observe" --interval 1s --prometheus "$prometheus"
  --alertmanager "$alertmanager")

refused "usage:" "${start[@]}" --gone
refused "is no HOST:PORT of loopback" "${start[@]}" 192.0.2.1:9464
refused "is no HOST:PORT of loopback" "${start[@]}" --prometheus 0.0.0.0:9090
refused "cellcrushd --metrics $nowhere" "${start[@]}" "$nowhere"
mkdir "$folder/bin"
ln -s "$(command -v bash)" "$(command -v dirname)" "$folder/bin"
refused "deploy/install-packages observe" env PATH="$folder/bin" "${start[@]}"

# --- a daemon with jobs that succeed, run, wait and fail --------------------------------------------------------------

start_daemon() {  # start_daemon METRICS: sets daemon
  setpriv --pdeathsig=TERM "$cellcrushd" --data "$folder/data" --listen "unix:$folder/daemon.sock" --http none \
    --workers 1 --metrics "$1" >"$folder/daemon.log" 2>&1 &
  daemon=$!
  processes+=("$daemon")
  wait_for "a daemon that serves its metrics" grep -q "serving metrics on" "$folder/daemon.log"
  wait_for "a daemon that listens" grep -q "listening on unix:" "$folder/daemon.log"
}
submit() {
  "$cellcrush" submit preset:hexagon-small --server "unix:$folder/daemon.sock" "$@" >>"$folder/client.log" 2>&1
}

start_daemon 127.0.0.1:0
metrics=$(sed -n 's|.*serving metrics on http://\(.*\)/metrics$|\1|p' "$folder/daemon.log")
submit --watch || give_up "The job does not succeed."

setpriv --pdeathsig=TERM "${start[@]}" "$metrics" >"$folder/start.log" 2>&1 &
observer=$!
processes+=("$observer")
wait_for "both programs" grep -q "Ctrl-C stops both" "$folder/start.log"
refused "$prometheus is taken" "${start[@]}" "$metrics"

# count QUERY...: a line for each: how many series it has, or why it is refused. All go through one curl.
count() {
  local query options=()
  for query in "$@"; do
    query=${query//\\/\\\\}
    query=${query//$'\n'/ }
    options+=(${options:+next} get 'noproxy = "*"' "url = \"http://$prometheus/api/v1/query\""
      "data-urlencode = \"query=${query//\"/\\\"}\"")
  done
  printf '%s\n' "${options[@]}" | curl -sS --config - |
    jq -r 'if .status == "success" then .data.result | length else .error end'
}
has() { [[ $(count "$1") == 1 ]]; }

wait_for "scrapes" has 'up{job="cellcrush"} == 1'
# A failure that Prometheus sees: the alert reaches Alertmanager. Then a job that runs, and one that waits.
if submit --time-limit 0.001s --watch; then give_up "The job with a time limit succeeds."; fi
submit --set loading.speed_m_per_s=0.1
submit
alert_arrives() {
  amtool alert query CellcrushCasesFail --alertmanager.url="http://$alertmanager" -o json |
    jq -e '.[0].labels.cause == "TIME_LIMIT"' >/dev/null
}
wait_for "the alert of a failed job in Alertmanager" alert_arrives
wait_for "a job that waits" has "cellcrush_jobs_waiting == 1 and cellcrush_jobs_running == 1"

# --- every query ------------------------------------------------------------------------------------------------------

is_elsewhere() {
  for name in "${elsewhere[@]}"; do
    [[ $1 != *"$name"* ]] || return 0
  done
  return 1
}
mapfile -t shown < <(jq -r '.panels[].targets[]?.expr' "$observe/dashboard.json")
((${#shown[@]} > 30)) || wrong "The dashboard has only ${#shown[@]} queries."
asked=("${shown[@]//\$instance/"$metrics"}")
mapfile -t found < <(count "${asked[@]//\$__rate_interval/10s}")
((${#found[@]} == ${#shown[@]})) || give_up "Not every query has an answer:" "${found[@]}"
for i in "${!shown[@]}"; do
  if [[ ! ${found[i]} =~ ^[0-9]+$ ]]; then
    wrong "The dashboard's query ${shown[i]} is refused: ${found[i]}"
  elif ((found[i] == 0)) && ! is_elsewhere "${shown[i]}"; then
    wrong "The dashboard's query ${shown[i]} finds nothing."
  fi
done

rules=$(curl -sS --noproxy '*' "http://$prometheus/api/v1/rules" | jq '[.data.groups[].rules[]]')
mapfile -t checked < <(jq -r '.[].query' <<<"$rules")
mapfile -t found < <(count "${checked[@]}")
((${#found[@]} == ${#checked[@]})) || give_up "Not every rule has an answer:" "${found[@]}"
for i in "${!checked[@]}"; do
  [[ ${found[i]} =~ ^[0-9]+$ ]] || wrong "The rule ${checked[i]} is refused: ${found[i]}"
done
sick=$(jq -r '.[] | select(.health != "ok") | "\(.name): \(.lastError)"' <<<"$rules")
[[ -z $sick ]] || wrong "Rules that fail:" "$sick"

# --- what alerts say --------------------------------------------------------------------------------------------------

says='.[] | select(.type == "alerting")'
dumb=$(jq -r "$says"' | select((.labels.severity | IN("critical", "warning", "info") | not)
  or (.annotations.summary | length) == 0 or (.annotations.description | length) == 0) | .name' <<<"$rules")
[[ -z $dumb ]] || wrong "Alerts without severity, summary or description:" "$dumb"
# Each description names PAGE.md, and perhaps a heading of it.
while IFS=$'\t' read -r name description; do
  pages=$(grep -oE '[a-z_/-]+\.md(, [A-Z][A-Za-z. ]*[A-Za-z])?' <<<"$description" || true)
  [[ -n $pages ]] || wrong "$name names no page."
  while IFS= read -r named; do
    page=${named%%, *}
    heading=${named#"$page"}
    grep -qE "^#+ ${heading#, }" "$root/$page" || wrong "$name names $named, which does not exist."
  done < <(lines "$pages")
done < <(jq -r "$says"' | [.name, .annotations.description] | @tsv' <<<"$rules")

# --- every metric -----------------------------------------------------------------------------------------------------

names_in() { grep -oE '\b(cellcrush|process)_[a-z_]+' | sed -E 's/_(bucket|sum|count)$//' | sort -u; }
served=$(curl -sS --noproxy '*' "http://$metrics/metrics" | sed -n 's/^# TYPE \([^ ]*\) .*/\1/p' |
  grep -v '^exposer_' | sort -u)
used=$(printf '%s\n' "${shown[@]}" "${checked[@]}" | names_in)
unknown=$(comm -23 <(lines "$used") <(printf '%s\n' "$served" "${elsewhere[@]}" | sort -u))
[[ -z $unknown ]] || wrong "Rules or dashboard use metrics that the daemon does not serve:" "$unknown"
unused=$(comm -13 <(lines "$used") <(lines "$served"))
[[ -z $unused ]] || wrong "Neither rules nor dashboard use these metrics:" "$unused"
here=$(comm -12 <(printf '%s\n' "${elsewhere[@]}" | sort) <(lines "$served"))
[[ -z $here ]] || wrong "These metrics are here, and need no exception:" "$here"

# --- the end of the daemon, and of those who watch it -----------------------------------------------------------------

kill "$daemon"
wait_for "a daemon that is seen to be down" has 'up{job="cellcrush"} == 0'
kill -0 "$observer" 2>/dev/null || wrong "start ended with the daemon."
kill "$observer"
status=0
wait "$observer" || status=$?
((status == 0)) || wrong "start ended with $status."
for address in "$prometheus" "$alertmanager"; do
  if (exec 3<>"/dev/tcp/127.0.0.1/${address#*:}") 2>/dev/null; then wrong "Something still listens at $address."; fi
done
wait "$daemon" || wrong "The daemon ended with $?."

((failures == 0)) || give_up "" "$failures failures"
echo "all is as it should be: ${#shown[@]} queries, ${#checked[@]} rules, $(lines "$served" | wc -l) metrics"
