#!/usr/bin/env python3
"""Published cases beside what cellcrush computes. FOLDER holds cellcrush and cellcrushd, such as build/ci/bin.

  published.py run --bin FOLDER [NAME...]    runs cases of cases.json, and keeps a record of each
  published.py check --bin FOLDER [--all]    runs the short ones, or all, and fails where one is beyond a limit that its
                                             record keeps
  published.py page [--check]                writes ../published.md and the pictures from the records, or compares them

A case of cases.json:
  name, title, source, assumed, causes    words of its row; causes are those of the differences
  short     whether `check` runs it by default, in the first of its runs
  runs      label, case (a file, or preset:NAME), set (as --set), compare, shape
  compare   of a run, or of all: curves (names in curves/; several are repeats), force, displacement (as in
            `cellcrush plot --with`), bars
  bars      kind, percent (the limit; set it before you run, by the scatter of the test or the error of reading):
            slope between two displacements, by least squares; force, the worst of all points between two, beyond
            `reading` in N; greatest; least; peak, the greatest up to a displacement; steps, the worst at every so many
            mm over the greatest force; column, the greatest force over that of column.py; agree, of the greatest force
            over all runs
  shape     what, of (half_width, height, crown), value, mm (the limit): of the last frame
  family    cells that change with a number: along, quantity, unit, case, cells (arguments of cells.py), set, window of
            strain, stress (a column of history.csv), times (a factor on its mean), percent, members (x, value, and
            what the others name in braces)

curves/NAME.csv: a line `# source`, a header as in `cellcrush plot --with`, then points, the displacement first.
"""
import argparse
import csv
import datetime
import json
import math
import pathlib
import re
import subprocess
import sys
import tempfile

import column
from page import write_page
from records import HERE, RECORDS, cases, record_of, verdict

POINTS = 100  # of a curve in a record


def call(program, *words):
    done = subprocess.run([program, *words], capture_output=True, text=True, cwd=HERE)
    if done.returncode != 0:
        sys.exit(f"{program} {' '.join(words)}\n{done.stdout[-2000:]}{done.stderr[-2000:]}")
    return done.stdout


# What a run says of a case.

def at(x, y, where):
    for i in range(1, len(x)):
        if x[i] >= where:
            return y[i - 1] + (y[i] - y[i - 1]) * (where - x[i - 1]) / (x[i] - x[i - 1])
    return y[-1]


def slope(x, y, low, high):
    pairs = [(a, b) for a, b in zip(x, y) if low <= a <= high]
    mean_x = sum(a for a, _ in pairs) / len(pairs)
    mean_y = sum(b for _, b in pairs) / len(pairs)
    return sum((a - mean_x) * (b - mean_y) for a, b in pairs) / sum((a - mean_x) ** 2 for a, _ in pairs)


def measure(bar, places, x, published, computed):
    """What is compared, published, computed, and the difference in per cent. `places`: of the published points."""
    kind = bar["kind"]
    if kind == "slope":
        a, b = (slope(x, y, bar["from"], bar["to"]) for y in (published, computed))
        return f"slope from {bar['from']} to {bar['to']} mm, N/mm", a, b, 100 * (b / a - 1)
    if kind in ("greatest", "least"):
        pick = max if kind == "greatest" else min
        a, b = pick(published), pick(computed)
        return f"{kind} force, N", a, b, 100 * (b / a - 1)
    if kind == "column":
        a, b = column.peak_load(**bar["of"]), max(computed)
        return "greatest force, N; in place of the published one, that of our own column", a, b, 100 * (b / a - 1)
    if kind == "peak":
        a, b = (max(v for place, v in zip(x, y) if place <= bar["to"]) for y in (published, computed))
        return f"peak up to {bar['to']} mm, N", a, b, 100 * (b / a - 1)
    if kind == "force":
        low, high = bar["from"], min(bar["to"], x[-1])

        def difference(where):
            a, b = at(x, published, where), at(x, computed, where)
            return 100 * math.copysign(max(abs(b - a) - bar.get("reading", 0.0), 0.0), b - a) / a

        where = max((v for v in places if low <= v <= high), key=lambda v: abs(difference(v)))
        beyond = f", less {bar['reading']} N of reading" if "reading" in bar else ""
        return (f"force from {low} to {high:.4g} mm, N; worst at {where:.3g} mm{beyond}", at(x, published, where),
                at(x, computed, where), difference(where))
    if kind == "steps":
        greatest = max(abs(v) for v in published)
        steps = [bar["every"] * i for i in range(1, int(x[-1] / bar["every"]) + 1)]
        where = max(steps, key=lambda v: abs(at(x, computed, v) - at(x, published, v)))
        a, b = at(x, published, where), at(x, computed, where)
        what = f"force at every {bar['every']} mm, N; worst at {where} mm, of the greatest published"
        return what, a, b, 100 * (b - a) / greatest
    sys.exit(f"cases.json: {kind} is no kind of bar")


