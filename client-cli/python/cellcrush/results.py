"""What jobs and result files have in common: arrays, tables, datasets, pictures and files for other programs."""
from __future__ import annotations

import os
from abc import ABC, abstractmethod
from typing import TYPE_CHECKING, Any, List, Tuple, Union

import numpy as np

from cellcrush.arrays import Array, Frames, Mesh
from cellcrush.errors import need
from cellcrush.words import unit_of, units_of

if TYPE_CHECKING:
    import matplotlib.animation
    import matplotlib.axes
    import pandas
    import xarray

PathLike = Union[str, "os.PathLike[str]"]


class Results(ABC):
    """The results of one crush."""

    title: str
    summary: Any

    @abstractmethod
    def samples(self) -> Array:
        """The samples so far as a structured array, a field for each number: `samples()["strain"]`."""

    @abstractmethod
    def breaks(self) -> Array:
        """The walls that have broken so far, as a structured array in their order: `breaks()["time_s"]`."""

    @property
    @abstractmethod
    def mesh(self) -> Mesh:
        """The mesh before loading."""

    @property
    @abstractmethod
    def frames(self) -> Frames:
        """The frames so far."""

    def _result_rows(self) -> List[Tuple[str, str]]:
        """What a notebook shows of the results."""
        rows = []
        for label, name, unit in (("plateau at the impact plate", "plateau_stress_impact_mpa", "MPa"),
                                  ("plateau at the support plate", "plateau_stress_support_mpa", "MPa"),
                                  ("peak stress", "peak_stress_mpa", "MPa"),
                                  ("densification strain", "densification_strain", ""),
                                  ("other lasting rise of the stress", "other_rise_strain", ""),
                                  ("Poisson's ratio", "poissons_ratio", ""),
                                  ("valid to strain", "valid_to_strain", ""),
                                  ("inertia's share of the work", "inertia_share", "")):
            value = getattr(self.summary, name)
            if value is not None:
                rows.append((label, f"{value:.4g} {unit}".rstrip()))
        if self.summary.crush_forces:
            forces = self.summary.crush_forces
            rows.append(("mean and peak crush force", f"{forces.mean_n:.4g} N, {forces.peak_n:.4g} N"))
            rows.append(("crush force efficiency", f"{forces.efficiency:.4g}"))
            rows.append(("specific energy absorbed", f"{forces.specific_energy_j_per_g:.4g} J/g"))
        if self.summary.fibre_strain:
            rows.append(("largest fibre strain", f"{self.summary.fibre_strain.largest:.4g}"))
        return rows

    def history(self) -> "pandas.DataFrame":
        """The samples so far as a table. `history().attrs["units"]` has the units."""
        table: "pandas.DataFrame" = need("pandas", "python3-pandas").DataFrame(self.samples())
        table.attrs.update(title=self.title, units=units_of(table.columns))
        return table

    def xarray(self) -> "xarray.Dataset":
        """Samples, frames, mesh and, if walls have broken, breaks as one dataset with units."""
        build = need("xarray", "python3-xarray").Dataset
        samples, frames, mesh = self.samples(), self.frames, self.mesh
        variables: dict[str, Any] = {name: ("sample", samples[name]) for name in samples.dtype.names or ()}
        variables.update({
            "frame_time_s": ("frame", frames.time_s), "frame_strain": ("frame", frames.strain),
            "position_mm": (("frame", "particle", "axis"), frames.position_mm),
            "plastic_fraction": (("frame", "element"), frames.plastic_fraction),
            "fibre_strain": (("frame", "wall"), frames.fibre_strain),
            "local_strain": (("frame", "wall" if frames.local_strain.size else "cell_wall"), frames.local_strain),
            "undeformed_position_mm": (("particle", "axis"), mesh.position_mm),
            "element_nodes": (("element", "end"), mesh.element_nodes), "thickness_mm": ("element", mesh.thickness_mm),
            "element_wall": ("element", mesh.element_wall),
        })
        if len(breaks := self.breaks()):
            variables.update({f"break_{name}": ("break", breaks[name]) for name in breaks.dtype.names or ()})
            ends = np.full((len(frames), len(breaks), 2), np.nan, np.float32)  # until they break
            for i, known in enumerate(frames.end_position_mm):
                ends[i, :len(known)] = known
            variables["end_position_mm"] = (("frame", "break", "axis"), ends)
        dataset: "xarray.Dataset" = build(
            {name: (*value, {"units": unit_of(name)} if unit_of(name) else {}) for name, value in variables.items()},
            coords={"axis": ["x", "y"]}, attrs={"title": self.title})
        coordinates: "xarray.Dataset" = dataset.set_coords(["time_s", "strain", "frame_time_s", "frame_strain"])
        return coordinates

    def write_vtk(self, path: PathLike) -> None:
        """Writes a .pvd file with all frames for ParaView, and beside it a folder with a .vtu file for each."""
        from cellcrush.vtk import write_vtk

        write_vtk(self, path)

    def plot(self, ax: "matplotlib.axes.Axes | None" = None, **style: Any) -> "matplotlib.axes.Axes":
        """Draws the stresses at both plates, the plateau and densification. `style`: `width_mm=85`, `font_pt=8`."""
        from cellcrush.plots import plot_curves

        return plot_curves(self, ax, **style)

    def plot_frame(self, strain: float, ax: "matplotlib.axes.Axes | None" = None,
                   **style: Any) -> "matplotlib.axes.Axes":
        """Draws the frame nearest to a strain, coloured by the share of each section that has yielded."""
        from cellcrush.plots import plot_frame

        return plot_frame(self, strain, ax, **style)

    def animate(self, **style: Any) -> "matplotlib.animation.FuncAnimation":
        """The crush as a movie: `.save("crush.gif")`. Notebooks show it as a player, the HTML of `.to_jshtml()`."""
        from cellcrush.plots import animate

        return animate(self, **style)
