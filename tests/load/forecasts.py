#!/usr/bin/env python3
"""Predicted memory and disk space of jobs (cellcrush check) against what their workers use; a row of CSV each.

usage: forecasts.py BIN [LARGEST]   BIN has cellcrushd and cellcrush; LARGEST: most elements, default 2,000,000
"""
import json
import os
import subprocess
import sys
import tempfile
import time

LATTICES = {"hexagon": 3, "square": 2, "triangle": 3}  # and the walls of a cell
LAWS = {
    "plastic": [],
    "hardening": ["material.hardening_modulus_mpa=700", "material.isotropic_fraction=0.5"],
    "friction": ["contact.friction=0.2", "plates.friction=0.2"],
    "paper": ["section.formulation=DISPLACEMENT_BASED", "section.depth_rule=LOBATTO",
              "section.area_rule=CONSTANT_AREA"],
}
SIZES = [1_000, 10_000, 100_000, 500_000, 1_990_000]
ELEMENTS_PER_WALL = 4
COMMON = """
depth_mm: 4 elements_per_wall: 4 material { youngs_modulus_mpa: 69000 yield_stress_mpa: 76 density_kg_per_m3: 2700 }
loading { speed_m_per_s: 200 end_strain: %g } output { sample_count: 100 frame_count: 10 }"""


def case_of(lattice, elements):
    """Few columns, which are crushed in few steps; the more elements, the less far."""
    columns = 10 if elements < 100_000 else 40
    rows = max(2, round(elements / (LATTICES[lattice] * ELEMENTS_PER_WALL * columns)))
    strain = {1_000: 0.8, 10_000: 0.5, 100_000: 0.05, 500_000: 0.01}.get(elements, 0.003)
    return (
        f"lattice {{ {lattice} {{ columns: {columns} rows: {rows} side_mm: 4 wall_thickness_mm: 0.3 }} }}"
        + COMMON % strain
    )


class Daemon:
    def __init__(self, programs, folder):
        self.data = os.path.join(folder, "data")
        self.client = [os.path.join(programs, "cellcrush"), "--server", "unix:" + os.path.join(folder, "socket")]
        self.process = subprocess.Popen(
            [os.path.join(programs, "cellcrushd"), "--data", self.data, "--listen", self.client[2], "--http", "none"]
            + ["--workers", "1", "--checkpoint-interval", "0.05"],
            stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
        self.process.stdout.readline()

    def call(self, *words):
        done = subprocess.run(self.client + list(words) + ["--json"], capture_output=True, text=True, check=False)
        if done.returncode != 0:
            raise RuntimeError(done.stderr)
        return json.loads(done.stdout)

    def run(self, *case):
        """The most memory of the job's worker, the most bytes in its folder and the size of the result, polled."""
        job = self.call("submit", *case)["name"]
        folder = os.path.join(self.data, job)
        memory = data = 0
        largest = {}
        while True:
            try:
                with open(os.path.join(folder, "worker"), encoding="ascii") as file:
                    status = open(f"/proc/{file.read().split()[0]}/status", encoding="ascii").read()
                fields = {line.split(":")[0]: line.split(":")[1].split() for line in status.splitlines()}
                memory = max(memory, 1024 * int(fields["VmHWM"][0]))
                data = max(data, 1024 * int(fields["VmData"][0]))
            except (OSError, KeyError, IndexError):
                if memory and self.call("show", job)["state"] not in ("PENDING", "RUNNING"):
                    break
            try:
                for entry in os.scandir(folder):
                    largest[entry.name] = max(largest.get(entry.name, 0), entry.stat().st_size)
            except OSError:
                pass
            time.sleep(0.003)
        shown = self.call("show", job)
        if shown["state"] != "SUCCEEDED":
            print(f"# {shown['state']}: {shown.get('cause_message')}", flush=True)
        self.call("delete", job)
        # At a checkpoint near the end all files are there at once, the result under its first name.
        result = max(largest.pop("result.h5", 0), largest["result.h5.partial"])
        return memory, sum(largest.values()), data, result


def main():
    largest = int(sys.argv[2]) if len(sys.argv) > 2 else SIZES[-1]
    print("lattice,law,elements,memory_predicted_mb,memory_mb,memory_ratio,disk_predicted_mb,disk_mb,disk_ratio,"
          "data_mb,result_predicted_mb,result_mb")
    with tempfile.TemporaryDirectory() as folder:
        daemon = Daemon(sys.argv[1], folder)
        path = os.path.join(folder, "case.txtpb")
        try:
            for size in (size for size in SIZES if size <= largest):
                for lattice in LATTICES:
                    for law in LAWS:
                        with open(path, "w", encoding="ascii") as file:
                            file.write(case_of(lattice, size))
                        case = [path] + [word for change in LAWS[law] for word in ("--set", change)]
                        check = {name: float(value) for name, value in daemon.call("check", *case).items()
                                 if name.startswith("predicted") or name == "element_count"}
                        memory, disk, data, result = daemon.run(*case)
                        row = [check["predicted_memory_bytes"], memory, check.get("predicted_disk_bytes", 0), disk,
                               data, check["predicted_bytes"], result]
                        mb = [number / 1e6 for number in row]
                        print(f"{lattice},{law},{check['element_count']:.0f},{mb[0]:.1f},{mb[1]:.1f},"
                              f"{mb[0] / mb[1]:.3f},{mb[2]:.1f},{mb[3]:.1f},{mb[2] / mb[3]:.3f},{mb[4]:.1f},"
                              f"{mb[5]:.2f},{mb[6]:.2f}", flush=True)
        finally:
            daemon.process.terminate()
            daemon.process.wait()


main()
