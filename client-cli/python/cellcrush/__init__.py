"""cellcrush: crushes of honeycombs and other lattices, from Python.

>>> import cellcrush as cc                                              # doctest: +SKIP
>>> server = cc.connect()                                               # doctest: +SKIP
>>> job = server.submit("preset:hexagon-small", speed_m_per_s=50)       # doctest: +SKIP
>>> job.wait().summary.plateau_stress_impact_mpa                        # doctest: +SKIP
2.4
"""
from cellcrush.arrays import Frames, Mesh
from cellcrush.comparison import Comparison
from cellcrush.errors import (CaseError, CrushError, FileError, JobFailed, NotConnected, NotFound, Problem,
                              ServerChanged)
from cellcrush.job import Job
from cellcrush.private import private_server, run
from cellcrush.result_file import ResultFile, open
from cellcrush.server import Check, Server, connect
from cellcrush.sweep import Sweep
from cellcrush.v1.case_pb2 import Case

__all__ = ["Case", "CaseError", "Check", "Comparison", "CrushError", "FileError", "Frames", "Job", "JobFailed", "Mesh",
           "NotConnected", "NotFound", "Problem", "ResultFile", "Server", "ServerChanged", "Sweep", "connect", "open",
           "private_server", "run"]
