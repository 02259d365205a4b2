"""A sweep: jobs that vary some fields of one case, and their results as a table."""
from __future__ import annotations

from typing import TYPE_CHECKING, Any, Dict, Iterator, List, Sequence, Union

from cellcrush.connection import Connection
from cellcrush.display import Bar, html_table
from cellcrush.errors import need
from cellcrush.job import ENDED, Job, leaves_running
from cellcrush.means import mean_table
from cellcrush.v1 import job_pb2, sweep_pb2, sweeps_service_pb2
from cellcrush.v1.case_pb2 import Case
from cellcrush.words import short_names, units_of

if TYPE_CHECKING:
    import matplotlib.axes
    import pandas

# The columns of results, named as in the table of the command line.
_RESULTS = ("plateau_stress_impact_mpa", "plateau_stress_support_mpa", "plateau_stress_to_densification_mpa",
            "densification_strain", "absorbed_energy_mj", "theory.gibson_ashby_mpa", "theory.shock_mpa",
            "front.shock_mpa", "front.strain_behind", "energy_error_relative", "valid_to_strain",
            "solid_fraction_at_densification", "crush_forces.mean_n", "crush_forces.peak_n", "crush_forces.efficiency",
            "crush_forces.specific_energy_j_per_g", "poissons_ratio")


def _column(path: str) -> str:
    return path.replace("theory.", "").replace(".", "_")


class SweepWatch:
    """What a watch of a sweep has received, and the request that continues it."""

    def __init__(self, name: str) -> None:
        self.request = sweeps_service_pb2.WatchSweepRequest(name=name)
        self.fractions: Dict[str, float] = {}  # by job
        self.ended: Dict[str, bool] = {}

    def take(self, message: sweeps_service_pb2.WatchSweepResponse) -> None:
        if message.resume_token:
            self.request.resume_token = message.resume_token
        for job in message.snapshot.jobs:
            self.ended.setdefault(job, False)
        kind = message.event.WhichOneof("event")
        if kind in ("snapshot", "state"):
            state = message.event.snapshot.job.state if kind == "snapshot" else message.event.state.state
            self.ended[message.job] = state in ENDED
        elif kind == "progress":
            self.fractions[message.job] = message.event.progress.fraction

    def show(self, bar: Bar) -> None:
        bar.show(self.fraction(), f"{sum(self.ended.values())} of {len(self.ended)} jobs ended")

    def has_ended(self) -> bool:
        return bool(self.ended) and all(self.ended.values())

    def fraction(self) -> float:
        return sum(1.0 if ended else self.fractions.get(job, 0.0) for job, ended in self.ended.items()) / max(
            1, len(self.ended))


