"""A daemon, to which cases are submitted."""
from __future__ import annotations

import uuid
import warnings
from typing import Any, Dict, Iterator, List, Mapping, Optional, Sequence, Tuple, Union

import numpy as np

from cellcrush.arrays import Values
from cellcrush.case import CaseLike, build_case, find_path, is_list, join_fields, seed_count, set_field, swept_values
from cellcrush.connection import Connection
from cellcrush.errors import Problem, problem_from
from cellcrush.explain import explain
from cellcrush.job import Job
from cellcrush.sweep import Sweep
from cellcrush.v1 import cases_service_pb2, jobs_service_pb2, sweep_pb2, sweeps_service_pb2
from cellcrush.v1.case_pb2 import Case

SEED = "lattice.imperfection.seed"
SEVERAL = (list, tuple, range, np.ndarray)


class Check(Values):
    """The answer to a check: `problems` that keep the case from running, or what the run takes (step_count,
    predicted_seconds, relative_density, theory.shock_mpa and more), and `notes` on implausible values."""

    @property
    def problems(self) -> List[Problem]:
        return [problem_from(problem) for problem in self._message.problems]

    @property
    def notes(self) -> List[Problem]:
        return [problem_from(note) for note in self._message.notes]

    def _rows(self) -> List[Tuple[str, str]]:
        return [*(("problem", str(problem)) for problem in self.problems), *super()._rows(),
                *(("note", str(note)) for note in self.notes)]


def _set_options(message: Any, labels: Optional[Mapping[str, Any]], **options: Any) -> None:
    for name, value in options.items():
        set_field(message, name, value)
    message.labels.update({str(key): str(value) for key, value in (labels or {}).items()})


