"""Units as people write them, with prefixes that make numbers handy."""

from __future__ import annotations

import re

import numpy as np
from numpy.typing import ArrayLike

raised = str.maketrans("0123456789-", "⁰¹²³⁴⁵⁶⁷⁸⁹⁻")
_prefixed = ("m", "s", "N", "J", "Pa", "Hz", "rad", "m s-1", "rad s-1", "N m")
_prefixes = ((1e9, "G"), (1e6, "M"), (1e3, "k"), (1.0, ""), (1e-3, "m"), (1e-6, "µ"), (1e-9, "n"), (1e-12, "p"))
_spellings = {"m s-1": "m/s", "m s-2": "m/s²", "rad s-1": "rad/s", "s-1": "1/s", "1": ""}


def spelled(units: str) -> str:
    """A unit of a file as people write it; nothing for numbers without one.

    >>> spelled("rad s-1"), spelled("kg m-3"), spelled("1")
    ('rad/s', 'kg m⁻³', '')
    """
    return _spellings.get(units, re.sub(r"(?<=[a-zA-Z])-?\d+\b", lambda power: power.group().translate(raised), units))


def scaled(units: str, values: ArrayLike) -> tuple[float, str]:
    """The factor that brings values into a handy unit, and this unit.

    >>> scaled("m", [2e-5, -8e-5])
    (1000000.0, 'µm')
    >>> scaled("s-1", [640.0])
    (1.0, '1/s')
    """
    numbers = np.abs(np.asarray(values, dtype=float))
    largest = np.max(numbers[np.isfinite(numbers)], initial=0.0)
    if units not in _prefixed or largest == 0:
        return 1.0, spelled(units)
    for size, prefix in _prefixes:
        # Large numbers keep their unit a little longer: 3,900 N reads better than 3.9 kN beside a limit of 1,000 N.
        if largest >= (10 * size if size > 1 else size * (1 - 1e-4)):
            break
    if units in ("s", "rad") and size > 1:
        size, prefix = 1.0, ""
    return float(f"{1 / size:.12g}"), prefix + spelled(units)


def lowered(number: int) -> str:
    """A number as an index.

    >>> "λ" + lowered(12)
    'λ₁₂'
    """
    return "".join("₀₁₂₃₄₅₆₇₈₉"[int(digit)] for digit in str(number))


def plus_minus(value: float, half: float) -> str:
    """A value and the half width of its interval, to two digits of the latter; of small and large ones the power of ten stands apart.

    >>> plus_minus(1.234e-7, 2e-9), plus_minus(-0.0451, 0.0031), plus_minus(2.33075, 1e-9)
    ('(1.234 ± 0.020)·10⁻⁷', '−0.0451 ± 0.0031', '2.33075 ± 0.00001')
    """
    if not np.isfinite(value):
        return "no number"
    if not np.isfinite(half) or half <= 0:
        return _minus(f"{value:.4g}")
    # More than six digits say nothing: an interval that is narrower is rounded up to the last of them.
    half = max(half, 10.0 ** np.floor(np.log10(abs(value))) * 1e-5) if value else half
    size = int(np.floor(np.log10(max(abs(value), half))))
    power = size if size >= 5 or size <= -4 else 0
    mean, width = value / 10.0**power, half / 10.0**power
    digits = 0 if half <= abs(value) * 1.0001e-4 else 1
    places = digits - int(np.floor(np.log10(width) + 1e-9))
    text = _minus(f"{round(mean, places):.{max(places, 0)}f} ± {round(width, places):.{max(places, 0)}f}")
    return f"({text})·10{str(power).translate(raised)}" if power else text


def _minus(text: str) -> str:
    return text.replace("-", "−") if "e" not in text else ("−" + text[1:] if text.startswith("-") else text)
