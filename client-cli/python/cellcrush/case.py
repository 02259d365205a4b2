"""Cases from dicts, text, JSON, files and protos, with the field paths of every other surface."""
from __future__ import annotations

import difflib
import functools
import operator
import os
import pathlib
import re
from typing import Any, Callable, Iterable, Iterator, Mapping, Optional, Union

import numpy as np
from google.protobuf import json_format, text_format
from google.protobuf.descriptor import Descriptor, FieldDescriptor
from google.protobuf.message import Message

from cellcrush.errors import CaseError, Problem
from cellcrush.v1.case_pb2 import Case

CaseLike = Union[Case, Mapping[str, Any], str, "os.PathLike[str]"]

_PRESET = "preset:"
_FORMS = "Give a file, preset:NAME, text or a dict."
_WHOLE = {FieldDescriptor.TYPE_INT32: (-2**31, 2**31 - 1), FieldDescriptor.TYPE_SINT32: (-2**31, 2**31 - 1),
          FieldDescriptor.TYPE_INT64: (-2**63, 2**63 - 1), FieldDescriptor.TYPE_UINT32: (0, 2**32 - 1),
          FieldDescriptor.TYPE_UINT64: (0, 2**64 - 1)}
_SHOWN = 60  # characters of a value in an error
_MAX_SEEDS = 100000


def _refuse(field: str, value: object, message: str, remedy: str) -> CaseError:
    text = "" if value is None else str(value)
    return CaseError([Problem(field, text if len(text) <= _SHOWN else text[:_SHOWN] + "...", message, remedy)])


def _near(word: str, known: list[str]) -> str:
    near = [name for name in known if name.startswith(word + "_")] or difflib.get_close_matches(word, known, 1)
    return f"Did you mean {near[0]}?" if near else "Known are " + ", ".join(known) + "."


def refuse_unknown(path: str, name: str, group: Optional[Descriptor]) -> CaseError:
    """The error for a path with a name that its group does not have."""
    return _refuse(path, None, "is no field of a case.", _near(name, [f.name for f in group.fields]) if group else "")


def all_paths(descriptor: Descriptor = Case.DESCRIPTOR, prefix: str = "") -> Iterator[str]:
    """The paths of all fields outside of lists, groups included."""
    for field in descriptor.fields:
        yield prefix + field.name
        if field.message_type is not None and field.label != FieldDescriptor.LABEL_REPEATED:
            yield from all_paths(field.message_type, prefix + field.name + ".")


@functools.lru_cache(maxsize=None)
def _paths_by_last_part() -> dict[str, list[str]]:
    paths: dict[str, list[str]] = {}
    for path in all_paths():
        paths.setdefault(path.rsplit(".", 1)[-1], []).append(path)
    return paths


def _fits(case: Case, path: str) -> bool:
    """Whether no other member of a choice stands in the way, such as a square in that of a hexagon."""
    message: Message = case
    for part in path.split(".")[:-1]:
        field = message.DESCRIPTOR.fields_by_name[part]
        choice = field.containing_oneof
        if choice is not None and message.WhichOneof(choice.name) not in (None, part):
            return False
        message = getattr(message, part)
    return True


def _text_of(key: Any, prefix: str = "") -> str:
    if not isinstance(key, str):
        raise _refuse(f"{prefix}{key}", None, "is no field of a case.", "Name fields by texts.")
    return key


def find_path(word: str, case: Case) -> str:
    """The path of a field: itself, or the only path in this case that ends in this word.

    >>> find_path("speed_m_per_s", Case()), find_path("lattice__hexagon__rows", Case())
    ('loading.speed_m_per_s', 'lattice.hexagon.rows')
    """
    path = _text_of(word).replace("__", ".")
    if "." in path or "[" in path or path in Case.DESCRIPTOR.fields_by_name:
        return path
    known = _paths_by_last_part()
    found = [candidate for candidate in known.get(path, []) if _fits(case, candidate)]
    if len(found) == 1:
        return found[0]
    if found:
        raise _refuse(word, None, "is the name of several fields.", "Give one of " + ", ".join(found) + ".")
    if path in known:
        raise _refuse(word, None, "is no field of this lattice.", "The paths are " + ", ".join(known[path]) + ".")
    raise _refuse(word, None, "is no field of a case.", _near(path, sorted(known)))


