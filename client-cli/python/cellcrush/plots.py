"""Plots by matplotlib, sized for a column of a journal."""
from __future__ import annotations

import io
import re
import time
from typing import TYPE_CHECKING, Any, Optional, Tuple

import numpy as np

from cellcrush.arrays import Array, samples_array
from cellcrush.display import notebook_display
from cellcrush.errors import need

if TYPE_CHECKING:
    import matplotlib.animation
    import matplotlib.axes
    from cellcrush.job import Job, JobWatch
    from cellcrush.results import Results

_MM = 1.0 / 25.4
_BLUE, _ORANGE, GREY = "#0072b2", "#d55e00", "#666666"  # told apart by the colour-blind
_SMOOTHED = 0.02  # strain over which a curve is averaged
_REDRAWN_S = 0.5
_DPI = 200.0
_TALLEST = 1.5  # height of a picture over its width
_ICONS = {"minus": "−", "fast-backward": "«", "step-backward": "‹", "play fa-flip-horizontal": "◀\ufe0e",
          "pause": "❚❚", "play": "▶\ufe0e", "step-forward": "›", "fast-forward": "»", "plus": "+"}


def new_axes(ax: "Optional[matplotlib.axes.Axes]", width_mm: float, aspect: float = 0.75) -> "matplotlib.axes.Axes":
    pyplot = need("matplotlib.pyplot", "python3-matplotlib")
    if ax is None:
        size = (width_mm * _MM, aspect * width_mm * _MM)
        ax = pyplot.subplots(figsize=size, dpi=_DPI, layout="constrained")[1]
    ax.set_prop_cycle(color=[_BLUE, _ORANGE, "#009e73", "#cc79a7", "#56b4e9", "#e69f00"])
    return ax


def finish(ax: Any, font_pt: float, title: str = "", columns: int = 2) -> None:
    """The legend goes above the axes, where it hides no curve."""
    named = zip(*ax.get_legend_handles_labels())
    if entries := sorted(named, key=lambda entry: not isinstance(entry[0], tuple)):  # error bars, then lines
        ax.legend(*zip(*entries), fontsize=font_pt, frameon=False, handlelength=1.5, ncols=columns, loc="lower left",
                  borderaxespad=0.0, bbox_to_anchor=(0.0, 1.02), columnspacing=1.2, title=title or None,
                  title_fontsize=font_pt, alignment="left")
    for text in (ax.title, ax.xaxis.label, ax.yaxis.label):
        text.set_fontsize(font_pt)
    ax.tick_params(labelsize=font_pt, direction="in", width=0.5)
    for spine in ax.spines.values():
        spine.set_linewidth(0.5)


def _smoothed(x: Array, y: Array) -> Array:
    """Mean of y over all points within half of a window of each x, which ascends."""
    total = np.concatenate([[0.0], np.cumsum(y)])
    low, high = np.searchsorted(x, x - 0.5 * _SMOOTHED), np.searchsorted(x, x + 0.5 * _SMOOTHED, "right")
    means: Array = (total[high] - total[low]) / np.maximum(high - low, 1)
    return means


def stress_unit(ax: Any, largest: float) -> Tuple[str, float]:
    """The unit by size, as in all outputs of cellcrush, and its number in a MPa. Axes with curves keep theirs."""
    label = ax.get_ylabel()
    is_small = 0.0 < largest < 0.1 and not label.endswith("(MPa)")
    return ("kPa", 1e3) if is_small or label.endswith("(kPa)") else ("MPa", 1.0)


