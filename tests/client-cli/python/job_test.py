"""Jobs: results as arrays, and waits that survive what happens to them."""
import asyncio
import contextlib
import io
import itertools
import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import threading
import time
import unittest
from unittest import mock

import cellcrush as cc
import cellcrush.aio
import numpy as np
from support import PRESET, SLOW, SMALL, WithServer


class Jobs(WithServer):
    def test_results_come_as_arrays_with_units(self):
        job = self.crush()
        samples, frames, mesh = job.samples(), job.frames, job.mesh
        self.assertEqual(job.state, "SUCCEEDED")
        self.assertAlmostEqual(samples["strain"][-1], 0.5, places=2)
        self.assertEqual(frames.position_mm.shape, (len(frames), *mesh.position_mm.shape))
        self.assertEqual(frames.plastic_fraction.shape, (len(frames), len(mesh.element_nodes)))
        np.testing.assert_array_equal(frames.position_mm[0], mesh.position_mm)
        window = (samples["strain"] > 0.2) & (samples["strain"] <= 0.4)
        self.assertAlmostEqual(samples["stress_impact_mpa"][window].mean(), job.summary.plateau_stress_impact_mpa,
                               delta=0.05 * job.summary.plateau_stress_impact_mpa)
        self.assertIsNone(job.summary.densification_strain)
        history = job.history()
        self.assertEqual((len(history), history.attrs["units"]["stress_impact_mpa"]), (len(samples), "MPa"))
        dataset = job.xarray()
        self.assertEqual(dataset.position_mm.attrs["units"], "mm")
        self.assertEqual(dataset.position_mm.dims, ("frame", "particle", "axis"))
        self.assertIn("MPa", job._repr_html_())
        self.assertIn("<td>theory densification strain</td>", job.summary._repr_html_())
        self.assertRegex(repr(mesh), f"<mesh of {len(mesh.position_mm)} particles .* elements, "
                                     f"{mesh.length_mm:.6g} x {mesh.width_mm:.6g} mm>")
        self.assertEqual(repr(frames), f"<{len(frames)} frames, strain 0 to 0.5>")
        self.assertEqual([s.strain for s in job.watch()], list(samples["strain"]))

    def test_a_test_is_laid_over_its_curve(self):
        job = self.crush()
        samples = job.samples()
        with tempfile.TemporaryDirectory() as folder:
            first, second = pathlib.Path(folder, "1.csv"), pathlib.Path(folder, "2.csv")
            for path, factor in ((first, 0.5), (second, 1.5)):
                rows = [f"{strain};{factor * stress}" for strain, stress in
                        zip(samples["strain"], samples["stress_support_mpa"])]
                path.write_text("\n".join(["strain;stress MPa", *rows]).replace(".", ","))
            one = job.compare(first, window=(0.1, 0.3), energy_to=0.4)
            both = job.compare(first, second)
            awaited = asyncio.run(cellcrush.aio.Job(job).compare(first))
            with self.assertRaisesRegex(cc.CrushError, "1.csv, which has no column that is stress or force"):
                job.compare(first, columns="strain, -")
            with self.assertRaisesRegex(cc.CrushError, 'force_part is "press", but the job has no rigid wall'):
                job.compare(first, force="press")
        self.assertAlmostEqual(one.ratio("energy"), 2.0, places=6)
        self.assertAlmostEqual(one.ratio("mean"), 2.0, places=6)
        self.assertEqual((one.window, one.energy_to, one.is_force), ((0.1, 0.3), 0.4, False))
        self.assertAlmostEqual(both.ratio("energy"), 1.0, places=6)
        np.testing.assert_allclose(both.measured_most, 1.5 * both.computed_y, atol=1e-9)
        self.assertAlmostEqual(awaited.ratio("energy"), 2.0, places=6)
        self.assertIn("energy +100.0%", repr(one))
        self.assertEqual(both.plot().get_ylabel(), "nominal stress (MPa)")

    def test_a_note_replaces_only_the_one_that_is_known(self):
        job = self.server.submit(PRESET, SMALL, note="thin").wait()
        other = self.server.get(job.name)
        self.assertEqual(job.set_note("thin walls").note, "thin walls")
        with self.assertRaisesRegex(cc.CrushError, "thin walls"):
            other.set_note("thick")
        self.assertEqual(other.refresh().set_note("").refresh().note, "")

    def test_a_watched_node_has_columns(self):
        frame = {"lattice.frame": {
            "nodes": [{"id": "a", "x_mm": 0, "y_mm": 0}, {"id": "b", "x_mm": 10, "y_mm": 0}],
            "beams": [{"start": "a", "end": "b", "thickness_mm": 1}], "watched_nodes": ["b"], "end_time_s": 1e-4,
            "supports": [{"node": "a", "fix_x": True, "fix_y": True, "fix_rotation": True}],
            "loads": [{"node": "b", "component": "COMPONENT_Y",
                       "force_n_or_n_mm": {"points": [{"time_s": 0, "value": 1}]}}]},
            "depth_mm": 1, "youngs_modulus_mpa": 70000, "yield_stress_mpa": 100, "density_kg_per_m3": 2700}
        job = self.server.submit(frame, sample_count=20).wait()
        self.assertGreater(job.samples()["nodes.b.uy_mm"][-1], 0.0)
        sweep = self.server.sweep(frame, sample_count=20, depth_mm=[1, 2], watched_nodes=["a"]).wait()
        self.assertEqual(list(sweep.case.lattice.frame.watched_nodes), ["a"])  # a list is the value of a list
        check = self.server.check(frame)
        self.assertEqual((check.relative_density, check.length_mm), (None, None))
        for theory in (job.summary.theory, check.theory):
            self.assertEqual((theory.shock_mpa, theory.gibson_ashby_mpa), (None, None))

    def test_what_a_job_has_not_got_is_none(self):
        job = self.server.submit(PRESET, SLOW)
        summary = job.summary
        for value in (summary.absorbed_energy_mj, summary.energy_error_relative, summary.theory.shock_mpa,
                      summary.front.shock_mpa, summary.quasi_static.kinetic_share, job.suspend().progress.fraction):
            self.assertIsNone(value)
        self.assertFalse(summary.front)
        self.assertNotRegex(repr(summary), " 0|UNSPECIFIED")
        job.cancel()
        crush = self.crush(speed_m_per_s=1)
        self.assertIsNone(crush.summary.front.shock_mpa)
        self.assertGreater(crush.summary.absorbed_energy_mj, 0.0)
        self.assertGreater(crush.summary.theory.shock_mpa, 0.0)

    def test_commands_change_the_state(self):
        job = self.server.submit(PRESET, SLOW, labels={"study": "walls"})
        self.assertEqual(job.suspend().state, "SUSPENDED")
        self.assertIn(job.resume().state, ("PENDING", "RUNNING"))
        next(job.watch())
        job.cancel()
        with self.assertRaisesRegex(cc.JobFailed, f"{job.name} CANCELLED: it was cancelled at step .* results so far"):
            job.wait()
        queued = self.server.submit(PRESET, SLOW).cancel()
        with self.assertRaisesRegex(cc.JobFailed, f"{queued.name} CANCELLED: .*Submit job.case again to run it."):
            queued.wait()
        self.assertEqual([j.name for j in self.server.jobs('label.study = "walls"')], [job.name])
        self.assertEqual(self.server.get(job.name).case.loading.speed_m_per_s, 0.5)
        job.delete()
        with self.assertRaises(cc.NotFound):
            self.server.get(job.name)

    def test_a_download_appears_whole_or_not_at_all(self):
        file = self.folder / "result.h5"
        file.write_text("of before")
        job = self.server.submit(PRESET, SLOW).suspend()
        with self.assertRaisesRegex(cc.CrushError, "no result"):
            job.download(file)
        job.cancel()
        job = self.crush()
        follow = job._connection.follow
        with mock.patch.object(job._connection, "follow", lambda *of: itertools.chain(
                itertools.islice(follow(*of), 1), self.lost())), self.assertRaises(cc.NotConnected):
            job.download(file)
        self.assertEqual([(path.name, path.read_text()) for path in self.folder.iterdir()], [(file.name, "of before")])
        (self.folder / "link.h5").symlink_to(file)
        job.download(self.folder / "link.h5")
        self.assertEqual(cc.open(file).title, job.title)
        for wrong, remedy in (("nofolder/x.h5", "Create it"), (".", "such as .*result.h5")):
            with self.assertRaisesRegex(cc.FileError, remedy):
                job.download(self.folder / wrong)

    @staticmethod
    def lost():
        raise cc.NotConnected("lost the connection")
        yield

    def test_a_request_id_names_one_job(self):
        jobs = [self.server.submit(PRESET, SMALL, request_id="once") for _ in range(2)]
        self.assertEqual(jobs[0].name, jobs[1].name)

    def test_a_bar_shows_progress(self):
        with contextlib.redirect_stderr(io.StringIO()) as shown:
            self.server.submit(PRESET, SMALL).wait(progress=True)
        self.assertRegex(shown.getvalue(), "100%  SUCCEEDED")

    def test_ctrl_c_leaves_the_job_running(self):
        server = self.enterContext(cc.connect(self.server.address))
        job = server.submit(PRESET, SLOW)
        interrupt = mock.patch("cellcrush.plots.LivePlot.take", lambda *_: os.kill(os.getpid(), signal.SIGINT))
        for wait in (job.wait, job.live_plot):
            with contextlib.redirect_stderr(io.StringIO()) as said, self.assertRaises(KeyboardInterrupt), interrupt:
                if wait == job.wait:
                    threading.Timer(0.5, os.kill, (os.getpid(), signal.SIGINT)).start()
                wait()
            self.assertEqual(said.getvalue(), f"\n{job.name} keeps running; get({job.name!r}) of the server finds it "
                                              "again\n")
        self.assertIn(job.refresh().state, ("PENDING", "RUNNING"))
        job.cancel()


