"""Signs of exponents: one rule of the program, the functions and the page."""

from __future__ import annotations

import json
from typing import Any

import numpy as np
import pytest
import slideway
import xarray as xr
from conftest import Result
from slideway.exponent_signs import half_width_of_mean
from slideway.program import call
from slideway.report.findings import exponent_words

grows_like_t = "no growth beyond a power of time"


def exponent_of(result: xr.Dataset) -> dict[str, Any]:
    """The largest one, as the program says it."""
    largest: dict[str, Any] = json.loads(call(None, ["info", result.slideway.path, "--json"]))["exponents"][0]
    return largest


def of_growth(*members: tuple[float, float], half: float = 0.01, time: float = 10.0) -> xr.Dataset:
    """Members with these logarithms of the growth of the whole record and of its second half."""
    growth = np.array(members)[:, None, :]
    result = slideway.example().isel(member=slice(0, len(members)))
    for name, values in (("", growth[..., 0] / time), ("_late", growth[..., 1] / (time / 2)), ("_half_width", np.full((len(members), 1), half))):
        result["lyapunov_exponent" + name] = (("member", "exponent"), values, {"units": "s-1"})
    result["lyapunov_time"] = ("member", np.full(len(members), time))
    return result


def test_signs_need_growth_beyond_the_third_power_in_the_second_half() -> None:
    cubic = 3 * np.log(2)  # the second half's interval is 0.01 * 10 / √2 = 0.0707 besides
    result = of_growth((4, np.log(2)), (9, 2 * np.log(2)), (9, cubic + 0.07), (9, cubic + 0.08), (-9, -cubic - 0.08), (-4, -1), (0.05, 9))
    assert slideway.exponent_signs(result).values[:, 0].tolist() == [
        grows_like_t, grows_like_t, grows_like_t, "above zero", "below zero", grows_like_t, "undecided",
    ]  # fmt: skip


def test_signs_are_those_that_the_program_counts(result_of: Result) -> None:
    for name in ("lyapunov", "columns"):
        with result_of(name) as result:
            signs = slideway.exponent_signs(result).values[slideway.finished(result).values, 0].tolist()
            told = exponent_of(result)
        assert signs.count("above zero") == told["members_positive"]
        assert signs.count("below zero") == told["members_negative"]
        assert signs.count(grows_like_t) == told["members_power_of_time"]
        assert len(signs) == told["members_positive"] + told["members_negative"] + told["members_undecided"]


def test_mean_of_members_that_grow_like_a_power_reaches_to_zero(result_of: Result) -> None:
    linear = of_growth(*((4 + 0.01 * k, np.log(2)) for k in range(5)))
    columns = [linear[f"lyapunov_exponent{name}"].values[:, 0] for name in ("", "_half_width", "_late")]
    assert half_width_of_mean(*columns, linear["lyapunov_time"].values) == pytest.approx(columns[0].mean())
    with result_of("lyapunov") as result:
        told = exponent_of(result)["mean"]
        columns = [result[f"lyapunov_exponent{name}"].values[:, 0] for name in ("", "_half_width", "_late")]
        rounding = float(result["lyapunov_resolution"].max())
        assert half_width_of_mean(*columns, result["lyapunov_time"].values) + rounding == pytest.approx(told["half_width"], rel=1e-2)


def test_page_names_members_that_grow_like_a_power_undecided() -> None:
    result = of_growth((4, np.log(2)), (9, 8.0), (0.05, 0.02))
    del result.attrs["sweep_parameter"]
    words = " ".join(exponent_words(result))
    assert "positive in 1, negative in 0 and undecided in 2 of 3 members" in words
    assert "Of 1 of the undecided the interval alone excludes 0" in words


def test_signs_of_a_result_without_exponents_are_refused(result_of: Result) -> None:
    with pytest.raises(slideway.SlidewayError, match="has no lyapunov_exponent; use study.kind"):
        slideway.exponent_signs(result_of("ensemble"))
