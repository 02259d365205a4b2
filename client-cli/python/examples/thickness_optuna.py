"""The thicknesses of both kinds of walls for a wanted plateau at the least density: thickness_optuna.py [CASE [MPA]]

Optuna proposes a batch, which the daemon crushes side by side."""
import sys

import cellcrush as cc
import optuna

BATCHES, BATCH = 5, 4
case = sys.argv[1] if len(sys.argv) > 1 else "preset:hexagon-small"
wanted_mpa = float(sys.argv[2]) if len(sys.argv) > 2 else 0.5
server = cc.connect()
optuna.logging.set_verbosity(optuna.logging.WARNING)
study = optuna.create_study(sampler=optuna.samplers.TPESampler(seed=1))
for _ in range(BATCHES):
    batch = []
    for trial in [study.ask() for _ in range(BATCH)]:
        fields = {name: trial.suggest_float(name, 0.2, 0.6)
                  for name in ("wall_thickness_mm", "vertical_wall_thickness_mm")}
        batch.append((trial, fields, server.submit(case, fields, speed_m_per_s=20, end_strain=0.41)))
    for trial, fields, job in batch:
        missed = abs(job.wait().summary.plateau_stress_impact_mpa / wanted_mpa - 1)
        study.tell(trial, missed + 0.1 * server.check(case, fields).relative_density)
print(f"{wanted_mpa} MPa: " + ", ".join(f"{name} {value:.3f}" for name, value in study.best_params.items()))