class Interruptions(unittest.TestCase):
    def test_ctrl_c_stops_a_private_server(self):
        for wait in (lambda server: server.submit(PRESET, SLOW).wait(),
                     lambda server: server.sweep(PRESET, SLOW, speed_m_per_s=[0.5, 1]).wait()):
            threading.Timer(1.0, os.kill, (os.getpid(), signal.SIGINT)).start()
            with contextlib.redirect_stderr(io.StringIO()) as said, self.assertRaises(KeyboardInterrupt):
                with cc.private_server() as server:
                    wait(server)
            self.assertEqual(said.getvalue(), "\nthe private server stops, and its jobs with it\n")

    def start(self, folder, data="data"):
        daemon = subprocess.Popen([os.environ["CELLCRUSHD"], "--data", f"{folder}/{data}", "--listen",
                                   f"unix:{folder}/s", "--http", "none"], stdout=subprocess.PIPE, text=True)
        self.addCleanup(daemon.kill)
        daemon.stdout.readline()
        daemon.stdout.close()
        return daemon

    def test_waits_go_on_when_the_daemon_is_killed_and_started_again(self):
        with tempfile.TemporaryDirectory(dir="/tmp") as folder:
            daemon = self.start(folder)
            server = cc.connect(f"unix:{folder}/s")
            case = server.case(PRESET, SMALL, speed_m_per_s=2)
            job, sweep = server.submit(case), server.sweep(case, speed_m_per_s=[3, 4])
            watched = []
            threads = [threading.Thread(target=lambda: watched.extend(s.step for s in job.watch())),
                       threading.Thread(target=sweep.wait)]
            for thread in threads:
                thread.start()
            while server.get(job.name).state == "PENDING":
                time.sleep(0.05)
            daemon.kill()
            daemon.wait()
            time.sleep(0.5)
            daemon = self.start(folder)
            for thread in threads:
                thread.join(200)
            steps = list(server.get(job.name).samples()["step"])
            self.assertEqual(watched, steps)
            self.assertEqual(sweep.states, {"SUCCEEDED": 2})
            server.close()
            daemon.terminate()
            daemon.wait()

    def test_a_handle_of_a_former_server_changes_nothing_of_the_next_one(self):
        with tempfile.TemporaryDirectory(dir="/tmp") as folder:
            daemon = self.start(folder)
            server = self.enterContext(cc.connect(f"unix:{folder}/s"))
            job, sweep = server.submit(PRESET, SMALL).wait(), server.sweep(PRESET, SMALL, depth_mm=[1, 2]).wait()
            daemon.terminate()
            daemon.wait()
            daemon = self.start(folder, "second")
            now = self.enterContext(cc.connect(f"unix:{folder}/./s"))  # a connection of its own
            theirs = now.submit(PRESET, SMALL).wait(), now.sweep(PRESET, SMALL, depth_mm=[1, 2]).wait()
            self.assertEqual([each.name for each in theirs], [job.name, sweep.name])
            for call in (job.delete, job.cancel, job.refresh, job.wait, sweep.delete, sweep.retry,
                         lambda: sweep.set_note("x"), lambda: server.submit(PRESET, SMALL),
                         lambda: asyncio.run(cellcrush.aio.Job(job).wait())):
                with self.assertRaisesRegex(cc.ServerChanged, r"another server, .* connect\(\) again"):
                    call()
            self.assertEqual((theirs[0].refresh().state, theirs[1].refresh().note), ("SUCCEEDED", ""))
            daemon.terminate()
            daemon.wait()

    def test_without_a_daemon_the_error_says_what_to_do(self):
        with self.assertRaisesRegex(cc.NotConnected, "unix:/nowhere/s. Start cellcrushd"):
            cc.connect("unix:/nowhere/s")
        with self.assertRaisesRegex(ValueError, "HOST:PORT"):
            cc.connect("nowhere")
        token = pathlib.Path(__file__)
        with self.assertRaisesRegex(ValueError, "plain text"):
            cc.connect("crusher.example.org:50551", token_file=str(token))

    def test_run_refuses_an_impossible_output_before_the_crush(self):
        with mock.patch("cellcrush.private.private_server") as started, self.assertRaisesRegex(
                cc.FileError, "nofolder/x.h5: the folder .*nofolder does not exist. Create it"):
            cc.run(PRESET, SMALL, output="nofolder/x.h5")
        started.assert_not_called()

    def test_run_saves_the_results_of_a_failed_job_too(self):
        file = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()), "result.h5")
        with self.assertRaisesRegex(cc.JobFailed, f"FAILED: .*time_limit_s.* {file} has the results so far") as raised:
            cc.run(PRESET, SLOW, time_limit_s=1, output=file)
        job, result = raised.exception.job, cc.open(file)
        self.assertEqual((raised.exception.output, result.attributes["complete"]), (file, 0))
        np.testing.assert_array_equal(result.samples()["strain"], job.samples()["strain"])

    def test_run_needs_no_daemon(self):
        with tempfile.TemporaryDirectory() as folder:
            job = cc.run(PRESET, SMALL, output=f"{folder}/result.h5")
            self.assertEqual(cc.open(f"{folder}/result.h5").summary.plateau_stress_impact_mpa,
                             job.summary.plateau_stress_impact_mpa)
        self.assertEqual(len(job.samples()), len(job.history()))
        self.assertGreater(len(job.frames), 5)


if __name__ == "__main__":
    sys.exit(unittest.main())
