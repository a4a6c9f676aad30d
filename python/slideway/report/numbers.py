"""Numbers as people write them."""

from __future__ import annotations

import math

from slideway.units import raised, scaled


def number(value: float, digits: int = 4) -> str:
    """A number with so many significant digits, powers of ten raised.

    >>> number(0.0376152), number(-5.1537e-07), number(4706.79), number(float("nan"))
    ('0.03762', '−5.154·10⁻⁷', '4707', '–')
    """
    if not math.isfinite(value):
        return "–" if math.isnan(value) else ("∞" if value > 0 else "−∞")
    if value != 0 and not 1e-4 <= abs(value) < 1e6:
        mantissa, exponent = f"{value:.{digits - 1}e}".split("e")
        if "." in mantissa:
            mantissa = mantissa.rstrip("0").rstrip(".")
        return f"{mantissa}·10{str(int(exponent)).translate(raised)}".replace("-", "−")
    written = f"{value:.{digits}g}"
    if "e" in written:
        written = f"{float(written):.0f}"
    return written.replace("-", "−")


def amount(value: float, unit: str, digits: int = 4) -> str:
    """A number with its unit, with a prefix where that reads better.

    >>> amount(0.0376152, "J"), amount(-5.1525e-07, "J", 3)
    ('37.62 mJ', '−515 nJ')
    """
    factor, named = scaled(unit, value)
    return f"{number(value * factor, digits)} {named}".strip()


def percent(share: float, digits: int = 2) -> str:
    """A share in percent, small ones in parts per million.

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

    >>> counted(1, "member"), counted(1024, "member")
    ('1 member', '1,024 members')
    """
    return f"{count:,} {what}{'' if count == 1 else 's'}"
