#!/usr/bin/env python3
"""Attacks a daemon of its own, one at a time, and prints its memory and how long another caller waits meanwhile.

Usage: attacks.py CELLCRUSHD [--times N] [NAME...]. `--times` multiplies the size of each attack. Ends with 1 where a
bar is missed: resident memory under 300 MB, within 60 MB of before 10 s later, GetJob at 100 ms in the median and 1 s
at most. Needs Python's standard library alone.
"""
import argparse
import json
import multiprocessing
import pathlib
import re
import resource
import signal
import socket
import statistics
import struct
import subprocess
import sys
import tempfile
import threading
import time

from http2 import Http2

BAR_MB, BAR_AFTER_MB, BAR_MEDIAN_S, BAR_MOST_S = 300, 60, 0.1, 1.0
MEBIBYTE = 1 << 20


def field(number, payload):
    size, out = len(payload), bytearray([number << 3 | 2])
    while size > 127:
        out.append(size & 127 | 128)
        size >>= 7
    return bytes(out) + bytes([size]) + payload


def post(daemon, method, body=b"", token=None, headers=(), size=None):
    """Sends a call over HTTP, as JSON, without waiting for the answer; returns the socket."""
    out = socket.create_connection(("127.0.0.1", daemon.http))
    kind = "connect+json" if method == "Jobs/ExportJob" else "json"
    lines = [f"POST /cellcrush.v1.{method} HTTP/1.1", f"Host: localhost:{daemon.http}", "Connection: close",
             "Content-Type: application/" + kind, *headers]
    if token:
        lines.append("Authorization: Bearer " + token)
    if "Transfer-Encoding: chunked" not in headers:
        lines.append(f"Content-Length: {len(body) if size is None else size}")
    out.sendall("\r\n".join(lines).encode() + b"\r\n\r\n")
    try:
        out.sendall(body)
    except OSError:
        pass  # refused before its body
    return out


def answer(connection, patience=120):
    """What comes until the end, or 12 bytes of it; closes the socket."""
    connection.settimeout(patience)
    try:
        return connection.recv(4096)
    except OSError:
        return b""
    finally:
        connection.close()


def together(count, work, at_once=120):
    """Runs work(i) on threads, for a minute at most: by then an attack has what it can get."""
    numbers = iter(range(count))
    until = time.time() + 60
    lock = threading.Lock()

    def run():
        while True:
            with lock:
                i = next(numbers, None)
            if i is None or time.time() > until:
                return
            try:
                work(i)
            except OSError:
                pass  # refused or cut

    threads = [threading.Thread(target=run, daemon=True) for _ in range(min(count, at_once))]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join(max(0, until - time.time()))


# Each attack has the daemon and how many times its size.

def empty_points_grpc(daemon, times):
    message = field(1, b"\x22\x00" * 1_990_000)
    together(12 * times, lambda i: Http2(daemon.grpc, daemon.token).call("/cellcrush.v1.Sweeps/CreateSweep", message))


def empty_points_http(daemon, times):
    body = b'{"sweep":{"points":[' + b"{}," * 1_390_000 + b"{}]}}"
    together(12 * times, lambda i: answer(post(daemon, "Sweeps/CreateSweep", body, daemon.token)))


def unfinished_messages(daemon, times):
    """4 MiB less one byte, by calls with a token."""
    part = b"\0" + struct.pack(">I", 4 * MEBIBYTE - 16) + bytes(4 * MEBIBYTE - 32)
    connections = [Http2(daemon.grpc, daemon.token) for _ in range(5)]

    def send(i):
        connection = connections[i % len(connections)]
        connection.send(connection.begin("/cellcrush.v1.Sweeps/CreateSweep"), part, last=False)
    together(50 * times, send, 250)
    time.sleep(3)


def sweep(daemon, times):
    """Its jobs are kept, so that it stays at its size."""
    request = {"sweep": {"case": daemon.case, "axes": [
        {"field": "loading.end_strain", "linear": {"first": 0.01, "last": 0.02, "count": 10_000 * times}}]}}
    answer(post(daemon, "Sweeps/CreateSweep", json.dumps(request).encode(), daemon.token))


def trailers(daemon, times):
    connection = post(daemon, "Jobs/GetJob", headers=("Transfer-Encoding: chunked",))
    try:
        connection.sendall(b"0\r\n")
        for _ in range(200 * times):
            connection.sendall(b"X: " + b"a" * (MEBIBYTE - 5) + b"\r\n")
    except OSError:
        pass  # refused
    time.sleep(1)


def unfinished_bodies(daemon, times, token=None):
    open_ = []

    def send(i):
        open_.append(post(daemon, "Jobs/GetJob", bytes(4 * MEBIBYTE - 1), token, size=4 * MEBIBYTE))
    together(496 * times, send, 496)
    time.sleep(1)


