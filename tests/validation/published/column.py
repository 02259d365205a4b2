"""The greatest load of a pinned column of a rectangular, perfectly plastic section, with a bow of half a sine wave: its
fibres yield one after another (Chen and Atsuta, Theory of Beam-Columns, 1976). Held to by the strut of cases.json."""
import math

STEPS = 100  # of half the column


def curvature(moment, load, width, thickness, modulus, stress):
    """Of a section under a moment and an axial load; None beyond the full plastic moment."""
    n = load / (width * thickness * stress)
    m = 6 * moment / (stress * width * thickness ** 2)  # over the first yield without load
    at_yield = 2 * stress / (modulus * thickness)
    if m <= 1 - n:
        return m * at_yield
    if m <= 1 + n - 2 * n * n:  # one face yields
        return at_yield * 4 * (1 - n) ** 3 / (3 * (1 - n) - m) ** 2
    full = 1.5 * (1 - n * n)
    return at_yield / math.sqrt(2 * (full - m)) if m < full else None


def end_deflection(load, middle, bow, length, *section):
    """Deflection at the end of half a column whose middle deflects; 0 in equilibrium, None if a section fails."""
    step, x, w, slope = 0.5 * length / STEPS, 0.5 * length, middle, 0.0

    def bend(x, w):
        return curvature(load * (bow * math.sin(math.pi * x / length) + w), load, *section)

    for _ in range(STEPS):
        first = bend(x, w)
        half = None if first is None else bend(x - 0.5 * step, w + 0.5 * step * slope - step ** 2 / 8 * first)
        if half is None:
            return None
        w += step * slope - 0.5 * step ** 2 * half
        slope -= step * half
        x -= step
    return w


def is_borne(load, bow, length, *section):
    """Whether some deflection is in equilibrium, or the column springs back from it."""
    middle = 0.01 * bow
    while middle < length:
        end = end_deflection(load, middle, bow, length, *section)
        if end is None or end >= 0:
            return end is not None
        middle *= 1.005
    return False


def peak_load(bow, length, width, thickness, modulus, stress):
    section = (width, thickness, modulus, stress)
    low, high = 0.0, width * thickness * stress
    while high - low > 1e-4 * high:
        middle = 0.5 * (low + high)
        low, high = (middle, high) if is_borne(middle, bow, length, *section) else (low, middle)
    return low
