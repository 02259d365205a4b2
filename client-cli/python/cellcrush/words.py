"""Units and labels of numbers, from their names: `speed_m_per_s` is "speed" in m/s."""
from __future__ import annotations

from typing import Iterable

_UNITS = {
    "_kg_per_m3": "kg/m³", "_j_per_g": "J/g", "_m_per_s2": "m/s²", "_m_per_s": "m/s", "_per_s": "1/s",
    "_n_mm": "N mm", "_g_mm2": "g mm²", "_mpa": "MPa", "_mm": "mm", "_mj": "mJ", "_rad": "rad", "_n": "N",
    "_g": "g", "_s": "s",
}


def unit_of(name: str) -> str:
    """The unit of a number, empty if it has none.

    >>> unit_of("loading.speed_m_per_s"), unit_of("energy_elastic_mj"), unit_of("strain")
    ('m/s', 'mJ', '')
    """
    return next((unit for suffix, unit in _UNITS.items() if name.endswith(suffix)), "")


def words_of(name: str) -> str:
    """What a person calls a number.

    >>> words_of("lattice.hexagon.wall_thickness_mm")
    'wall thickness'
    """
    last = name.rsplit(".", 1)[-1]
    suffix = next((suffix for suffix in _UNITS if last.endswith(suffix)), "")
    of_frame = " or beam" if name == "elements_per_wall" else ""
    return last[: len(last) - len(suffix)].replace("_", " ") + of_frame


def label_of(name: str) -> str:
    """What an axis calls a number.

    >>> label_of("lattice.hexagon.wall_thickness_mm"), label_of("strain")
    ('wall thickness (mm)', 'strain')
    """
    return f"{words_of(name)} ({unit_of(name)})" if unit_of(name) else words_of(name)


def units_of(names: Iterable[str]) -> dict[str, str]:
    """The units of numbers that have one."""
    return {name: unit for name in names if (unit := unit_of(name))}


def short_names(paths: Iterable[str]) -> list[str]:
    """The last part of each path, or the whole path where two would be the same.

    >>> short_names(["loading.speed_m_per_s", "contact.friction", "plates.friction"])
    ['speed_m_per_s', 'contact.friction', 'plates.friction']
    """
    paths = list(paths)
    lasts = [path.rsplit(".", 1)[-1] for path in paths]
    return [last if lasts.count(last) == 1 else path for path, last in zip(paths, lasts)]
