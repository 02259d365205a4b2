"""Result files (result.h5), read by h5py."""
from __future__ import annotations

import pathlib
import zlib
from typing import Any, Mapping

import numpy as np
from google.protobuf import json_format
from google.protobuf.descriptor import FieldDescriptor

from cellcrush.arrays import BREAK, Array, Frames, Mesh, Values
from cellcrush.case import parse_case
from cellcrush.display import html_table
from cellcrush.errors import FileError, need
from cellcrush.results import PathLike, Results
from cellcrush.v1.job_pb2 import Job
from cellcrush.v1.sample_pb2 import Summary

_HDF5 = b"\x89HDF"
_SEALED_LEAF = 5  # in the superblock of a file that ends with a seal


def _check_seal(path: pathlib.Path) -> None:
    """Compares a file with the checksum at its end, or in its first block as files of versions before have it."""
    try:
        with path.open("rb") as file:
            start, size = file.read(512), file.seek(0, 2)
            at_end = start.startswith(_HDF5)
            begin, end = (0, max(size - 64, 0)) if at_end else (512, size)
            file.seek(end if at_end else 0)
            found = file.read(64 if at_end else 512)
            file.seek(begin)
            crc, left = 0, end - begin
            while left > 0 and (part := file.read(min(left, 1 << 20))):
                crc, left = zlib.crc32(part, crc), left - len(part)
    except OSError as error:
        raise FileError(f"{path}: cannot be read: {error.strerror}. Name a result.h5.") from None
    if at_end and start[16:17] != bytes([_SEALED_LEAF]) and not found.startswith(b"CELLCRUSH RESULT"):
        raise FileError(f"{path}: an HDF5 file without the checksum of cellcrush: another program or an early version "
                        "wrote it. Run its case again, or read it with h5py.")
    if not at_end and not found.startswith(b"CELLCRUSH RESULT"):
        raise FileError(f"{path}: not a result of cellcrush. Name a result.h5.")
    seal = f"CELLCRUSH RESULT {2 if at_end else 1} {crc} {end - begin}\n".encode()
    if found != seal.ljust(64 if at_end else 512, b"\0"):
        raise FileError(f"{path}: damaged or incomplete: its contents do not match its checksum. Download it again, or "
                        "run its case again.")


def _read_numbers(attributes: Mapping[str, Any], message: Any, prefix: str = "") -> None:
    """The numbers that are attributes of their own, those of a group under names such as "theory_shock_mpa"."""
    for field in message.DESCRIPTOR.fields:
        name = prefix + field.name
        if field.label == FieldDescriptor.LABEL_REPEATED:
            continue
        if field.message_type is not None:
            _read_numbers(attributes, getattr(message, field.name), name.removesuffix("_times") + "_")
        elif name in attributes and field.cpp_type != FieldDescriptor.CPPTYPE_ENUM:
            setattr(message, field.name, attributes[name])


def _summary(attributes: Mapping[str, Any]) -> Summary:
    """The summary as a job has it. Files of early versions have only the attributes of its parts."""
    summary: Summary = json_format.Parse(attributes.get("job", "{}"), Job(), ignore_unknown_fields=True).summary
    if "job" in attributes:
        return summary
    _read_numbers(attributes, summary)
    if "theory_shock_error_relative" in attributes:
        summary.shock_error_relative = attributes["theory_shock_error_relative"]
    if "crush_mode" in attributes:
        summary.crush_mode = Summary.CrushMode.Value("CRUSH_MODE_" + attributes["crush_mode"])
    for line in attributes.get("warnings", "").splitlines():
        kind, _, message = line.partition(": ")
        json_format.ParseDict({"kind": kind, "message": message}, summary.warnings.add(), ignore_unknown_fields=True)
    return summary


class ResultFile(Results):
    """A result file, read once. `summary` is that of a job; `attributes` has all that the file says of the run."""

    def __init__(self, path: PathLike) -> None:
        h5py = need("h5py", "python3-h5py")
        _check_seal(pathlib.Path(path))
        with h5py.File(path, "r") as file:
            self.attributes: dict[str, Any] = dict(file.attrs)
            history = {name: column[()] for name, column in file["history"].items()}
            for group in ("nodes", "rigid_walls", "grips"):
                for id_, columns in file.get(group, {}).items():
                    history.update({f"{group}.{id_}.{name}": column[()] for name, column in columns.items()})
            self._samples: Array = np.empty(len(history["time_s"]), [(n, c.dtype) for n, c in history.items()])
            for name, column in history.items():
                self._samples[name] = column
            breaks = file.get("breaks", {})
            self._breaks: Array = np.zeros(len(breaks.get("step", ())), BREAK)
            for name in set(breaks).intersection(BREAK.names or ()):
                self._breaks[name] = breaks[name][()]
            mesh, frames = file["mesh"], file["frames"]
            walls = mesh["element_wall"][()] if "element_wall" in mesh else np.zeros(len(mesh["beam_nodes"]), np.int32)
            no_walls = np.zeros((len(frames["time_s"]), 0), np.float32)
            fibre_strain, local_strain = (frames[name][()] if name in frames else no_walls
                                          for name in ("fibre_strain", "local_strain"))
            self._mesh = Mesh(mesh["position_mm"][()], mesh["beam_nodes"][()], mesh["thickness_mm"][()], walls,
                              **{name: mesh.attrs[name] for name in mesh.attrs if name in Mesh.__annotations__},
                              **{name: mesh[name][()] for name in ("overlap_particle",) if name in mesh})
            counts = frames["break_count"][()] if "break_count" in frames else np.zeros(len(no_walls), np.int64)
            ends = frames["end_position_mm"][()] if "end_position_mm" in frames else np.zeros((0, 2), np.float32)
            broken = self._breaks[:counts.max(initial=0)]
            self._frames = Frames(frames["time_s"][()], frames["strain"][()], frames["position_mm"][()],
                                  frames["plastic_fraction"][()], fibre_strain, local_strain,
                                  (2 * broken["element"] + broken["at_end"]).astype(np.int32),
                                  np.split(ends, np.cumsum(counts))[:-1])
        self.case = parse_case(self.attributes["case"], str(path))
        self.title = self.case.title
        self.summary = Values(_summary(self.attributes))

    def __repr__(self) -> str:
        return f"<{'result' if self.attributes['complete'] else 'partial result'} {self.title!r}>"

    def _repr_html_(self) -> str:
        ended = [] if self.attributes["complete"] else [("partial", str(self.attributes.get("failure", "cancelled")))]
        return html_table(ended + self._result_rows(), self.title)

    def samples(self) -> Array:
        return self._samples

    def breaks(self) -> Array:
        return self._breaks

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
