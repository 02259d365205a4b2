"""Result files (result.h5), read by h5py."""
from __future__ import annotations

import pathlib
import zlib
from types import SimpleNamespace
from typing import Any

import numpy as np

from cellcrush.arrays import Array, Frames, Mesh
from cellcrush.errors import FileError, need
from cellcrush.results import PathLike, Results
from cellcrush.case import parse_case

_SEAL_BYTES = 512


def _check_seal(path: pathlib.Path) -> None:
    """Compares a file with the checksum in its first block."""
    crc = size = 0
    try:
        with path.open("rb") as file:
            found = file.read(_SEAL_BYTES)
            while part := file.read(1 << 20):
                crc, size = zlib.crc32(part, crc), size + len(part)
    except OSError as error:
        raise FileError(f"{path}: cannot be read: {error.strerror}. Name a result.h5.") from None
    if found.startswith(b"\x89HDF"):
        raise FileError(f"{path}: an HDF5 file without the checksum of cellcrush: another program or an early version "
                        "wrote it. Run its case again, or read it with h5py.")
    if not found.startswith(b"CELLCRUSH RESULT"):
        raise FileError(f"{path}: not a result of cellcrush. Name a result.h5.")
    if found != f"CELLCRUSH RESULT 1 {crc} {size}\n".encode().ljust(_SEAL_BYTES, b"\0"):
        raise FileError(f"{path}: damaged or incomplete: its contents do not match its checksum. Download it again, or "
                        "run its case again.")


class ResultFile(Results):
    """A result file, read once. `attributes` has what the file says of the run; `summary` is the same by name."""

    def __init__(self, path: PathLike) -> None:
        h5py = need("h5py", "python3-h5py")
        _check_seal(pathlib.Path(path))
        with h5py.File(path, "r") as file:
            self.attributes: dict[str, Any] = dict(file.attrs)
            history = {name: column[()] for name, column in file["history"].items()}
            for group in ("nodes", "rigid_walls"):
                for id_, columns in file.get(group, {}).items():
                    history.update({f"{group}.{id_}.{name}": column[()] for name, column in columns.items()})
            self._samples: Array = np.empty(len(history["time_s"]), [(n, c.dtype) for n, c in history.items()])
            for name, column in history.items():
                self._samples[name] = column
            mesh, frames = file["mesh"], file["frames"]
            self._mesh = Mesh(mesh["position_mm"][()], mesh["beam_nodes"][()], mesh["thickness_mm"][()],
                              **{name: mesh.attrs[name] for name in mesh.attrs if name in Mesh.__annotations__})
            self._frames = Frames(frames["time_s"][()], frames["strain"][()], frames["position_mm"][()],
                                  frames["plastic_fraction"][()])
        self.case = parse_case(self.attributes["case"], str(path))
        self.title = self.case.title
        self.summary = SimpleNamespace(**{
            "densification_strain": None, "plateau_stress_impact_mpa": None, "plateau_stress_support_mpa": None,
            **self.attributes})

    def samples(self) -> Array:
        return self._samples

    @property
    def mesh(self) -> Mesh:
        return self._mesh

    @property
    def frames(self) -> Frames:
        return self._frames


def open(path: PathLike) -> ResultFile:  # noqa: A001
    """Reads a result file: history, frames, mesh, plots and datasets as from a job.

    Raises FileError if the file is missing, damaged or no result."""
    return ResultFile(path)
