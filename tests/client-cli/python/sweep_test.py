"""Sweeps, their tables and means, and what is written for other programs and for print."""
import asyncio
import contextlib
import os
import pathlib
import subprocess
import tempfile
import unittest
import urllib.request
import warnings
import zlib
from dataclasses import replace
from types import SimpleNamespace

import cellcrush as cc
import cellcrush.aio
import h5py
import meshio
import numpy as np
import pandas
from cellcrush.means import mean_table
from cellcrush.plots import GREY, plot_frame
from matplotlib.colors import to_hex
from support import PRESET, SLOW, SMALL, WithServer


class Sweeps(WithServer):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.sweep = cls.server.sweep(PRESET, {**SMALL, "speed_m_per_s": np.array([50, 100, 200])}, seeds=3,
                                     amplitude_mm=0.02).wait()
        cls.job = cls.sweep.jobs[0]

    def test_the_table_has_a_row_for_each_job(self):
        table = self.sweep.table()
        self.assertEqual(list(table["speed_m_per_s"]), [50] * 3 + [100] * 3 + [200] * 3)
        self.assertEqual(list(table["seed"]), [1, 2, 3] * 3)
        self.assertEqual(list(table["job"]), [job.name for job in self.sweep])
        self.assertEqual(list(table["warnings"]), [len(job.summary.warnings) for job in self.sweep])
        self.assertEqual(len(self.sweep), 9)
        self.assertEqual(table.attrs["units"]["absorbed_energy_mj"], "mJ")

    def test_it_has_a_note_of_its_own(self):
        asyncio.run(cellcrush.aio.Sweep(self.sweep).set_note("series 2"))
        self.assertEqual((self.sweep.refresh().note, self.sweep.jobs[0].note), ("series 2", ""))

    def test_means_have_confidence_intervals(self):
        plateau = self.sweep.table()["plateau_stress_impact_mpa"].to_numpy().reshape(3, 3)
        table = self.sweep.table(mean_over="seed")
        np.testing.assert_allclose(table["plateau_stress_impact_mpa"], plateau.mean(axis=1))
        # Student's t for two degrees of freedom is 4.303.
        np.testing.assert_allclose(table["plateau_stress_impact_mpa_ci95"],
                                   4.303 * plateau.std(axis=1, ddof=1) / np.sqrt(3), rtol=1e-3)
        self.assertEqual(list(table["count"]), [3, 3, 3])
        self.assertEqual(len(self.sweep.table(mean_over=["seed", "speed_m_per_s"])), 1)
        for name in ("lattice.imperfection.seed", ["lattice__imperfection__seed"]):
            pandas.testing.assert_frame_equal(self.sweep.table(mean_over=name), table)
        self.assertEqual(list(self.sweep.table(mean_over="loading.speed_m_per_s")["seed"]), [1, 2, 3])
        for name in ("rows", "lattice.hexagon.rows"):
            with self.assertRaisesRegex(ValueError, f"mean_over '{name}' .* varies speed_m_per_s, seed"):
                self.sweep.table(mean_over=name)

    def test_points_without_results_stay(self):
        sweep = self.server.sweep(PRESET, {**SLOW, "speed_m_per_s": [1, 0.5]}, seeds=2, amplitude_mm=0.02,
                                  max_parallel=1).cancel().wait()
        table = sweep.table(mean_over="seed")
        self.assertEqual((list(table["speed_m_per_s"]), list(table["count"])), ([1, 0.5], [0, 0]))
        self.assertTrue(table["plateau_stress_impact_mpa"].isna().all())
        self.assertTrue(sweep.table()["absorbed_energy_mj"][:2].isna().all())  # the longest jobs start first
        marks = [line for line in sweep.plot().get_lines() if line.get_label() == "no job succeeded"]
        self.assertEqual(list(marks[0].get_xdata()), [1, 0.5])

    def test_means_tell_how_many_jobs_they_have(self):
        nan = float("nan")
        table = pandas.DataFrame({
            "speed": [1, 1, 1, 2, 2, 3], "seed": [1, 2, 3, 1, 2, 1], "warnings": [0, 2, 1, 0, 0, 5],
            "state": ["SUCCEEDED", "SUCCEEDED", "FAILED", "SUCCEEDED", "SUCCEEDED", "FAILED"],
            "plateau": [1.0, 3.0, 9.0, 5.0, 5.0, 9.0], "densification": [0.5, nan, 0.9, nan, nan, nan],
            "front": [nan] * 6})
        table.attrs["units"] = {}
        means = mean_table(table, ["speed", "seed"], ["plateau", "densification", "front"], ["seed"])
        self.assertEqual([list(means[name]) for name in ("speed", "count", "warned", "densification_count")],
                         [[1, 2, 3], [2, 2, 0], [1, 0, 0], [1, 0, 0]])
        np.testing.assert_array_equal(means["plateau"], [2.0, 5.0, nan])
        self.assertFalse({"plateau_count", "front_count"} & set(means))
        self.assertEqual(list(mean_table(table, ["speed", "seed"], ["plateau"], ["speed", "seed"])["count"]), [4])

    def test_seeds_without_an_imperfection_warn(self):
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            sweep = self.server.sweep(PRESET, SLOW, seeds=2).cancel()
        self.assertRegex(str(caught[0].message), "amplitude_mm=0.01")
        sweep.retry().wait()  # no job failed, so none runs again
        self.assertEqual(sweep.states, {"CANCELLED": 2})
        self.assertIn(sweep.name, [other.name for other in self.server.sweeps()])
        sweep.delete()
        with self.assertRaises(cc.NotFound):
            self.server.get(sweep.name)
        sweep = self.server.sweep(PRESET, SLOW, speed_m_per_s=[0.5, 0.6], time_limit_s=0.1, max_parallel=1,
                                  max_failures=1).wait()
        self.assertEqual(sweep.states, {"FAILED": 1, "CANCELLED": 1})
        old = [job.name for job in sweep]
        self.assertFalse({job.name for job in sweep.retry()} & set(old))  # both again
        self.assertEqual(self.server.get(old[0]).state, "FAILED")
        sweep.cancel()

    def test_meshio_reads_every_frame(self):
        self.job.write_vtk(self.folder / "crush.pvd")
        self.assertIn('file="crush/0000.vtu"', (self.folder / "crush.pvd").read_text())
        frames = self.job.frames
        for index in (0, len(frames) - 1):
            grid = meshio.read(self.folder / "crush" / f"{index:04}.vtu")
            np.testing.assert_array_equal(grid.points[:, :2], frames.position_mm[index])
            np.testing.assert_array_equal(grid.cells_dict["line"], self.job.mesh.element_nodes)
            np.testing.assert_array_equal(grid.cell_data["plastic_fraction"][0], frames.plastic_fraction[index])
            np.testing.assert_array_equal(grid.cell_data["thickness_mm"][0], self.job.mesh.thickness_mm)
        self.assertGreater(np.abs(grid.point_data["displacement_mm"]).max(), 1.0)

    def test_surplus_frames_of_a_longer_crush_are_deleted(self):
        path, folder = self.folder / "crush.pvd", self.folder / "crush"
        self.job.write_vtk(path)
        count = len(self.job.frames)
        path.write_text(path.read_text().replace("</Collection>", "".join(
            f'<DataSet file="{name}"/>' for name in (f"crush/{count:04}.vtu", "crush/own.vtu", "../0000.vtu"))))
        others = (folder / "own.vtu", folder / "9999.vtu", self.folder / "0000.vtu")
        for name in (folder / f"{count:04}.vtu", *others):
            name.touch()
        self.job.write_vtk(path)
        self.assertEqual(len(list(folder.iterdir())), count + 2)
        self.assertTrue(all(name.exists() for name in others))

    def test_a_result_file_has_what_the_job_has(self):
        file = cc.open(self.job.download(self.folder / "result.h5"))
        for name in file.samples().dtype.names:
            np.testing.assert_array_equal(file.samples()[name], self.job.samples()[name], name)
        np.testing.assert_array_equal(file.frames.position_mm, self.job.frames.position_mm)
        self.assertEqual(file.mesh.length_mm, self.job.mesh.length_mm)
        self.assertEqual(file.summary.as_dict(), self.job.summary.as_dict())
        self.assertEqual(file.summary.theory.shock_mpa, self.job.summary.theory.shock_mpa)
        self.assertEqual(file.case, self.job.case)
        self.assertEqual(repr(file), f"<result {self.job.title!r}>")
        self.assertIn("plateau at the impact plate", file._repr_html_())

    def test_a_result_file_of_an_early_version_has_the_same_numbers(self):
        path = self.job.download(self.folder / "result.h5")
        with h5py.File(path, "r+") as file:
            del file.attrs["job"]
        content = path.read_bytes()  # HDF5 has removed the checksum at the end
        path.write_bytes(f"CELLCRUSH RESULT 1 {zlib.crc32(content)} {len(content)}\n".encode().ljust(512, b"\0") +
                         content)
        of_file, of_job = cc.open(path).summary, self.job.summary
        without = {"crush_mode_words": "", "end": "END_UNSPECIFIED", "end_words": ""}  # they have no attribute
        self.assertEqual(of_file.as_dict(), {**of_job.as_dict(), **without})
        warnings = [[(w.kind, w.message) for w in summary.warnings] for summary in (of_file, of_job)]
        self.assertEqual(*warnings)

    def test_only_a_whole_result_file_is_read(self):
        whole = self.job.download(self.folder / "result.h5").read_bytes()
        flipped = bytearray(whole)
        flipped[len(whole) // 2] ^= 1
        other = self.folder / "other.h5"
        for content, wrong in ((bytes(flipped), "damaged.* Download it again"), (whole[:-1], "damaged"),
                               (whole[:300], "damaged"), (whole[:-64], "damaged"),
                               (whole[:16] + b"\x04" + whole[17:-64], "without the checksum"),
                               (b"strain,stress", "not a result"), (b"", "not a result")):
            other.write_bytes(content)
            with self.assertRaisesRegex(cc.FileError, f"other.h5: .*{wrong}"):
                cc.open(other)
        for missing in (self.folder / "nothing.h5", self.folder):
            with self.assertRaisesRegex(cc.FileError, f"{missing}: cannot be read.*Name a result.h5"):
                cc.open(str(missing))

    def test_figures_fit_a_column(self):
        live = self.server.submit(PRESET, SMALL).live_plot()
        for ax in (self.job.plot(), self.sweep.plot(), self.job.plot_frame(0.4), live):
            self.assertAlmostEqual(ax.figure.get_figwidth() * 25.4, 85.0)
        self.assertEqual(live.get_xlabel(), "nominal strain")
        legend = [text.get_text() for text in self.sweep.plot().get_legend().get_texts()]
        self.assertIn("shock theory (Eq. 51)", legend)
        self.assertEqual(self.job.plot(font_pt=7).xaxis.label.get_fontsize(), 7)

    def test_small_stresses_are_in_kpa(self):
        thin = {**SMALL, "wall_thickness_mm": 0.1, "vertical_wall_thickness_mm": 0.1}
        sweep = self.server.sweep(PRESET, thin, speed_m_per_s=[5, 10]).wait()
        job = sweep.jobs[0]
        kpa = 1000.0 * job.summary.plateau_stress_impact_mpa
        self.assertLess(kpa, 100.0)
        ax, over = job.plot(), sweep.plot()
        self.assertEqual([ax.get_ylabel(), over.get_ylabel()], ["nominal stress (kPa)", "plateau stress (kPa)"])
        self.assertIn(f"plateau {kpa:.4g} kPa", [text.get_text() for text in ax.get_legend().get_texts()])
        self.assertAlmostEqual(over.containers[0][0].get_ydata()[0], kpa)
        line = self.job.plot(self.job.plot(ax)).get_lines()[-1]  # axes keep their unit
        self.assertAlmostEqual(line.get_ydata()[0], 1000.0 * self.job.summary.plateau_stress_impact_mpa)

    def test_a_picture_fits_its_frame(self):
        positions = self.job.frames.position_mm[-1]
        self.assertEqual(self.job.plot_frame(1.0).get_xlim(), (positions[:, 0].min(), positions[:, 0].max()))

    def test_rigid_walls_are_drawn_as_the_plates(self):
        rigid = SimpleNamespace(frames=self.job.frames, mesh=replace(self.job.mesh, rigid_element_count=3))
        lines = plot_frame(rigid, 1.0).collections[0]
        lines.update_scalarmappable()
        *walls, plate = [tuple(colour) for colour in lines.get_colors()]
        self.assertEqual(to_hex(plate), GREY)
        self.assertEqual(walls.count(plate), 2)

    def test_a_player_needs_no_other_host(self):
        player = self.job.animate()
        self.assertIn("<script", player._repr_html_())
        self.assertNotRegex(player.to_jshtml(), r"https?:|//\w+\.\w|<link|<i ")
        self.assertRegex(player.to_jshtml(), 'aria-label="Play"[^>]*>\\s*▶')

    def test_two_varied_fields_give_a_map_of_means_over_seeds(self):
        sweep = self.server.sweep(PRESET, SMALL, speed_m_per_s=[50, 200], wall_thickness_mm=[0.3, 0.4], seeds=2,
                                  amplitude_mm=0.02).wait()
        ax = sweep.plot()
        means = sweep.table(mean_over="seed").sort_values(["wall_thickness_mm", "speed_m_per_s"])
        cells, contours = ax.collections[0], ax.collections[1:]
        np.testing.assert_array_equal(cells.get_array().ravel(), means["plateau_stress_impact_mpa"])
        self.assertEqual((ax.get_xlabel(), ax.get_ylabel()), ("speed (m/s)", "wall thickness (mm)"))
        self.assertTrue(any(len(contour.get_paths()) for contour in contours))
        self.assertEqual([text.get_text() for text in ax.texts],
                         [f"{value:.3g}" for value in means["plateau_stress_impact_mpa"]])
        self.assertGreater(min(*ax.get_xlim(), *ax.get_ylim()), 0.0)
        series = sweep.plot(series=True)
        self.assertEqual([text.get_text() for text in series.get_legend().get_texts()], ["0.3", "0.4", "support"])
        self.assertGreaterEqual(series.get_xlim()[0], 0.0)

    def test_seeds_alone_are_points_at_whole_numbers(self):
        ax = self.server.sweep(PRESET, SMALL, seeds=3, amplitude_mm=0.02).wait().plot()
        self.assertEqual([container[0].get_linestyle() for container in ax.containers], ["None"] * 2)
        self.assertTrue(all(tick % 1 == 0 for tick in ax.get_xticks()))

    def test_a_map_shows_where_no_job_succeeded(self):
        sweep = self.server.sweep(PRESET, {**SLOW, "speed_m_per_s": [1, 0.5]}, wall_thickness_mm=[0.3, 0.4],
                                  max_parallel=1).cancel().wait()
        self.assertEqual([text.get_text() for text in sweep.plot().texts], ["–"] * 4)


class Means(unittest.TestCase):
    def test_means_are_those_of_the_daemon(self):
        folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory(dir="/tmp")))
        with subprocess.Popen([os.environ["CELLCRUSHD"], "--data", folder / "data", "--listen", f"unix:{folder}/s",
                               "--http", "127.0.0.1:0"], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
                              ) as daemon, contextlib.ExitStack() as stack:
            stack.callback(daemon.terminate)
            pages = next(line.split()[-1] for line in daemon.stderr if "serving HTTP on" in line)
            daemon.stdout.readline()
            server = stack.enter_context(cc.connect(f"unix:{folder}/s"))
            sweep = server.sweep(PRESET, SMALL, wall_thickness_mm=[0.5, 0.6], vertical_wall_thickness_mm=0.4,
                                 end_strain=0.85, speed_m_per_s=10, elements_per_wall=2, seeds=3, amplitude_mm=0.05
                                 ).wait()
            direct = urllib.request.build_opener(urllib.request.ProxyHandler({}))
            theirs = pandas.read_csv(direct.open(f"{pages}/{sweep.name}.csv"))
            ours = sweep.table(mean_over="seed")
        results = [name.removesuffix("_ci95") for name in theirs if name.endswith("_ci95")]
        self.assertEqual((len(results), list(ours["densification_strain_count"])), (17, [2, 3]))
        for name in results:
            np.testing.assert_allclose(ours[name], theirs[name], rtol=1e-6, err_msg=name)
            np.testing.assert_array_equal(ours.get(f"{name}_count", theirs[f"{name}_count"]), theirs[f"{name}_count"])
            if f"{name}_ci95" in ours:  # Student's factor of the daemon has four digits
                np.testing.assert_allclose(ours[f"{name}_ci95"], theirs[f"{name}_ci95"], rtol=2e-5, err_msg=name)

if __name__ == "__main__":
    unittest.main()