def _kind(field: FieldDescriptor) -> str:
    """What a field, or each entry of a list, takes."""
    if field.message_type is not None:
        return "a dict with fields of it: " + ", ".join(member.name for member in field.message_type.fields)
    if field.enum_type is not None:
        return "one of " + ", ".join(entry.name for entry in field.enum_type.values if entry.number != 0)
    if field.type in _WHOLE:
        low, high = _WHOLE[field.type]
        return f"a whole number from {low} to {high}"
    return {FieldDescriptor.TYPE_BOOL: "True or False", FieldDescriptor.TYPE_STRING: "a text"}.get(
        field.type, "a number")


def _scalar(field: FieldDescriptor, value: Any, path: str) -> Any:
    try:
        if field.enum_type is not None:
            numbers = {entry.name: entry.number for entry in field.enum_type.values if entry.number != 0}
            return numbers[value.upper()] if isinstance(value, str) else field.enum_type.values_by_number[
                operator.index(value)].number
        if field.type == FieldDescriptor.TYPE_BOOL:
            return {False: False, True: True}[value]
        if isinstance(value, (bool, np.bool_)):
            raise ValueError
        if field.type == FieldDescriptor.TYPE_STRING:
            text = value if isinstance(value, str) else str(operator.index(value))
            text.encode()
            return text
        if field.type not in _WHOLE:
            return float(value)
        whole = int(value)
        low, high = _WHOLE[field.type]
        if float(whole) != float(value) or not low <= whole <= high:
            raise ValueError
        return whole
    except (LookupError, TypeError, ValueError, OverflowError):
        raise _refuse(path, str(value), "is not valid.", f"Give {_kind(field)}.") from None


def is_list(path: str) -> bool:
    """Whether a field takes a list.

    >>> is_list("lattice.frame.watched_nodes"), is_list("depth_mm")
    (True, False)
    """
    group, field = Case.DESCRIPTOR, None
    for part in path.split("."):
        field = group.fields_by_name.get(part) if group is not None else None
        group = field.message_type if field is not None else None
    return field is not None and field.label == FieldDescriptor.LABEL_REPEATED


def swept_values(path: str, values: Iterable[Any]) -> list[float]:
    """The values of an axis of a sweep.

    >>> swept_values("depth_mm", range(2, 4))
    [2.0, 3.0]
    """
    numbers = []
    for value in values:
        try:
            numbers.append(float(value))
        except (TypeError, ValueError, OverflowError):
            raise _refuse(path, str(value), "takes only numbers in a sweep.",
                          "Give numbers, or submit a sweep for each value.") from None
    return numbers


def seed_count(value: Any) -> int:
    """How many seeds a sweep has; 0 for none.

    >>> seed_count(3)
    3
    """
    try:
        count = operator.index(value)
    except TypeError:
        count = -1
    if not 0 <= count <= _MAX_SEEDS:
        raise _refuse("seeds", str(value), "is not valid.", f"Give a whole number from 1 to {_MAX_SEEDS}.")
    return count


def _fill(message: Message, values: Mapping[str, Any], prefix: str) -> None:
    for key, value in values.items():
        set_field(message, _text_of(key, prefix), value, prefix)


