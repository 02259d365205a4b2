"""A job of a daemon: its state, and its results as they come."""
from __future__ import annotations

import pathlib
import sys
import zlib
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any, Dict, Iterator, List, Optional, Tuple

from cellcrush.arrays import Array, Frames, Mesh, Values, breaks_array, frames_from, mesh_from, samples_array
from cellcrush.comparison import Comparison
from cellcrush.connection import Connection
from cellcrush.display import Bar, html_table
from cellcrush.errors import FileError, JobFailed
from cellcrush.results import PathLike, Results
from cellcrush.v1 import event_pb2, job_pb2, jobs_service_pb2
from cellcrush.v1.case_pb2 import Case
from cellcrush.v1.sample_pb2 import Sample
from cellcrush.whole_file import whole_file

if TYPE_CHECKING:
    import matplotlib.axes

ENDED = (job_pb2.Job.SUCCEEDED, job_pb2.Job.FAILED, job_pb2.Job.CANCELLED)


@contextmanager
def leaves_running(name: str, connection: Connection) -> Iterator[None]:
    """Ctrl-C ends the wait, not what is waited for, unless the daemon ends with this script."""
    try:
        yield
    except KeyboardInterrupt:
        if not connection.is_private:
            print(f"\n{name} keeps running; get({name!r}) of the server finds it again", file=sys.stderr)
        raise


class JobWatch:
    """What a watch of a job has received, and the request that continues it."""

    def __init__(self, job: job_pb2.Job) -> None:
        self.job = job
        self.request = jobs_service_pb2.WatchJobRequest(name=job.name)
        self.samples: Dict[int, Sample] = {}

    def take(self, event: event_pb2.JobEvent) -> str:
        """Takes an event; returns its kind."""
        kind: str = event.WhichOneof("event") or ""
        self.request.after_sequence = max(self.request.after_sequence, event.sequence)
        if kind == "snapshot":
            self.request.epoch = event.snapshot.epoch
            self.job = event.snapshot.job
        elif kind == "state":
            self.job = event.state
            if event.state.begun_again_sequence == event.sequence:
                self.samples.clear()
        elif kind == "progress":
            self.job.progress.CopyFrom(event.progress)
        elif kind == "sample":
            self.samples[event.sequence] = event.sample
        return kind

    def show(self, bar: Bar, kind: str) -> None:
        now = self.job.progress
        if kind == "progress":
            bar.show(now.fraction, f"strain {now.strain:.3f}, {now.seconds_left:.0f} s left")
        elif kind in ("snapshot", "state") and not self.has_ended():
            bar.show(now.fraction, job_pb2.Job.State.Name(self.job.state))

    def has_ended(self) -> bool:
        return self.job.state in ENDED


