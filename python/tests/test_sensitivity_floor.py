"""Sensitivities of what varies by no more than rounding: plots and pages say that there are none."""

from __future__ import annotations

import pytest
import slideway
import xarray as xr
from slideway.report.figures import _sensitivity

falling = {
    "schema": 1,
    "mechanism": {"kind": "free_slider", "slider_mass": 0.1},
    "joint": {"clearance": 1e-3},
    "contact": {"law": "rigid", "restitution": 0.5},
    "initial": {},
    "study": {
        "kind": "tolerance", "verify": 0, "design": "mc", "members": 64, "duration": 0.2,
        "quantities": ["damping_loss", "friction_loss", "energy_change"],
        "vary": {
            "initial.vx": {"dist": "unif", "low": 0.1, "high": 1.0},
            "initial.y": {"dist": "unif", "low": -1e-4, "high": 1e-4},
            "initial.z": {"dist": "unif", "low": -1e-4, "high": 1e-4},
        },
    },
}  # fmt: skip


@pytest.fixture(scope="module")
def result(program: str, tmp_path_factory: pytest.TempPathFactory) -> xr.Dataset:
    """Falls from unlike heights: the losses follow the height, friction there is none."""
    return slideway.run(falling, tmp_path_factory.mktemp("floor") / "s.nc", progress=False)


def test_plot_of_rounding_is_refused_with_the_reason(result: xr.Dataset) -> None:
    with pytest.raises(slideway.SlidewayError, match="friction_loss has no sensitivities, for it varies by .* no more than its error"):
        slideway.plot.sensitivity(result, "friction_loss")
    assert slideway.plot.sensitivity(result, "damping_loss").get_xlabel() == "rank correlation of damping loss"


def test_page_says_what_has_no_index(result: xr.Dataset) -> None:
    figure = _sensitivity(result)
    assert figure is not None
    assert "Without an index: friction_loss varies by" in figure.caption
    assert {variant.label for variant in figure.variants} == {"damping_loss", "energy_change"}


def test_file_has_no_numbers_and_the_reason(result: xr.Dataset) -> None:
    group = result.slideway.sensitivity
    assert group["friction_loss_rank_correlation"].isnull().all()
    assert int(group["friction_loss_rank"].max()) == 0
    assert float(group["damping_loss_rank_correlation"].sel(input="initial.y")) > 0.99
    assert "friction_loss varies by" in group.attrs["without_index"]
