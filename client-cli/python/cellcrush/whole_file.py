"""Files that appear whole or not at all."""
from __future__ import annotations

import os
import pathlib
import uuid
from contextlib import contextmanager
from typing import BinaryIO, Iterator

from cellcrush.errors import FileError


def require_place(path: pathlib.Path) -> None:
    """Refuses a path at which no file can be written."""
    folder = path.resolve().parent
    if path.is_dir():
        raise FileError(f"{path}: is a folder. Name a file in it, such as {path / 'result.h5'}.")
    if not folder.is_dir():
        raise FileError(f"{path}: the folder {folder} does not exist. Create it, or name another.")
    if not os.access(folder, os.W_OK | os.X_OK):
        raise FileError(f"{path}: the folder {folder} cannot be written to. Name another.")


@contextmanager
def whole_file(path: pathlib.Path) -> Iterator[BinaryIO]:
    """A file that takes its name, in place of what had it, once the block has ended without an error."""
    require_place(path)
    target = path.resolve()
    part = target.with_name(f".{uuid.uuid4().hex}.part")
    try:
        with part.open("xb") as file:
            yield file
        os.replace(part, target)
    finally:
        part.unlink(missing_ok=True)
