"""Prints a table of the points that crush-array.sbatch has crushed: python3 plateaus.py RESULTS"""

import csv
import json
import pathlib
import sys

QUANTITIES = ["plateau_stress_impact_mpa", "plateau_stress_support_mpa", "energy_error_relative"]

if len(sys.argv) != 2:
    sys.exit("usage: python3 plateaus.py RESULTS")


def sort_key(row):
    """Numbers in their order, before everything else."""
    keys = []
    for name in fields:
        try:
            keys.append((0, float(row[name]), ""))
        except (KeyError, ValueError):
            keys.append((1, 0.0, row.get(name, "")))
    return keys


rows = []
fields = {}
for file in pathlib.Path(sys.argv[1]).glob("*/summary.json"):
    point = dict(field.split("=", 1) for field in file.parent.name.split(","))
    fields.update(point)
    job = json.loads(file.read_text())["state"]
    summary = job.get("summary", {})
    rows.append(point | {"state": job["state"]} | {name: summary.get(name) for name in QUANTITIES})
if not rows:
    sys.exit(f"{sys.argv[1]} has no result yet. Give the folder RESULTS of crush-array.sbatch.")
table = csv.DictWriter(sys.stdout, [*fields, "state", *QUANTITIES], lineterminator="\n")
table.writeheader()
table.writerows(sorted(rows, key=sort_key))
