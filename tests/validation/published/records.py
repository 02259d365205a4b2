"""Where the cases and their records are, and what a record says."""
import csv
import json
import pathlib

HERE = pathlib.Path(__file__).resolve().parent
RECORDS = HERE / "records"


def cases():
    return json.loads((HERE / "cases.json").read_text())


def record_of(case):
    if case["name"] == "nets":
        return nets_record()
    file = RECORDS / f"{case['name']}.json"
    return json.loads(file.read_text()) if file.exists() else None


def verdict(row):
    return "" if row["bar"] is None else "ok" if row["size"] <= row["bar"] else "MISS"


def nets_record():
    """Of the nets, whose record the test PublishedNets writes: moduli with shear over the published ones."""
    rows = list(csv.DictReader((RECORDS / "nets.csv").open()))
    curves, differences = [], []
    for net in dict.fromkeys(row["net"] for row in rows):
        own = [row for row in rows if row["net"] == net]
        ratios = [float(row["computed_shear"]) / float(row["published"]) for row in own]
        curves.append({"label": net, "force": "", "x": [float(row["density"]) for row in own],
                       "published": [1.0] * len(own), "computed": ratios})
        for words, computed, linear, bar in (("without shear", "computed", "linear", 0.3),
                                             ("with shear", "computed_shear", "linear_shear", 1)):
            size = max(100 * abs(float(row[computed]) / float(row[linear]) - 1) for row in own)
            differences.append(difference(f"{net}, {words}, over the linear solution of the same beams, at worst", size,
                                          2, bar))
        spread = 100 * (max(ratios) / min(ratios) - 1)
        words = f"{net}, with shear, over the published modulus: {min(ratios):.3f} to {max(ratios):.3f}, spread"
        differences.append(difference(words, spread, 1, None))
    return {"name": "nets", "curves": curves, "differences": differences, "low": 0.9,
            "axes": ["density", "modulus over the published one"]}


def difference(what, size, digits, bar):
    return {"what": what, "published": None, "computed": None, "difference": f"{size:.{digits}f} %", "size": size,
            "bar": bar}
