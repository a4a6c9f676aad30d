"""What was run: the scene in a few lines, and where the numbers come from."""

from __future__ import annotations

import os
from typing import Any

import numpy as np
import xarray as xr

import slideway
from slideway.ideal import drive_kind
from slideway.scenes import varied
from slideway.way import mean_clearance

from .numbers import amount, counted, number

Facts = list[tuple[str, str]]

STUDIES = {
    "ensemble": "ensemble: every member to the end time",
    "lyapunov": "lyapunov: how fast neighbouring motions part",
    "poincare": "poincare: states at sections of the orbit",
    "sweep": "sweep: sections and exponents as one key changes",
    "tolerance": "tolerance: how quantities scatter with what varies",
}
# Keys of [contact] that several laws have; what else stands there is the law's own.
CONTACT = {
    "law", "slider_young_modulus", "way_young_modulus", "slider_poisson_ratio", "way_poisson_ratio", "edge_radius", "apex_radius",
    "point_stiffness", "hertz_exponent", "eta", "chi_line", "chi_surface", "restitution",
}  # fmt: skip


def of_scene(result: xr.Dataset, members: int) -> Facts:
    """What was asked for."""
    scene = slideway.scene(result)
    study, mechanism, joint, integrator = (scene.get(key, {}) for key in ("study", "mechanism", "joint", "integrator"))
    kind = str(mechanism.get("kind", ""))
    facts = [
        ("study", STUDIES.get(str(study.get("kind")), str(study.get("kind")))),
        ("mechanism", str(result.attrs.get("mechanism_meaning", kind)) + _speed(scene)),
        ("bodies", ", ".join(scene.get("body", {}))),
        ("joints", ", ".join(f"{name} ({_joint(link)})" for name, link in scene.get("link", {}).items())),
        ("clearance per side", "" if any(key.startswith("joint.clearance") for key in varied(result)) else _clearance(joint)),
        ("contact law", _law(result, scene)),
        ("friction", _friction(scene.get("friction", {}))),
        ("members", counted(members, "member") + _design(study)),
        ("time", _time(study)),
        ("integrator", _integrator(integrator)),
    ]
    if "parameter" in study:
        facts.append((f"sweeps: {study['parameter']}", _sweep(result, str(study["parameter"]))))
    vary = study.get("vary", {})
    facts += [(f"varies: {key}", _distribution(form, _unit(result, key))) for key, form in vary.items()]
    facts += [(f"varies: {key}", _sweep(result, key)) for key in varied(result) if key not in (*vary, study.get("parameter"))]
    facts += [(f"limit: {key}", _limit(form)) for key, form in study.get("limits", {}).items()]
    return [(name, words) for name, words in facts if words]


def of_run(result: xr.Dataset) -> Facts:
    """Which program computed it, where and when."""
    path = slideway.results.path_of(result)
    facts = [("file", f"{os.path.basename(path)} ({os.path.getsize(path) / 1e6:.3g} MB)")]
    names = {
        "created": "created", "version": "version", "commit": "commit", "compiler": "compiler", "flags": "compiler flags", "backend": "backend",
        "isa": "instruction set", "threads": "threads", "machine": "machine", "seed": "seed", "completeness": "members in the file",
        "payload_hash": "hash of the data",
    }  # fmt: skip
    facts += [(words, str(result.attrs[name])) for name, words in names.items() if name in result.attrs]
    return facts


def _speed(scene: dict[str, Any]) -> str:
    mechanism, kind = scene.get("mechanism", {}), drive_kind(scene)
    if kind != "speed":
        return {"profile": ", on a profile", "torque": ", on a motor", "free": ", without a drive"}[kind]
    if "crank_speed" in mechanism:
        speed = float(mechanism["crank_speed"])
        return f", crank at {number(speed)} rad/s ({number(speed * 60 / (2 * np.pi))} rpm)"
    if "carriage_speed" in mechanism:
        return f", {number(mechanism['carriage_speed'] * 100)} cm/s"
    return ""


def _clearance(joint: dict[str, Any]) -> str:
    gaps = [gap * 1e3 for gap in (mean_clearance(joint, axis) for axis in ("y", "z")) if not np.isnan(gap)]
    if len(gaps) == 2 and gaps[0] != gaps[1]:
        return f"{number(gaps[0])} mm along Y, {number(gaps[1])} mm along Z"
    return f"{number(gaps[0])} mm" if gaps else ""


def _joint(link: dict[str, Any]) -> str:
    gap = f", clearance {number(1e3 * link['clearance'])} mm" if "clearance" in link else ""
    return f"{link['kind']} of {link['first']} and {link['second']}{gap}"


def _law(result: xr.Dataset, scene: dict[str, Any]) -> str:
    contact = scene.get("contact", {})
    words = [str(contact.get("law", "point law of each joint" if "link" in scene else "point law at each corner"))]
    if "law" in contact and "contact_law_meaning" in result.attrs:
        words[0] += f": {result.attrs['contact_law_meaning']}"
    words += [f"{key} {number(value)}" for key, value in contact.items() if key not in CONTACT]
    if "restitution" in contact:
        words.append(f"restitution {number(contact['restitution'])}")
    elif "eta" in contact:
        damping = ", ".join(f"{key} {number(contact[key])}" for key in ("eta", "chi_line", "chi_surface") if contact.get(key))
        words.append(f"damping {damping or 'none'}")
    return "; ".join(words)


def _friction(friction: dict[str, Any]) -> str:
    if not friction.get("enabled", False):
        return "none"
    return f"static {number(friction['static'])}, kinetic {number(friction['kinetic'])}"


def _design(study: dict[str, Any]) -> str:
    design = f", design {study['design']}" if "design" in study and study["design"] != "mc" else ""
    return design + (", as statistics only" if study.get("store") == "statistics" else "")


def _time(study: dict[str, Any]) -> str:
    parts = []
    for key, words in (
        ("transient_revolutions", "{} revolutions of transient"),
        ("Ttr", "{} s of transient"),
        ("revolutions", "{} revolutions"),
        ("duration", "{} s"),
    ):
        if key in study:
            parts.append(words.format(number(study[key])))
    return ", then ".join(parts)


def _unit(result: xr.Dataset, key: str) -> str:
    variable = key.replace(".", "_")
    return str(result[variable].attrs.get("units", "1")) if variable in result else "1"


def _integrator(integrator: dict[str, Any]) -> str:
    tolerances = [f"{key} {number(integrator[key])}" for key in ("rtol", "atol", "step") if key in integrator]
    return ", ".join([str(integrator.get("method", "")), *tolerances])


def _sweep(result: xr.Dataset, key: str) -> str:
    variable = key.replace(".", "_")
    if variable not in result:
        return ""
    values = np.unique(result[variable].values)
    unit = _unit(result, key)
    return f"{counted(len(values), 'value')} from {amount(float(values[0]), unit)} to {amount(float(values[-1]), unit)}"


def _distribution(form: dict[str, Any], unit: str) -> str:
    def written(key: str, value: object) -> str:
        if isinstance(value, (int, float)):
            return f"{key} {number(value) if key in ('shape', 'levels') else amount(value, unit)}"
        return f"{key} {value}"

    arguments = ", ".join(written(key, value) for key, value in form.items() if key != "dist")
    return f"{form.get('dist', '')}: {arguments}" if arguments else str(form.get("dist", ""))


def _limit(form: dict[str, Any]) -> str:
    return ", ".join(f"{key} {number(value)}" for key, value in form.items())
