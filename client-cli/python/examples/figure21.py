"""Plateau stress against speed with shock theory (Eq. 51), as in Figure 21 of the paper: figure21.py [CASE ...]

The presets take some minutes of one core each."""
import sys

import cellcrush as cc
import matplotlib.pyplot as plt

cases = sys.argv[1:] or ["preset:type-i", "preset:type-ii-as-counted", "preset:type-iii-as-counted"]
server = cc.connect()
sweeps = [server.sweep(case, speed_m_per_s=[25, 50, 100, 150, 200], seeds=3, amplitude_mm=0.01, end_strain=0.41)
          for case in cases]
figure, axes = plt.subplots(len(cases), 1, figsize=(85 / 25.4, len(cases) * 70 / 25.4), layout="constrained",
                            squeeze=False)
for sweep, ax in zip(sweeps, axes.flat):
    sweep.wait().plot(ax)
    table = sweep.table(mean_over="seed")
    columns = ["speed_m_per_s", "plateau_stress_impact_mpa", "plateau_stress_impact_mpa_ci95", "shock_mpa"]
    print(table[columns].to_string(index=False))
figure.savefig("figure21.pdf")
