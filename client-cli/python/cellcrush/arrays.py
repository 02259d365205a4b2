"""Samples, meshes and frames as numpy arrays."""
from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any, Iterable, Iterator, List, Sequence, Tuple

import numpy as np
from google.protobuf.descriptor import FieldDescriptor
from google.protobuf.message import Message

from cellcrush.v1.event_pb2 import FrameChunk, MeshChunk
from cellcrush.v1.sample_pb2 import Break
from cellcrush.v1.sample_pb2 import Mesh as MeshMessage
from cellcrush.v1.sample_pb2 import Sample
from cellcrush.words import unit_of, words_of

Array = np.ndarray[Any, Any]
# The type of a table of breaks, as /breaks of result.h5.
BREAK = np.dtype([(of.name, {FieldDescriptor.TYPE_DOUBLE: np.float64, FieldDescriptor.TYPE_BOOL: np.bool_}.get(
    of.type, np.int64)) for of in Break.DESCRIPTOR.fields])


def _numbers(message: Any, prefix: str = "") -> Iterator[Tuple[str, type, float]]:
    for field in message.DESCRIPTOR.fields:
        if field.type == FieldDescriptor.TYPE_DOUBLE:
            yield prefix + field.name, np.float64, getattr(message, field.name)
        elif field.type == FieldDescriptor.TYPE_INT64:
            yield prefix + field.name, np.int64, getattr(message, field.name)


def _columns(sample: Sample) -> Iterator[Tuple[str, type, float]]:
    yield from _numbers(sample)
    for name, kind, value in _numbers(sample.front, "front_"):
        yield name, kind, value if sample.HasField("front") else np.nan
    for node in sample.watched:
        yield from _numbers(node, f"nodes.{node.node}.")
    for wall in sample.rigid_walls:
        yield from _numbers(wall, f"rigid_walls.{wall.wall}.")
    for grip in sample.grips:
        yield from _numbers(grip, f"grips.{grip.grip}.")


def samples_array(samples: Sequence[Sample]) -> Array:
    """A structured array with a row for each sample, its fields named like the datasets of result.h5.

    >>> samples_array([Sample(strain=0.5), Sample(strain=0.6)])["strain"]
    array([0.5, 0.6])
    """
    columns = list(_columns(samples[0] if samples else Sample()))
    array = np.empty(len(samples), dtype=[(name, kind) for name, kind, _ in columns])
    for i, sample in enumerate(samples):
        array[i] = tuple(value for _, _, value in _columns(sample))
    return array


def breaks_array(samples: Iterable[Sample]) -> Array:
    """A structured array with a row for each break, its fields named like the datasets of result.h5.

    >>> breaks_array([Sample(), Sample(breaks=[Break(wall=7, at_end=True)])])[["wall", "at_end"]].tolist()
    [(7, True)]
    """
    return np.array([tuple(getattr(broken, name) for name in BREAK.names or ())
                     for sample in samples for broken in sample.breaks], BREAK)


@dataclass(frozen=True, repr=False)
class Mesh:
    """What is constant during a run. N particles, E elements; lengths in mm."""

    position_mm: Array  # (N, 2), before loading
    element_nodes: Array  # (E, 2), numbers of particles
    thickness_mm: Array  # (E)
    element_wall: Array  # (E), number of the wall of each element; all 0 in results of earlier versions
    length_mm: float  # of the undeformed lattice along the crush
    width_mm: float  # and across
    impact_plate_mm: float  # face of the plate along the crush, before loading
    support_plate_mm: float
    along_y: bool  # whether the crush is along y
    rigid_element_count: int = 0  # elements of stiff cells or rigid links; they come last
    # Particles of walls that overlapped others before loading.
    overlap_particle: Array = field(default_factory=lambda: np.zeros(0, np.int32))
    side_low_mm: float = 0.0  # faces of the side walls across the crush; equal without any
    side_high_mm: float = 0.0

    def __repr__(self) -> str:
        return (f"<mesh of {len(self.position_mm)} particles and {len(self.element_nodes)} elements, "
                f"{self.length_mm:.6g} x {self.width_mm:.6g} mm>")


@dataclass(frozen=True, repr=False)
class Frames:
    """The deformed mesh at F times."""

    time_s: Array  # (F)
    strain: Array  # (F)
    position_mm: Array  # (F, N, 2), float32
    plastic_fraction: Array  # (F, E), float32: fraction of each element's section that has yielded
    fibre_strain: Array  # (F, W), float32: largest strain of each wall; no walls in results of earlier versions
    local_strain: Array  # (F, W), float32: along the crush, of the cells beside each wall; no walls without cells
    broken_end: Array  # (B), in the order of the breaks: 2 * element, + 1 at its end
    end_position_mm: List[Array]  # F times (b, 2), float32: of the first b broken ends, all that there were by then

    def __len__(self) -> int:
        return len(self.time_s)

    def __repr__(self) -> str:
        return f"<{len(self)} frames, strain 0 to {self.strain.max(initial=0.0):.3g}>"

    def nearest(self, strain: float) -> int:
        """The index of the frame nearest to a nominal strain."""
        return int(np.abs(self.strain - strain).argmin())

    def lines(self, index: int, mesh: Mesh) -> Tuple[Array, Array]:
        """Positions of all particles of a frame, then of its broken ends, and the numbers of each element's two."""
        ends = self.end_position_mm[index]
        if not len(ends):
            return self.position_mm[index], mesh.element_nodes
        position, nodes = np.concatenate([self.position_mm[index], ends]), mesh.element_nodes.copy()
        nodes.flat[self.broken_end[:len(ends)]] = np.arange(len(position) - len(ends), len(position))
        return position, nodes


