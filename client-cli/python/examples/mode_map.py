"""A map of crush modes over speed and wall thickness: mode_map.py [CASE]"""
import sys

import cellcrush as cc
import matplotlib.pyplot as plt
from cellcrush.words import label_of

COLOURS = {"X": "#0072b2", "V": "#d55e00", "I": "#009e73", "C": "#cc79a7", "MIXED": "#999999", "NONE": "#ffffff"}

SPEEDS, THICKNESSES = [8, 32, 128], [0.1, 0.2, 0.35]

case, size = (sys.argv[1], {}) if len(sys.argv) > 1 else (
    "preset:hexagon-small", {"lattice.hexagon.columns": 14, "lattice.hexagon.rows": 15})
sweep = cc.connect().sweep(case, size, speed_m_per_s=SPEEDS, wall_thickness_mm=THICKNESSES, amplitude_mm=0.05,
                           end_strain=0.41).wait()
figure, ax = plt.subplots(figsize=(85 / 25.4, 65 / 25.4), layout="constrained")
for job in sweep:
    mode = job.summary.crush_mode.removeprefix("CRUSH_MODE_")
    place = job.case.loading.speed_m_per_s, job.case.lattice.hexagon.wall_thickness_mm
    ax.scatter(*place, s=260, marker="s", color=COLOURS.get(mode, "#ffffff"), edgecolor="black", linewidth=0.5)
    ax.annotate(mode, place, ha="center", va="center", fontsize=5 if len(mode) > 1 else 8)
ax.set(xscale="log", xlabel=label_of("speed_m_per_s"), ylabel=label_of("wall_thickness_mm"))
ax.minorticks_off()
ax.set_xticks(SPEEDS, [f"{speed}" for speed in SPEEDS])
ax.set_yticks(THICKNESSES)
ax.margins(0.2)
figure.savefig("mode_map.pdf")
