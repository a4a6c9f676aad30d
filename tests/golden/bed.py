"""Writes bed.csv: what an elastic bed of stiffness k = 1 N/m over a face carries, in exact fractions.

    python3 tests/golden/bed.py [ROWS] > tests/golden/bed.csv

The face is the square [-1, 1]^2, its apices a (+,+), b (+,-), c (-,-), d (-,+).  The depths are a plane through them, exactly, and so are
their rates.  What is wet is the square cut by the line where the depth is zero; the integrals over that polygon go along its edges (Green's
theorem).  Columns: depths, rates and slope of the damping; forces without and with it, potential; derivatives of the latter by depths and
rates, row by row.  Each is the double next to the exact value.  None is clamped at zero: a force below zero is one that damping turned.
"""
import random
import sys
from fractions import Fraction as F

SIGNS = {"a": (1, 1), "b": (1, -1), "c": (-1, -1), "d": (-1, 1)}


class Polynomial(dict):
    """Coefficients by powers (i, j) of xi^i eta^j."""

    def __mul__(self, other):
        product = Polynomial()
        for (i, j), x in self.items():
            for (k, l), y in other.items():
                product[i + k, j + l] = product.get((i + k, j + l), 0) + x * y
        return product


def plane(level, along, across):
    return Polynomial({(0, 0): F(level), (1, 0): F(along), (0, 1): F(across)})


def weight(apex):
    x, y = SIGNS[apex]
    return plane(F(1, 2), F(x, 2), 0) * plane(F(1, 2), 0, F(y, 2))


def at(p, x, y):
    return sum(c * x**i * y**j for (i, j), c in p.items())


def wet_polygon(depth):
    """The square where depth >= 0, corner by corner."""
    square = [(F(1), F(1)), (F(-1), F(1)), (F(-1), F(-1)), (F(1), F(-1))]
    polygon = []
    for here, there in zip(square, square[1:] + square[:1]):
        h, t = at(depth, *here), at(depth, *there)
        if h >= 0:
            polygon.append(here)
        if h * t < 0:
            share = h / (h - t)
            polygon.append(tuple(x + share * (y - x) for x, y in zip(here, there)))
    return polygon


def powers(x, dx, highest):
    """(x + s dx)^n as coefficients of s, for n = 0 ... highest."""
    rows = [[F(1)]]
    for _ in range(highest):
        last, row = rows[-1], [F(0)] * (len(rows[-1]) + 1)
        for n, c in enumerate(last):
            row[n] += c * x
            row[n + 1] += c * dx
        rows.append(row)
    return rows


class Integrals:
    """Of xi^i eta^j over a polygon, all at once: the sum over its edges of xi^(i+1)/(i+1) eta^j d eta."""

    def __init__(self, polygon, highest=5):
        self.of = {(i, j): F(0) for i in range(highest + 1) for j in range(highest + 1)}
        for (x, y), (u, v) in zip(polygon, polygon[1:] + polygon[:1]):
            if v == y:
                continue
            xs, ys = powers(x, u - x, highest + 1), powers(y, v - y, highest)
            for i, j in self.of:
                self.of[i, j] += (v - y) / (i + 1) * sum(
                    a * b / (m + n + 1) for m, a in enumerate(xs[i + 1]) for n, b in enumerate(ys[j]) if a and b)

    def __call__(self, p):
        return sum(c * self.of[power] for power, c in p.items())


def row(depth, rate, slope):
    """depth, rate: (level, along, across); of area 4 the stiffness per area is 1/4."""
    d, r = plane(*depth), plane(*rate)
    integral = Integrals(wet_polygon(d))
    factor = plane(1 + slope * rate[0], slope * rate[1], slope * rate[2])
    tilt = {j: plane(F(1, 4), F(x, 4), F(y, 4)) for j, (x, y) in SIGNS.items()}  # of the plane, by the value at an apex
    values = [at(d, *SIGNS[i]) for i in SIGNS] + [at(r, *SIGNS[i]) for i in SIGNS] + [slope]
    values += [integral(d * weight(i)) / 4 for i in SIGNS]
    values += [integral(d * weight(i) * factor) / 4 for i in SIGNS]
    values += [integral(d * d) / 8]
    values += [integral(weight(i) * factor * tilt[j]) / 4 for i in SIGNS for j in SIGNS]
    values += [slope * integral(weight(i) * d * tilt[j]) / 4 for i in SIGNS for j in SIGNS]
    for v in values[:9]:
        assert F(float(v)) == v, "an input that no double holds"
    return values


def draw(dice, kind):
    """A plane whose depths at the apices doubles hold exactly: whole numbers of some 2^-n m."""
    unit = F(1, 2**dice.randint(52, 80))
    whole = lambda bits: dice.randint(-2**bits, 2**bits)
    if kind == "any":
        level, along, across = whole(dice.randint(30, 49)), whole(dice.randint(30, 49)), whole(dice.randint(30, 49))
    elif kind == "flat":  # tilts of some units in 2^43: 1e-20 of 1e-7 m
        level, along, across = abs(whole(49)), whole(dice.randint(0, 8)), whole(dice.randint(0, 8))
    elif kind == "corner":  # that is in by little
        p, q, depth = abs(whole(48)) + 1, abs(whole(48)) + 1, dice.randint(1, 2**dice.randint(1, 48))
        level, along, across = depth - p - q, dice.choice([-1, 1]) * p, dice.choice([-1, 1]) * q
    elif kind == "dry corner":
        p, q, depth = abs(whole(48)) + 1, abs(whole(48)) + 1, dice.randint(1, 2**dice.randint(1, 48))
        level, along, across = p + q - depth, dice.choice([-1, 1]) * p, dice.choice([-1, 1]) * q
    elif kind == "strip":  # of any width, more and less skew
        p = abs(whole(49)) + 1
        level = dice.choice([1, -1]) * dice.randint(0, p) if dice.random() < 0.5 else dice.randint(1, 2**dice.randint(1, 48)) - p
        along, across = dice.choice([-1, 1]) * p, dice.choice([0, whole(dice.randint(1, 40)), whole(48)])
        if dice.random() < 0.5:
            along, across = across, along
    elif kind == "border":  # an apex or an edge on the line itself
        p, q = abs(whole(40)), abs(whole(40))
        level, along, across = dice.choice([p + q, p - q, q - p, -p - q]), dice.choice([-1, 1]) * p, dice.choice([-1, 1]) * q
    else:  # dry
        p, q = whole(48), whole(48)
        level, along, across = -abs(p) - abs(q) - dice.randint(0, 2**40), p, q
    return tuple(x * unit for x in (level, along, across))


def main(rows):
    dice = random.Random(2024)
    kinds = ["any", "flat", "corner", "strip", "dry corner", "any", "border", "strip", "flat", "corner", "any", "dry"]
    matrix = [i + j for i in SIGNS for j in SIGNS]
    print(",".join([f"{name}_{i}" for name in ("depth", "rate") for i in SIGNS] + ["slope"] +
                   [f"{name}_{i}" for name in ("elastic", "normal") for i in SIGNS] + ["potential"] +
                   [f"{name}_{ij}" for name in ("by_depth", "by_rate") for ij in matrix]))
    for n in range(rows):
        rate = tuple(F(dice.randint(-2**14, 2**14), 2**20) for _ in range(3))  # up to 16 mm/s
        slope = F(dice.choice([0, 3, 10, 100]))
        print(",".join(repr(float(v)) for v in row(draw(dice, kinds[n % len(kinds)]), rate, slope)))


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 48)
