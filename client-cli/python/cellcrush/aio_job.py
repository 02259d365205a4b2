"""Jobs for asyncio."""
from __future__ import annotations

import asyncio
import pathlib
from typing import TYPE_CHECKING, Any, AsyncIterator, Callable, Dict, List, Optional, Tuple, TypeVar

import grpc

from cellcrush import job as _job
from cellcrush.arrays import Array, Frames, Mesh
from cellcrush.comparison import Comparison
from cellcrush.connection import OPTIONS, RECOVERABLE, SILENCE_S, Connection, Patience
from cellcrush.display import Bar
from cellcrush.errors import NotConnected
from cellcrush.job import JobWatch
from cellcrush.results import PathLike
from cellcrush.v1 import jobs_service_pb2_grpc
from cellcrush.v1.case_pb2 import Case
from cellcrush.v1.sample_pb2 import Sample

if TYPE_CHECKING:
    import matplotlib.animation
    import matplotlib.axes
    import pandas
    import xarray

Class = TypeVar("Class", bound=type)


def documented_as(plain: type) -> Callable[[Class], Class]:
    """Gives members the texts of those of the plain class."""

    def add(mirror: Class) -> Class:
        for name, member in vars(mirror).items():
            if (callable(member) or isinstance(member, property)) and not member.__doc__:
                member.__doc__ = getattr(getattr(plain, name, None), "__doc__", None)
        return mirror

    return add


async def follow(connection: Connection, stub: Any, method: str, next_request: Callable[[], Any],
                 is_complete: Callable[[], bool]) -> AsyncIterator[Any]:
    """As Connection.follow."""
    patience = Patience(connection.patience_s)
    secure = connection.credentials
    channel = (grpc.aio.secure_channel(connection.address, secure, options=OPTIONS) if secure else
               grpc.aio.insecure_channel(connection.address, options=OPTIONS))
    async with channel:
        while True:
            stream = getattr(stub(channel), method)(next_request(), metadata=connection.metadata)
            try:
                while True:
                    async with asyncio.timeout(SILENCE_S):
                        message = await stream.read()
                    if message is grpc.aio.EOF:
                        break
                    patience.renew()
                    yield message
                if is_complete():
                    return
                lost = "the server closed the stream"
            except TimeoutError:
                lost = "it fell silent"
            except grpc.RpcError as error:
                if error.code() not in RECOVERABLE:
                    connection.refuse(error)
                lost = error.details() or ""
            finally:
                stream.cancel()
            pause = patience.next_pause()
            if pause is None:
                raise NotConnected(f"lost the connection to {connection.address}: {lost}")
            await asyncio.sleep(pause)