class Server:
    """A daemon. In all methods `case` is a dict, protobuf text, JSON, a file, "preset:NAME" or a proto, and `fields`
    are values for fields of it: by name (`speed_m_per_s=50`), or by path in a dict (`{"contact.friction": 0.2}`)."""

    def __init__(self, connection: Connection) -> None:
        self._connection = connection

    explain = staticmethod(explain)

    @property
    def address(self) -> str:
        return self._connection.address

    def case(self, case: CaseLike, fields: Optional[Mapping[str, Any]] = None, **more: Any) -> Case:
        """The case as a proto, with these fields set."""
        return build_case(case, join_fields(fields, more), self._preset)

    def _preset(self, name: str) -> Case:
        request = cases_service_pb2.GetPresetRequest(name=name)
        case: Case = self._connection.call(self._connection.cases.GetPreset, request).case
        return case

    def presets(self) -> Dict[str, str]:
        """The cases built into the daemon: names and titles."""
        answer = self._connection.call(self._connection.cases.ListPresets, cases_service_pb2.ListPresetsRequest())
        return {f"preset:{preset.name}": preset.title for preset in answer.presets}

    def materials(self) -> Dict[str, str]:
        """The materials that `material.named` may name, and their numbers."""
        answer = self._connection.call(self._connection.cases.ListMaterials, cases_service_pb2.ListMaterialsRequest())
        return {material.name: material.numbers for material in answer.materials}

    def check(self, case: CaseLike, fields: Optional[Mapping[str, Any]] = None, **more: Any) -> Check:
        """All problems of a case, or what running it takes. Starts nothing."""
        request = cases_service_pb2.CheckCaseRequest(case=self.case(case, fields, **more))
        return Check(self._connection.call(self._connection.cases.CheckCase, request))

    def submit(self, case: CaseLike, fields: Optional[Mapping[str, Any]] = None, *,
               labels: Optional[Mapping[str, str]] = None, note: str = "", priority: int = 0,
               time_limit_s: float = 0.0, executor: str = "", request_id: str = "", **more: Any) -> Job:
        """Queues a job. Raises CaseError with all problems if the case is not valid.

        A call with the `request_id` of an earlier one returns the job of that one."""
        request = jobs_service_pb2.CreateJobRequest(case=self.case(case, fields, **more),
                                                    request_id=request_id or str(uuid.uuid4()))
        _set_options(request, labels, note=note, priority=priority, time_limit_s=time_limit_s, executor=executor)
        return Job(self._connection, self._connection.call(self._connection.jobs.CreateJob, request))

    def sweep(self, case: CaseLike, fields: Optional[Mapping[str, Any]] = None, *, seeds: int = 0,
              labels: Optional[Mapping[str, str]] = None, note: str = "", priority: int = 0,
              time_limit_s: float = 0.0, max_parallel: int = 0, max_failures: int = 0, executor: str = "",
              request_id: str = "", **more: Any) -> Sweep:
        """Queues a job for every combination of the fields with several values; `seeds=5` repeats each with the seeds
        1 to 5 of the random imperfection."""
        base = self.case(case)
        axes = []
        for word, value in join_fields(fields, more).items():
            path = find_path(word, base)
            if isinstance(value, SEVERAL) and not is_list(path):
                values = sweep_pb2.SweepAxis.List(values=swept_values(path, value))
                axes.append(sweep_pb2.SweepAxis(field=path, list=values))
            else:
                set_field(base, path, value)
        if count := seed_count(seeds):
            axes.append(sweep_pb2.SweepAxis(field=SEED, seed_count=count))
            self._warn_of_equal_seeds(base, [axis.field for axis in axes])
        request = sweeps_service_pb2.CreateSweepRequest(request_id=request_id or str(uuid.uuid4()))
        request.sweep.MergeFrom(sweep_pb2.Sweep(case=base, axes=axes))
        _set_options(request.sweep, labels, note=note, priority=priority, time_limit_s=time_limit_s,
                     max_parallel=max_parallel, max_failures=max_failures, executor=executor)
        return Sweep(self._connection, self._connection.call(self._connection.sweeps.CreateSweep, request))

    @staticmethod
    def _warn_of_equal_seeds(case: Case, varied: Sequence[str]) -> None:
        imperfection = case.lattice.imperfection
        is_varied = any("imperfection" in field for field in varied if field != SEED)
        if not (imperfection.amplitude_mm or imperfection.bow_mm or is_varied):
            warnings.warn("all seeds give the same crush, because lattice.imperfection.amplitude_mm is 0: give a "
                          "value, such as amplitude_mm=0.01", stacklevel=3)

    def get(self, name: Union[str, int]) -> Any:
        """The job or sweep of a name, such as "jobs/7", 7 (the job) or "sweeps/3"."""
        name = name if isinstance(name, str) and "/" in name else f"jobs/{name}"
        if name.startswith("sweeps/"):
            return Sweep(self._connection, sweep_pb2.Sweep(name=name)).refresh()
        return Job(self._connection, self._connection.call(self._connection.jobs.GetJob,
                                                           jobs_service_pb2.GetJobRequest(name=name)))

    def jobs(self, filter: str = "") -> Iterator[Job]:  # noqa: A002
        """The jobs, newest first; `filter` such as 'state = RUNNING' or 'label.study = "walls"'."""
        for page in self._connection.pages(self._connection.jobs.ListJobs,
                                           jobs_service_pb2.ListJobsRequest(filter=filter)):
            yield from (Job(self._connection, job) for job in page.jobs)

    def sweeps(self) -> Iterator[Sweep]:
        """The sweeps, newest first."""
        for page in self._connection.pages(self._connection.sweeps.ListSweeps, sweeps_service_pb2.ListSweepsRequest()):
            yield from (Sweep(self._connection, sweep) for sweep in page.sweeps)

    def close(self) -> None:
        self._connection.channel.close()

    def __enter__(self) -> "Server":
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def __repr__(self) -> str:
        return f"<cellcrush server {self.address}>"


def connect(address: Optional[str] = None, *, ca: Optional[str] = None, token_file: Optional[str] = None,
            certificate: Optional[str] = None, key: Optional[str] = None, patience_s: float = 300.0) -> Server:
    """Connects to a daemon: HOST:PORT or unix:PATH, else $CELLCRUSH_SERVER, else its default socket or port.

    `ca` names the authority of its certificate and turns on TLS, `certificate` and `key` those of this client, and
    `token_file` the token. Without them $CELLCRUSH_TLS_CA, $CELLCRUSH_TOKEN_FILE and $CELLCRUSH_TOKEN count. For
    `patience_s` calls and watches wait for a daemon that went away."""
    connection = Connection(address, ca, token_file, certificate, key, patience_s)
    connection.require()
    return Server(connection)
