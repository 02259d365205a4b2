#!/usr/bin/env bash
# Makes the packages twice, the second time as a newer version, and installs, runs, upgrades, downgrades and purges them
# in a clean Debian 12. Takes root, mmdebstrap and the package sources of this machine. systemd does not run in there:
# as_unit.sh starts the daemon as the unit has it.
#   tests/package/packages_test.sh [FOLDER]   # FOLDER keeps the system for another look
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
folder=${1:-$(mktemp -d)}
system=$folder/system
daemon=

stop_daemon() {
  [[ -n $daemon ]] || return 0
  kill "$daemon" 2>/dev/null || true
  wait "$daemon" 2>/dev/null || true
  daemon=
}
finish() {
  stop_daemon
  umount -l "$system/proc" 2>/dev/null || true
  [[ -n ${kept:-} ]] || rm -rf --one-file-system "$folder"
}
kept=${1:-}
trap finish EXIT

inside() { chroot "$system" /usr/bin/env -i PATH=/usr/sbin:/usr/bin HOME=/root DEBIAN_FRONTEND=noninteractive "$@"; }
client() { inside CELLCRUSH_SERVER=unix:/run/cellcrush/cellcrushd.sock cellcrush "$@"; }
install_packages() { inside apt-get install -y --allow-downgrades "${@/#//packages/}" >>"$folder/apt.log" 2>&1; }

start_daemon() {
  install -d -o "$(id_in cellcrush)" -m 700 "$system/var/lib/cellcrush"
  install -d -o "$(id_in cellcrush)" -m 755 "$system/run/cellcrush"
  local command
  command=$(sed -n 's/^ExecStart=//p' "$system/lib/systemd/system/cellcrushd.service")
  # shellcheck disable=SC2086
  unshare --mount --ipc --uts --propagation private "$root/tests/package/as_unit.sh" "$system" $command \
    >>"$folder/daemon.log" 2>&1 &
  daemon=$!
  for ((i = 0; i < 300; ++i)); do
    if client list >/dev/null 2>&1; then return; fi
    sleep 0.1
  done
  tail "$folder/daemon.log"
  exit 1
}
id_in() { awk -F: -v name="$1" '$1 == name { print $3 }' "$system/etc/passwd"; }
state_of() { client show "$1" --json | jq -r .state; }
expect() {  # expect WHAT IS WANTED
  [[ $2 == "$3" ]] || { echo "$1 is \"$2\", not \"$3\""; exit 1; }
  echo "ok: $1 is $2"
}

rm -rf --one-file-system "${folder:?}/old" "$folder/new" "$system"
mkdir -p "$folder/old" "$folder/new"
"$root/deploy/package"
cp "$root"/build/packages/*.deb "$folder/old"
"$root/deploy/package" --version 9.9
cp "$root"/build/packages/*.deb "$folder/new"

cat /etc/apt/sources.list /etc/apt/sources.list.d/*.list 2>/dev/null >"$folder/one-line.list" || true
sources=("$folder/one-line.list" /etc/apt/sources.list.d/debian.sources)
for source in "${sources[@]}"; do [[ -s $source ]] && break; done
mmdebstrap --quiet --variant=apt --skip=cleanup/apt/lists --customize-hook='rm -f "$1"/usr/sbin/policy-rc.d' \
  bookworm "$system" "$source"
mkdir "$system/packages"
cp "$folder"/old/*.deb "$folder"/new/*.deb "$system/packages"
mount -t proc proc "$system/proc"
mapfile -t old < <(cd "$folder/old" && ls)
mapfile -t new < <(cd "$folder/new" && ls)

SECONDS=0
install_packages "${old[@]}"
echo "ok: installed in $SECONDS s, with what it depends on"
inside apt-get install -y --no-install-recommends systemd python3-seccomp >>"$folder/apt.log" 2>&1
inside systemd-analyze security --offline=true --threshold=15 cellcrushd.service | tail -1
expect "the user" "$(inside id -un cellcrush)" cellcrush
expect "the checked configuration" \
  "$(inside cellcrushd check-config --config /etc/cellcrush/cellcrushd.toml | head -2 | tr '\n' ';')" \
  "data in /var/lib/cellcrush;gRPC at unix:/run/cellcrush/cellcrushd.sock;"
start_daemon
expect "the number of filters of its system calls" \
  "$(sed -n 's/^Seccomp_filters:[[:space:]]*//p' "/proc/$daemon/status")" 11
client submit preset:hexagon-small --watch >"$folder/watch.log"
expect "the first job" "$(state_of jobs/1)" SUCCEEDED
expect "where it listens" "$(sed -n 's/.* listening on //p; /http:/p' "$folder/daemon.log" | sort -u)" \
  unix:/run/cellcrush/cellcrushd.sock
expect "the Python package" "$(inside CELLCRUSH_SERVER=unix:/run/cellcrush/cellcrushd.sock python3 -c '
import cellcrush
print(cellcrush.connect().get("jobs/1").state)' 2>&1)" SUCCEEDED

# Jobs that run and wait while the packages are upgraded.
workers=$(nproc)
for ((i = 0; i < workers + 2; ++i)); do client submit preset:papka-kyriakides-1 >/dev/null; done
while (($(client list --filter 'state = RUNNING' --json | jq '.jobs | length') < workers)); do sleep 0.1; done
stop_daemon
install_packages "${new[@]}"
expect "the new version" "$(inside dpkg-query -W -f '${Version}' cellcrushd)" 9.9
start_daemon
last=jobs/$((workers + 3))
client watch "$last" >/dev/null
for ((i = 2; i <= workers + 3; ++i)); do client watch "jobs/$i" >/dev/null; done
expect "what ended after the upgrade" \
  "$(client list --json | jq -r '[.jobs[].state] | unique | join(",")')" SUCCEEDED
plateaus='[.jobs[].summary.plateau_stress_impact_mpa] | unique | length'
expect "the number of their plateaus" "$(client list --filter 'title : "Papka"' --json | jq "$plateaus")" 1

stop_daemon
install_packages "${old[@]}"
start_daemon
expect "the jobs after a downgrade" "$(client list --json | jq '.jobs | length')" $((workers + 3))
stop_daemon

inside apt-get purge -y cellcrushd cellcrush python3-cellcrush >>"$folder/apt.log" 2>&1
places=(-path "$system/packages" -o -path "$system/proc" -o -path "$system/run" -o -path "$system/var/log"
  -o -path "$system/var/lib/systemd")
expect "what a purge leaves" "$(find "$system" -xdev \( "${places[@]}" \) -prune -o -name '*cellcrush*' -print)" ""
echo "all is as it should be"
