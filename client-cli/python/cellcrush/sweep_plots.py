"""Plots of sweeps by matplotlib: curves over one field, a map over two."""
from __future__ import annotations

from typing import TYPE_CHECKING, Any, List, Optional, Tuple

import numpy as np

from cellcrush.arrays import Array
from cellcrush.errors import need
from cellcrush.plots import GREY, finish, new_axes, stress_unit
from cellcrush.words import label_of, short_names

if TYPE_CHECKING:
    import matplotlib.axes
    import pandas
    from cellcrush.sweep import Sweep

_STRESS = "plateau_stress_impact_mpa"
_MOST_LEVELS = 8
_DARK = 0.7  # of the colours; brighter ones take black text
_CHARACTER = 0.62  # width of a digit in its height


def read_points(sweep: "Sweep") -> "Tuple[pandas.DataFrame, List[str]]":
    """The means over seeds, and the other varied fields."""
    names = short_names(sweep.fields)
    seeds = [name for name in names if name.rsplit(".", 1)[-1] == "seed" and len(names) > 1]
    return sweep.table(mean_over=seeds), [name for name in names if name not in seeds]


def plot_points(table: "pandas.DataFrame", fields: "List[str]", ax: "Optional[matplotlib.axes.Axes]" = None,
                width_mm: float = 85.0, font_pt: float = 8.0, series: bool = False) -> "matplotlib.axes.Axes":
    ax = new_axes(ax, width_mm)
    grid = [np.unique(table[name]) for name in fields]
    is_grid = not table.duplicated(fields).any() and len(table) == np.prod([len(values) for values in grid])
    if len(fields) == 2 and is_grid and min(len(values) for values in grid) > 1 and not series:
        _draw_map(ax, table, fields, font_pt)
    else:
        _draw_curves(ax, table, fields[0], fields[1:], font_pt)
    return ax


def _draw_curves(ax: Any, table: "pandas.DataFrame", first: str, others: "List[str]", font_pt: float) -> None:
    unit, factor = stress_unit(ax, table[[_STRESS, "plateau_stress_support_mpa"]].max().max())
    is_seed = first.rsplit(".", 1)[-1] == "seed"
    groups = table.groupby(others if len(others) > 1 else others[0], sort=False) if others else [((), table)]
    for key, rows in groups:
        rows = rows.sort_values(first)
        values = key if isinstance(key, tuple) else (key,)
        group = ", ".join(f"{value:g}" for value in values)
        colour = None
        for plate, marker, line in (("impact", "o", "-"), ("support", "s", "--")):
            column = f"plateau_stress_{plate}_mpa"
            bars = factor * rows[column + "_ci95"]
            drawn = ax.errorbar(rows[first], factor * rows[column], yerr=None if bars.isna().all() else bars,
                                marker=marker, markersize=3, linewidth=0.8, capsize=2, elinewidth=0.6, color=colour,
                                linestyle="none" if is_seed else line,
                                label=(group if plate == "impact" else None) if group else f"{plate} plate")
            colour = drawn[0].get_color() if group else None
    missing = table[first][table["count"] == 0]
    if len(missing):
        ax.plot(missing, [0.0] * len(missing), "x", color=GREY, markersize=4, clip_on=False, label="no job succeeded")
    if others:
        ax.plot([], [], color=GREY, linewidth=0.8, linestyle="--", marker="s", markersize=3, label="support")
    theory = table["shock_mpa"].notna()
    if first == "speed_m_per_s" and not others and theory.sum() > 1:
        slope, constant = np.polyfit(table[first][theory] ** 2, table["shock_mpa"][theory], 1)
        speeds = np.linspace(table[first].min(), table[first].max(), 200)
        ax.plot(speeds, factor * (constant + slope * speeds**2), color="black", linewidth=0.8,
                label="shock theory (Eq. 51)")
    ax.set(xlabel=label_of(first), ylabel=f"plateau stress ({unit})", ylim=(0.0, None))
    locator = ax.xaxis.get_major_locator()
    if isinstance(locator, need("matplotlib.ticker", "python3-matplotlib").MaxNLocator):
        locator.set_params(integer=bool((table[first] % 1 == 0).all()))
    if table[first].min() > 0.0:
        ax.set_xlim(left=max(ax.get_xlim()[0], 0.0))
    finish(ax, font_pt, ", ".join(label_of(name) for name in others), 4 if len(others) == 1 else 2)


