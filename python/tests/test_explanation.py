"""The forces of a stored state, as a table and as a picture."""

from __future__ import annotations

import warnings

import matplotlib.pyplot as plt
import numpy as np
import pytest
import slideway
from conftest import Result
from matplotlib.text import Annotation


@pytest.fixture(scope="module")
def pushing(result_of: Result) -> slideway.Explanation:
    """The state with the largest force."""
    single = result_of("single")
    return slideway.explain(single, time=float(single.time[int(np.argmax(single.normal_force.values[0]))]))


def test_a_state_is_that_of_the_series(result_of: Result) -> None:
    result = result_of("ensemble")
    found = slideway.explain(result, member=5, time=0.0123)
    there = result.sel(member=5).sel(time=0.0123, method="nearest")
    assert (found.member, found.time, found.stored) == (5, float(there.time), "sample")
    assert all(found.state[name] == float(there[name]) for name in ("y", "vz", "wx"))
    end = slideway.explain(result, member=5)
    assert end.time == float(result.end_time.sel(member=5)) and end.state["y"] == float(result.final_y.sel(member=5))


def test_members_of_given_inputs_are_explained_by_their_own_values() -> None:
    study = {"duration": "20 ms", "samples": 21, "quantities": ["y", "normal_force"]}
    scene = {"schema": 1, "contact": {"law": "conservative"}, "initial": {"y": "-0.0999 mm"}, "study": study}
    result = slideway.Ensemble(scene).run({"joint.clearance": [1e-4, 2e-4], "joint.slider_length": [0.04, 0.08]})
    for member, length in enumerate((0.04, 0.08)):
        time = float(result.time[int(np.argmax(result.normal_force.values[member]))])
        found = slideway.explain(result.sel(member=member), time=time)
        assert (found.member, found.sizes["slider_length"]) == (member, length)
        assert found.table().normal_force.sum() == pytest.approx(float(result.normal_force.sel(member=member, time=time)), rel=1e-9)


def test_pairs_come_to_the_forces(result_of: Result, pushing: slideway.Explanation) -> None:
    table = pushing.table()
    assert table.shape == (16, 7) and table.index.names == ["apex", "face"]
    there = result_of("single").isel(member=0).sel(time=pushing.time)
    force = float(there.normal_force)
    assert force > 0
    assert table.normal_force.sum() == pytest.approx(force, rel=1e-9)
    kinds = [mode["kind"] + "s" for mode in pushing.modes]
    assert all(kinds.count(kind) == float(there[kind]) for kind in ("surfaces", "lines", "points")) and kinds
    of_y = table.normal_force.xs("y_plus", level="face").sum() - table.normal_force.xs("y_minus", level="face").sum()
    assert pushing.force[1] == pytest.approx(of_y + pushing.friction[1], rel=1e-3, abs=1e-3 * force)


def test_picture_has_an_arrow_for_each_force(pushing: slideway.Explanation) -> None:
    forces = pushing.table().normal_force
    rubs = pushing.friction[0] != 0
    count = {axis: sum(force > 0 for (_, face), force in forces.items() if face.startswith(axis)) for axis in "yz"}
    assert sum(count.values()) > 0
    for view, arrows in (("end", count["y"] + count["z"]), ("side", count["y"] + rubs), ("top", count["z"] + rubs)):
        ax = slideway.plot.apex_forces(pushing, plt.subplots()[1], view=view)
        assert len([text for text in ax.texts if isinstance(text, Annotation) and text.arrow_patch is not None]) == arrows, view
        with warnings.catch_warnings():
            warnings.simplefilter("error", UserWarning)
            ax.figure.canvas.draw()


def test_hole_lies_inside_of_the_way_where_it_touches(pushing: slideway.Explanation) -> None:
    ring = slideway.plot.apex_forces(pushing).lines[0]
    half = 500 * pushing.sizes["way_width"]
    heights = {"P4": ring.get_ydata()[0], "P1": ring.get_ydata()[1], "P2": ring.get_ydata()[2], "P3": ring.get_ydata()[3]}
    assert ring.get_xdata()[0] < 0 < ring.get_xdata()[1] and ring.get_ydata()[0] > 0
    for pair in pushing.pairs:
        if pair["apex"] in heights and pair["face"].startswith("y"):
            assert (abs(heights[pair["apex"]]) < half) == pair["touches"]


def test_rigid_states_are_drawn_without_forces(program: str) -> None:
    result = slideway.run({"schema": 1, "contact": {"law": "rigid", "restitution": 0.5}, "study": {"duration": "20 ms", "samples": 11}}, progress=False)
    found = slideway.explain(result, time=0.01)
    assert np.isnan(found.force).all() and np.isfinite([pair["depth"] for pair in found.pairs]).all()
    assert [text.get_text() for text in slideway.plot.apex_forces(found).texts] == ["forces are not told"]


def test_members_with_inputs_of_ones_own_are_explained_and_named(program: str) -> None:
    scene = {"schema": 1, "contact": {"law": "conservative"}, "study": {"duration": "1 ms", "samples": 3, "members": 1}}
    result = slideway.Ensemble(scene).run(inputs={"initial.y": [0.0, 1e-5, 2e-5], "joint.clearance": [1e-4, -1.0, 2e-4]})
    found = slideway.explain(result, member=2)
    assert found.state["y"] == float(result.final_y[2])
    assert found.sizes == slideway.explain(slideway.run(scene, progress=False, joint__clearance=2e-4, initial__y=2e-5)).sizes
    with pytest.raises(slideway.SceneError, match=r'study.table is "" \(no file has this name; members of Ensemble.run\(inputs=...\) are of none\)'):
        slideway.run(slideway.scene(result), progress=False)


def test_what_cannot_be_explained_is_said(result_of: Result) -> None:
    with pytest.raises(slideway.SceneError, match="has no member 9999; it has 0 to 63"):
        slideway.explain(result_of("ensemble"), member=9999)
    with pytest.raises(slideway.SceneError, match="keeps statistics, no states of members"):
        slideway.explain(result_of("stored"))
    with pytest.raises(slideway.SlidewayError, match="apex_forces draws what slideway.explain returns"):
        slideway.plot.apex_forces(result_of("ensemble"))
    with pytest.raises(slideway.SlidewayError, match="view is 'front'; use one of end, side, top"):
        slideway.plot.apex_forces(slideway.explain(result_of("ensemble")), view="front")