class Sweep:
    """A sweep. Iterating over it gives its jobs, in the order of the points."""

    def __init__(self, connection: Connection, message: sweep_pb2.Sweep) -> None:
        self._connection = connection
        self._message = message

    @property
    def name(self) -> str:
        """Its name, such as "sweeps/3"."""
        return str(self._message.name)

    @property
    def case(self) -> Case:
        """The case that it varies."""
        return self._message.case

    @property
    def fields(self) -> List[str]:
        """The paths of the varied fields."""
        if self._message.axes:
            return [axis.field for axis in self._message.axes]
        return sorted(self._message.points[0].fields)

    @property
    def note(self) -> str:
        """Its note; `set_note` changes it."""
        return str(self._message.note)

    @property
    def states(self) -> Dict[str, int]:
        """How many jobs are in each state."""
        return dict(self._message.state_counts)

    def refresh(self) -> "Sweep":
        """Asks the daemon."""
        self._message = self._connection.call(self._connection.sweeps.GetSweep,
                                              sweeps_service_pb2.GetSweepRequest(name=self.name))
        return self

    def _rows(self) -> List[sweep_pb2.SweepTable.Row]:
        request = sweeps_service_pb2.GetSweepTableRequest(name=self.name)
        return [row for page in self._connection.pages(self._connection.sweeps.GetSweepTable, request)
                for row in page.rows]

    @property
    def jobs(self) -> List[Job]:
        return [Job(self._connection, row.result) for row in self._rows()]

    def __iter__(self) -> Iterator[Job]:
        return iter(self.jobs)

    def __len__(self) -> int:
        return len(self._message.jobs)

    def wait(self, progress: "bool | None" = None) -> "Sweep":
        """Waits until all jobs have ended, however: `states` counts how. Ctrl-C leaves them running."""
        bar, watch = Bar(self.name, progress), SweepWatch(self.name)
        with leaves_running(self.name, self._connection):
            for message in self._connection.follow(self._connection.sweeps.WatchSweep, lambda: watch.request,
                                                   watch.has_ended):
                watch.take(message)
                watch.show(bar)
        return self._ended(bar, watch)

    def _ended(self, bar: Bar, watch: SweepWatch) -> "Sweep":
        self.refresh()
        bar.show(watch.fraction(), ", ".join(f"{n} {state}" for state, n in self.states.items()), last=True)
        return self

    def table(self, mean_over: Union[str, Sequence[str], None] = None) -> "pandas.DataFrame":
        """The results, a row for each job with the number of its `warnings`; `attrs["units"]` has the units.

        With `mean_over`, such as "seed" or a list of fields by name or path, a row for all jobs that differ in these
        fields alone: the `count` of those that succeeded, how many of these are `warned`, the mean of each result over
        them (NaN where there are none) and the half-width of its 95 % interval (`..._ci95`). A result that only some of
        them have also has their number (`..._count`)."""
        pandas = need("pandas", "python3-pandas")
        names = short_names(self.fields)
        records = []
        for row in self._rows():
            values = Job(self._connection, row.result).summary.as_dict()
            record: Dict[str, Any] = dict(zip(names, row.values))
            record.update(job=row.job, state=job_pb2.Job.State.Name(row.result.state),
                          warnings=len(row.result.summary.warnings))
            record.update({_column(path): values[path] for path in _RESULTS})
            record["crush_mode"] = values["crush_mode_words"]
            records.append(record)
        columns = [_column(path) for path in _RESULTS]
        table = pandas.DataFrame(records, columns=[*names, "job", "state", "warnings", *columns, "crush_mode"])
        table[columns] = table[columns].astype(float)
        table.attrs.update(title=self.case.title, units=units_of(table.columns))
        if mean_over is None:
            return table
        by_path = dict(zip(self.fields, names))
        over = [mean_over] if isinstance(mean_over, str) else mean_over
        return mean_table(table, names, columns, [by_path.get(name.replace("__", "."), name) for name in over])

    def plot(self, ax: "matplotlib.axes.Axes | None" = None, **style: Any) -> "matplotlib.axes.Axes":
        """Draws the plateau stresses, means over seeds: over one field as curves with intervals and theory, over two as
        a map with contours (with `series=True`, a curve for each value of the second). `style`: `width_mm=85`,
        `font_pt=8`."""
        from cellcrush.sweep_plots import plot_points, read_points

        return plot_points(*read_points(self), ax, **style)

    def cancel(self) -> "Sweep":
        """Cancels all jobs that have not ended."""
        self._message = self._connection.call(self._connection.sweeps.CancelSweep,
                                              sweeps_service_pb2.CancelSweepRequest(name=self.name))
        return self

    def retry(self) -> "Sweep":
        """Queues a new job in the place of each that FAILED, and of each that `max_failures` cancelled. The old ones
        stay as jobs of their own. Jobs that were cancelled otherwise are left; without any to repeat, nothing changes.
        `wait` waits for the new ones."""
        self._message = self._connection.call(self._connection.sweeps.RetryFailedJobs,
                                              sweeps_service_pb2.RetryFailedJobsRequest(name=self.name))
        return self

    def set_note(self, note: str) -> "Sweep":
        """Writes its note; "" removes it. Raises CrushError if somebody has changed it since `refresh`."""
        request = sweeps_service_pb2.UpdateSweepRequest(sweep=sweep_pb2.Sweep(name=self.name, note=note),
                                                        previous_note=self.note, update_mask={"paths": ["note"]})
        self._message = self._connection.call(self._connection.sweeps.UpdateSweep, request)
        return self

    def delete(self) -> None:
        """Deletes the sweep with its jobs, which have ended."""
        self._connection.call(self._connection.sweeps.DeleteSweep,
                              sweeps_service_pb2.DeleteSweepRequest(name=self.name))

    def __repr__(self) -> str:
        states = ", ".join(f"{count} {state}" for state, count in self.states.items())
        return f"<{self.name} {states} {self.case.title!r}>"

    def _repr_html_(self) -> str:
        rows = [("varied", ", ".join(self.fields)), *((state, str(n)) for state, n in self.states.items())]
        return html_table(rows, f"{self.name}: {self.case.title}")