def set_field(message: Message, path: str, value: Any, prefix: str = "") -> None:
    """Sets the field at a path to a number, name, list, mapping or message.

    >>> case = Case()
    >>> set_field(case, "lattice.hexagon.rows", 7)
    >>> case.lattice.hexagon.rows
    7
    """
    head, _, rest = path.partition(".")
    match = re.fullmatch(r"(\w+)(?:\[(\d+)\])?", head)
    name, index = (match.group(1), match.group(2)) if match else (head, None)
    here = prefix + head
    field = message.DESCRIPTOR.fields_by_name.get(name)
    if field is None:
        raise refuse_unknown(here, name, message.DESCRIPTOR)
    choice = field.containing_oneof
    if choice is not None and message.WhichOneof(choice.name) not in (None, name):
        present = message.WhichOneof(choice.name)
        raise _refuse(here, None, f"cannot be set: the case has {prefix}{present}.",
                      f"Start from a case with {here}.")
    repeated = field.label == FieldDescriptor.LABEL_REPEATED
    current = getattr(message, name)
    if repeated and index is not None:
        if int(index) >= len(current):
            raise _refuse(here, None, f"is no entry: the list has {len(current)}.", "Indices count from 0.")
        if field.message_type is None:
            current[int(index)] = _scalar(field, value, here)
            return
        current, repeated = current[int(index)], False
    elif index is not None:
        raise _refuse(here, None, "is not a list.", f"Write {prefix}{name}.")
    if rest:
        if repeated or field.message_type is None:
            what = "a list" if repeated else "a single value"
            raise _refuse(here, None, f"is {what}.", f"Name an entry, such as {here}[0]." if repeated else "")
        set_field(current, rest, value, here + ".")
    elif repeated:
        entries = _entries(field, value, here)
        del current[:]
        for i, entry in enumerate(entries):
            if field.message_type is None:
                current.append(_scalar(field, entry, f"{here}[{i}]"))
            else:
                _assign(field, current.add(), entry, f"{here}[{i}]")
    elif field.message_type is not None:
        current.SetInParent()
        _assign(field, current, value, here)
    else:
        setattr(message, name, _scalar(field, value, here))


def _entries(field: FieldDescriptor, value: Any, path: str) -> list[Any]:
    """The entries of a list; a text or a dict is none, though Python iterates over it."""
    try:
        if not isinstance(value, (str, bytes, Mapping)):
            return list(value)
    except TypeError:
        pass
    raise _refuse(path, str(value), "is a list.", f"Give a list; each entry is {_kind(field)}.")


def _assign(field: FieldDescriptor, message: Message, value: Any, path: str) -> None:
    if isinstance(value, Mapping):
        _fill(message, value, path + ".")
    elif isinstance(value, type(message)):
        message.CopyFrom(value)
    else:
        raise _refuse(path, str(value), "is a group.", f"Give {_kind(field)}.")


def parse_case(text: str, source: str = "the text") -> Case:
    """A case from protobuf text or JSON.

    >>> parse_case("depth_mm: 4").depth_mm
    4.0
    """
    try:
        if text.lstrip().startswith("{"):
            case: Case = json_format.Parse(text, Case())
        else:
            case = text_format.Parse(text, Case())
    except (json_format.ParseError, text_format.ParseError) as error:
        raise _refuse("case", None, f"cannot be read from {source}: {error}.", "") from None
    return case


def join_fields(fields: Optional[Mapping[str, Any]], more: Mapping[str, Any]) -> dict[str, Any]:
    if not isinstance(fields, (Mapping, type(None))):
        raise _refuse("fields", fields, "is not a dict.", 'Give a dict, such as {"contact.friction": 0.2}.')
    return {**(fields or {}), **more}


def build_case(source: CaseLike, fields: Mapping[str, Any], preset: Callable[[str], Case]) -> Case:
    """The case that any of the accepted forms describes, with these fields set. `preset` finds one by name."""
    case = Case()
    if isinstance(source, Case):
        case.CopyFrom(source)
    elif isinstance(source, Mapping):
        for key, value in source.items():
            set_field(case, find_path(key, case), value)
    elif isinstance(source, str) and source.startswith(_PRESET):
        case.CopyFrom(preset(source[len(_PRESET):]))
    elif isinstance(source, str) and re.search(r"[{\n]|:\s", source):
        case = parse_case(source)
    elif not isinstance(source, (str, os.PathLike)):
        raise _refuse("case", repr(source), "cannot be read.", _FORMS)
    else:
        try:
            text = pathlib.Path(source).read_text()
        except (OSError, ValueError) as error:
            reason = error.strerror if isinstance(error, OSError) else "not a text file"
            raise _refuse("case", None, f"cannot be read: {source}: {reason}.", _FORMS) from None
        case = parse_case(text, str(source))
    for word, value in fields.items():
        set_field(case, find_path(word, case), value)
    return case
