"""Verdicts on synthetic numbers."""

import numpy as np
import pytest
from reproduction.claims import LAWS, growth, judge, percent
from slideway.units import plus_minus

from test_estimates import around


@pytest.mark.parametrize(
    ("paper", "conservative", "words", "kind"),
    [
        (True, True, "holds", "yes"),
        (True, False, "holds only under the paper's law", "part"),
        (False, True, "holds only under the conservative law", "part"),
        (False, False, "does not hold", "no"),
        (None, None, "cannot be told from these runs", "open"),
        (True, None, "holds under the paper's law, undecided under the conservative one", "open"),
        (False, None, "does not hold under the paper's law, undecided under the conservative one", "open"),
        (None, True, "holds under the conservative law, undecided under the paper's", "open"),
        (None, False, "does not hold under the conservative law, undecided under the paper's", "open"),
    ],
)
def test_verdict_is_that_of_both_laws(paper: bool | None, conservative: bool | None, words: str, kind: str) -> None:
    assert (judge(paper, conservative).words, judge(paper, conservative).kind) == (words, kind)


def test_growth_under_one_law_alone_is_the_laws() -> None:
    found = growth(
        "Fig. 0", "It grows.", ["small", "large"], {"paper": [around(1, 0.1), around(2, 0.1)], "conservative": [around(1, 0.01), around(1, 0.01)]}, "N"
    )
    assert found.verdict.words == "holds only under the paper's law"
    assert found.findings["paper"].lines[0] == "small: 1.000 ± 0.032 N"  # t = 2.0227 of 39, 0.1/sqrt(40)
    assert "+100.0 ± 4.5 %" in found.findings["paper"].lines[-1]
    assert set(found.findings) == set(LAWS)


def test_what_does_not_move_does_not_grow() -> None:
    quiet = [around(1e-13, 1e-15), around(9e-13, 1e-15)]
    moving = growth("Fig. 0", "It grows.", ["a", "b"], {"paper": quiet, "conservative": quiet}, "m")
    still = growth("Fig. 0", "It grows.", ["a", "b"], {"paper": quiet, "conservative": quiet}, "m", floor=1e-7)
    assert moving.verdict.words == "holds"
    assert still.verdict.words == "does not hold"
    assert still.findings["paper"].lines[-1] == "nothing moves in 100 % of the starts at least: below 1e-07 m"


def test_numbers_have_the_digits_of_their_intervals() -> None:
    assert plus_minus(684.52, 103.2) == "680 ± 100"
    assert plus_minus(-0.04512, 0.0031) == "−0.0451 ± 0.0031"
    assert plus_minus(1.234e-7, 2e-9) == "(1.234 ± 0.020)·10⁻⁷"
    assert plus_minus(2.0, np.nan) == "2"
    assert plus_minus(np.nan, 1.0) == "no number"
    assert percent(-0.5, 0.013) == "−50.0 ± 1.3 %"
