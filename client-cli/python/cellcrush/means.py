"""Means over repeated runs and their 95 % intervals."""
from __future__ import annotations

import functools
import math
from typing import TYPE_CHECKING, Any, List, Sequence

if TYPE_CHECKING:
    import pandas

THEORY = ("gibson_ashby_mpa", "shock_mpa")  # no random results, so without intervals


def _share_within(t: float, freedom: int) -> float:
    """The probability that |Student's t| is below `t` (Abramowitz and Stegun, 26.7.3 and 26.7.4)."""
    angle = math.atan(t / math.sqrt(freedom))
    cosine2, odd = math.cos(angle) ** 2, freedom % 2
    term = math.cos(angle) if odd else 1.0
    total = 0.0
    for k in range(2 + odd, freedom + 1, 2):
        total += term
        term *= cosine2 * (k - 1) / k
    total *= math.sin(angle)
    return 2.0 / math.pi * (angle + total) if odd else total


@functools.lru_cache(maxsize=None)
def t_quantile(freedom: int) -> float:
    """|Student's t| that 95 % of draws stay below.

    >>> [round(t_quantile(freedom), 3) for freedom in (1, 2, 3, 4, 30)]
    [12.706, 4.303, 3.182, 2.776, 2.042]
    """
    low, high = 0.0, 13.0
    for _ in range(60):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if _share_within(middle, freedom) < 0.95 else (low, middle)
    return high


def half_width(values: "pandas.Series[Any]") -> float:
    """The half-width of the 95 % interval of the mean; NaN for a single value."""
    known = values.dropna()
    count = len(known)
    return t_quantile(count - 1) * float(known.std()) / math.sqrt(count) if count > 1 else math.nan


def mean_table(table: "pandas.DataFrame", fields: List[str], results: List[str],
               averaged: Sequence[str]) -> "pandas.DataFrame":
    """The results of the rows that succeeded, averaged over some of the varied fields. A point where none did stays."""
    unknown = [name for name in averaged if name not in fields]
    if unknown:
        raise ValueError(f"mean_over {unknown[0]!r} is not varied; the sweep varies {', '.join(fields)}")
    kept = [name for name in fields if name not in averaged]
    done = table["state"] == "SUCCEEDED"
    points = [table[name] for name in kept] if kept else (lambda _: 0)
    groups = table[results].where(done).groupby(points, sort=False)
    means, widths, counts = groups.mean(), groups.agg(half_width), groups.count()
    out = done.groupby(points, sort=False).sum().to_frame("count")
    out["warned"] = (done & (table["warnings"] > 0)).groupby(points, sort=False).sum()
    for name in results:
        out[name] = means[name]
        if (counts[name] % out["count"]).any():  # neither none nor all
            out[name + "_count"] = counts[name]
        if name not in THEORY:
            out[name + "_ci95"] = widths[name]
    out = out.reset_index(drop=not kept)
    units: dict[str, str] = table.attrs["units"]
    widths_units = {name + "_ci95": unit for name, unit in units.items() if name + "_ci95" in out}
    out.attrs.update(table.attrs, units={**units, **widths_units})
    return out
