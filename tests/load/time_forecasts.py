#!/usr/bin/env python3
"""Predicted time of jobs (cellcrush check) against the time that they take: presets, and lattices of every generator.

What else the machine does changes both. The reference crush (core/scene/run_cost.h) before and after each run tells by
how much: its own ratio is taken off. Of runs that end at rest, the steps taken count. --record replaces these rows in
time_forecasts.csv, and the figures of README.md in evidence.csv.
"""
import argparse
import os
import tempfile

from forecasts import Daemon, Record

GENERATORS = {
    "hexagon": "columns: 14 rows: 9 side_mm: 4 wall_thickness_mm: 0.2 vertical_wall_thickness_mm: 0.2",
    "square": "columns: 12 rows: 12 side_mm: 4 wall_thickness_mm: 0.2",
    "triangle": "columns: 10 rows: 10 side_mm: 4 wall_thickness_mm: 0.2",
    "diamond": "columns: 10 rows: 10 side_mm: 4 wall_thickness_mm: 0.2",
    "kagome": "columns: 8 rows: 8 side_mm: 3 wall_thickness_mm: 0.2",
    "arrowhead": "columns: 10 rows: 10 side_mm: 4 wall_thickness_mm: 0.15",
    "anti_tetrachiral": "columns: 8 rows: 8 side_mm: 6 wall_thickness_mm: 0.15",
    "hierarchical_hexagon": "columns: 7 rows: 7 side_mm: 6 wall_thickness_mm: 0.15",
    "sinusoidal_square": "columns: 10 rows: 10 side_mm: 4 wall_thickness_mm: 0.15",
    "voronoi": "columns: 14 rows: 14 side_mm: 3 irregularity: 0.5 seed: 1 relative_density: 0.08",
}
END_STRAINS = {5: 0.2, 100: 0.5}  # by speed, m/s
REFERENCE = ["preset:hexagon-small", "--set", "loading.speed_m_per_s=20", "--set", "output.sample_count=10"]
COLUMNS = ["case", "elements", "steps", "predicted_s", "taken_s", "reference_ratio", "ratio"]
SHORT = 2  # s; shorter runs count as the mean of four


def case_of(lattice, speed):
    return (
        f"lattice {{ {lattice} {{ {GENERATORS[lattice]} }} imperfection {{ amplitude_mm: 0.01 seed: 1 }} }} "
        "depth_mm: 4 material { youngs_modulus_mpa: 69000 yield_stress_mpa: 76 density_kg_per_m3: 2700 } "
        f"loading {{ speed_m_per_s: {speed} end_strain: {END_STRAINS[speed]} }}"
    )


def time_of(daemon, case):
    job = daemon.call("submit", *case)["name"]
    daemon.wait(job)
    summary = daemon.call("show", job)["summary"]
    daemon.call("delete", job)
    return summary["solver_seconds"], int(summary["step_count"])


def measure(daemon, name, case, longest):
    check = daemon.call("check", *case)
    predicted = check["predicted_seconds"]
    if predicted > longest:
        print(f"# {name}: {predicted:.0f} s predicted, left out", flush=True)
        return None
    of_reference = daemon.call("check", *REFERENCE)["predicted_seconds"]
    times = 4 if predicted < SHORT else 1
    before, _ = time_of(daemon, REFERENCE)
    runs = [time_of(daemon, case) for _ in range(times)]
    after, _ = time_of(daemon, REFERENCE)
    taken = sum(seconds for seconds, _ in runs) / times
    predicted *= runs[0][1] / int(check["step_count"])
    reference = of_reference / (0.5 * (before + after))
    values = [name, check["element_count"], check["step_count"], f"{predicted:.3g}", f"{taken:.3g}", f"{reference:.2f}",
              f"{predicted / taken / reference:.2f}"]
    print(",".join(values), flush=True)
    return dict(zip(COLUMNS, values))


def figures_of(rows):
    """Least and greatest ratio of the presets and of the generators."""
    for kind, of_speed in (("presets", False), ("lattices", True)):
        ratios = [float(row["ratio"]) for row in rows if row["case"].endswith(" m/s") == of_speed]
        yield f"{kind} in time", len(ratios)
        yield f"least ratio of time of {kind}", f"{min(ratios):.2f}"
        yield f"most ratio of time of {kind}", f"{max(ratios):.2f}"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("programs", metavar="BIN", help="folder of cellcrushd and cellcrush")
    parser.add_argument("--longest", type=float, default=60, metavar="S", help="leave out longer predicted times")
    parser.add_argument("--only", nargs="+", metavar="CASE", help="those of the first column that are wanted")
    parser.add_argument("--record", action="store_true")
    wanted = parser.parse_args()
    measured = []
    print(",".join(COLUMNS))
    with tempfile.TemporaryDirectory() as folder, Daemon(wanted.programs, folder) as daemon:
        cases = [(preset["name"], ["preset:" + preset["name"]]) for preset in daemon.call("presets")["presets"]]
        for speed in END_STRAINS:
            for lattice in GENERATORS:
                path = os.path.join(folder, f"{lattice}-{speed}.txtpb")
                with open(path, "w", encoding="ascii") as file:
                    file.write(case_of(lattice, speed))
                cases.append((f"{lattice} at {speed} m/s", [path]))
        for name, case in cases:
            if wanted.only and name not in wanted.only:
                continue
            if row := measure(daemon, name, case, wanted.longest):
                measured.append(row)
    if wanted.record:
        Record("time_forecasts", COLUMNS, key=lambda row: (row["case"],)).replace(measured, figures_of)


if __name__ == "__main__":
    main()
