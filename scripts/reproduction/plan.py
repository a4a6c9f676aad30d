"""Which runs the tables and figures need."""

from __future__ import annotations

from typing import Any

from .claims import LAWS
from .runs import Run
from .scale import Scale

CLEARANCES = {"0.08 mm": 0.08, "0.1 mm": 0.1, "0.15 mm": 0.15, "0.22 mm": 0.22, "0.3 mm": 0.3, "0.5 mm": 0.5}
"""Slider-cranks at π rad/s, by their clearance per side [mm]."""
SPEEDS = {"π rad/s": "0.1mm", "1.22π rad/s": "0.1mm_1.22pi", "2π rad/s": "0.1mm_2pi"}
"""Slider-cranks with 0.1 mm of clearance, by their speed."""
MAPS = {"0.08 mm": 0.08, "0.1 mm": 0.1, "0.3 mm": 0.3, "0.5 mm": 0.5}
"""Clearances of Fig. 17."""
CASES = {"case 1": "1", "case 2": "2", "case 3": "3", "case 4": "4"}
"""Of Table 1."""
CARRIAGE_CLEARANCES = {"0.15 mm": "2", "0.22 mm": "0.22", "0.25 mm": "1"}
"""Carriages at 6 cm/s, by the difference of the widths."""

AUDIT = ["energy_residual", "drive_work", "friction_loss", "damping_loss"]
_CRANK = [*AUDIT, "peak_normal_force", "mean_normal_force", "mode_time", "contact_onsets", "peak_rod_angular_velocity", "rms_rod_angular_velocity",
          "peak_acceleration", "rms_acceleration", "peak_tilt", "normal_force", "rod_angular_velocity"]  # fmt: skip
_CARRIAGE = [*AUDIT, "peak_normal_force", "mode_time", "contact_onsets", "peak_acceleration", "rms_acceleration", "peak_channel_acceleration",
             "acceleration_area", "acceleration_top", "acceleration_front"]  # fmt: skip
_DENSE = [*AUDIT, "mode_time", "peak_normal_force", "normal_force", "surfaces", "lines", "points"]


def crank(clearance: float) -> str:
    """Name of a slider-crank at π rad/s.

    >>> crank(0.1)
    '0.1mm'
    """
    return f"{clearance:g}mm"


def name(family: str, case: str, stage: str, law: str) -> str:
    """Name of a run: crank_0.1mm_settled_paper."""
    return f"{family}_{case}_{stage}_{law}"


def plan(scale: Scale) -> list[Run]:
    """All runs; one that starts from another comes after it."""
    runs: list[Run] = []
    for law in LAWS:
        runs += _cranks(scale, law) + _carriages(scale, law) + _chaos(scale, law)
    return runs


def _keys(law: str, quantities: list[str], revolutions: float, samples: float, verified: int | None = None) -> dict[str, Any]:
    """What runs with series have in common.

    Args:
        verified: members that run again, all of them. Of sliders that lie on their way an explicit method takes hundreds of times what the run
            does: not of those.
    """
    keys = {"contact.law": law, "study.revolutions": revolutions, "study.samples_per_revolution": samples, "study.quantities": quantities}
    return keys if verified is None or law != "paper" else keys | {"study.verify": verified}


def _cranks(scale: Scale, law: str) -> list[Run]:
    cases = {crank(c): c for c in CLEARANCES.values()} | {case: 0.1 for case in SPEEDS.values()}
    runs = []
    for case, clearance in cases.items():
        scene, start = f"slider_crank_{case}.toml", name("crank", case, "start", law)
        keys = _keys(law, _CRANK, scale.revolutions, scale.crank_samples, scale.verified)
        runs.append(Run(start, scene, keys | {"study.members": scale.members, "study.vary": starts(clearance)}))
        runs.append(Run(name("crank", case, "settled", law), scene, keys, after=start))
    dense = _keys(law, _DENSE, scale.dense_revolutions, scale.dense_samples)
    runs.append(Run(name("crank", "0.15mm", "dense", law), "slider_crank_0.15mm.toml", dense, name("crank", "0.15mm", "start", law), scale.dense_members))
    return runs


def _carriages(scale: Scale, law: str) -> list[Run]:
    runs = []
    for case in dict.fromkeys([*CASES.values(), *CARRIAGE_CLEARANCES.values()]):
        scene, start = f"carriage_{case if case in CASES.values() else '1'}.toml", name("carriage", case, "start", law)
        keys = _keys(law, _CARRIAGE, scale.carriage_revolutions, scale.carriage_samples, scale.verified)
        keys |= {"joint.clearance": "0.11 mm"} if case == "0.22" else {}
        # Half the difference of the widths in Table 1 is the clearance per side.
        gap = {"1": 0.125, "2": 0.075, "3": 0.125, "4": 0.125, "0.22": 0.11}[case]
        runs.append(Run(start, scene, keys | {"study.members": scale.carriages, "study.vary": starts(gap)}))
        runs.append(Run(name("carriage", case, "settled", law), scene, keys, after=start))
        if case in CASES.values():
            dense = keys | {"study.revolutions": None, "study.duration": 0.1 * scale.dense_revolutions, "study.samples_per_revolution": None,
                            "study.samples": round(scale.dense_samples * scale.dense_revolutions) + 1}  # fmt: skip
            runs.append(Run(name("carriage", case, "dense", law), scene, dense, start, scale.dense_members))
    return runs


def _chaos(scale: Scale, law: str) -> list[Run]:
    runs = []
    for gap in MAPS.values():
        own = {"contact.law": law, "joint.clearance": f"{gap:g} mm", "study.quantities": AUDIT, "study.vary": starts(gap)}
        maps = {"study.members": scale.maps, "study.transient_revolutions": scale.map_transient, "study.revolutions": scale.map_revolutions}
        exponents = {"study.members": scale.exponents, "study.transient_revolutions": scale.exponent_transient, "study.revolutions": scale.exponent_revolutions,
                     "study.history": scale.exponent_history}  # fmt: skip
        runs.append(Run(name("map", crank(gap), "settled", law), "poincare_0.1mm.toml", own | maps))
        runs.append(Run(name("exponent", crank(gap), "settled", law), "lyapunov_0.1mm.toml", own | exponents))
    series = _keys(law, [*AUDIT, "x"], scale.series_revolutions, scale.series_samples)
    runs.append(Run(name("series", "0.1mm", "settled", law), "slider_crank_0.1mm.toml", series, name("crank", "0.1mm", "start", law), scale.series))
    return runs


def starts(clearance: float) -> dict[str, Any]:
    """Starts scattered within the clearance [mm], as in scenes/ensemble_starts.toml: 0.65 of it is used at most, so that all fly free."""
    place, tilt = 0.3 * clearance, 0.01 * clearance

    def even(half: float, unit: str = "") -> dict[str, Any]:
        ends = (f"{-half:.6g} {unit}", f"{half:.6g} {unit}") if unit else (-half, half)
        return {"dist": "unif", "low": ends[0], "high": ends[1]}

    return {"initial.y": even(place, "mm"), "initial.z": even(place, "mm"), **{f"initial.{axis}": even(tilt) for axis in ("roll", "yaw", "pitch")}}
