"""Quantiles that intervals need."""

from __future__ import annotations

import math


def student_t(freedom: int) -> float:
    """Student's t of a two-sided 95 % interval.

    One and two degrees of freedom have closed forms; from three on Cornish and Fisher's expansion about the normal quantile is
    right within 0.8 %.

    >>> round(student_t(1), 3), round(student_t(2), 3), round(student_t(10), 3)
    (12.706, 4.303, 2.228)
    """
    if freedom == 1:
        return math.tan(0.475 * math.pi)
    if freedom == 2:
        return 0.95 * math.sqrt(2 / (1 - 0.95**2))
    z = 1.959963984540054
    terms = (z, (z**3 + z) / 4, (5 * z**5 + 16 * z**3 + 3 * z) / 96, (3 * z**7 + 19 * z**5 + 17 * z**3 - 15 * z) / 384)
    return float(sum(term / freedom**power for power, term in enumerate(terms)))
