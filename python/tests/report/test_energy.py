"""The verdict of the energy audit, from numbers made up so that the shares are round."""

from __future__ import annotations

import math

import pytest
import xarray as xr
from slideway.columns import Column
from slideway.report import energy, figures


def scene(law: str | None, kind: str = "slider_crank", more: str = "", **attributes: object) -> xr.Dataset:
    contact = f'law = "{law}"' if law else ""
    text = f'[mechanism]\nkind = "{kind}"\n{more}\n[contact]\n{contact}\n[study]\nduration = 2.0\n'
    return xr.Dataset(attrs={"scene": text, **attributes})


def quantity(name: str, mean: float, low: float | None = None, high: float | None = None) -> Column:
    low, high = mean if low is None else low, mean if high is None else high
    return Column(name, "", "J", 4, mean, 0.0, low, high, {}, {}, None, None)


def of(law: str, residual: float, worst: float | None = None, **others: float) -> energy.Verdict:
    high = residual if worst is None else worst
    every = [quantity("energy_residual", residual, min(residual, high), max(residual, high))]
    every += [quantity(name, mean) for name, mean in others.items()]
    return energy.verdict(scene(law), every)


def test_the_conservative_law_is_said_to_keep_energy() -> None:
    found = of("conservative", 2e-8, drive_work=0.01)
    assert found.grade == "good"
    assert found.headline == "Energy is kept to 2 ppm"
    assert "makes no energy" in " ".join(found.sentences)
    assert "rtol" in " ".join(found.sentences)


def test_much_residual_of_the_conservative_law_is_the_methods() -> None:
    found = of("conservative", 0.002, drive_work=0.02)
    assert found.grade == "bad"
    assert "10 %" in found.headline
    assert "error of the integration" in " ".join(found.sentences)


def test_a_bad_member_shows_though_the_mean_is_fine() -> None:
    found = of("conservative", 2e-6, worst=5e-5, drive_work=0.01)
    assert found.grade == "warn"
    assert found.headline == "Energy is kept to 0.02 % on average, 0.5 % at worst"


def test_energy_of_mode_switching_is_called_no_physics() -> None:
    found = of("paper", 0.01, drive_work=0.04, damping_loss=0.009)
    words = " ".join(found.sentences)
    assert found.grade == "warn"
    assert found.headline == "The contact law made 25 % of the drive's work"
    assert "not physics" in words
    assert "switches" in words
    assert "10 mJ per member" in words
    assert "5 mJ in each second" in words  # 10 mJ in the 2 s of the scene
    assert "damping took 9 mJ" in words


def test_the_paper_law_that_hardly_switches_is_not_blamed() -> None:
    assert of("paper", 1e-9, drive_work=0.04).grade == "good"


def test_a_law_is_called_by_its_name_and_judged_by_what_the_program_says_of_it() -> None:
    every = [quantity("energy_residual", 2e-8), quantity("drive_work", 0.01)]
    for result in (scene("kelvin_voigt"), scene("kelvin_voigt", contact_law_switches=0)):
        found = energy.verdict(result, every)
        assert found.grade == "good"
        assert "The kelvin_voigt law derives its elastic forces from one potential" in " ".join(found.sentences)
        assert "onservative" not in " ".join(found.sentences)
    rigid = energy.verdict(scene("rigid", contact_law_switches=0), every)
    assert rigid.grade == "good"
    assert "Rigid contacts hold no energy" in " ".join(rigid.sentences)
    jumping = energy.verdict(scene("stepwise", contact_law_switches=1), [quantity("energy_residual", 0.01), every[1]])
    assert jumping.headline == "The contact law made 100 % of the drive's work"
    assert "The stepwise law switches" in " ".join(jumping.sentences)


def test_losses_stand_in_for_work_that_is_not_stored() -> None:
    found = of("paper", 0.01, friction_loss=0.015, damping_loss=0.005)
    assert found.headline == "The contact law made 50 % of what friction and damping took"


TERMS = {"energy_residual": 1e-6, "load_work": 3.0, "ground_work": 2.0, "friction_loss": 0.5, "damping_loss": 0.25, "spring_loss": 0.125, "film_loss": 1.0}


def balance_of(without: str = "", sections: str = "load ground_motion stop film") -> energy.Balance:
    result = scene("conservative", "free_slider", "\n".join(f"[{name}]" for name in sections.split()))
    terms = energy.balance(result, [quantity(name, mean) for name, mean in TERMS.items() if name != without])
    assert terms is not None
    return terms


def test_the_balance_has_every_term_of_the_audit() -> None:
    figure = figures._balance(balance_of(), "the members")
    assert figure is not None
    bars = {bar.label.split(":")[0]: bar.values for bar in figure.variants[0].panels[0].marks}
    assert bars["motion, height, springs"].tolist() == [pytest.approx(3.125001), 0]  # E(t) - E(0) [J], below what came
    assert len(bars) == 8  # all but the drive
    assert sum(bars.values()).tolist() == [pytest.approx(5.000001)] * 2
    assert balance_of().scale_named == (3.0, "the loads' work")