def _draw_curves(ax: Any, samples: Array) -> Tuple[str, float]:
    """Draws the stresses; returns their unit."""
    samples = samples[np.diff(np.maximum.accumulate(samples["strain"]), prepend=-1.0) > 0.0]  # a mass rebounds
    strain = samples["strain"]
    is_shown = strain > min(_SMOOTHED, 0.1 * strain.max(initial=0.0))  # the first impact may leave the axes
    smooth = {name: _smoothed(strain, samples[name]) for name in ("stress_impact_mpa", "stress_support_mpa")}
    top = max(curve[is_shown].max(initial=0.0) for curve in smooth.values())
    unit, factor = stress_unit(ax, top)
    for (name, curve), label, colour in zip(smooth.items(), ("impact plate", "support plate"), (_BLUE, _ORANGE)):
        ax.plot(strain, factor * samples[name], color=colour, alpha=0.25, linewidth=0.4)
        ax.plot(strain, factor * curve, color=colour, linewidth=1.0, label=label)
    ax.set(xlim=(0.0, None), ylim=(0.0, 1.1 * factor * top or None), xlabel="nominal strain",
           ylabel=f"nominal stress ({unit})")
    return unit, factor


def plot_curves(results: "Results", ax: "Optional[matplotlib.axes.Axes]" = None, width_mm: float = 85.0,
                font_pt: float = 8.0) -> "matplotlib.axes.Axes":
    ax = new_axes(ax, width_mm)
    unit, factor = _draw_curves(ax, results.samples())
    summary = results.summary
    if summary.plateau_stress_impact_mpa is not None:
        window = (summary.plateau_window_low, summary.plateau_window_high)
        plateau = factor * summary.plateau_stress_impact_mpa
        ax.plot(window, [plateau] * 2, color="black", linewidth=1.2, solid_capstyle="butt",
                label=f"plateau {plateau:.4g} {unit}")
    if summary.densification_strain is not None:
        ax.axvline(summary.densification_strain, color=GREY, linewidth=0.6, linestyle=":",
                   label=f"densification {summary.densification_strain:.3g}")
    if summary.other_rise_strain is not None:
        ax.axvline(summary.other_rise_strain, color=GREY, linewidth=0.6, linestyle=":",
                   label=f"{summary.other_rise_words} {summary.other_rise_strain:.3g}")
    _, end = ax.get_xlim()
    if summary.valid_to_strain is not None and summary.valid_to_strain < end:
        ax.axvspan(summary.valid_to_strain, end, color=GREY, alpha=0.15, linewidth=0, label="closed")
        ax.set_xlim(right=end)
    finish(ax, font_pt)
    return ax


class _Picture:
    """A frame as lines, coloured by plastic fraction, rigid ones as the plates; it can show another one."""

    def __init__(self, results: "Results", ax: Any, font_pt: float, low: Array, high: Array) -> None:
        collections = need("matplotlib.collections", "python3-matplotlib")
        self._frames, self._mesh = results.frames, results.mesh
        # Thickness to scale: a point of a line is 1/72 inch.
        box = ax.get_window_extent()
        scale = min(box.width / (high[0] - low[0]), box.height / (high[1] - low[1])) * 72.0 / ax.figure.dpi
        self._lines = collections.LineCollection([], cmap="inferno_r", linewidths=np.maximum(
            self._mesh.thickness_mm * scale, 0.35))
        self._lines.set_clim(-0.25, 1.0)  # elastic walls stay visible on white
        self._lines.set_cmap(self._lines.get_cmap().with_extremes(bad=GREY))
        ax.add_collection(self._lines)
        self._plate: Any = None
        if self._mesh.impact_plate_mm != self._mesh.support_plate_mm:
            draw = ax.axhline if self._mesh.along_y else ax.axvline
            draw(self._mesh.support_plate_mm, color=GREY, linewidth=1.5, clip_on=False)
            self._plate = draw(self._mesh.impact_plate_mm, color=GREY, linewidth=1.5, clip_on=False)
        ax.set(xlim=(low[0], high[0]), ylim=(low[1], high[1]), aspect="equal")
        ax.set_axis_off()
        self._title = ax.set_title("", fontsize=font_pt)
        self.show(0)

    def show(self, index: int) -> Tuple[Any, Any]:
        position, nodes = self._frames.lines(index, self._mesh)
        self._lines.set_segments(position[nodes])
        fraction = np.ma.array(self._frames.plastic_fraction[index])
        fraction[len(fraction) - self._mesh.rigid_element_count:] = np.ma.masked
        self._lines.set_array(fraction)
        self._title.set_text(f"strain {self._frames.strain[index]:.2f}")
        if self._plate is not None:
            travel = self._frames.strain[index] * self._mesh.length_mm
            place = self._mesh.impact_plate_mm + travel * np.sign(
                self._mesh.support_plate_mm - self._mesh.impact_plate_mm)
            (self._plate.set_ydata if self._mesh.along_y else self._plate.set_xdata)([place, place])
        return self._lines, self._title