def shape_of(folder, client, run):
    """Extent of the walls' faces in the last frame, mm."""
    call(client, "fetch", str(folder), "-o", str(folder / "last"), "--frame", "1e9")
    frame = sorted((folder / "last").glob("frame*.csv"))[-1]
    points = []
    for row in csv.DictReader(frame.open()):
        points += [(float(row[f"x{end}_mm"]), float(row[f"y{end}_mm"]), float(row["thickness_mm"])) for end in "01"]
    xs, ys = [p[0] for p in points], [p[1] for p in points]
    middle, thickness = 0.5 * (min(ys) + max(ys)), points[0][2]
    near = [y for x, y, _ in points if abs(x) < 1.0]
    return {"half_width": 0.5 * (max(xs) - min(xs) + thickness), "height": max(ys) - min(ys) + thickness,
            "crown": max(near) - middle + 0.5 * thickness}


def places_of(name):
    """The displacements of the points of a curve."""
    lines = [line for line in (HERE / "curves" / f"{name}.csv").read_text().splitlines() if line[:1] not in ("#", "")]
    separator = ";" if ";" in lines[0] else "\t" if "\t" in lines[0] else ","
    return [float(line.split(separator)[0].replace(",", ".")) for line in lines[1:]]


def run_case(case, programs, folder):
    """The record of a case: its curves and differences."""
    if "family" in case:
        return run_family(case, programs, folder)
    client = str(programs / "cellcrush")
    record = {"name": case["name"], "curves": [], "differences": []}
    greatest = {}
    for number, run in enumerate(case["runs"]):
        result = folder / f"{case['name']}-{number}"
        settings = [word for value in run.get("set", []) for word in ("--set", value)]
        call(client, "run", run["case"], *settings, "-o", str(result))
        for compared in run.get("compare", case.get("compare", [])):
            files = [word for name in compared["curves"] for word in ("--with", f"curves/{name}.csv")]
            parts = ["--force", compared["force"]]
            if "displacement" in compared:
                parts += ["--displacement", compared["displacement"]]
            text = call(client, "--json", "plot", str(result), *files, *parts, "-o", str(folder / "picture.svg"))
            curves = json.loads(text)
            x, published, computed = curves["x"], curves["measured_mean"], curves["computed_y"]
            places = places_of(compared["curves"][0])
            for bar in compared["bars"]:
                if bar["kind"] == "agree":
                    key = compared["force"], bar["percent"]
                    greatest.setdefault(key, []).append(max(computed))
                    continue
                what, a, b, difference = measure(bar, places, x, published, computed)
                record["differences"].append(row_of(run, compared, what, a, b, f"{difference:+.1f} %",
                                                    abs(difference), bar.get("percent")))
            keep = range(0, len(x), max(1, len(x) // POINTS))
            record["curves"].append({"label": run["label"], "force": compared["force"],
                                     **{name: [float(f"{values[i]:.5g}") for i in keep] for name, values in
                                        (("x", x), ("published", published), ("computed", computed))}})
        if "shape" in run:
            extent = shape_of(result, client, run)
            for shape in run["shape"]:
                difference = extent[shape["of"]] - shape["value"]
                record["differences"].append(row_of(run, {}, shape["what"] + ", mm", shape["value"],
                                                    extent[shape["of"]], f"{difference:+.2f} mm", abs(difference),
                                                    shape.get("mm")))
    for (force, percent), values in greatest.items():
        spread = 100 * (max(values) / min(values) - 1)
        record["differences"].append({"what": f"greatest {force} over the meshes, N; spread", "published": None,
                                      "computed": None,
                                      "difference": f"{spread:.1f} %", "size": spread, "bar": percent})
    return record


def run_family(case, programs, folder):
    """The record of cells that change: what each bears over the first, published and computed."""
    family = case["family"]
    client = str(programs / "cellcrush")
    values = []
    for number, member in enumerate(family["members"]):
        drawing, result = folder / f"cells-{number}.csv", folder / f"{case['name']}-{number}"
        words = [word.format(**member) for word in family["cells"]]
        drawing.write_text(call(sys.executable, str(HERE / "cells.py"), *words))
        settings = [word for value in family["set"] for word in ("--set", value.format(**member))]
        call(client, "run", family["case"], "--lattice", str(drawing), "--unit", "mm", "--thickness",
             str(member["thickness"]), *settings, "-o", str(result))
        low, high = family["window"]
        rows = csv.DictReader((result / "history.csv").open())
        stresses = [float(row[family["stress"]]) for row in rows if low <= float(row["strain"]) <= high]
        values.append(family.get("times", 1.0) * sum(stresses) / len(stresses))
    published = [member["value"] for member in family["members"]]
    ratios = [[value / of[0] for value in of] for of in (published, values)]
    places = [member["x"] for member in family["members"]]
    along, quantity = family["along"], family["quantity"]
    rows = [family_row(f"{along} {x:g}, over {places[0]:g}", a, b, family["percent"])
            for x, a, b in list(zip(places, *ratios))[1:]]
    first = family_row(f"{quantity} at {along} {places[0]:g}, {family['unit']}", published[0], values[0], None)
    x, told, borne = zip(*sorted(zip(places, *ratios)))
    curve = {"label": "computed", "force": "", "x": x, "published": told,
             "computed": [float(f"{value:.5g}") for value in borne]}
    return {"name": case["name"], "curves": [curve], "differences": [first, *rows],
            "axes": [along, f"{quantity} over that at {places[0]:g}"]}


def family_row(what, published, computed, bar):
    difference = 100 * (computed / published - 1)
    return {"what": what, "published": float(f"{published:.4g}"), "computed": float(f"{computed:.4g}"),
            "difference": f"{difference:+.1f} %", "size": round(abs(difference), 3), "bar": bar}


def row_of(run, compared, what, published, computed, difference, size, bar):
    force = f", {compared['force']}" if "." in compared.get("force", "") else ""
    return {"what": f"{run['label']}{force}: {what}", "published": float(f"{published:.4g}"),
            "computed": float(f"{computed:.4g}"), "difference": difference, "size": round(size, 3), "bar": bar}


def machine():
    names = [line.split(":")[1].strip() for line in open("/proc/cpuinfo") if line.startswith("model name")]
    return names[0] if names else "unknown"


def run(programs, names):
    unknown = set(names) - {case["name"] for case in cases()}
    if unknown:
        sys.exit(f"cases.json has no {', '.join(sorted(unknown))}")
    RECORDS.mkdir(exist_ok=True)
    version = call(str(programs / "cellcrushd"), "--version").splitlines()[0]
    for case in cases():
        if (names and case["name"] not in names) or case["name"] == "nets":
            continue
        with tempfile.TemporaryDirectory() as folder:
            record = run_case(case, programs, pathlib.Path(folder))
        record.update(version=version, machine=machine(), date=datetime.date.today().isoformat())
        text = re.sub(r"\[\s+([^\[\]{}]*?)\s+\]", lambda found: "[" + " ".join(found[1].split()) + "]",
                      json.dumps(record, indent=1))  # a list in a line
        (RECORDS / f"{case['name']}.json").write_text(text + "\n")
        print(case["name"])
        for row in record["differences"]:
            print(f"  {verdict(row):4} {row['what']}: {row['published']} {row['computed']} {row['difference']}")


def without_place(what):
    return re.sub(r"worst at [^,]* mm", "", what)


def known_misses(case):
    """What misses its limit in the record, too, as the page says, and by how much."""
    record = record_of(case) or {"differences": []}
    return {without_place(row["what"]): row["size"] for row in record["differences"] if verdict(row) == "MISS"}


def check(programs, is_all):
    missed = []
    with tempfile.TemporaryDirectory() as folder:
        for case in cases():
            if case["name"] == "nets" or not (is_all or case.get("short")):
                continue
            if not is_all:
                case["runs"] = case["runs"][:1]
            for row in run_case(case, programs, pathlib.Path(folder))["differences"]:
                print(f"{case['name']}: {row['what']}: {row['published']} {row['computed']} {row['difference']}")
                known = known_misses(case).get(without_place(row["what"]), 0)
                if verdict(row) == "MISS" and row["size"] > 1.1 * known:
                    missed.append(f"{case['name']}: {row['what']}: {row['difference']}, bar {row['bar']}")
    sys.exit("\n".join(missed) if missed else 0)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    commands = parser.add_subparsers(dest="command", required=True)
    for name in ("run", "check"):
        command = commands.add_parser(name)
        command.add_argument("--bin", type=pathlib.Path, required=True, help="folder of cellcrush and cellcrushd")
        if name == "run":
            command.add_argument("names", nargs="*")
        else:
            command.add_argument("--all", action="store_true", help="also the long ones")
    commands.add_parser("page").add_argument("--check", action="store_true")
    options = parser.parse_args()
    if options.command == "page":
        write_page(options.check)
    elif options.command == "check":
        check(options.bin.resolve(), options.all)
    else:
        run(options.bin.resolve(), options.names)


if __name__ == "__main__":
    main()
