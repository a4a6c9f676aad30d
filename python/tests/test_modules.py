"""slideway.compile(): a law of one's own, in scenes of the program and of Python's process."""

import fcntl
from pathlib import Path

import numpy as np
import pytest
import slideway

SPRING = """
#include "kernels/laws/kelvin_voigt.hpp"

namespace slideway::inline SLIDEWAY_ISA {
struct Spring : KelvinVoigt {
    static constexpr Key keys[] = {
        {"contact.spring", &Inputs::law_a, "N/m", Rule::positive, KeyGroup::law, "stiffness of an apex", 2e7}};
    static constexpr LawInfo info{.name = "spring", .words = "a spring at each apex", .switches = false, .ends_steps = true, .groups = KelvinVoigt::info.groups, .keys = keys};
};
}
#define SLIDEWAY_LAW Spring
"""

SCENE = {
    "schema": 1,
    "contact": {"law": "spring"},
    "study": {"members": 3, "duration": "5 ms", "samples": 5, "quantities": ["peak_normal_force"]},
}


@pytest.fixture
def modules(tmp_path, monkeypatch):
    monkeypatch.setenv("SLIDEWAY_MODULES", str(tmp_path))
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    return tmp_path


def peaks(**settings):
    return slideway.Ensemble(SCENE, set=settings).run().peak_normal_force.values


def test_a_law_is_compiled_changed_and_compared(modules, program):
    (module,) = slideway.compile(SPRING, modules, isa="scalar")  # soonest compiled
    assert (module.kind, module.name, module.was_there) == ("law", "spring", False)
    assert all(str(modules) in file for file in module.files)
    soft = peaks()
    by_program = slideway.run(SCENE, modules / "a.nc", program=program, progress=False)
    np.testing.assert_array_equal(by_program.peak_normal_force, soft)
    np.testing.assert_array_equal(slideway.Ensemble({**SCENE, "contact": {"law": "kelvin_voigt", "apex_stiffness": 2e7}}).run().peak_normal_force, soft)
    assert slideway.compile(SPRING, modules, isa="scalar")[0].was_there
    # The former version stays what it was for who has a scene of it.
    before = slideway.Ensemble(SCENE)
    (changed,) = slideway.compile(SPRING.replace("2e7", "4e7"), modules, isa="scalar")
    assert changed.source != module.source
    stiff = peaks()
    assert (stiff > 1.2 * soft).all()
    np.testing.assert_array_equal(before.run().peak_normal_force, soft)
    np.testing.assert_array_equal(peaks(**{"contact.spring": 2e7}), soft)
    assert module.source in before.resolved
    assert changed.source in slideway.Ensemble(SCENE).resolved


@pytest.mark.slow
def test_a_key_that_became_another_one_is_refused_in_the_same_process(modules):
    slideway.compile(SPRING.replace("spring", "spring_of_units"), modules, isa="scalar")
    scene = {**SCENE, "contact": {"law": "spring_of_units"}}
    slideway.Ensemble(scene)
    slideway.compile(SPRING.replace("spring", "spring_of_units").replace('"N/m"', '"1"'), modules, isa="scalar")
    with pytest.raises(slideway.SlidewayError, match="start anew"):
        slideway.Ensemble(scene)


@pytest.fixture
def motor(program, tmp_path, monkeypatch):
    """The motor of docs/how_to/extending.md, which takes long to compile: once for all tests of a build (tests/system/own_module_fixture.hpp)."""
    results = Path(program).resolve().parents[1] / "gtest"
    cache = results / "cache" if results.is_dir() else tmp_path / "cache"
    monkeypatch.setenv("XDG_CACHE_HOME", str(cache))
    modules = cache / "slideway" / "modules"
    modules.mkdir(parents=True, exist_ok=True)
    with (modules / "lock").open("w") as alone:
        fcntl.flock(alone, fcntl.LOCK_EX)
        slideway.compile(Path(__file__).parents[2] / "tests/extending/motor_yoke.hpp", isa="auto", program=program)


@pytest.mark.usefixtures("motor")
def test_signals_of_a_mechanism_are_drawn_and_summed_up_without_it(program, tmp_path, monkeypatch):
    study = {"members": 8, "duration": "5 ms", "quantities": ["max_motor_torque", "mean_motor_power"], "vary": {"mechanism.stall_torque": {"dist": "unif", "low": 0.4, "high": 0.6}}}
    mechanism = {"kind": "motor_yoke", "crank_speed": 0, "no_load_speed": "60 rad/s"}
    scene = {"schema": 1, "mechanism": mechanism, "contact": {"law": "conservative"}, "study": {**study, "samples": 5, "quantities": ["max_motor_torque", "motor_torque"]}}
    series = slideway.run(scene, tmp_path / "series.nc", program=program, progress=False)
    in_memory = slideway.Ensemble(scene).run()
    tolerance = {**scene, "study": {**study, "kind": "tolerance", "design": "lhs"}}
    slideway.run(tolerance, tmp_path / "tolerance.nc", program=program, progress=False)
    np.testing.assert_array_equal(in_memory.motor_torque.values, series.motor_torque.values)
    # It turns from rest.
    np.testing.assert_array_equal(series.max_motor_torque.values, series.mechanism_stall_torque.values)
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "empty"))
    series, spread = slideway.open(tmp_path / "series.nc"), slideway.open(tmp_path / "tolerance.nc")
    assert (series.motor_torque.dims, series.motor_torque.units, series.motor_torque.long_name) == (("member", "sample"), "N m", "torque of the motor")
    assert (spread.max_motor_torque.units, spread.mean_motor_power.long_name) == ("N m", "power of the motor: time mean")
    assert slideway.plot.time_series(series, "motor_torque").get_ylabel().startswith("motor torque [")
    assert slideway.plot.quantiles(spread, "max_motor_torque").get_xlabel().startswith("max motor torque [")
    assert spread.slideway.statistics.max_motor_torque_mean.item() == pytest.approx(spread.max_motor_torque.values.mean())
    assert spread.slideway.sensitivity.max_motor_torque_rank_correlation.item() == pytest.approx(1)


@pytest.mark.slow
def test_what_the_compiler_says_is_there(modules):
    with pytest.raises(slideway.SceneError, match="does not compile it") as caught:
        slideway.compile(SPRING.replace("2e7", "2e7 +"), modules)
    assert "own.hpp:7" in caught.value.stderr
    with pytest.raises(slideway.SceneError, match="offers nothing"):
        slideway.compile("#pragma once\n", modules)
    assert not list(modules.glob("*.so"))


def test_the_package_brings_the_headers_that_it_compiles_with(modules):
    packaged = Path(slideway.__file__).parent / "bin" / "slideway"
    if not packaged.exists():
        pytest.skip("the package is not installed from a wheel")
    (module,) = slideway.compile(Path(__file__).resolve().parents[2] / "tests/extending/hunt_crossley.hpp", modules, isa="scalar", program=packaged)
    result = slideway.run({**SCENE, "contact": {"law": "hunt_crossley"}}, modules / "a.nc", program=packaged, progress=False)
    assert module.source in result.attrs["scene"]
