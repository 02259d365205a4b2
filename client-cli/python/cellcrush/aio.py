"""The same for asyncio: `server = await connect()`, `await job.wait()`, `async for sample in job.watch()`.

Calls run in threads; watches and waits hold none, so that one program can wait for thousands of jobs."""
from __future__ import annotations

import asyncio
from typing import TYPE_CHECKING, Any, AsyncIterator, Callable, List, Mapping, Optional

import grpc

from cellcrush import job as _job
from cellcrush import server as _server
from cellcrush import sweep as _sweep
from cellcrush.arrays import Array, Frames
from cellcrush.case import CaseLike
from cellcrush.connection import OPTIONS, RECOVERABLE, SILENCE_S, Connection, Patience
from cellcrush.errors import JobFailed, NotConnected, raise_error
from cellcrush.v1 import jobs_service_pb2_grpc, sweeps_service_pb2_grpc
from cellcrush.v1.sample_pb2 import Sample

if TYPE_CHECKING:
    import pandas


async def _follow(connection: Connection, stub: Any, method: str, next_request: Callable[[], Any],
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
                while (message := await asyncio.wait_for(stream.read(), SILENCE_S)) is not grpc.aio.EOF:
                    patience.renew()
                    yield message
                if is_complete():
                    return
                lost = "the server closed the stream"
            except asyncio.TimeoutError:
                lost = "it fell silent"
            except grpc.RpcError as error:
                if error.code() not in RECOVERABLE:
                    raise_error(error, connection.address)
                lost = error.details() or ""
            finally:
                stream.cancel()
            pause = patience.next_pause()
            if pause is None:
                raise NotConnected(f"lost the connection to {connection.address}: {lost}")
            await asyncio.sleep(pause)


class Job:
    """A job; `sync` is the same with blocking methods, for what it computes without the daemon (plots, tables)."""

    def __init__(self, sync: _job.Job) -> None:
        self.sync = sync

    @property
    def name(self) -> str:
        return self.sync.name

    @property
    def state(self) -> str:
        return self.sync.state

    @property
    def summary(self) -> Any:
        return self.sync.summary

    async def watch(self) -> AsyncIterator[Sample]:
        """Each sample as it comes, up to the end of the job."""
        watch = _job.JobWatch(self.sync._message)
        async for event in _follow(self.sync._connection, jobs_service_pb2_grpc.JobsStub, "WatchJob",
                                   lambda: watch.request, watch.has_ended):
            if watch.take(event) == "sample":
                yield event.sample
        await asyncio.to_thread(self.sync.refresh)

    async def wait(self, check: bool = True) -> "Job":
        """Waits for the end of the job. Cancelling the task leaves the job running."""
        async for _ in self.watch():
            pass
        if check and self.state != "SUCCEEDED":
            raise JobFailed(self.sync)
        return self

    async def samples(self) -> Array:
        return await asyncio.to_thread(self.sync.samples)

    async def history(self) -> "pandas.DataFrame":
        return await asyncio.to_thread(self.sync.history)

    async def frames(self) -> Frames:
        return await asyncio.to_thread(lambda: self.sync.frames)

    async def set_note(self, note: str) -> "Job":
        await asyncio.to_thread(self.sync.set_note, note)
        return self

    async def cancel(self) -> "Job":
        await asyncio.to_thread(self.sync.cancel)
        return self

    async def delete(self) -> None:
        await asyncio.to_thread(self.sync.delete)


class Sweep:
    """A sweep; `sync` is the same with blocking methods."""

    def __init__(self, sync: _sweep.Sweep) -> None:
        self.sync = sync

    @property
    def name(self) -> str:
        return self.sync.name

    async def jobs(self) -> List[Job]:
        return [Job(job) for job in await asyncio.to_thread(lambda: self.sync.jobs)]

    async def wait(self) -> "Sweep":
        """Waits until all jobs have ended."""
        watch = _sweep.SweepWatch(self.name)
        async for message in _follow(self.sync._connection, sweeps_service_pb2_grpc.SweepsStub, "WatchSweep",
                                     lambda: watch.request, watch.has_ended):
            watch.take(message)
        await asyncio.to_thread(self.sync.refresh)
        return self

    async def table(self, mean_over: Optional[str] = None) -> "pandas.DataFrame":
        return await asyncio.to_thread(self.sync.table, mean_over)

    async def set_note(self, note: str) -> "Sweep":
        await asyncio.to_thread(self.sync.set_note, note)
        return self

    async def cancel(self) -> "Sweep":
        await asyncio.to_thread(self.sync.cancel)
        return self

    async def delete(self) -> None:
        await asyncio.to_thread(self.sync.delete)


class Server:
    """A daemon."""

    def __init__(self, sync: _server.Server) -> None:
        self.sync = sync

    async def submit(self, case: CaseLike, fields: Optional[Mapping[str, Any]] = None, **more: Any) -> Job:
        return Job(await asyncio.to_thread(self.sync.submit, case, fields, **more))

    async def sweep(self, case: CaseLike, fields: Optional[Mapping[str, Any]] = None, **more: Any) -> Sweep:
        return Sweep(await asyncio.to_thread(self.sync.sweep, case, fields, **more))

    async def check(self, case: CaseLike, fields: Optional[Mapping[str, Any]] = None, **more: Any) -> _server.Check:
        return await asyncio.to_thread(self.sync.check, case, fields, **more)

    async def jobs(self, filter: str = "") -> List[Job]:  # noqa: A002
        return [Job(job) for job in await asyncio.to_thread(lambda: list(self.sync.jobs(filter)))]


async def connect(address: Optional[str] = None, **options: Any) -> Server:
    """As cellcrush.connect, with the same options."""
    return Server(await asyncio.to_thread(_server.connect, address, **options))
