"""Arguments of the public functions: what they are made of, or one line that says what is wrong with them."""

from __future__ import annotations

import functools
import os
from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING, Any, ParamSpec, TypeVar

import numpy as np
import xarray as xr

from .errors import SlidewayError

if TYPE_CHECKING:
    from numpy.typing import NDArray

P = ParamSpec("P")
R = TypeVar("R")
_longest = 60  # characters of a value that a message repeats


def one_line(function: Callable[P, R]) -> Callable[P, R]:
    """A public function whose errors are all SlidewayErrors of one line.

    What numpy, xarray, netCDF4 or matplotlib say of arguments that no check of ours has caught becomes the line; their own error
    is its ``__cause__``.
    """

    @functools.wraps(function)
    def checked(*arguments: P.args, **named: P.kwargs) -> R:
        try:
            return function(*arguments, **named)
        except (ArithmeticError, AttributeError, LookupError, OSError, RuntimeError, TypeError, ValueError) as error:
            said = shown(error, 300).removeprefix(type(error).__name__)
            raise SlidewayError(f"{function.__name__} cannot use this: {type(error).__name__}{said}; check its arguments") from error

    return checked


def shown(value: object, longest: int = _longest) -> str:
    """A value as a message repeats it: on one line, and not too long.

    >>> shown("a" * 100)[-5:]
    'aa...'
    """
    return shortened(" ".join(repr(value).split()), longest)


def shortened(text: str, longest: int) -> str:
    """Text of at most so many characters.

    >>> shortened("y, z, vy, vz", 8)
    'y, z,...'
    """
    return text if len(text) <= longest else text[: longest - 3] + "..."


def numbers(value: Any, name: str) -> NDArray[np.float64]:
    """Real numbers, each of which is there: what is imaginary or masked is refused, for numpy would leave it out without a word.

    >>> numbers([1, 2.5], "inputs")
    array([1. , 2.5])
    >>> numbers(np.array([1 + 2j]), "states")
    Traceback (most recent call last):
    slideway.errors.SlidewayError: states is array([1.+2.j]), which is complex; give real numbers in SI units
    >>> numbers(np.ma.masked_equal([1.0, 0.0], 0.0), "inputs")
    Traceback (most recent call last):
    slideway.errors.SlidewayError: inputs has masked entries; fill them (.filled(value)), or leave these members out
    """
    if _is_masked(value):
        raise SlidewayError(f"{name} has masked entries; fill them (.filled(value)), or leave these members out")
    try:
        found = np.asarray(value)
        if found.dtype.kind == "c":
            raise SlidewayError(f"{name} is {shown(value)}, which is complex; give real numbers in SI units")
        if found.dtype.kind in "mM":
            raise SlidewayError(f"{name} is {shown(value)}, which are dates or durations; give numbers in SI units")
        return found.astype(np.float64, copy=False)
    except (TypeError, ValueError):
        raise SlidewayError(f"{name} is {shown(value)}; give numbers in SI units") from None


def _is_masked(value: Any) -> bool:
    if isinstance(value, (list, tuple)):
        return any(_is_masked(part) for part in value)
    return isinstance(value, np.ma.MaskedArray) and bool(np.any(np.ma.getmaskarray(value)))


def dataset(result: object) -> xr.Dataset:
    """A result.

    >>> dataset(3)
    Traceback (most recent call last):
    slideway.errors.SlidewayError: the result is 3 (int), no Dataset; give what slideway.open or slideway.run returned
    """
    if not isinstance(result, xr.Dataset):
        kind = type(result).__name__
        raise SlidewayError(f"the result is {shown(result)} ({kind}), no Dataset; give what slideway.open or slideway.run returned")
    return result


def path(value: object, name: str) -> str:
    """A path as text; of the name of an argument.

    >>> path("", "output")
    Traceback (most recent call last):
    slideway.errors.SlidewayError: output is '', no path; give text or a pathlib.Path
    """
    found = os.fspath(value) if isinstance(value, (str, os.PathLike)) else None
    if not isinstance(found, str) or not found or "\0" in found:
        raise SlidewayError(f"{name} is {shown(value)}, no path; give text or a pathlib.Path")
    return found


def text(value: object, name: str) -> str:
    """A name; empty it is none.

    >>> text(None, "name")
    Traceback (most recent call last):
    slideway.errors.SlidewayError: name is None; give text
    """
    if not isinstance(value, str) or not value:
        raise SlidewayError(f"{name} is {shown(value)}; give text")
    return value


def whole(value: object, name: str, least: int, most: int | None = None) -> int:
    """A whole number from `least` to `most`.

    >>> whole(2.5, "bins", 1)
    Traceback (most recent call last):
    slideway.errors.SlidewayError: bins is 2.5; give a whole number from 1 on
    """
    fits = isinstance(value, (int, np.integer)) and not isinstance(value, bool)
    if not fits or int(value) < least or (most is not None and int(value) > most):  # type: ignore[call-overload]
        raise SlidewayError(f"{name} is {shown(value)}; give a whole number from {least} {'on' if most is None else f'to {most}'}")
    return int(value)  # type: ignore[call-overload, no-any-return]


def positive(value: object, name: str) -> float:
    """A finite number > 0.

    >>> positive("3 h", "max_hours")
    Traceback (most recent call last):
    slideway.errors.SlidewayError: max_hours is '3 h'; give a number > 0
    """
    fits = isinstance(value, (int, float, np.integer, np.floating)) and not isinstance(value, bool)
    if not fits or not 0 < float(value) < float("inf"):  # type: ignore[arg-type]
        raise SlidewayError(f"{name} is {shown(value)}; give a number > 0")
    return float(value)  # type: ignore[arg-type]


def overrides(given: Any, words: Mapping[str, Any], unknown: Callable[[str], str]) -> dict[str, Any]:
    """Dotted keys of a scene and their values: those of the argument `set`, and words with two underscores for the dot.

    Args:
        unknown: what to say of a word that has none.
    """
    if given is not None and not isinstance(given, Mapping):
        raise SlidewayError(f'set is {shown(given)}; give keys and their values: {{"joint.clearance": "0.2 mm"}}')
    named = {text(key, "a key of set"): value for key, value in (given or {}).items()}
    for word, value in words.items():
        if "__" not in word:
            raise SlidewayError(unknown(word))
        named[word.replace("__", ".")] = value
    return named


def members(value: Any, there: Sequence[int], name: str = "member") -> list[int]:
    """Numbers of members: those asked for, each of which is in the result.

    Args:
        value: a number or several.
        there: numbers in the result.

    >>> members([1, 7], [0, 1])
    Traceback (most recent call last):
    slideway.errors.SlidewayError: there is no member 7 in this result; see its coordinate member
    """
    numbers = np.atleast_1d(np.asarray(value))
    if numbers.ndim != 1 or numbers.dtype.kind not in "iu" or numbers.size == 0:
        raise SlidewayError(f"{name} is {shown(value)}; give the number of a member, or a list of numbers")
    wanted = [int(number) for number in numbers]
    for number in wanted:
        if number not in there:
            raise SlidewayError(f"there is no member {number} in this result; see its coordinate member")
    return wanted
