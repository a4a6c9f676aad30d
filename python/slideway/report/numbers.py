"""Numbers as people write them."""

from __future__ import annotations

import math
import re

_raised = str.maketrans("0123456789-", "⁰¹²³⁴⁵⁶⁷⁸⁹⁻")


def number(value: float, digits: int = 4) -> str:
    """A number with so many significant digits, powers of ten raised.

    >>> from slideway.report.numbers import number
    >>> number(0.0376152), number(-5.1537e-07), number(4706.79), number(float("nan"))
    ('0.03762', '−5.154·10⁻⁷', '4707', '–')
    """
    if not math.isfinite(value):
        return "–" if math.isnan(value) else ("∞" if value > 0 else "−∞")
    if value != 0 and not 1e-4 <= abs(value) < 1e6:
        mantissa, exponent = f"{value:.{digits - 1}e}".split("e")
        if "." in mantissa:
            mantissa = mantissa.rstrip("0").rstrip(".")
        return f"{mantissa}·10{str(int(exponent)).translate(_raised)}".replace("-", "−")
    written = f"{value:.{digits}g}"
    if "e" in written:
        written = f"{float(written):.0f}"
    return written.replace("-", "−")


_prefixes = ((1e9, "G"), (1e6, "M"), (1e3, "k"), (1.0, ""), (1e-3, "m"), (1e-6, "µ"), (1e-9, "n"), (1e-12, "p"))
_prefixed = ("m", "s", "N", "J", "Pa", "rad", "N m", "m s-1", "m s-2", "rad s-1", "m/s", "rad/s")


def scaled(size: float, unit: str) -> tuple[float, str]:
    """By what to multiply numbers of about that size, and the unit that they then have.

    >>> from slideway.report.numbers import scaled
    >>> scaled(0.00374, "J"), scaled(4700.0, "N"), scaled(0.02, "1")
    ((1000.0, 'mJ'), (0.001, 'kN'), (1.0, '1'))
    """
    if unit not in _prefixed or not math.isfinite(size) or size == 0:
        return 1.0, unit
    for factor, prefix in _prefixes:
        if abs(size) >= 0.9999 * factor and (factor <= 1 or unit in ("N", "J", "Pa", "N m")):
            return float(f"{1 / factor:.12g}"), prefix + unit
    return 1.0, unit


def unit_words(unit: str) -> str:
    """A unit of a file as people write it.

    >>> from slideway.report.numbers import unit_words
    >>> unit_words("rad s-1"), unit_words("N m")
    ('rad s⁻¹', 'N m')
    """
    return re.sub(r"(?<=[a-zA-Z])-?\d+\b", lambda power: power.group().translate(_raised), unit)


def amount(value: float, unit: str, digits: int = 4) -> str:
    """A number with its unit, with a prefix where that reads better.

    >>> from slideway.report.numbers import amount
    >>> amount(0.0376152, "J"), amount(-5.1525e-07, "J", 3)
    ('37.62 mJ', '−515 nJ')
    """
    factor, named = scaled(value, unit)
    return f"{number(value * factor, digits)} {'' if named == '1' else unit_words(named)}".strip()


def percent(share: float, digits: int = 2) -> str:
    """A share in percent, small ones in parts per million.

    >>> from slideway.report.numbers import percent
    >>> percent(0.354), percent(5.5e-06), percent(-2e-3), percent(0.8958, 3)
    ('35 %', '5.5 ppm', '−0.2 %', '89.6 %')
    """
    if not math.isfinite(share):
        return "–"
    if share != 0 and abs(share) < 1e-4:
        return f"{number(share * 1e6, 2)} ppm"
    return f"{number(100 * share, digits)} %"


def counted(count: int, what: str) -> str:
    """A count with its noun.

    >>> from slideway.report.numbers import counted
    >>> counted(1, "member"), counted(1024, "member")
    ('1 member', '1,024 members')
    """
    return f"{count:,} {what}{'' if count == 1 else 's'}"
