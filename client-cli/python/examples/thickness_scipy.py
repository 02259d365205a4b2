"""The wall thickness for a wanted plateau stress, by root finding: thickness_scipy.py [CASE [MPA]]"""
import sys

import cellcrush as cc
from scipy.optimize import brentq

case = sys.argv[1] if len(sys.argv) > 1 else "preset:hexagon-small"
wanted_mpa = float(sys.argv[2]) if len(sys.argv) > 2 else 0.5
server = cc.connect()


def excess(thickness_mm: float) -> float:
    job = server.submit(case, wall_thickness_mm=thickness_mm, vertical_wall_thickness_mm=thickness_mm,
                        speed_m_per_s=20, end_strain=0.41).wait()
    print(f"{thickness_mm:.4f} mm: {job.summary.plateau_stress_impact_mpa:.4f} MPa")
    return job.summary.plateau_stress_impact_mpa - wanted_mpa


print(f"wall thickness {brentq(excess, 0.2, 0.6, xtol=0.005):.3f} mm for {wanted_mpa} MPa")
