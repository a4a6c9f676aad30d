"""Parts of the pictures whose answer is known."""

import doctest

from pictures import impacts, regimes


def test_examples_in_docstrings_hold() -> None:
    for module in (impacts, regimes):
        assert doctest.testmod(module).failed == 0, module.__name__
