"""The examples, each as a program against a daemon. CELLCRUSH_LONG_EXAMPLES runs those with heavy packages instead."""
import importlib.util
import json
import os
import subprocess
import sys
import unittest

from google.protobuf import text_format
from support import PRESET, ROOT, SMALL, WithServer

EXAMPLES = ROOT / "client-cli/python/examples"
is_long = "CELLCRUSH_LONG_EXAMPLES" in os.environ


class Example(WithServer):
    def setUp(self):
        super().setUp()
        case = self.server.case(PRESET, SMALL, sample_count=100)
        (self.folder / "case.txtpb").write_text(text_format.MessageToString(case))

    def run_command(self, *command):
        environment = {**os.environ, "CELLCRUSH_SERVER": self.server.address, "HOME": str(self.folder),
                       "CRUSH_CASE": str(self.folder / "case.txtpb"), "XDG_CACHE_HOME": str(self.folder)}
        done = subprocess.run([str(word) for word in command], cwd=self.folder, env=environment, text=True,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=240)
        self.assertEqual(done.returncode, 0, done.stdout)
        return done.stdout

    def run_example(self, name, *arguments):
        return self.run_command(sys.executable, EXAMPLES / name, "case.txtpb", *arguments)


@unittest.skipIf(is_long, "a short one")
class Short(Example):
    def test_figure_21(self):
        self.assertRegex(self.run_example("figure21.py"), "200.0")
        self.assertTrue((self.folder / "figure21.pdf").exists())

    def test_a_live_plot(self):
        self.assertRegex(self.run_example("live.py"), "SUCCEEDED")
        self.assertTrue((self.folder / "live.pdf").exists())

    def test_a_mode_map(self):
        self.run_example("mode_map.py")
        self.assertTrue((self.folder / "mode_map.pdf").exists())


@unittest.skipUnless(is_long, "a long one")
class Long(Example):
    def test_optuna_finds_thicknesses(self):
        self.assertRegex(self.run_example("thickness_optuna.py", 0.5), r"0.5 MPa: wall_thickness_mm 0\.\d+")

    def test_a_rule_of_snakemake(self):
        self.run_command("/usr/bin/snakemake", "--snakefile", EXAMPLES / "Snakefile", "--cores", "2", "--config",
                         "case=case.txtpb")
        rows = (self.folder / "plateaus.csv").read_text().splitlines()
        self.assertEqual([row.split(",")[0] for row in rows], ["speed_m_per_s", "50.0", "100.0", "200.0"])

    def test_a_notebook_with_a_player(self):
        self.run_command("/usr/bin/jupyter-nbconvert", "--to", "notebook", "--execute", "--output-dir", self.folder,
                         "--output", "done", EXAMPLES / "crush.ipynb")
        cells = [cell for cell in json.loads((self.folder / "done.ipynb").read_text())["cells"] if "outputs" in cell]
        outputs = [[kind for output in cell["outputs"] for kind in output.get("data", {})] for cell in cells]
        self.assertIn("image/png", outputs[1])
        player = cells[4]["outputs"][0]["data"]["text/html"]
        self.assertIn("<script", "".join(player))


@unittest.skipUnless(is_long and importlib.util.find_spec("scipy"),
                     "no scipy: deploy/install-packages examples unpacks it")
class Scipy(Example):
    def test_a_root_finds_a_thickness(self):
        self.assertRegex(self.run_example("thickness_scipy.py", 0.5), r"wall thickness 0\.\d+ mm for 0.5 MPa")


if __name__ == "__main__":
    unittest.main()
