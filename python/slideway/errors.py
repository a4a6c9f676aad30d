"""What goes wrong: one family of exceptions, each with one line that says what is wrong and what to do."""

from __future__ import annotations


class SlidewayError(Exception):
    """Whatever slideway cannot do: its text is one line that says what is wrong and what to do.

    >>> try:
    ...     slideway.open("nowhere.nc")
    ... except slideway.SlidewayError as error:
    ...     print(error)
    nowhere.nc: there is no such file; check the path
    """
