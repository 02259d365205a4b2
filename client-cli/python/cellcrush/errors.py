"""What can go wrong, as exceptions that say what to do."""
from __future__ import annotations

import pathlib
from dataclasses import dataclass
from typing import Any, NoReturn, Optional, Sequence

import grpc

from cellcrush.status import status_pb2
from cellcrush.v1 import problem_pb2


class CrushError(Exception):
    """The base of all errors of this package."""


class NotConnected(CrushError, ConnectionError):
    """No daemon answers, or it stopped answering for longer than `patience_s`."""


class ServerChanged(CrushError):
    """Another daemon answers than at first, or the same one with other data: its jobs are others, even under the same
    names. It has changed nothing; `connect` again to use it."""


class NotFound(CrushError, LookupError):
    """No job, sweep or preset has this name."""


class FileError(CrushError, OSError):
    """A file cannot be read or written, or is no whole result."""


@dataclass(frozen=True)
class Problem:
    """What is wrong with one field of a case, and how to correct it."""

    field: str
    value: str
    message: str
    remedy: str

    def __str__(self) -> str:
        found = f" (found {self.value})" if self.value else ""
        return f"{self.field} {self.message}{found} {self.remedy}".rstrip()


class CaseError(CrushError, ValueError):
    """A case that cannot run. `problems` lists everything that is wrong, not only the first."""

    def __init__(self, problems: Sequence[Problem]) -> None:
        self.problems = list(problems)
        super().__init__("\n".join(str(problem) for problem in self.problems))


def _end_of(job: Any) -> str:
    """Why a job ended without a complete result, and what to do."""
    if job.cause_message or job.state != "CANCELLED":
        return f"{job.cause_message} {job.remedy}".strip()
    if not job.has_result:
        return "it was cancelled before it began. Submit job.case again to run it."
    return (f"it was cancelled at step {job.summary.step_count}. Its results so far are kept: samples(), frames and "
            "download() have them. Submit job.case again to run it to its end.")


class JobFailed(CrushError):
    """A job ended without a complete result. `job` has the cause and what was computed, and `output` the file with it,
    if `run` saved one."""

    def __init__(self, job: Any, output: Optional[pathlib.Path] = None) -> None:
        self.job, self.output = job, output
        saved = f" {output} has the results so far." if output else ""
        super().__init__(f"{job.name} {job.state}: {_end_of(job)}{saved}")


def problem_from(message: problem_pb2.Problem) -> Problem:
    return Problem(message.field, message.value, message.message, message.remedy)


def _problems_of(error: grpc.RpcError) -> list[Problem]:
    metadata = dict(error.trailing_metadata() or ())
    status = status_pb2.Status.FromString(metadata.get("grpc-status-details-bin", b""))
    found = problem_pb2.ProblemList()
    for detail in status.details:
        if detail.Unpack(found):
            return [problem_from(problem) for problem in found.problems]
    return []


def raise_error(error: grpc.RpcError, address: str) -> NoReturn:
    """Raises the exception for a call that failed."""
    code, text = error.code(), error.details() or ""
    problems = _problems_of(error)
    if problems:
        raise CaseError(problems) from None
    if code == grpc.StatusCode.NOT_FOUND:
        raise NotFound(text) from None
    if code in (grpc.StatusCode.UNAVAILABLE, grpc.StatusCode.DEADLINE_EXCEEDED):
        raise NotConnected(f"no answer from {address}: {text}. Start cellcrushd, or give its address to connect()."
                           ) from None
    raise CrushError(f"{code.name}: {text}") from None


def need(module: str, package: str) -> Any:
    """Imports a module that not every use of this package needs.

    >>> need("no_such_module", "python3-no-such")
    Traceback (most recent call last):
    ImportError: this needs no_such_module: install it with `apt install python3-no-such`
    """
    import importlib

    try:
        return importlib.import_module(module)
    except ImportError:
        raise ImportError(f"this needs {module}: install it with `apt install {package}`") from None
