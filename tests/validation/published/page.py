"""The page of published cases and its pictures, made of the records."""
import re
import sys

from records import HERE, cases, record_of, verdict

PICTURES = HERE / "pictures"
PAGE = HERE.parent / "published.md"
COLOURS = ["#d55e00", "#0072b2", "#009e73", "#cc79a7"]


def ticks(low, high):
    step = 10.0 ** len(str(int(high - low))) if high - low >= 1 else 1.0
    while (high - low) / step < 3:
        for divisor in (2, 2.5, 2):
            step /= divisor
            if (high - low) / step >= 3:
                break
    first = int(low / step) - 1
    return [v for v in (step * (first + i) for i in range(40)) if low - 1e-9 <= v <= high + 1e-9]


def picture(record):
    """Published curves in black, computed ones in colour."""
    width, height, left, right, bottom = 320, 220, 52, 12, 36
    curves = record["curves"]
    labels = list(dict.fromkeys(curve["label"] for curve in curves))
    colours = {label: COLOURS[i % len(COLOURS)] for i, label in enumerate(labels)}
    legend, row, place = [], 0, left
    for text, colour in [("published", "black"), *colours.items()]:
        if place + 20 + 5.6 * len(text) > width:
            row, place = row + 1, left
        legend.append(f'<path d="M{place:g} {11 + 13 * row}h12" stroke="{colour}" stroke-width="2"/>'
                      f'<text x="{place + 15:g}" y="{14 + 13 * row}">{text}</text>')
        place += 24 + 5.6 * len(text)
    top = 22 + 13 * row
    values = [v for curve in curves for name in ("published", "computed") for v in curve[name]]
    unit, factor = ("kN", 1e-3) if max(values) > 1e4 else ("N", 1.0)
    x_label, y_label = record.get("axes", ["displacement (mm)", f"force ({unit})"])
    values = [factor * v for v in values]
    end, low, high = max(curve["x"][-1] for curve in curves), record.get("low", min(0.0, *values)), max(values)
    high += 0.05 * (high - low)

    def px(x):
        return left + (width - left - right) * x / end

    def py(y):
        return height - bottom - (height - top - bottom) * (y - low) / (high - low)

    def line(x, y, colour, stroke):
        path = " ".join(f"{px(a):.1f},{py(factor * b):.1f}" for a, b in zip(x, y))
        return f'<polyline points="{path}" fill="none" stroke="{colour}" stroke-width="{stroke}"/>'

    out = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" font-family="sans-serif" '
           f'font-size="10">', f'<rect width="{width}" height="{height}" fill="white"/>']
    for y in ticks(low, high):
        out.append(f'<path d="M{left} {py(y):.1f}H{width - right}" stroke="#ddd"/>'
                   f'<text x="{left - 4}" y="{py(y) + 3:.1f}" text-anchor="end">{y:g}</text>')
    for x in ticks(0.0, end):
        out.append(f'<path d="M{px(x):.1f} {top}V{height - bottom}" stroke="#ddd"/>'
                   f'<text x="{px(x):.1f}" y="{height - bottom + 12}" text-anchor="middle">{x:g}</text>')
    out.append(f'<text x="{0.5 * (left + width - right)}" y="{height - 6}" text-anchor="middle">{x_label}</text>')
    out.append(f'<text x="12" y="{0.5 * (top + height - bottom)}" text-anchor="middle" '
               f'transform="rotate(-90 12 {0.5 * (top + height - bottom)})">{y_label}</text>')
    for curve in curves:
        out.append(line(curve["x"], curve["computed"], colours[curve["label"]], 1.4))
    published = {}
    for curve in curves:
        published.setdefault(curve["force"], curve)
    out += [line(curve["x"], curve["published"], "black", 1.6) for curve in published.values()]
    return "\n".join([*out, *legend, "</svg>", ""])


def worst_rows(rows):
    """Of several meshes the one that is worst, for each number."""
    groups = {}
    for row in rows:
        groups.setdefault(re.sub(r"^\d+ elements|worst at [^,]* mm", "", row["what"]), []).append(row)
    for group in groups.values():
        worst = max(group, key=lambda row: row["size"])
        yield {**worst, "what": worst["what"] + (f" (worst of {len(group)} meshes)" if len(group) > 1 else "")}


def cell(row):
    numbers = "" if row["published"] is None else f" {row['published']:g}, {row['computed']:g}:"
    limit = "" if row["bar"] is None else f" (limit {row['bar']:g} {row['difference'].split()[-1]}" + (
        ": **missed**)" if verdict(row) == "MISS" else ")")
    return f"{row['what']}:{numbers} {row['difference']}{limit}"


def page():
    """Name and text of each file that is made of the records."""
    files = {}
    rows = []
    for case in cases():
        record = record_of(case)
        made, picture_of, differences = "not run yet", "", ""
        if record is not None:
            files[PICTURES / f"{case['name']}.svg"] = picture(record)
            picture_of = f"![{case['title']}](published/pictures/{case['name']}.svg)"
            differences = "<br>".join(cell(row) for row in worst_rows(record["differences"]))
            made = ", ".join(record[key] for key in ("date", "version", "machine") if key in record)
        rows.append(f"| {case['title']} | {case['source']} | {case['assumed']} | {picture_of} | {differences} | "
                    f"{case['causes']} | {made or 'test PublishedNets'} |")
    names = ["Case", "Published", "Assumed", "Published (black) and computed", "Published, computed: difference",
             "Causes of differences", "Run"]
    table = "\n".join([f"| {' | '.join(names)} |", "|---" * len(names) + "|", *rows])
    files[PAGE] = f"""{(HERE / "head.txt").read_text()}
<!-- table: cases -->

{table}

<!-- end of table -->
"""
    return files


def write_page(is_check):
    stale = [path for path, text in page().items() if not path.exists() or path.read_text() != text]
    if is_check:
        sys.exit(f"stale: {', '.join(str(p) for p in stale)}. Run published.py page" if stale else 0)
    PICTURES.mkdir(exist_ok=True)
    for path, text in page().items():
        path.write_text(text)