class Job(Results):
    """A job. Its properties are those of the last answer of the daemon; `refresh`, `wait` and `watch` renew them."""

    def __init__(self, connection: Connection, message: job_pb2.Job) -> None:
        self._connection = connection
        self._message = message
        self._kept: Dict[str, Any] = {}  # results, once the job has ended

    # What is known of the job.

    @property
    def name(self) -> str:
        """Its name, such as "jobs/7"."""
        return str(self._message.name)

    @property
    def title(self) -> str:  # type: ignore[override]
        return str(self._message.title)

    @property
    def state(self) -> str:
        """PENDING, RUNNING, SUSPENDED, CANCELLING, SUCCEEDED, FAILED or CANCELLED."""
        return str(job_pb2.Job.State.Name(self._message.state))

    @property
    def cause(self) -> str:
        """Why it failed, such as TIME_LIMIT; empty if it did not."""
        return str(job_pb2.Job.Cause.Name(self._message.cause)) if self._message.cause else ""

    @property
    def cause_message(self) -> str:
        return str(self._message.cause_message)

    @property
    def remedy(self) -> str:
        return str(self._message.remedy)

    @property
    def labels(self) -> Dict[str, str]:
        return dict(self._message.labels)

    @property
    def note(self) -> str:
        """Its note; `set_note` changes it."""
        return str(self._message.note)

    @property
    def notes(self) -> List[str]:
        """Implausible values in the case, as found when it was submitted."""
        return [f"{note.field} {note.message} {note.remedy}" for note in self._message.notes]

    @property
    def progress(self) -> Any:
        """Strain, fraction, seconds_left and more while it runs, else None."""
        return Values(self._message.progress, self._message.HasField("progress"))

    @property
    def summary(self) -> Any:
        """Plateau stresses, densification strain, energies and theory; None where the run gives none."""
        return Values(self._message.summary)

    @property
    def has_result(self) -> bool:
        """Whether there is a result file; of a job that was cancelled or failed, it has the results so far."""
        return bool(self._message.HasField("summary"))

    @property
    def case(self) -> Case:
        """The case as submitted."""
        if not self._message.HasField("case"):
            self.refresh()
        return self._message.case

    def _take(self, message: job_pb2.Job) -> None:
        if self._message.HasField("case") and not message.HasField("case"):
            message.case.CopyFrom(self._message.case)
        self._message = message

    def refresh(self) -> "Job":
        """Asks the daemon."""
        self._message = self._connection.call(self._connection.jobs.GetJob,
                                              jobs_service_pb2.GetJobRequest(name=self.name))
        return self

    # What can be done with it.

    def events(self) -> Iterator[tuple[str, JobWatch]]:
        """The kind of each event (snapshot, state, sample, progress ...) with all that came so far, up to the end."""
        watch = JobWatch(self._message)
        stream = self._connection.follow(self._connection.jobs.WatchJob, lambda: watch.request, watch.has_ended)
        for event in stream:
            kind = watch.take(event)
            if kind in ("snapshot", "state"):
                self._take(watch.job)
            yield kind, watch

    def watch(self) -> Iterator[Sample]:
        """Each sample as it comes, from the first, up to the end of the job; lost connections are made up for.

        A job that restarts from step 0 sends its samples again."""
        with leaves_running(self.name, self._connection):
            for kind, watch in self.events():
                if kind == "sample":
                    yield watch.samples[watch.request.after_sequence]

    def wait(self, progress: "bool | None" = None, check: bool = True) -> "Job":
        """Waits for the end of the job. A bar shows on terminals and in notebooks, always or never with `progress`.

        Raises JobFailed if it did not succeed, unless `check` is False. Ctrl-C leaves the job running,
        but stops a private server."""
        bar = Bar(self.name, progress)
        with leaves_running(self.name, self._connection):
            for kind, watch in self.events():
                watch.show(bar, kind)
        return self._ended(bar, check)

    def _ended(self, bar: Bar, check: bool) -> "Job":
        bar.show(1.0 if self.state == "SUCCEEDED" else self._message.progress.fraction, self.state, last=True)
        if check and self.state != "SUCCEEDED":
            raise JobFailed(self)
        return self

    def _command(self, name: str) -> "Job":
        method, request = getattr(self._connection.jobs, name), getattr(jobs_service_pb2, name + "Request")
        self._take(self._connection.call(method, request(name=self.name)))
        return self

    def cancel(self) -> "Job":
        """Stops it; results so far are kept."""
        return self._command("CancelJob")

    def suspend(self) -> "Job":
        """Stops it at a checkpoint, until `resume`."""
        return self._command("SuspendJob")

    def resume(self) -> "Job":
        return self._command("ResumeJob")

    def set_note(self, note: str) -> "Job":
        """Writes its note; "" removes it. Raises CrushError if somebody has changed it since `refresh`."""
        request = jobs_service_pb2.UpdateJobRequest(job=job_pb2.Job(name=self.name, note=note),
                                                    previous_note=self.note, update_mask={"paths": ["note"]})
        self._take(self._connection.call(self._connection.jobs.UpdateJob, request))
        return self

    def delete(self) -> None:
        """Deletes a job that has ended, with its results."""
        self._connection.call(self._connection.jobs.DeleteJob, jobs_service_pb2.DeleteJobRequest(name=self.name))

    # Its results.

    def _history(self) -> Tuple[Array, Array]:
        """Samples and breaks."""
        if "history" in self._kept:
            kept: Tuple[Array, Array] = self._kept["history"]
            return kept
        pages = self._connection.pages(self._connection.jobs.GetHistory,
                                       jobs_service_pb2.GetHistoryRequest(name=self.name))
        samples = [sample for page in pages for sample in page.samples]
        history = samples_array(samples), breaks_array(samples)
        if self._message.state in ENDED:
            self._kept["history"] = history
        return history

    def samples(self) -> Array:
        return self._history()[0]

    def breaks(self) -> Array:
        return self._history()[1]

    def _read_fields(self) -> None:
        request = jobs_service_pb2.StreamFramesRequest(name=self.name)
        count = 0
        meshes: List[event_pb2.MeshChunk] = []
        frames: List[List[event_pb2.FrameChunk]] = []
        chunks: List[event_pb2.FrameChunk] = []

        def next_request() -> jobs_service_pb2.StreamFramesRequest:
            nonlocal chunks
            chunks = []
            meshes.clear()
            setattr(request, "from", len(frames))
            return request

        stream = self._connection.follow(self._connection.jobs.StreamFrames, next_request,
                                         lambda: len(frames) >= count)
        for message in stream:
            if message.HasField("times"):
                count = len(message.times.time_s)
            elif message.HasField("mesh"):
                meshes.append(message.mesh)
            else:
                chunks.append(message.frame)
                if message.frame.part + 1 == message.frame.part_count:
                    frames.append(chunks)
                    chunks = []
        self._kept["mesh"], self._kept["frames"] = mesh_from(meshes), frames_from(frames)

    def _fields(self, key: str) -> Any:
        if key not in self._kept:
            self._read_fields()
        return self._kept[key] if self._message.state in ENDED else self._kept.pop(key)

    @property
    def mesh(self) -> Mesh:
        mesh: Mesh = self._fields("mesh")
        return mesh

    @property
    def frames(self) -> Frames:
        frames: Frames = self._fields("frames")
        return frames

    def download(self, path: PathLike = "result.h5") -> pathlib.Path:
        """Saves the result file, whole: until then a file of this name stays as it is."""
        target = pathlib.Path(path)
        request = jobs_service_pb2.DownloadResultRequest(name=self.name)
        size, crc = -1, 0
        with whole_file(target) as file:
            for chunk in self._connection.follow(self._connection.jobs.DownloadResult, lambda: request,
                                                 lambda: request.offset == size):
                file.write(chunk.data)
                crc = zlib.crc32(chunk.data, crc)
                if chunk.HasField("crc32") and chunk.crc32 != crc:
                    raise FileError(f"{path}: the file was damaged on its way. Download it again.")
                request.offset, size = chunk.offset + len(chunk.data), chunk.total_size
        return target

    def compare(self, *tests: PathLike, columns: str = "", window: Optional[Tuple[float, float]] = None,
                energy_to: Optional[float] = None, force: str = "", displacement: str = "") -> Comparison:
        """Lays tests over its curve: CSV files whose header, or `columns`, names columns and units. With `force`, a
        part such as "press" or "grip.y", forces are compared over its displacement, or over that of `displacement`.
        `window` is that of the mean, `energy_to` the end of the energy."""
        request = jobs_service_pb2.CompareTestRequest(name=self.name, columns=columns, energy_to=energy_to,
                                                      force_part=force, displacement_part=displacement)
        if window is not None:
            request.window_low, request.window_high = window
        for test in tests:
            request.tests.add(name=str(test), text=pathlib.Path(test).read_text(encoding="utf-8", errors="replace"))
        answer = self._connection.call(self._connection.jobs.CompareTest, request)
        return Comparison(answer, [str(test) for test in tests])

    def live_plot(self, **style: Any) -> "matplotlib.axes.Axes":
        """Draws the curves while the job runs, in a notebook or a window, and returns them at its end."""
        from cellcrush.plots import LivePlot

        live = LivePlot(**style)
        with leaves_running(self.name, self._connection):
            for kind, watch in self.events():
                live.take(kind, watch)
        return live.end(self)

    def __repr__(self) -> str:
        return f"<{self.name} {self.state} {self.title!r}>"

    def _repr_html_(self) -> str:
        rows = [("state", self.state)]
        if self.cause:
            rows.append(("cause", f"{self.cause}: {self.cause_message} {self.remedy}"))
        if self._message.HasField("progress"):
            rows.append(("strain", f"{self.progress.strain:.3f} ({self.progress.fraction:.0%})"))
        return html_table(rows + self._result_rows(), f"{self.name}: {self.title}")