def mesh_from(chunks: Iterable[MeshChunk]) -> Mesh:
    whole = MeshMessage()
    for chunk in chunks:
        whole.MergeFrom(chunk.mesh)
    return Mesh(np.array(whole.position_mm, np.float32).reshape(-1, 2),
                np.array(whole.element_nodes, np.int32).reshape(-1, 2), np.array(whole.thickness_mm, np.float32),
                np.array(whole.element_wall or [0] * len(whole.thickness_mm), np.int32),
                whole.length_mm, whole.width_mm, whole.impact_plate_mm, whole.support_plate_mm, whole.along_y,
                whole.rigid_element_count, np.array(whole.overlap_particle, np.int32), whole.side_low_mm,
                whole.side_high_mm)


def frames_from(frames: Sequence[Sequence[FrameChunk]]) -> Frames:
    """Frames, each from all of its chunks."""
    def whole(field: str, kind: type = np.float32) -> List[Array]:
        return [np.concatenate([np.array(getattr(c.frame, field), kind) for c in chunks]) for chunks in frames]

    return Frames(np.array([chunks[0].frame.time_s for chunks in frames]),
                  np.array([chunks[0].frame.strain for chunks in frames]),
                  np.array([p.reshape(-1, 2) for p in whole("position_mm")]), np.array(whole("plastic_fraction")),
                  np.array(whole("fibre_strain")), np.array(whole("local_strain")),
                  max(whole("broken_end", np.int32), key=len, default=np.zeros(0, np.int32)),
                  [p.reshape(-1, 2) for p in whole("end_position_mm")])


_NUMBERS = (FieldDescriptor.TYPE_DOUBLE, FieldDescriptor.TYPE_INT64)
# By message or field, the number that is above 0 where it is known. A frame has no relative density.
_KNOWN_BY = {"Summary": "step_count", "CheckCaseResponse": "step_count", "Theory": "shock_mpa",
             "densification_strain": "densification_strain",  # of a theory
             **dict.fromkeys(("length_mm", "width_mm", "relative_density"), "relative_density")}


class Values:
    """The numbers of a summary by name; None where the run does not give one. A group without values is false.

    >>> from cellcrush.v1.sample_pb2 import Summary
    >>> values = Values(Summary(densification_strain=0.5))
    >>> values.densification_strain, values.absorbed_energy_mj, values.front.shock_mpa, bool(values.front)
    (0.5, None, None, False)
    """

    def __init__(self, message: Message, is_present: bool = True) -> None:
        self._message: Any = message
        self._is_present = is_present

    def __bool__(self) -> bool:
        return self._is_present

    def _has(self, field: FieldDescriptor) -> bool:
        if field.has_presence:
            return bool(self._message.HasField(field.name))
        known_by = _KNOWN_BY.get(field.name, _KNOWN_BY.get(self._message.DESCRIPTOR.name))
        is_known = known_by is None or field.type not in _NUMBERS or getattr(self._message, known_by) > 0
        return self._is_present and is_known

    def __getattr__(self, name: str) -> Any:
        field = self._message.DESCRIPTOR.fields_by_name.get(name)
        if name.startswith("_") or field is None:
            raise AttributeError(name)
        if field.label == FieldDescriptor.LABEL_REPEATED:
            return list(getattr(self._message, name))
        value, has = getattr(self._message, name), self._has(field)
        if field.message_type is not None:
            return Values(value, has)
        if not has:
            return None
        return field.enum_type.values_by_number[value].name if field.enum_type else value

    def __dir__(self) -> List[str]:
        return [field.name for field in self._message.DESCRIPTOR.fields]

    def as_dict(self, prefix: str = "") -> dict[str, Any]:
        """All values, those of groups under names such as "theory.shock_mpa"."""
        values: dict[str, Any] = {}
        for field in self._message.DESCRIPTOR.fields:
            if field.message_type is not None and (field.label == FieldDescriptor.LABEL_REPEATED or
                                                   field.message_type.name == "Case"):
                continue  # lists of messages and whole cases are no values
            value = getattr(self, field.name)
            group = isinstance(value, Values)
            values.update(value.as_dict(prefix + field.name + ".") if group else {prefix + field.name: value})
        return values

    def _rows(self) -> List[Tuple[str, str]]:
        shown = [(name, value) for name, value in self.as_dict().items()
                 if value not in (None, "", []) and not str(value).endswith("_UNSPECIFIED")]
        return [(name, f"{value:.6g} {unit_of(name)}".rstrip() if isinstance(value, float) else
                 " ".join(value) if isinstance(value, list) else str(value)) for name, value in shown]

    def __repr__(self) -> str:
        return "\n".join(f"{name}: {text}" for name, text in self._rows())

    def _repr_html_(self) -> str:
        from cellcrush.display import html_table

        return html_table([(" ".join(words_of(part) for part in name.split(".")), text) for name, text in self._rows()])
