"""Frames for ParaView and meshio: a .pvd file that lists times, and an unstructured grid (.vtu) of lines for each."""
from __future__ import annotations

import base64
import pathlib
import re
from typing import TYPE_CHECKING, List, Set, Tuple

import numpy as np

from cellcrush.arrays import Array

if TYPE_CHECKING:
    from cellcrush.results import PathLike, Results

_TYPES = {"f4": "Float32", "f8": "Float64", "i4": "Int32", "u1": "UInt8"}
_LINE = 3  # VTK_LINE


def _array(name: str, values: Array) -> str:
    values = np.ascontiguousarray(values)
    data = values.astype(values.dtype.newbyteorder("<")).tobytes()
    text = base64.b64encode(np.uint32(len(data)).tobytes() + data).decode()
    components = f' NumberOfComponents="{values.shape[1]}"' if values.ndim == 2 else ""
    kind = _TYPES[values.dtype.str[1:]]
    return f'<DataArray type="{kind}" Name="{name}"{components} format="binary">{text}</DataArray>'


def _in_space(values: Array) -> Array:
    return np.column_stack([values, np.zeros(len(values), values.dtype)])


def _section(tag: str, arrays: List[Tuple[str, Array]]) -> str:
    return f"<{tag}>" + "".join(_array(name, values) for name, values in arrays) + f"</{tag}>"


def _cells(nodes: Array) -> str:
    return _section("Cells", [("connectivity", nodes.ravel()),
                              ("offsets", np.arange(2, nodes.size + 1, 2, dtype=np.int32)),
                              ("types", np.full(len(nodes), _LINE, np.uint8))])


def _frames_of(file: pathlib.Path) -> Set[str]:
    """The files of frames that a .pvd names in the folder of its own name."""
    if not file.exists():
        return set()
    text = file.read_text(errors="replace")
    return set(re.findall(rf'file="({re.escape(file.stem)}/\d{{4,}}\.vtu)"', text))


def write_vtk(results: "Results", path: "PathLike") -> None:
    file = pathlib.Path(path)
    if file.suffix != ".pvd":
        raise ValueError(f"{file}: the name of the file ends in .pvd")
    mesh, frames = results.mesh, results.frames
    folder, old = file.with_suffix(""), _frames_of(file)
    folder.mkdir(exist_ok=True)
    count = len(mesh.element_nodes)
    entries = []
    for i in range(len(frames)):
        position, nodes = frames.lines(i, mesh)
        broken_from = mesh.element_nodes.flat[frames.broken_end[:len(frames.end_position_mm[i])]]
        before = np.concatenate([mesh.position_mm, mesh.position_mm[broken_from]])
        piece = (_section("Points", [("position_mm", _in_space(position))]) + _cells(nodes) +
                 _section("PointData", [("displacement_mm", _in_space(position - before))]) +
                 _section("CellData", [("thickness_mm", mesh.thickness_mm),
                                       ("plastic_fraction", frames.plastic_fraction[i])]))
        field = _section("FieldData", [("strain", frames.strain[i:i + 1])]).replace(
            ' Name="strain"', ' Name="strain" NumberOfTuples="1"')
        (folder / f"{i:04}.vtu").write_text(
            '<?xml version="1.0"?>\n<VTKFile type="UnstructuredGrid" version="0.1" byte_order="LittleEndian">'
            f'<UnstructuredGrid>{field}<Piece NumberOfPoints="{len(position)}" NumberOfCells="{count}">{piece}</Piece>'
            "</UnstructuredGrid></VTKFile>\n")
        entries.append(f'<DataSet timestep="{frames.time_s[i]:.9g}" file="{folder.name}/{i:04}.vtu"/>\n')
    file.write_text('<?xml version="1.0"?>\n<VTKFile type="Collection" version="0.1" byte_order="LittleEndian">'
                    "<Collection>\n" + "".join(entries) + "</Collection></VTKFile>\n")
    for surplus in old - _frames_of(file):  # of an earlier, longer crush
        (file.parent / surplus).unlink(missing_ok=True)