def unfinished_bodies_of_a_caller(daemon, times):
    unfinished_bodies(daemon, times, daemon.token)


def reset_watches(daemon, times):
    connections = [Http2(daemon.grpc) for _ in range(10)]

    def send(i):
        connection = connections[i]
        head, data = connection.headers("/grpc.health.v1.Health/Watch"), bytes(5)
        for first in range(0, 2000 * times, 50):
            frames = b"".join(
                Http2.frame(1, 4, stream, head) + Http2.frame(0, 1, stream, data) + Http2.frame(3, 0, stream, bytes(4))
                for stream in range(2 * first + 1, 2 * first + 101, 2))
            connection.socket.sendall(frames)
    together(10, send)
    time.sleep(1)


def unsent_messages(daemon, times):
    """Calls of Health.Watch without a token whose message never comes."""
    connections = []
    for _ in range(10 * times):
        connection = Http2(daemon.grpc)
        connections.append(connection)
        head = connection.headers("/grpc.health.v1.Health/Watch")
        try:
            connection.socket.sendall(b"".join(Http2.frame(1, 4, stream, head) for stream in range(1, 2200, 2)))
        except OSError:
            pass  # cut
    time.sleep(3)


def large_json(daemon, times):
    body = b'{"case":{"lattice":{"frame":{"nodes":[' + b"{}," * 1_390_000 + b"{}]}}}}"
    together(times, lambda i: answer(post(daemon, "Cases/CheckCase", body, daemon.token)))


def previews(daemon, times):
    body = daemon.case_of(100)

    def send(i):  # the first read nothing of the answer
        connection = post(daemon, "Cases/PreviewCase", body, daemon.token)
        if i < 200:
            time.sleep(10)
        answer(connection)
    together(400 * times, send, 400)


def exports(daemon, times):
    """Unread; another caller's export must still come."""
    streams = [Http2(daemon.grpc, daemon.token, reads=False) for _ in range(4 * times)]
    message = field(1, daemon.job.encode())
    for each in streams:
        each.send(each.begin("/cellcrush.v1.Jobs/ExportJob"), b"\0" + struct.pack(">I", len(message)) + message)
    time.sleep(1)
    body = json.dumps({"name": daemon.job}).encode()
    daemon.expect("an export of another caller", lambda: b"RESOURCE" not in daemon.read(post(
        daemon, "Jobs/ExportJob", struct.pack(">BI", 0, len(body)) + body, daemon.other)).upper())


def idle_connections(daemon, times):
    """Without a token, on both ports. Another caller's new connections must be let in."""
    grpc = [Http2(daemon.grpc) for _ in range(500 * times)]
    http = [socket.create_connection(("127.0.0.1", daemon.http)) for _ in range(500 * times)]
    for each in http:
        try:
            each.sendall(b"GET / HTTP/1.1\r\nHost: 127.0.0.1:%d\r\n\r\n" % daemon.http)
        except OSError:
            pass
    time.sleep(5)
    del grpc


def large_checks(daemon, times):
    """Another caller's small check must not wait for them."""
    body = daemon.case_of(400)
    attack = threading.Thread(target=together, daemon=True, args=(
        40 * times, lambda i: answer(post(daemon, "Cases/CheckCase", body, daemon.token)), 400))
    attack.start()
    for caller in (daemon.other, daemon.token):
        time.sleep(1)
        daemon.expect("a small check", lambda token=caller: b"200 OK" in answer(
            post(daemon, "Cases/CheckCase", daemon.case_of(6), token)))
    attack.join()


ATTACKS = [empty_points_grpc, empty_points_http, unfinished_messages, sweep, trailers, unfinished_bodies,
           unfinished_bodies_of_a_caller, reset_watches, unsent_messages, large_json, previews, exports,
           idle_connections, large_checks]


