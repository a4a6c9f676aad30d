"""Prints the largest Lyapunov exponent of a double pendulum of two equal rods (1 m, 1 kg), let go from rest with both level: its interval of 95 %.

    python3 tests/golden/double_pendulum.py [SEED [MEMBERS [DURATION]]]

Lagrange's equations in angles, which the kernels do not use, with the growth of one neighbour along the exact derivative (a complex step of 1e-30); RK4 in steps
of 2 ms.  Members start a microradian apart, and are strangers after 20 s, which do not count.  The norm is of angles and rates as they are; exponents do not
depend on it.
"""

import sys

import numpy as np

GRAVITY, MASS, LENGTH = 9.81, 1.0, 1.0
FIRST = MASS * LENGTH**2 * (1 / 3 + 1)  # of T = FIRST a'^2/2 + SECOND b'^2/2 + BOTH cos(a - b) a' b'
SECOND, BOTH = MASS * LENGTH**2 / 3, MASS * LENGTH**2 / 2
PULL = np.array([1.5, 0.5]) * MASS * GRAVITY * LENGTH  # of V = PULL . sin


def rate(y):
    a, b, u, v = y
    c, s = np.cos(a - b), np.sin(a - b)
    first, second = -BOTH * s * v * v - PULL[0] * np.cos(a), BOTH * s * u * u - PULL[1] * np.cos(b)
    whole = FIRST * SECOND - (BOTH * c) ** 2
    return np.array([u, v, (SECOND * first - BOTH * c * second) / whole, (FIRST * second - BOTH * c * first) / whole])


def both(y, d):
    """The rate, and its derivative along d."""
    z = rate(y + 1e-30j * d)
    return z.real, z.imag / 1e-30


def step(y, d, h):
    k1, j1 = both(y, d)
    k2, j2 = both(y + h / 2 * k1, d + h / 2 * j1)
    k3, j3 = both(y + h / 2 * k2, d + h / 2 * j2)
    k4, j4 = both(y + h * k3, d + h * j3)
    return y + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4), d + h / 6 * (j1 + 2 * j2 + 2 * j3 + j4)


def energy(y):
    a, b, u, v = y
    return FIRST * u * u / 2 + SECOND * v * v / 2 + BOTH * np.cos(a - b) * u * v + PULL[0] * np.sin(a) + PULL[1] * np.sin(b)


def main():
    seed, members, duration = (int(x) for x in (sys.argv[1:] + ["1", "512", "100"][len(sys.argv) - 1 :]))
    random = np.random.default_rng(seed)
    y, d = random.uniform(-1e-6, 1e-6, (4, members)), random.normal(size=(4, members))
    h, between, transient, grown = 2e-3, 25, 20, np.zeros(members)
    for i in range(1, round((transient + duration) / h) + 1):
        y, d = step(y, d, h)
        if i % between == 0:
            size = np.sqrt((d**2).sum(0))
            d /= size
            if i * h > transient:
                grown += np.log(size)
    exponents = grown / duration
    print(f"{exponents.mean():.4f} +- {1.96 * exponents.std(ddof=1) / np.sqrt(members):.4f} 1/s, sd {exponents.std(ddof=1):.3f}, energy changed by {abs(energy(y)).max():.0e} J")


if __name__ == "__main__":
    main()