def _picture(results: "Results", shown: slice, ax: "Optional[matplotlib.axes.Axes]", width_mm: float,
             font_pt: float) -> Tuple[Any, _Picture]:
    """Axes with a picture that has room for these frames."""
    frames = results.frames
    positions = [frames.position_mm[shown].reshape(-1, 2), *filter(len, frames.end_position_mm[shown])]
    low, high = np.min([p.min(axis=0) for p in positions], axis=0), np.max([p.max(axis=0) for p in positions], axis=0)
    size = high - low
    ax = new_axes(ax, width_mm, min(float(size[1] / size[0]) + 0.08, _TALLEST))
    return ax, _Picture(results, ax, font_pt, low, high)


def plot_frame(results: "Results", strain: float, ax: "Optional[matplotlib.axes.Axes]" = None, width_mm: float = 85.0,
               font_pt: float = 8.0) -> "matplotlib.axes.Axes":
    index = results.frames.nearest(strain)
    ax, picture = _picture(results, slice(index, index + 1), ax, width_mm, font_pt)
    picture.show(index)
    return ax


def animate(results: "Results", width_mm: float = 85.0, font_pt: float = 8.0,
            frames_per_s: float = 12.0) -> "matplotlib.animation.FuncAnimation":
    animation = need("matplotlib.animation", "python3-matplotlib")
    ax, picture = _picture(results, slice(None), None, width_mm, font_pt)

    class Player(animation.FuncAnimation):  # type: ignore[misc, name-defined]
        def to_jshtml(self, *options: Any, **named: Any) -> str:
            """The player, with texts for the icons that matplotlib takes from another host."""
            page = re.sub(r"<link[^>]*>", "", super().to_jshtml(*options, **named))
            return re.sub(r'<i class="fa fa-([^"]*)"></i>', lambda icon: _ICONS[icon.group(1)], page)

        def _repr_html_(self) -> str:
            return self.to_jshtml()

    movie: "matplotlib.animation.FuncAnimation" = Player(
        ax.figure, picture.show, frames=len(results.frames), interval=1000.0 / frames_per_s)
    need("matplotlib.pyplot", "python3-matplotlib").close(ax.figure)  # a notebook shows the movie alone
    return movie


class LivePlot:
    """Curves that are drawn again as samples arrive, in a notebook or a window."""

    def __init__(self, width_mm: float = 85.0, font_pt: float = 8.0) -> None:
        self._pyplot = need("matplotlib.pyplot", "python3-matplotlib")
        self._style = (width_mm, font_pt)
        self._ax = new_axes(None, width_mm)
        self._notebook: Any = notebook_display()
        self._handle: Any = None
        if self._notebook:
            self._handle = self._notebook.display("", display_id=True)
            self._pyplot.close(self._ax.figure)  # else the notebook would show it once more
        self._next_s = 0.0

    def _show(self) -> None:
        png = io.BytesIO()
        self._ax.figure.savefig(png, format="png")
        self._handle.update(self._notebook.Image(png.getvalue()))

    def take(self, kind: str, watch: "JobWatch") -> None:
        if kind != "sample" or time.monotonic() < self._next_s:
            return
        self._ax.clear()
        _draw_curves(self._ax, samples_array(list(watch.samples.values())))
        finish(self._ax, self._style[1])
        if self._handle is not None:
            self._show()
        elif self._pyplot.get_backend().lower() != "agg":
            self._pyplot.pause(0.01)
        self._next_s = time.monotonic() + _REDRAWN_S

    def end(self, job: "Job") -> "matplotlib.axes.Axes":
        self._ax.clear()
        plot_curves(job, self._ax, *self._style)
        if self._handle is not None:
            self._show()
        return self._ax
