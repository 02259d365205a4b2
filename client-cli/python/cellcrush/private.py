"""Crushes without a daemon: a private one in a temporary folder, stopped at the end."""
from __future__ import annotations

import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
from contextlib import contextmanager
from typing import Any, Iterator, Mapping, Optional

from cellcrush.case import CaseLike
from cellcrush.errors import JobFailed, NotConnected
from cellcrush.job import Job
from cellcrush.results import PathLike
from cellcrush.server import Server, connect
from cellcrush.whole_file import require_place


def _program() -> str:
    program = os.environ.get("CELLCRUSHD") or shutil.which("cellcrushd")
    if not program:
        raise NotConnected("cellcrushd is not found: install it in a folder of $PATH, or name the program in "
                           "$CELLCRUSHD")
    return program


@contextmanager
def private_server(data: Optional[PathLike] = None) -> Iterator[Server]:
    """A daemon of this script's own on a Unix socket, stopped when the block ends. Its data is temporary unless `data`
    names a folder."""
    # A path of a socket has room for 107 bytes, so it is not in a folder that may be deep.
    with tempfile.TemporaryDirectory(prefix="cellcrush-", dir="/tmp") as folder:
        address, log = f"unix:{folder}/socket", pathlib.Path(folder, "log")
        command = [_program(), "--data", str(data or pathlib.Path(folder, "data")), "--listen", address, "--http",
                   "none"]
        with log.open("w") as errors:
            # A process group of its own: Ctrl-C reaches this script, which then stops the daemon.
            daemon = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=errors, text=True, process_group=0)
        try:
            assert daemon.stdout is not None
            if not daemon.stdout.readline():
                lines = log.read_text().splitlines() or ["it ended at once"]
                raise NotConnected(f"{command[0]} does not start: {lines[-1]}")
            with connect(address, patience_s=10.0) as server:
                server._connection.is_private = True
                yield server
        except KeyboardInterrupt:
            kept = f"; a daemon with the data folder {data} continues them" if data else ""
            print(f"\nthe private server stops, and its jobs with it{kept}", file=sys.stderr)
            raise
        finally:
            daemon.terminate()
            try:
                daemon.wait(60)
            except subprocess.TimeoutExpired:
                daemon.kill()
                daemon.wait()
            daemon.stdout.close()  # type: ignore[union-attr]


def keep_results(job: Job, output: Optional[PathLike], check: bool) -> None:
    """Takes the results of an ended job into memory and into a file, before its daemon stops."""
    job.case
    saved = None
    if job.has_result:
        job.samples(), job.mesh
        saved = job.download(output) if output is not None else None
    if check and job.state != "SUCCEEDED":
        raise JobFailed(job, saved)


def run(case: CaseLike, fields: Optional[Mapping[str, Any]] = None, *, output: Optional[PathLike] = None,
        progress: Optional[bool] = None, check: bool = True, **more: Any) -> Job:
    """Crushes one case and returns its job, with all results in memory; `output` also saves the result file.

    Raises JobFailed if the job did not succeed, unless `check` is False. The results so far are kept and saved then,
    too."""
    if output is not None:
        require_place(pathlib.Path(output))
    with private_server() as server:
        job = server.submit(case, fields, **more).wait(progress, check=False)
        keep_results(job, output, check)
    return job
