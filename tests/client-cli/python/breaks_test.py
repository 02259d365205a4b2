"""Walls that break: the same from a job and from a result file, without a daemon."""
import pathlib
import tempfile
import unittest
import zlib
from types import SimpleNamespace

import cellcrush as cc
import h5py
import meshio
import numpy as np
import support  # noqa: F401  # where figures are drawn
from cellcrush.arrays import BREAK
from cellcrush.v1.job_pb2 import Job as JobMessage
from cellcrush.v1.jobs_service_pb2 import GetHistoryResponse, StreamFramesResponse
from cellcrush.v1.sample_pb2 import Break, FieldFrame, Sample
from cellcrush.v1.sample_pb2 import Mesh as MeshMessage

# Three elements in a row. The third breaks off at its start, then the first at its end.
PLACES = np.array([[0, 0], [1, 0], [2, 0], [3, 1]], np.float32)
NODES = [[0, 1], [1, 2], [2, 3]]
BREAKS = [Break(step=5, time_s=0.5, wall=2, x_mm=2, y_mm=-1, energy_mj=3, element=2, particle=2),
          Break(step=9, time_s=0.9, wall=0, x_mm=1, y_mm=-2, energy_mj=4, element=0, at_end=True, particle=1)]
SAMPLES = [Sample(time_s=0), Sample(time_s=0.6, strain=0.1, break_count=1, energy_fracture_mj=3, breaks=BREAKS[:1]),
           Sample(time_s=1, strain=0.2, break_count=2, energy_fracture_mj=7, breaks=BREAKS[1:])]
ENDS = [np.array(ends, np.float32).reshape(-1, 2) for ends in ([], [[2, 0.5]], [[2, 1], [1, 5]])]
LINES = [NODES, [[0, 1], [1, 2], [4, 3]], [[0, 5], [1, 2], [4, 3]]]


def frame(i):
    return FieldFrame(index=i, time_s=SAMPLES[i].time_s, strain=SAMPLES[i].strain, plastic_fraction=[0] * 3,
                      position_mm=(PLACES - [0, i]).ravel(), broken_end=[4, 1][:i], end_position_mm=ENDS[i].ravel())


def parts(whole):
    """A frame in two, as a large one comes."""
    both = FieldFrame(), FieldFrame()
    for part in both:
        part.CopyFrom(whole)
    for name in ("broken_end", "end_position_mm", "position_mm", "plastic_fraction"):
        half = len(getattr(whole, name)) // 2
        del getattr(both[0], name)[half:], getattr(both[1], name)[:half]
    return [{"frame": part, "part": i, "part_count": 2} for i, part in enumerate(both)]


def job():
    """A job whose daemon answers with these samples and frames."""
    mesh = MeshMessage(position_mm=PLACES.ravel(), element_nodes=np.ravel(NODES), thickness_mm=[1] * 3, length_mm=3)
    stream = [StreamFramesResponse(mesh={"mesh": mesh}),
              *(StreamFramesResponse(frame=part) for i in range(len(SAMPLES)) for part in parts(frame(i)))]
    pages = [GetHistoryResponse(samples=SAMPLES[:2]), GetHistoryResponse(samples=SAMPLES[2:])]
    daemon = SimpleNamespace(jobs=SimpleNamespace(GetHistory=None, StreamFrames=None), pages=lambda *_: pages,
                             follow=lambda *_: stream)
    return cc.Job(daemon, JobMessage(name="jobs/1", state=JobMessage.SUCCEEDED))


def write_result(path, samples, has_broken=True):
    with h5py.File(path, "w") as file:
        file.attrs.update(case="depth_mm: 1", complete=1)
        for name in ("time_s", "strain", "energy_fracture_mj", "break_count"):
            file[f"history/{name}"] = np.array([getattr(sample, name) for sample in samples])
        file["mesh/position_mm"], file["mesh/beam_nodes"] = PLACES, np.array(NODES, np.int32)
        file["mesh/thickness_mm"] = np.ones(3, np.float32)
        file["mesh"].attrs.update(length_mm=3.0, width_mm=0.0, impact_plate_mm=0.0, support_plate_mm=0.0, along_y=0)
        frames = [frame(i) for i in range(len(samples))]
        for name, shape in (("time_s", ()), ("strain", ()), ("position_mm", (4, 2)), ("plastic_fraction", (3,))):
            file[f"frames/{name}"] = np.array([getattr(each, name) for each in frames]).reshape(-1, *shape)
        if has_broken:
            for name in BREAK.names:
                file[f"breaks/{name}"] = np.array([getattr(broken, name) for broken in BREAKS]) * 1
            file["frames/break_count"] = np.array([len(ends) for ends in ENDS], np.int64)
            file["frames/end_position_mm"] = np.concatenate(ENDS)
    content = path.read_bytes()
    path.write_bytes(f"CELLCRUSH RESULT 1 {zlib.crc32(content)} {len(content)}\n".encode().ljust(512, b"\0") + content)