class Daemon:
    def __init__(self, program, folder):
        self.missed = []
        tokens, lines = [], []
        for name in ("attacker", "other"):
            token, line = subprocess.run([program, "token", name, "--scope", "submit"], capture_output=True, text=True,
                                         check=True).stdout.splitlines()[:2]
            tokens.append(token)
            lines.append(line)
        self.token, self.other = tokens
        (folder / "tokens").write_text("\n".join(lines) + "\n")
        (folder / "tokens").chmod(0o600)
        self.log = open(folder / "log", "w+")
        self.process = subprocess.Popen(
            [program, "--data", folder / "data", "--listen", "127.0.0.1:0", "--http", "127.0.0.1:0", "--tokens",
             folder / "tokens", "--workers", "1"], stdout=self.log, stderr=self.log)
        self.http = self.port_after("serving HTTP on http://127.0.0.1:", folder / "log")
        self.grpc = self.port_after("listening on 127.0.0.1:", folder / "log")

    def port_after(self, words, log):
        while not (found := re.search(words + r"(\d+)\n", log.read_text())):
            if self.process.poll() is not None:
                sys.exit(log.read_text())
            time.sleep(0.05)
        return int(found[1])

    def make_job(self):
        self.case = self.ask("Cases/GetPreset", {"name": "hexagon-small"})["case"]
        self.case["loading"]["endStrain"] = 0.02
        self.job = self.ask("Jobs/CreateJob", {"case": self.case})["name"]
        while self.ask("Jobs/GetJob", {"name": self.job})["state"] != "SUCCEEDED":
            time.sleep(0.2)

    def ask(self, method, request):
        return json.loads(self.read(post(self, method, json.dumps(request).encode(), self.other)))

    @staticmethod
    def read(connection):
        """The whole body of an answer."""
        return connection.makefile("rb").read().split(b"\r\n\r\n", 1)[1]

    def case_of(self, cells):
        """A request with a lattice of so many rows and columns."""
        hexagon = dict(self.case["lattice"]["hexagon"], columns=cells, rows=cells)
        return json.dumps({"case": dict(self.case, lattice=dict(self.case["lattice"], hexagon=hexagon))}).encode()

    def resident_mb(self):
        text = pathlib.Path(f"/proc/{self.process.pid}/status").read_text()
        return int(re.search(r"VmRSS:\s+(\d+)", text)[1]) / 1000

    def expect(self, what, ask):
        start = time.time()
        works = ask()
        seconds = time.time() - start
        print(f"    {what}: {'answered' if works else 'REFUSED'} after {seconds:.2f} s")
        if not works or seconds > 10:
            self.missed.append(what)


def ask_for_job(daemon, stop, out):
    """Another caller: GetJob on new connections to HTTP and on both doors in turn."""
    body, times, failed = json.dumps({"name": daemon.job}).encode(), [], 0
    while not stop.is_set():
        start = time.time()
        try:
            if len(times) % 2 == 0:
                works = b"200 OK" in answer(post(daemon, "Jobs/GetJob", body, daemon.other), 30)
            else:
                connection = Http2(daemon.grpc, daemon.other)
                works = connection.call("/cellcrush.v1.Jobs/GetJob", field(1, daemon.job.encode()), 30)
                connection.socket.close()
        except OSError:
            works = False
        times.append(time.time() - start)
        failed += not works
        time.sleep(0.02)
    out.put((times, failed))


def attack(daemon, work, times):
    before = peak = daemon.resident_mb()
    stop, answers = multiprocessing.Event(), multiprocessing.Queue()
    caller = multiprocessing.Process(target=ask_for_job, args=(daemon, stop, answers), daemon=True)
    caller.start()
    attacker = multiprocessing.Process(target=work, args=(daemon, times), daemon=True)
    missed = multiprocessing.Manager().list()
    daemon.missed = missed
    time.sleep(0.5)
    start = time.time()
    attacker.start()
    while attacker.is_alive():
        peak = max(peak, daemon.resident_mb())
        time.sleep(0.02)
    seconds = time.time() - start
    stop.set()
    waits, failed = answers.get(timeout=60)
    until = time.time() + 10
    while time.time() < until:
        peak = max(peak, daemon.resident_mb())
        time.sleep(0.05)
    after = daemon.resident_mb()
    median, most = statistics.median(waits), max(waits)
    is_met = (peak < BAR_MB and after < before + BAR_AFTER_MB and median <= BAR_MEDIAN_S and most <= BAR_MOST_S
              and failed == 0 and not missed)
    print(f"{work.__name__:30} {seconds:6.1f} s   {before:4.0f} MB before, {peak:5.0f} at most, {after:4.0f} after   "
          f"GetJob {1000 * median:6.1f} ms median, {most:5.2f} s at most, {failed} of {len(waits)} failed"
          f"{'' if is_met else '   MISSED'}", flush=True)
    return is_met


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("daemon")
    parser.add_argument("--times", type=int, default=1)
    parser.add_argument("names", nargs="*")
    given = parser.parse_intermixed_args()
    most = resource.getrlimit(resource.RLIMIT_NOFILE)[1]
    resource.setrlimit(resource.RLIMIT_NOFILE, (most, most))
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(1))
    is_met = True
    for work in ATTACKS:
        if given.names and work.__name__ not in given.names:
            continue
        with tempfile.TemporaryDirectory() as folder:
            daemon = Daemon(given.daemon, pathlib.Path(folder))
            try:
                daemon.make_job()
                is_met = attack(daemon, work, given.times) and is_met
            finally:
                daemon.process.kill()
                daemon.process.wait()
    sys.exit(0 if is_met else 1)


if __name__ == "__main__":
    main()
