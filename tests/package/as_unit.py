"""Runs a program under the seccomp filters that systemd makes of a unit: as_unit.py UNIT COMMAND...

Takes python3-seccomp and systemd-analyze. The filters are those of systemd 252 (src/shared/seccomp-util.c).
"""
import ctypes
import errno
import os
import subprocess
import sys

from seccomp import ALLOW, EQ, ERRNO, MASKED_EQ, Arg, SyscallFilter

PR_SET_NO_NEW_PRIVS = 38
PROT_WRITE, PROT_EXEC = 2, 4
NAMESPACES = (0x00020000, 0x02000000, 0x04000000, 0x08000000, 0x10000000, 0x20000000, 0x40000000)  # CLONE_NEW*
SET_IDS = 0o6000
FAMILIES = {"AF_UNIX": 1, "AF_INET": 2, "AF_INET6": 10, "AF_NETLINK": 16}


def read_settings(path):
    """All values of each key, in order; systemd has keys more than once."""
    settings = {}
    with open(path, encoding="utf-8") as unit:
        for line in unit:
            key, sign, value = line.strip().partition("=")
            if sign and not key.startswith("#"):
                settings.setdefault(key, []).append(value)
    return settings


def members(name):
    """The system calls of a set, with those of the sets in it."""
    if not name.startswith("@"):
        return {name}
    listed = subprocess.run(["systemd-analyze", "syscall-filter", name], check=True, capture_output=True, text=True)
    out = set()
    for word in listed.stdout.split("\n")[1:]:
        word = word.strip()
        if word and not word.startswith("#"):
            out |= members(word)
    return out


def allowed_calls(lines):
    out = set()
    for line in lines:
        for word in line.lstrip("~").split():
            out = out - members(word) if line.startswith("~") else out | members(word)
    return out


def add_rules(one, calls, action, *arguments):
    for call in calls:
        try:
            one.add_rule(action, call, *arguments)
        except (RuntimeError, ValueError):
            pass  # not a system call of this machine


def load_filters(settings):
    def is_set(key):
        return settings.get(key) == ["yes"]

    assert settings["SystemCallErrorNumber"] == ["EPERM"]
    refused = ERRNO(errno.EPERM)
    filters = []

    def begin(action=ALLOW):
        filters.append(SyscallFilter(action))
        return filters[-1]

    if is_set("MemoryDenyWriteExecute"):
        one = begin()
        both = PROT_WRITE | PROT_EXEC
        one.add_rule(refused, "mmap", Arg(2, MASKED_EQ, both, both))
        for call in ("mprotect", "pkey_mprotect"):
            one.add_rule(refused, call, Arg(2, MASKED_EQ, PROT_EXEC, PROT_EXEC))
        one.add_rule(refused, "shmat", Arg(2, MASKED_EQ, 0o100000, 0o100000))
    if is_set("RestrictNamespaces"):
        one = begin()
        for space in NAMESPACES:
            for call in ("clone", "unshare"):
                one.add_rule(refused, call, Arg(0, MASKED_EQ, space, space))
        one.add_rule(refused, "setns")
        one.add_rule(ERRNO(errno.ENOSYS), "clone3")
    if is_set("RestrictSUIDSGID"):
        one = begin()
        for call, index in (("chmod", 1), ("fchmod", 1), ("fchmodat", 2), ("mkdir", 1), ("mkdirat", 2), ("mknod", 1),
                            ("mknodat", 2), ("creat", 1)):
            for bit in (0o4000, 0o2000):
                one.add_rule(refused, call, Arg(index, MASKED_EQ, bit, bit))
    if is_set("RestrictRealtime"):
        one = begin()
        for policy in (1, 2, 6):
            one.add_rule(refused, "sched_setscheduler", Arg(1, EQ, policy))
    if is_set("LockPersonality"):
        begin().add_rule(refused, "personality")
    if is_set("ProtectKernelLogs"):
        begin().add_rule(refused, "syslog")
    if is_set("ProtectKernelModules"):
        add_rules(begin(), members("@module"), refused)
    if is_set("ProtectClock"):
        add_rules(begin(), members("@clock"), refused)
    if is_set("ProtectHostname"):
        add_rules(begin(), ("sethostname", "setdomainname"), refused)
    one = begin()
    known = {FAMILIES[name] for name in settings["RestrictAddressFamilies"][0].split()}
    for family in range(64):
        if family not in known:
            one.add_rule(ERRNO(errno.EAFNOSUPPORT), "socket", Arg(0, EQ, family))
    one = begin(refused)
    add_rules(one, allowed_calls(settings["SystemCallFilter"]), ALLOW)
    # What loads the filters and starts the program is allowed by systemd, too.
    add_rules(one, ("execve", "exit", "exit_group", "prctl", "seccomp", "rt_sigreturn"), ALLOW)
    for each in filters:
        each.load()
    return len(filters)


def main():
    settings = read_settings(sys.argv[1])
    assert settings["NoNewPrivileges"] == ["yes"]
    ctypes.CDLL(None).prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0)
    count = load_filters(settings)
    print(f"as the unit: {count} filters", file=sys.stderr, flush=True)
    os.execv(sys.argv[2], sys.argv[2:])


main()
