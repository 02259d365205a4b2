"""The same for asyncio: `server = await connect()`, `await job.wait()`, `async for sample in job.watch()`.

Every call of the package is here, to be awaited; properties that ask the daemon are calls, too: `await job.frames()`.
Calls run in threads; watches and waits hold none, so that one program can wait for thousands of jobs. Plots are drawn
in the thread of the loop, as matplotlib requires."""
from __future__ import annotations

import asyncio
import pathlib
from contextlib import asynccontextmanager
from typing import TYPE_CHECKING, Any, AsyncIterator, Dict, List, Mapping, Optional, Sequence, Union

import cellcrush as _plain
from cellcrush import (Case, CaseError, Check, Comparison, CrushError, FileError, Frames, JobFailed, Mesh, NotConnected,
                       NotFound, Problem, ResultFile, ServerChanged)
from cellcrush import server as _server
from cellcrush import sweep as _sweep
from cellcrush.aio_job import Job, documented_as, follow
from cellcrush.case import CaseLike
from cellcrush.display import Bar
from cellcrush.explain import explain
from cellcrush.private import keep_results
from cellcrush.results import PathLike
from cellcrush.v1 import sweeps_service_pb2_grpc
from cellcrush.whole_file import require_place

if TYPE_CHECKING:
    import matplotlib.axes
    import pandas

__all__ = ["Case", "CaseError", "Check", "Comparison", "CrushError", "FileError", "Frames", "Job", "JobFailed", "Mesh",
           "NotConnected", "NotFound", "Problem", "ResultFile", "Server", "ServerChanged", "Sweep", "connect", "open",
           "private_server", "run"]


@documented_as(_sweep.Sweep)
class Sweep:
    """A sweep; `sync` is the same with calls that block. `async for job in sweep` iterates over its jobs."""

    def __init__(self, sync: _sweep.Sweep) -> None:
        self.sync = sync

    @property
    def name(self) -> str:
        return self.sync.name

    @property
    def case(self) -> Case:
        return self.sync.case

    @property
    def fields(self) -> List[str]:
        return self.sync.fields

    @property
    def note(self) -> str:
        return self.sync.note

    @property
    def states(self) -> Dict[str, int]:
        return self.sync.states

    async def refresh(self) -> "Sweep":
        await asyncio.to_thread(self.sync.refresh)
        return self

    async def jobs(self) -> List[Job]:
        return [Job(job) for job in await asyncio.to_thread(lambda: self.sync.jobs)]

    async def __aiter__(self) -> AsyncIterator[Job]:
        for job in await self.jobs():
            yield job

    def __len__(self) -> int:
        return len(self.sync)

    async def wait(self, progress: Optional[bool] = False) -> "Sweep":
        """Waits until all jobs have ended, however: `states` counts how. Cancelling the task leaves them running."""
        watch = _sweep.SweepWatch(self.name)
        with Bar(self.name, progress) as bar:
            async for message in follow(self.sync._connection, sweeps_service_pb2_grpc.SweepsStub, "WatchSweep",
                                        lambda: watch.request, watch.has_ended):
                watch.take(message)
                watch.show(bar)
            await asyncio.to_thread(self.sync._ended, bar, watch)
        return self

    async def table(self, mean_over: Union[str, Sequence[str], None] = None) -> "pandas.DataFrame":
        return await asyncio.to_thread(self.sync.table, mean_over)

    async def plot(self, ax: "matplotlib.axes.Axes | None" = None, **style: Any) -> "matplotlib.axes.Axes":
        from cellcrush.sweep_plots import plot_points, read_points

        return plot_points(*await asyncio.to_thread(read_points, self.sync), ax, **style)

    async def set_note(self, note: str) -> "Sweep":
        await asyncio.to_thread(self.sync.set_note, note)
        return self

    async def cancel(self) -> "Sweep":
        await asyncio.to_thread(self.sync.cancel)
        return self

    async def retry(self) -> "Sweep":
        await asyncio.to_thread(self.sync.retry)
        return self

    async def delete(self) -> None:
        await asyncio.to_thread(self.sync.delete)

    def __repr__(self) -> str:
        return repr(self.sync)

    def _repr_html_(self) -> str:
        return self.sync._repr_html_()


@documented_as(_server.Server)
class Server:
    """A daemon; `sync` is the same with calls that block."""

    def __init__(self, sync: _server.Server) -> None:
        self.sync = sync

    explain = staticmethod(explain)

    @property
    def address(self) -> str:
        return self.sync.address

    async def case(self, case: CaseLike, fields: Optional[Mapping[str, Any]] = None, **more: Any) -> Case:
        return await asyncio.to_thread(self.sync.case, case, fields, **more)

    async def presets(self) -> Dict[str, str]:
        return await asyncio.to_thread(self.sync.presets)

    async def materials(self) -> Dict[str, str]:
        return await asyncio.to_thread(self.sync.materials)

    async def check(self, case: CaseLike, fields: Optional[Mapping[str, Any]] = None, **more: Any) -> Check:
        return await asyncio.to_thread(self.sync.check, case, fields, **more)

    async def submit(self, case: CaseLike, fields: Optional[Mapping[str, Any]] = None, **more: Any) -> Job:
        return Job(await asyncio.to_thread(self.sync.submit, case, fields, **more))

    async def sweep(self, case: CaseLike, fields: Optional[Mapping[str, Any]] = None, **more: Any) -> Sweep:
        return Sweep(await asyncio.to_thread(self.sync.sweep, case, fields, **more))

    async def get(self, name: Union[str, int]) -> Any:
        found = await asyncio.to_thread(self.sync.get, name)
        return Sweep(found) if isinstance(found, _sweep.Sweep) else Job(found)

    async def jobs(self, filter: str = "") -> List[Job]:  # noqa: A002
        return [Job(job) for job in await asyncio.to_thread(lambda: list(self.sync.jobs(filter)))]

    async def sweeps(self) -> List[Sweep]:
        return [Sweep(sweep) for sweep in await asyncio.to_thread(lambda: list(self.sync.sweeps()))]

    async def close(self) -> None:
        await asyncio.to_thread(self.sync.close)

    async def __aenter__(self) -> "Server":
        return self

    async def __aexit__(self, *_: object) -> None:
        await self.close()

    def __repr__(self) -> str:
        return repr(self.sync)


async def connect(address: Optional[str] = None, **options: Any) -> Server:
    """As cellcrush.connect, with the same options."""
    return Server(await asyncio.to_thread(_plain.connect, address, **options))


async def open(path: PathLike) -> ResultFile:  # noqa: A001
    """As cellcrush.open."""
    return await asyncio.to_thread(_plain.open, path)


@asynccontextmanager
async def private_server(data: Optional[PathLike] = None) -> AsyncIterator[Server]:
    """As cellcrush.private_server: `async with private_server() as server`."""
    plain = _plain.private_server(data)
    server = await asyncio.to_thread(plain.__enter__)
    try:
        yield Server(server)
    finally:
        await asyncio.to_thread(plain.__exit__, None, None, None)


async def run(case: CaseLike, fields: Optional[Mapping[str, Any]] = None, *, output: Optional[PathLike] = None,
              progress: Optional[bool] = False, check: bool = True, **more: Any) -> Job:
    """As cellcrush.run. Cancelling the task stops the crush."""
    if output is not None:
        require_place(pathlib.Path(output))
    async with private_server() as server:
        job = await (await server.submit(case, fields, **more)).wait(progress, check=False)
        await asyncio.to_thread(keep_results, job.sync, output, check)
    return job
