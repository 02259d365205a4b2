"""What the tests of the Python package share: one private daemon, and small cases."""
import os
import pathlib
import tempfile
import unittest

os.environ.setdefault("MPLBACKEND", "agg")
os.environ.setdefault("MPLCONFIGDIR", tempfile.gettempdir())

import cellcrush as cc  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parents[3]
SMALL = {"columns": 6, "lattice.hexagon.rows": 4, "speed_m_per_s": 100, "end_strain": 0.5, "sample_count": 200,
         "frame_count": 10}
PRESET = "preset:hexagon-small"
# Takes a minute, so a test can meet it while it runs.
SLOW = {**SMALL, "columns": 20, "speed_m_per_s": 0.5}


class WithServer(unittest.TestCase):
    """Tests with a daemon, which a class shares, and a folder of their own."""

    server: cc.Server

    @classmethod
    def setUpClass(cls) -> None:
        cls.server = cls.enterClassContext(cc.private_server())

    def setUp(self) -> None:
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))

    def crush(self, **fields):
        return self.server.submit(PRESET, {**SMALL, **fields}).wait()