@documented_as(_job.Job)
class Job:
    """A job; `sync` is the same with calls that block."""

    def __init__(self, sync: _job.Job) -> None:
        self.sync = sync

    @property
    def name(self) -> str:
        return self.sync.name

    @property
    def title(self) -> str:
        return self.sync.title

    @property
    def state(self) -> str:
        return self.sync.state

    @property
    def cause(self) -> str:
        return self.sync.cause

    @property
    def cause_message(self) -> str:
        return self.sync.cause_message

    @property
    def remedy(self) -> str:
        return self.sync.remedy

    @property
    def labels(self) -> Dict[str, str]:
        return self.sync.labels

    @property
    def note(self) -> str:
        return self.sync.note

    @property
    def notes(self) -> List[str]:
        return self.sync.notes

    @property
    def progress(self) -> Any:
        return self.sync.progress

    @property
    def summary(self) -> Any:
        return self.sync.summary

    @property
    def has_result(self) -> bool:
        return self.sync.has_result

    async def case(self) -> Case:
        return await asyncio.to_thread(lambda: self.sync.case)

    async def refresh(self) -> "Job":
        await asyncio.to_thread(self.sync.refresh)
        return self

    async def events(self) -> AsyncIterator[Tuple[str, JobWatch]]:
        watch = JobWatch(self.sync._message)
        async for event in follow(self.sync._connection, jobs_service_pb2_grpc.JobsStub, "WatchJob",
                                  lambda: watch.request, watch.has_ended):
            kind = watch.take(event)
            if kind in ("snapshot", "state"):
                self.sync._take(watch.job)
            yield kind, watch

    async def watch(self) -> AsyncIterator[Sample]:
        async for kind, watch in self.events():
            if kind == "sample":
                yield watch.samples[watch.request.after_sequence]

    async def wait(self, progress: Optional[bool] = False, check: bool = True) -> "Job":
        """Waits for the end of the job. Cancelling the task leaves the job running. A bar shows with `progress`, or
        with None on terminals and in notebooks; bars of several waits would overwrite each other.

        Raises JobFailed if it did not succeed, unless `check` is False."""
        with Bar(self.name, progress) as bar:
            async for kind, watch in self.events():
                watch.show(bar, kind)
            self.sync._ended(bar, check)
        return self

    async def cancel(self) -> "Job":
        await asyncio.to_thread(self.sync.cancel)
        return self

    async def suspend(self) -> "Job":
        await asyncio.to_thread(self.sync.suspend)
        return self

    async def resume(self) -> "Job":
        await asyncio.to_thread(self.sync.resume)
        return self

    async def set_note(self, note: str) -> "Job":
        await asyncio.to_thread(self.sync.set_note, note)
        return self

    async def delete(self) -> None:
        await asyncio.to_thread(self.sync.delete)

    async def samples(self) -> Array:
        return await asyncio.to_thread(self.sync.samples)

    async def breaks(self) -> Array:
        return await asyncio.to_thread(self.sync.breaks)

    async def mesh(self) -> Mesh:
        return await asyncio.to_thread(lambda: self.sync.mesh)

    async def frames(self) -> Frames:
        return await asyncio.to_thread(lambda: self.sync.frames)

    async def history(self) -> "pandas.DataFrame":
        return await asyncio.to_thread(self.sync.history)

    async def xarray(self) -> "xarray.Dataset":
        return await asyncio.to_thread(self.sync.xarray)

    async def download(self, path: PathLike = "result.h5") -> pathlib.Path:
        return await asyncio.to_thread(self.sync.download, path)

    async def compare(self, *tests: PathLike, columns: str = "", window: Optional[Tuple[float, float]] = None,
                      energy_to: Optional[float] = None, force: str = "", displacement: str = "") -> Comparison:
        return await asyncio.to_thread(lambda: self.sync.compare(*tests, columns=columns, window=window,
                                                                 energy_to=energy_to, force=force,
                                                                 displacement=displacement))

    async def write_vtk(self, path: PathLike) -> None:
        await asyncio.to_thread(self.sync.write_vtk, path)

    # The results of an ended job are kept, so that drawing them does not wait for the daemon.

    async def plot(self, ax: "matplotlib.axes.Axes | None" = None, **style: Any) -> "matplotlib.axes.Axes":
        await self.samples()
        return self.sync.plot(ax, **style)

    async def plot_frame(self, strain: float, ax: "matplotlib.axes.Axes | None" = None,
                         **style: Any) -> "matplotlib.axes.Axes":
        await self.frames()
        return self.sync.plot_frame(strain, ax, **style)

    async def animate(self, **style: Any) -> "matplotlib.animation.FuncAnimation":
        await self.frames()
        return self.sync.animate(**style)

    async def live_plot(self, **style: Any) -> "matplotlib.axes.Axes":
        from cellcrush.plots import LivePlot

        live = LivePlot(**style)
        async for kind, watch in self.events():
            live.take(kind, watch)
        await self.samples()
        return live.end(self.sync)

    def __repr__(self) -> str:
        return repr(self.sync)

    def _repr_html_(self) -> str:
        return self.sync._repr_html_()
