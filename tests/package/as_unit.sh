#!/usr/bin/env bash
# Starts the daemon of a Debian system in a folder as its unit has it, where systemd does not run: with the mounts, the
# namespaces and the user of the unit here, and with the rest in as_unit.py.
#   unshare --mount --ipc --uts --propagation private tests/package/as_unit.sh SYSTEM COMMAND...
# Not tried: IPAddressDeny=, DevicePolicy= and ProtectControlGroups=, which systemd does with control groups, the
# watchdog and RemoveIPC=.
set -euo pipefail
here=$(dirname "${BASH_SOURCE[0]}")
system=$1
shift
unit=$system/lib/systemd/system/cellcrushd.service
setting() {
  grep -qx "$1" "$unit" && return
  echo "The unit has no $1: this script does not start it as it is." >&2
  exit 1
}

script=$(mktemp "$system/packages/as_unit.XXXXXX")
cat "$here/as_unit.py" >"$script"
chmod 755 "$script"

setting ProtectSystem=strict
mount --bind "$system" "$system"
mount -o remount,bind,ro "$system"
setting StateDirectory=cellcrush
setting RuntimeDirectory=cellcrush
for place in var/lib/cellcrush run/cellcrush; do
  mount --bind "$system/$place" "$system/$place"
  mount -o remount,bind,rw "$system/$place"
done
setting PrivateTmp=yes
setting ProtectHome=yes
for place in tmp var/tmp; do mount -t tmpfs -o mode=1777 tmpfs "$system/$place"; done
for place in home root; do mount -t tmpfs -o ro,mode=000 tmpfs "$system/$place"; done
setting PrivateDevices=yes
mount -t tmpfs -o mode=755 tmpfs "$system/dev"
for device in 'null 1 3' 'zero 1 5' 'full 1 7' 'random 1 8' 'urandom 1 9'; do
  read -r name major minor <<<"$device"
  mknod -m 666 "$system/dev/$name" c "$major" "$minor"
done
ln -s /proc/self/fd "$system/dev/fd"
mkdir "$system/dev/shm"
mount -o remount,ro "$system/dev"
setting ProtectProc=invisible
setting ProtectKernelTunables=yes
umount -l "$system/proc" 2>/dev/null || true
mount -t proc -o hidepid=invisible proc "$system/proc"
mount --bind "$system/proc/sys" "$system/proc/sys"
mount -o remount,bind,ro "$system/proc/sys"
setting PrivateIPC=yes
setting ProtectHostname=yes
setting UMask=0077
umask 0077
setting CapabilityBoundingSet=
setting User=cellcrush
exec chroot "$system" setpriv --reuid=cellcrush --regid=cellcrush --clear-groups --bounding-set=-all \
  --inh-caps=-all /usr/bin/env -i PATH=/usr/sbin:/usr/bin python3 "${script#"$system"}" "${unit#"$system"}" "$@"
