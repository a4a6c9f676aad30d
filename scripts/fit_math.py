#!/usr/bin/env python3
"""Makes the constants of kernels/math/ and prints them as they stand in the headers, each with the error of its fit.

A developer's tool: it needs mpmath; the build and the tests do not.  Every fit is a minimax fit (Remez exchange in 60
digits); the errors shown are those of the coefficients rounded to double.  The output is the same on every machine.
Usage: fit_math.py [trigonometry] [logarithm] [exponential] [rough_powers] [lambert_w]
"""
import sys

import mpmath as mp

mp.mp.dps = 60


def chebyshev_points(low, high, count):
    return [(low + high) / 2 - (high - low) / 2 * mp.cos(mp.pi * i / (count - 1)) for i in range(count)]


def horner(coefficients, x):
    return mp.polyval(coefficients[::-1], x)


def alternating_extrema(errors, count):
    """Indices of `count` errors of alternating sign, each the largest of its run; None if there are fewer runs."""
    found = []
    for i, e in enumerate(errors):
        if found and (errors[found[-1]] > 0) == (e > 0):
            if abs(e) > abs(errors[found[-1]]):
                found[-1] = i
        else:
            found.append(i)
    while len(found) > count:
        found = found[1:] if abs(errors[found[0]]) < abs(errors[found[-1]]) else found[:-1]
    return found if len(found) == count else None


def first_reference(samples, count):
    return [int(mp.nint(mp.mpf(i) * (samples - 1) / (count - 1))) for i in range(count)]


def polynomial(function, weight, low, high, degree, samples=1000):
    """Double coefficients, lowest first, that make the largest |weight (function - sum)| least; and that error."""
    points = chebyshev_points(mp.mpf(low), mp.mpf(high), samples)
    values = [function(x) for x in points]
    weights = [weight(x) for x in points]
    count = degree + 2
    reference = first_reference(samples, count)
    for _ in range(60):
        rows, right = mp.matrix(count, count), mp.matrix(count, 1)
        for r, i in enumerate(reference):
            for c in range(degree + 1):
                rows[r, c] = points[i] ** c * weights[i]
            rows[r, count - 1] = (-1) ** r
            right[r] = values[i] * weights[i]
        solution = mp.lu_solve(rows, right)
        coefficients = [solution[c] for c in range(degree + 1)]
        errors = [w * (v - horner(coefficients, x)) for w, v, x in zip(weights, values, points)]
        reference = alternating_extrema(errors, count)
        if reference is None or max(map(abs, errors)) <= abs(solution[count - 1]) * (1 + mp.mpf(10) ** -4):
            break
    coefficients = [mp.mpf(float(c)) for c in coefficients]
    return coefficients, max(abs(w * (v - horner(coefficients, x))) for v, w, x in zip(values, weights, points))


def rational(function, weight, low, high, upper, lower, shift, samples=1000):
    """Numerator and denominator (constant term 1) in double, lowest first, that make the largest weighted error least.

    `shift` spreads the first reference evenly in log(x + shift).  A bad one ends at a fit with a pole beside a zero,
    which is worse by orders of magnitude; several were tried by hand.
    """
    points = [mp.exp(t) - shift
              for t in chebyshev_points(mp.log(mp.mpf(low) + shift), mp.log(mp.mpf(high) + shift), samples)]
    values = [function(x) for x in points]
    weights = [weight(x) for x in points]
    count = upper + lower + 2
    reference = first_reference(samples, count)
    level, denominator = mp.mpf(0), [mp.mpf(1)]
    for _ in range(100):
        # N(x) = (v + (-1)^r E/weight) D(x) on the reference, linearised about the last level E and denominator D.
        for _ in range(30):
            rows, right = mp.matrix(count, count), mp.matrix(count, 1)
            for r, i in enumerate(reference):
                x, v, unit = points[i], values[i], (-1) ** r / weights[i]
                d = horner(denominator, x)
                for c in range(upper + 1):
                    rows[r, c] = x ** c
                for c in range(1, lower + 1):
                    rows[r, upper + c] = -(v + unit * level) * x ** c
                rows[r, count - 1] = -unit * d
                right[r] = v + unit * level * (1 - d)
            solution = mp.lu_solve(rows, right)
            numerator = [solution[c] for c in range(upper + 1)]
            denominator = [mp.mpf(1)] + [solution[upper + c] for c in range(1, lower + 1)]
            change, level = abs(solution[count - 1] - level), solution[count - 1]
            if change < abs(level) * mp.mpf(10) ** -8:
                break
        errors = [w * (horner(numerator, x) / horner(denominator, x) - v) for x, v, w in zip(points, values, weights)]
        reference = alternating_extrema(errors, count)
        if reference is None or max(map(abs, errors)) <= abs(level) * (1 + mp.mpf(10) ** -3):
            break
    numerator = [mp.mpf(float(c)) for c in numerator]
    denominator = [mp.mpf(float(c)) for c in denominator]
    return numerator, denominator, max(abs(w * (horner(numerator, x) / horner(denominator, x) - v))
                                       for x, v, w in zip(points, values, weights))