def _borders(values: Array) -> Array:
    """The borders of cells around values, halfway between them. Positive values have positive borders."""
    middles = 0.5 * (values[1:] + values[:-1])
    low, high = 2.0 * values[0] - middles[0], 2.0 * values[-1] - middles[-1]
    if values[0] > 0.0:
        low = max(low, 0.5 * values[0])
    borders: Array = np.concatenate([[low], middles, [high]])
    return borders


def _draw_map(ax: Any, table: "pandas.DataFrame", fields: "List[str]", font_pt: float) -> None:
    """Cells coloured by the plateau stress with their values, and contours between the points."""
    matplotlib = need("matplotlib", "python3-matplotlib")
    stress = table.pivot(index=fields[1], columns=fields[0], values=_STRESS).sort_index().sort_index(axis=1)
    unit, factor = stress_unit(ax, stress.max().max())
    x, y, values = stress.columns.to_numpy(), stress.index.to_numpy(), factor * np.ma.masked_invalid(stress.to_numpy())
    colours = matplotlib.colors.ListedColormap(matplotlib.colormaps["plasma"](np.linspace(0.0, 0.8, 256)))
    ax.set_facecolor("#ededed")  # where there is no plateau
    cells = ax.pcolormesh(_borders(x), _borders(y), values, cmap=colours, rasterized=True)
    ax.set(xlabel=label_of(fields[0]), ylabel=label_of(fields[1]))
    if values.count():
        bar = ax.figure.colorbar(cells, ax=ax, label=f"plateau stress, impact plate ({unit})", pad=0.03)
        levels = matplotlib.ticker.MaxNLocator(_MOST_LEVELS).tick_values(values.min(), values.max())
        levels = levels[(levels > values.min()) & (levels < values.max())]
        if len(levels):
            bar.add_lines(ax.contour(x, y, values, levels=levels, colors="white", linewidths=0.8))
        bar.ax.yaxis.label.set_fontsize(font_pt)
        bar.ax.tick_params(labelsize=font_pt, width=0.5)
        bar.outline.set_linewidth(0.5)
    finish(ax, font_pt)
    _write_values(ax, x, y, values, cells, 0.8 * font_pt)


def _write_values(ax: Any, x: Array, y: Array, values: Any, cells: Any, font_pt: float) -> None:
    """Each value, where it fits into its cell."""
    ax.figure.draw_without_rendering()
    scale = 72.0 / ax.figure.dpi
    widths, heights = (scale * np.diff(ax.transData.transform(np.column_stack([borders, borders]))[:, axis])
                       for axis, borders in enumerate((_borders(x), _borders(y))))
    middles = [0.5 * (borders[1:] + borders[:-1]) for borders in (_borders(x), _borders(y))]
    for row, column in np.ndindex(values.shape):
        value = values[row, column]
        text = "–" if value is np.ma.masked else f"{value:.3g}"
        if (len(text) + 1) * _CHARACTER * font_pt > widths[column] or 1.6 * font_pt > heights[row]:
            continue
        is_bright = value is np.ma.masked or cells.norm(value) > _DARK
        behind = "#ededed" if value is np.ma.masked else cells.to_rgba(value)
        ax.text(middles[0][column], middles[1][row], text, fontsize=font_pt, ha="center", va="center", clip_on=True,
                color="black" if is_bright else "white", bbox={"facecolor": behind, "edgecolor": "none", "pad": 0.8})
