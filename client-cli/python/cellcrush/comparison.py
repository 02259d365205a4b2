"""Tests of the user's own beside the curve of a job."""
from __future__ import annotations

from typing import TYPE_CHECKING, Any, Optional, Sequence

import numpy as np

from cellcrush.v1 import jobs_service_pb2

if TYPE_CHECKING:
    import matplotlib.axes

_Numbers = jobs_service_pb2.CompareTestResponse.Numbers


class Comparison:
    """`measured` and `computed` have `slope`, `peak`, `peak_at`, `mean` and `energy`; `HasField` says whether a curve
    has a number. Stresses are in MPa over nominal strain, forces in N over displacement in mm."""

    def __init__(self, message: jobs_service_pb2.CompareTestResponse, names: Sequence[str]) -> None:
        self.names = list(names)
        self.is_force: bool = message.is_force
        self.measured, self.computed = message.measured, message.computed
        self.window = (message.window_low, message.window_high)
        self.energy_to: float = message.energy_to
        self.greatest_difference: float = message.greatest_difference
        self.greatest_difference_at: float = message.greatest_difference_at
        self.rms_difference: float = message.rms_difference
        self.x = np.array(message.x)
        self.measured_mean = np.array(message.measured_mean)
        self.measured_least = np.array(message.measured_least)
        self.measured_most = np.array(message.measured_most)
        self.computed_y = np.array(message.computed_y)

    def ratio(self, name: str) -> Optional[float]:
        """Computed over measured: `ratio("slope")`."""
        has = all(name == "energy" or numbers.HasField(name) for numbers in (self.measured, self.computed))
        measured: float = getattr(self.measured, name)
        return getattr(self.computed, name) / measured if has and measured else None

    def plot(self, ax: "Optional[matplotlib.axes.Axes]" = None, width_mm: float = 85.0,
             font_pt: float = 8.0) -> "matplotlib.axes.Axes":
        """Draws the tests, with their band, and the job."""
        from cellcrush.plots import finish, new_axes

        ax = new_axes(ax, width_mm)
        if len(self.names) > 1:
            ax.fill_between(self.x, self.measured_least, self.measured_most, color="black", alpha=0.15, linewidth=0)
        label = self.names[0] if len(self.names) == 1 else f"mean of {len(self.names)} tests"
        ax.plot(self.x, self.measured_mean, color="black", linewidth=1.2, label=label)
        ax.plot(self.x, self.computed_y, linewidth=1.0, label="computed")
        ax.set(xlabel="displacement (mm)" if self.is_force else "nominal strain",
               ylabel="force (N)" if self.is_force else "nominal stress (MPa)")
        finish(ax, font_pt)
        return ax

    def __repr__(self) -> str:
        parts = [f"{name} {ratio - 1:+.1%}" for name in ("slope", "peak", "mean", "energy")
                 if (ratio := self.ratio(name)) is not None]
        return f"<against {', '.join(self.names)}: {', '.join(parts)}>"