class Breaks(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))
        write_result(self.folder / "result.h5", SAMPLES)
        self.both = job(), cc.open(self.folder / "result.h5")

    def test_a_table_has_a_row_for_each_break(self):
        for results in self.both:
            breaks = results.breaks()
            self.assertEqual(breaks.dtype, BREAK)
            self.assertEqual(breaks.tolist(), [tuple(getattr(b, name) for name in BREAK.names) for b in BREAKS])
            self.assertEqual(list(results.samples()["break_count"]), [0, 1, 2])
            self.assertEqual(list(results.history()["energy_fracture_mj"]), [0, 3, 7])

    def test_broken_ends_are_particles_of_their_own(self):
        for results in self.both:
            frames, mesh = results.frames, results.mesh
            self.assertEqual(list(frames.broken_end), [4, 1])
            for i in (*range(len(frames)), -1):
                position, nodes = frames.lines(i, mesh)
                np.testing.assert_array_equal(position[:4], frames.position_mm[i])
                np.testing.assert_array_equal(position[4:], ENDS[i])
                np.testing.assert_array_equal(nodes, LINES[i])
            self.assertEqual(mesh.element_nodes.tolist(), NODES)
            self.assertIs(frames.lines(0, mesh)[1], mesh.element_nodes)

    def test_pictures_have_room_for_broken_ends(self):
        for results in self.both:
            ax = results.plot_frame(0.2)
            self.assertEqual((ax.get_xlim(), ax.get_ylim()), ((0, 3), (-2, 5)))
            drawn = [path.vertices.tolist() for path in ax.collections[0].get_paths()]
            self.assertEqual(drawn, [[[0, -2], [1, 5]], [[1, -2], [2, -2]], [[2, 1], [3, -1]]])
            self.assertIn("<script", results.animate()._repr_html_())

    def test_vtk_files_have_broken_ends(self):
        for results in self.both:
            results.write_vtk(self.folder / "crush.pvd")
            for i, moved in enumerate(([], [[0, 0.5, 0]], [[0, 1, 0], [0, 5, 0]])):
                grid = meshio.read(self.folder / "crush" / f"{i:04}.vtu")
                np.testing.assert_array_equal(grid.cells_dict["line"], LINES[i])
                np.testing.assert_array_equal(grid.points[4:, :2], ENDS[i])
                np.testing.assert_array_equal(grid.point_data["displacement_mm"], [[0, -i, 0]] * 4 + moved)

    def test_a_dataset_has_breaks(self):
        for results in self.both:
            dataset = results.xarray()
            self.assertEqual(dict(dataset.break_time_s.sizes), {"break": 2})
            self.assertEqual((list(dataset.break_at_end), dataset.break_x_mm.attrs["units"]), ([False, True], "mm"))
            self.assertEqual(dataset.end_position_mm.dims, ("frame", "break", "axis"))
            ends = [np.pad(end, ((0, 2 - len(end)), (0, 0)), constant_values=np.nan) for end in ENDS]
            np.testing.assert_array_equal(dataset.end_position_mm, ends)

    def test_without_breaks_all_is_as_before(self):
        write_result(self.folder / "whole.h5", SAMPLES[:1], has_broken=False)
        results = cc.open(self.folder / "whole.h5")
        self.assertEqual((len(results.breaks()), results.breaks().dtype), (0, BREAK))
        self.assertIs(results.frames.lines(0, results.mesh)[1], results.mesh.element_nodes)
        self.assertNotIn("break", results.xarray().sizes)
        results.plot_frame(0.0)


if __name__ == "__main__":
    unittest.main()
