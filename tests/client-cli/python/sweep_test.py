"""Sweeps, their tables and means, and what is written for other programs and for print."""
import asyncio
import unittest
import warnings

import cellcrush as cc
import cellcrush.aio
import meshio
import numpy as np
import pandas
from cellcrush.means import mean_table
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
        with self.assertRaisesRegex(ValueError, "varies speed_m_per_s, seed"):
            self.sweep.table(mean_over="rows")

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
        means = mean_table(table, ["speed", "seed"], ["plateau", "densification", "front"], "seed")
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

    def test_a_result_file_has_what_the_job_has(self):
        file = cc.open(self.job.download(self.folder / "result.h5"))
        for name in file.samples().dtype.names:
            np.testing.assert_array_equal(file.samples()[name], self.job.samples()[name], name)
        np.testing.assert_array_equal(file.frames.position_mm, self.job.frames.position_mm)
        self.assertEqual(file.mesh.length_mm, self.job.mesh.length_mm)
        self.assertEqual(file.summary.plateau_stress_impact_mpa, self.job.summary.plateau_stress_impact_mpa)
        self.assertEqual(file.case, self.job.case)

    def test_only_a_whole_result_file_is_read(self):
        whole = self.job.download(self.folder / "result.h5").read_bytes()
        flipped = bytearray(whole)
        flipped[len(whole) // 2] ^= 1
        other = self.folder / "other.h5"
        for content, wrong in ((bytes(flipped), "damaged.* Download it again"), (whole[:-1], "damaged"),
                               (whole[:300], "damaged"), (whole[512:], "without the checksum"),
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
        self.assertIn("<script", self.job.animate().to_jshtml())

    def test_a_second_varied_field_gives_a_series_each(self):
        sweep = self.server.sweep(PRESET, SMALL, wall_thickness_mm=[0.3, 0.4], speed_m_per_s=[50, 100]).wait()
        legend = [text.get_text() for text in sweep.plot().get_legend().get_texts()]
        self.assertIn("0.3", legend)


if __name__ == "__main__":
    unittest.main()
