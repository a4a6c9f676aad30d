"""The table of docs/evidence/linkages.md: scenes of linkages with published counterparts, beside the same with ideal joints.

Usage: build/python/bin/python scripts/linkage_findings.py [MEMBERS], after scripts/python_environment.sh.  A few minutes on two cores.
"""

from __future__ import annotations

import pathlib
import sys
import tomllib
from typing import Any

import numpy as np
import slideway

scenes = pathlib.Path(__file__).resolve().parents[1] / "scenes"
# Scene, turns, what is varied: of which joints the clearance is multiplied by how much.
rows = [("slider_crank_journal", factor) for factor in (0.2, 0.4, 1.0)] + [("slider_crank_clearances", 1.0), ("four_bar_journal", 0.2), ("four_bar_journal", 1.0),
                                                                          ("four_bar_journals", 1.0), ("six_bar_press", 1.0), ("six_bar_press", 3.0)]


def scaled(scene: dict[str, Any], factor: float) -> dict[str, Any]:
    """With all clearances multiplied, and spread by 1 % about that."""
    vary = {}
    for name, link in scene["link"].items():
        if "clearance" in link:
            middle = factor * float(link["clearance"].split()[0])
            link["clearance"] = f"{middle:g} mm"
            vary[f"link.{name}.clearance"] = {"dist": "unif", "low": f"{0.99 * middle} mm", "high": f"{1.01 * middle} mm"}
    scene["study"]["vary"] = vary
    return scene


def ideal(scene: dict[str, Any]) -> dict[str, Any]:
    """Journals made pins, and a block a slide of the ground."""
    for link in scene["link"].values():
        if link["kind"] == "block":
            link.update(first=link["second"], second=link["first"], first_x="0 m", first_y=link.pop("second_y", "0 m"), position="0.17 m")
        link["kind"] = {"journal": "revolute", "block": "prismatic"}.get(link["kind"], link["kind"])
        for key in ("clearance", "radius", "stiffness", "length", "height"):
            link.pop(key, None)
    for body in (link["second"] for link in scene["link"].values() if link["kind"] == "prismatic"):
        scene["body"][body].pop("angle", None)
    scene["study"].pop("vary", None)
    scene.pop("contact", None), scene.pop("friction", None)
    scene["study"] |= {"members": 1, "verify": 0}
    return scene


def main() -> None:
    """All rows."""
    members = int(sys.argv[1]) if len(sys.argv) > 1 else 64
    quantities = ["peak_normal_force", "peak_crank_torque", "contact_onsets", "energy_residual", "drive_work", "damping_loss", "friction_loss"]
    print("scene; clearance; peak force, N; peak torque, N m; the same of ideal joints; landings a turn; drive's work, lost, J; largest residual, J (rtol 1e-6, 1e-8)")
    for name, factor in rows:
        scene = tomllib.loads((scenes / f"{name}.toml").read_text(encoding="utf-8"))
        turns = scene["study"]["revolutions"]
        scene["study"] |= {"members": members, "samples_per_revolution": 0, "quantities": quantities, "verify": 0}
        perfect = ideal(tomllib.loads((scenes / f"{name}.toml").read_text(encoding="utf-8")))
        perfect["study"] |= {"samples_per_revolution": 0, "quantities": ["peak_crank_torque"]}
        torque = float(slideway.Ensemble(perfect).run().peak_crank_torque.values[0])
        scene = scaled(scene, factor)
        if "friction" not in scene:
            scene["study"]["quantities"] = quantities[:-1]
        loose, tight = (slideway.Ensemble(scene, set={"integrator.rtol": rtol, "integrator.atol": rtol}).run() for rtol in (1e-6, 1e-8))

        def told(quantity: str, share: float = 1, run: Any = tight) -> str:
            values = run[quantity].values * share
            return f"{values.mean():.4g} ± {1.96 * values.std(ddof=1) / np.sqrt(len(values)):.2g}"

        lost = tight.damping_loss.values + (tight.friction_loss.values if "friction" in scene else 0)
        clearance = next(link["clearance"] for link in scene["link"].values() if "clearance" in link)
        residuals = [float(np.abs(run.energy_residual.values).max()) for run in (loose, tight)]
        print(name, clearance, told("peak_normal_force"), told("peak_crank_torque"), f"{torque:.4g}", told("contact_onsets", 1 / turns),
              f"{told('drive_work')}, {lost.mean():.3g}", f"{residuals[0]:.1e}, {residuals[1]:.1e}", sep="; ", flush=True)


if __name__ == "__main__":
    main()
