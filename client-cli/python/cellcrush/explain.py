"""What the fields of a case mean, from the comments and rules of the protos."""
from __future__ import annotations

import functools
import pathlib
import textwrap
from typing import Dict, List, Tuple

from google.protobuf import descriptor_pb2

from cellcrush.case import find_path, refuse_unknown
from cellcrush.v1 import field_pb2
from cellcrush.v1.case_pb2 import Case
from cellcrush.words import unit_of

_Place = Tuple[int, ...]


@functools.lru_cache(maxsize=1)
def _comments() -> Dict[str, str]:
    """The comments of all fields, by their full names."""
    files = descriptor_pb2.FileDescriptorSet.FromString((pathlib.Path(__file__).parent / "v1/case.desc").read_bytes())
    file = next(file for file in files.file if file.name == "cellcrush/v1/case.proto")
    comments: Dict[str, str] = {}
    by_place: Dict[_Place, str] = {tuple(location.path): location.leading_comments
                                   for location in file.source_code_info.location}

    def collect(messages: List[descriptor_pb2.DescriptorProto], prefix: str, place: _Place) -> None:
        for i, message in enumerate(messages):
            here = (*place, i)
            for j, field in enumerate(message.field):
                comments[f"{prefix}.{message.name}.{field.name}"] = by_place.get((*here, 2, j), "")
            collect(list(message.nested_type), f"{prefix}.{message.name}", (*here, 3))

    collect(list(file.message_type), file.package, (4,))
    return comments


def explain(field: str) -> str:
    """What a field of a case means, its unit, default and limits.

    >>> print(explain("lattice.hexagon.wall_thickness_mm"))
    lattice.hexagon.wall_thickness_mm
    Thickness h of the slanted walls.
    in mm; required; at least 1e-06; at most half of side_mm
    """
    path = find_path(field, Case())
    descriptor, found = Case.DESCRIPTOR, None
    for part in path.split("."):
        name = part.split("[")[0]
        if descriptor is None or name not in descriptor.fields_by_name:
            raise refuse_unknown(path, name, descriptor)
        found = descriptor.fields_by_name[name]
        descriptor = found.message_type
    assert found is not None
    rules = found.GetOptions().Extensions[field_pb2.rules]
    unit = unit_of(path) or rules.counts
    facts = [f"in {unit}" if unit else "", "required" if rules.required else "",
             f"default {rules.default}" if rules.default else "",
             f"at least {rules.minimum:g}" if rules.HasField("minimum") else "",
             f"{'below' if rules.below else 'at most'} {rules.maximum:g}" if rules.HasField("maximum") else "",
             f"at most {rules.up_to}" if rules.up_to else "", rules.limits]
    if found.enum_type:
        facts.append("one of " + ", ".join(value.name for value in found.enum_type.values if value.number))
    if descriptor is not None:
        facts.append("fields: " + ", ".join(member.name for member in descriptor.fields))
    comment = textwrap.fill(" ".join(_comments()[found.full_name].split()), 100)
    return "\n".join(line for line in (path, comment, "; ".join(fact for fact in facts if fact)) if line)