@pytest.mark.parametrize("name", list(TERMS)[1:])
def test_the_balance_is_not_drawn_without_a_term_that_the_scene_has(name: str) -> None:
    assert figures._balance(balance_of(without=name), "the members") is None


def test_terms_that_the_scene_has_not_are_zero() -> None:
    terms = balance_of(without="load_work", sections="ground_motion spring film")
    assert (terms.loads, terms.work, figures._balance(terms, "") is None) == (0.0, 0.0, False)


def test_without_any_scale_nothing_is_judged() -> None:
    found = of("conservative", 3e-6)
    assert found.grade == "none"
    assert "3 µJ" in found.headline
    assert "drive_work" in " ".join(found.sentences)


def test_a_free_crank_is_compared_with_what_it_lost() -> None:
    every = [quantity("energy_residual", 1e-6), quantity("energy_change", -0.5)]
    found = energy.verdict(scene(None, "planar_slider_crank", 'crank = "free"'), every)
    assert found.headline == "Energy is kept to 2 ppm"
    assert "corners" in " ".join(found.sentences)


GAP = """slider_mass = 0.2
gravity = 10.0
[joint]
clearance_y = 1e-4
"""  # M g c = 2e-4 J


def in_gap(kind: str, residual: float, **others: float) -> energy.Verdict:
    every = [quantity("energy_residual", residual), *(quantity(name, mean) for name, mean in others.items())]
    return energy.verdict(scene("conservative", kind, GAP), every)


def test_a_carriage_without_friction_is_compared_with_its_weight() -> None:
    found = in_gap("carriage", -642e-12, drive_work=638e-12, friction_loss=0.0, damping_loss=0.0)
    assert found.grade == "good"
    assert found.headline == "Energy is kept to 3.2 ppm"  # 642e-12 of 2e-4
    assert "the weight's energy across the gap (200 µJ)" in found.sentences[0]
    assert "compared with the weight's energy across the gap" in found.sentences[1]


def test_a_slider_that_turned_over_nothing_yet_is_compared_with_its_weight() -> None:
    assert in_gap("free_slider", 1e-9, friction_loss=10e-9, damping_loss=4e-9, energy_change=-14e-9).grade == "good"


def test_much_residual_beside_the_weight_is_bad() -> None:
    found = in_gap("carriage", 1e-4, drive_work=1e-9, friction_loss=0.0, damping_loss=0.0)
    assert found.grade == "bad"
    assert "50 %" in found.headline


def test_the_largest_energy_is_the_scale_whatever_it_is() -> None:
    named = {"drive_work": "the drive's work", "energy_change": "the change of the mechanical energy"}
    for name, words in named.items():
        assert f"1 % of {words}" in in_gap("carriage", 1e-5, **{name: 1e-3}).sentences[0]
    lost = in_gap("carriage", 1e-5, drive_work=1e-9, friction_loss=6e-4, damping_loss=4e-4)
    assert "1 % of what friction and damping took" in lost.sentences[0]


def test_the_weight_alone_condemns_nothing() -> None:
    assert in_gap("carriage", 1e-6).grade == "none"
    assert in_gap("carriage", 1e-8).grade == "good"


def test_mass_that_follows_from_other_keys_counts() -> None:
    result = scene("conservative", "carriage", GAP.replace("slider_mass = 0.2", "# slider_mass = 0.2  # kg, follows from other keys"))
    terms = energy.balance(result, [quantity("energy_residual", 1e-9)])
    assert terms is not None
    assert terms.scale == pytest.approx(2e-4)


def test_a_planar_slider_is_compared_with_its_motion() -> None:
    more = 'slider_mass = 0.08\ncrank_length = 0.1\ncrank_speed = 50.0\ncrank = "free"'  # ½ · 0.08 · 5² = 1 J
    every = [quantity("energy_residual", 1e-4), quantity("energy_change", -1e-5)]
    found = energy.verdict(scene(None, "planar_slider_crank", more), every)
    assert found.grade == "good"
    assert "kinetic energy at the speed of the crank pin (1 J)" in found.sentences[0]


def test_missing_quantities_are_named() -> None:
    found = energy.verdict(scene("paper"), [])
    assert found.grade == "none"
    assert "study.quantities" in found.sentences[0]


@pytest.mark.parametrize("name", ["work", "friction", "damping"])
def test_unknown_terms_are_no_numbers(name: str) -> None:
    terms = energy.balance(scene("paper"), [quantity("energy_residual", 1.0)])
    assert terms is not None
    assert math.isnan(getattr(terms, name))
