"""What rigid members save in studies of compliant ones: slideway.control_variate on the crosshead of docs/tutorial/study.md and on scenes/rigid_starts.toml.

Usage: control_variates.py [-o TABLE.csv]; needs the slideway package.  Under two minutes on one core.  512 compliant members, 2,048 rigid ones at rtol 1e-4,
the same draws.  Gains are those of the best division between both (docs/how_to/tolerance.md): compliant members alone that give as short an interval, over
what the members of both kinds cost.  Beside them those of a quadratic in the inputs alone, which costs nothing.
"""

from __future__ import annotations

import argparse
import csv
import math
import pathlib
import sys
import tempfile
import time
from collections.abc import Mapping
from typing import Any

import numpy as np
import slideway
import xarray as xr

root = pathlib.Path(__file__).resolve().parents[1]
sys.path.insert(0, str(root / "scripts"))
from study.runs import fits, pump, turns  # noqa: E402

few, many = 512, 2048
quantities = ["damping_loss", "friction_loss", "mean_normal_force", "contact_onsets"]
limits = {"damping_loss": pump.impact_limit * turns, "friction_loss": pump.friction_limit * turns}  # of the crosshead [J]
scatter = {
    'study.vary."joint.clearance_y"': {"dist": "truncnorm", "mean": "0.1 mm", "sd": "0.01 mm", "low": "0.07 mm", "high": "0.13 mm"},
    'study.vary."friction.kinetic"': {"dist": "truncnorm", "mean": 0.1, "sd": 0.01, "low": 0.07, "high": 0.13},
    'study.vary."contact.restitution"': {"dist": "unif", "low": 0.5, "high": 0.7},
    "friction.static": 0.14,
}


def run(scene: pathlib.Path, keys: Mapping[str, Any], members: int) -> tuple[xr.Dataset, float]:
    """The members that finished, and seconds of processor time of each."""
    ensemble = slideway.Ensemble(scene, threads=1, set={**keys, "study.members": members, "study.verify": 0, "study.quantities": quantities})
    began = time.process_time()
    result = ensemble.run(any_start=True)  # clearances that scatter leave a slider without room, one in 512
    seconds = time.process_time() - began
    return result.sel(member=slideway.finished(result)), seconds / members


def quadratic(result: xr.Dataset) -> list[xr.DataArray]:
    """Of what the members drew: inputs, their squares and products; of an angle sine and cosine."""
    drawn = [result[name] for name in result.data_vars if str(name).startswith(("joint_", "friction_k", "contact_r", "mechanism_crank", "load_", "initial_"))]
    angle = result.mechanism_start_angle
    inputs = [(x - x.mean()) / x.std() for x in (*drawn, angle, np.sin(angle), np.cos(angle))]
    return inputs + [a * b for i, a in enumerate(inputs) for b in inputs[i:]]


def best_gain(correlation: float, ratio: float) -> float:
    """Of the best division.

    >>> round(best_gain(1, 1 / 7), 9)
    7.0
    """
    return 1 / (math.sqrt(1 - correlation**2) + correlation * math.sqrt(ratio)) ** 2


def rows(name: str, compliant: pathlib.Path, rigid: pathlib.Path, keys: Mapping[str, Any], yields: bool) -> list[list[str]]:
    """One of each quantity."""
    costly, seconds = run(compliant, keys, few)
    cheap, cheap_seconds = run(rigid, {**keys, "contact.law": "rigid", "integrator.rtol": 1e-4, "integrator.atol": 1e-4}, many)
    ratio = cheap_seconds / seconds
    inputs = quadratic(costly)
    pairs = {quantity: (costly[quantity], cheap[quantity]) for quantity in quantities}
    if yields:
        pairs |= {f"yield, {q}": (costly[q] <= limit, cheap[q] <= limit) for q, limit in limits.items()}
    made = []
    for quantity, (values, others) in pairs.items():
        if 0.01 < float(values.mean()) < 0.99 or not quantity.startswith("yield"):
            rho = slideway.control_variate(values, others).correlation
            free = slideway.control_variate(values, inputs).correlation
            made.append([name, f"1/{1 / ratio:.0f}", quantity, f"{rho:.4f}", f"{best_gain(rho, ratio):.1f}", f"{1 / (1 - free**2):.1f}"])
    return made


def main() -> None:
    """All studies, as a table."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("-o", "--output", type=pathlib.Path, help="the table, as CSV")
    options = parser.parse_args()
    table = [["study", "cost_of_a_rigid_member", "quantity", "correlation", "gain", "gain_by_inputs_alone"]]
    crosshead = root / "scenes/crosshead.toml"
    for fit in (fits[0], fits[2], fits[3]):
        table += rows(fit.name, crosshead, crosshead, {'study.vary."joint.clearance_y"': fit.clearance()}, True)
    starts = root / "scenes/rigid_starts.toml"
    with tempfile.TemporaryDirectory() as folder:
        compliant = pathlib.Path(folder) / "compliant.toml"
        compliant.write_text(starts.read_text(encoding="utf-8").replace('law = "rigid"\n', ""), encoding="utf-8")
        table += rows("rigid_starts", compliant, starts, scatter, False)
    csv.writer(sys.stdout, lineterminator="\n").writerows(table)
    if options.output:
        with options.output.open("w", encoding="utf-8", newline="") as file:
            csv.writer(file, lineterminator="\n").writerows(table)


if __name__ == "__main__":
    main()