def rounded_to_bits(x, bits):
    """x cut to so many significant bits, so that its product with a small integer is exact."""
    scale = mp.mpf(2) ** (bits - 1 - int(mp.floor(mp.log(x, 2))))
    return mp.floor(x * scale) / scale


def show(name, coefficients, error=None):
    note = '' if error is None else f'   // error {mp.nstr(error, 2)}'
    print(f'{name}:{note}\n    ' + ',\n    '.join(repr(float(c)) for c in coefficients))


def show_parts(name, value, bits):
    """`value` as a sum of doubles; all but the last have the given number of bits."""
    parts = []
    for b in bits:
        parts.append(rounded_to_bits(value, b) if b < 53 else mp.mpf(float(value)))
        value -= parts[-1]
    show(name, parts, abs(value))


def trigonometry():
    # sin x = x + x³ S(x²) and 1 - cos x = x²/2 + x⁴ C(x²), errors relative to sin x and 1 - cos x.
    def s(z):
        x = mp.sqrt(z)
        return (mp.sin(x) - x) / (x * z) if z else -mp.mpf(1) / 6

    def c(z):
        return (1 - mp.cos(mp.sqrt(z)) - z / 2) / z ** 2 if z else -mp.mpf(1) / 24

    quarter, half = (mp.pi / 4) ** 2, (mp.pi / 2) ** 2
    show('sine, |x| <= pi/4', *polynomial(s, lambda z: z + mp.mpf('0.01'), 0, quarter, 5))
    show('versine, |x| <= pi/4', *polynomial(c, lambda z: 2 * z + mp.mpf('0.01'), 0, quarter, 5))
    show('sine, |x| <= pi/2', *polynomial(s, lambda z: z + mp.mpf('0.01'), 0, half, 7))
    show_parts('pi/2 in parts', mp.pi / 2, [33, 53, 53])
    show('2/pi', [2 / mp.pi])


def logarithm():
    # log(1 + f) = f - f²/2 + f³ L(f)
    def function(f):
        if abs(f) < mp.mpf(10) ** -9:
            return mp.mpf(1) / 3 - f / 4
        return (mp.log1p(f) - f + f * f / 2) / f ** 3

    show('logarithm', *polynomial(function, lambda f: f * f + mp.mpf('0.003'), mp.sqrt(0.5) - 1, mp.sqrt(2) - 1, 19))
    show_parts('ln 2 in parts', mp.log(2), [42, 53])


def exponential():
    # exp r = 1 + r + r² E(r)
    def function(r):
        if abs(r) < mp.mpf(10) ** -12:
            return mp.mpf(1) / 2 + r / 6
        return (mp.expm1(r) - r) / r ** 2

    limit = mp.log(2) / 2 * mp.mpf('1.0001')
    show('exponential', *polynomial(function, lambda r: r * r + mp.mpf('0.003'), -limit, limit, 9))
    show('1/ln 2', [1 / mp.log(2)])


def rough_powers():
    # log2(1 + f) = f + f (1 - f) L(f), exact at both ends, so that it is continuous; 2^r, error relative.
    def log(f):
        if not f or f == 1:
            f += mp.mpf(10) ** -20 * (1 - 2 * f)
        return (mp.log(1 + f, 2) - f) / (f * (1 - f))

    show('rough binary logarithm', *polynomial(log, lambda f: f * (1 - f) + mp.mpf(10) ** -6, 0, 1, 2))
    show('rough binary exponential', *polynomial(lambda r: mp.mpf(2) ** r, lambda r: mp.mpf(2) ** -r,
                                                 mp.mpf(-1) / 2, mp.mpf(1) / 2, 3))


def lambert_w():
    # w = -W-1(-exp(-1 - t)) = t + M/D, error relative to w; M/D = 1 + ln w.
    def w(t):
        return -mp.lambertw(-mp.exp(-1 - t), -1).real if t else mp.mpf(1)

    for name, fit in (('t in [0, 7] by s = sqrt(t)',
                       rational(lambda s: w(s * s) - s * s, lambda s: 1 / w(s * s), 0, '2.66', 7, 7, 1)),
                      ('t in [7, 74]', rational(lambda t: w(t) - t, lambda t: 1 / w(t), 7, 74, 9, 9, 5))):
        show(name + ', numerator', fit[0], fit[2])
        show(name + ', denominator', fit[1])


if __name__ == '__main__':
    parts = {f.__name__: f for f in (trigonometry, logarithm, exponential, rough_powers, lambert_w)}
    unknown = [a for a in sys.argv[1:] if a not in parts]
    if unknown:
        sys.exit(f'fit_math.py: no part {unknown[0]!r}; one of: {" ".join(parts)}')
    for name in sys.argv[1:] or parts:
        parts[name]()
