"""How often the verdict on a study's numbers is right: random studies, good and bad, beside the truth.

Each study runs with its check. The truth is all of its members by two methods at a thousandth of its tolerance. A number is *wrong* where
both differ from it by more than its margin, *right* where both differ by less than half of it; numbers between are not counted.

    python -m evidence.verdicts PROGRAM FOLDER [--studies 400] [--first 0] [--seed 1]
"""

from __future__ import annotations

import argparse
import json
from collections import Counter
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
import slideway
import xarray as xr

PLANAR = (
    'kind = "planar_slider_crank"\ncrank_length = "30 mm"\nrod_length = "120 mm"\ncrank_mass = 0.3\nrod_mass = 0.25\nslider_mass = 0.35\n'
    "crank_inertia = 1.5e-4\nrod_inertia = 4e-4\nslider_inertia_z = 6e-5\n"
)


class Study:
    """A random study, from its number alone."""

    def __init__(self, number: int, seed: int) -> None:
        dice = np.random.default_rng([seed, number])
        self.number = number
        self.is_good = number % 2 == 0
        self.chaotic = (number // 2) % 2 == 0
        family = ("planar_rigid", "planar_compliant", "planar_compliant", "spatial_rigid", "spatial_compliant", "spatial_compliant")[(number // 4) % 6]
        self.family = family
        spatial, rigid = family.startswith("spatial"), family.endswith("rigid")
        self.method, tolerance = self._method(dice, rigid)
        self.rtol = tolerance
        speed = float(dice.uniform(20, 80))
        self.lists_speeds = not spatial and dice.random() < 0.2
        design = str(dice.choice(["mc", "lhs", "sobol"]))
        self.members = int(dice.choice([400, 700, 1024])) if not spatial else (600 if rigid else 96)
        if design == "sobol":
            self.members = 1 << int(np.log2(self.members))
        law = "rigid" if rigid else ("" if not spatial else str(dice.choice(["conservative", "kelvin_voigt", "paper", "foundation"])))
        span = float(dice.uniform(0.15, 0.4) if self.chaotic else dice.uniform(0.01, 0.04)) if not spatial else float(
            dice.uniform(0.02, 0.05) if self.chaotic else dice.uniform(0.002, 0.008)
        )
        clearance = float(dice.uniform(3e-5, 2e-4))
        text = f"schema = 1\n[mechanism]\n{PLANAR if not spatial else self._spatial(dice)}"
        if not self.lists_speeds and "free_slider" not in text and "carriage" not in text:
            text += f"crank_speed = {speed}\n"
        text += f'[joint]\nclearance = {clearance}\n'
        if not spatial:
            text += 'slider_length = "40 mm"\nslider_height = "25 mm"\n'
        text += "[contact]\n" + (f'law = "{law}"\n' if law else "")
        if rigid:
            text += f"restitution = {float(dice.uniform(0.3, 0.9))}\n"
        elif not spatial and self.method != "rk4":
            text += "restitution = 0.6\n"
        if dice.random() < 0.7:
            text += "[friction]\nstatic = 0.12\nkinetic = 0.08\n"
        text += f'[integrator]\nmethod = "{self.method}"\n'
        text += f"step = {tolerance}\n" if self.method in ("rk4", "moreau_jean") else f"rtol = {tolerance}\n"
        text += f'[study]\nkind = "tolerance"\ndesign = "{design}"\nmembers = {self.members}\nduration = {span}\nseed = {number + 1}\n'
        if family == "spatial_compliant":
            text += f"verify = {self.members}\n"
        text += 'quantities = ["damping_loss", "contact_onsets", "peak_normal_force", "mode_time", "energy_change"]\n'
        if rigid:
            text = text.replace(', "peak_normal_force"', "")
        text += "[study.vary]\n"
        text += f'"joint.clearance" = {{ dist = "unif", low = {0.8 * clearance}, high = {1.2 * clearance} }}\n'
        if self.lists_speeds:
            text += '"mechanism.crank_speed" = { dist = "values", values = [10, 25, 40, 55, 70, 85] }\n'
        if spatial:
            text += f'"initial.y" = {{ dist = "unif", low = {-0.5 * clearance}, high = {0.5 * clearance} }}\n'
            text += '"initial.roll" = { dist = "unif", low = -5e-4, high = 5e-4 }\n'
        else:
            text += '"initial.wz" = { dist = "norm", mean = 0, sd = 0.1 }\n'
        self.text = text

    def _method(self, dice: np.random.Generator, rigid: bool) -> tuple[str, float]:
        if self.is_good:
            return str(dice.choice(["auto", "auto", "dopri5", "verner65"])), float(10 ** dice.uniform(-8, -5.5))
        if rigid and dice.random() < 0.7:
            return "moreau_jean", float(10 ** dice.uniform(-4.7, -3.3))
        if self.family == "planar_compliant" and dice.random() < 0.4:
            return "rk4", float(10 ** dice.uniform(-5.3, -4.6))
        loose = ["auto", "dopri5", "verner65"] if rigid else ["auto", "dopri5", "bs32", "verner65"]
        return str(dice.choice(loose)), float(10 ** dice.uniform(-2.5, -1))

    @staticmethod
    def _spatial(dice: np.random.Generator) -> str:
        return f'kind = "{dice.choice(["slider_crank", "scotch_yoke", "free_slider", "carriage"])}"\n'


def means(result: xr.Dataset, columns: list[str], members: np.ndarray[Any, Any]) -> dict[str, float]:
    """Of some members."""
    found = {}
    for column in columns:
        variable, _, label = column.split(" ")[0].removesuffix("]").partition("[")
        values = result[variable].sel({result[variable].dims[1]: label}) if label else result[variable]
        found[column] = float(values.values[members].mean()) if members.any() else float("nan")
    return found


def look_at(program: str, study: Study, folder: Path) -> dict[str, Any]:
    """What the program says of a study, and what is true."""
    run = partial(slideway.run, program=program, threads=1, progress=False, force=True, max_failures="100%")
    scene, bare = folder / "scene.toml", folder / "truth.toml"
    scene.write_text(study.text)
    bare.write_text("\n".join(line for line in study.text.splitlines() if not line.startswith(("step =", "rtol =", "verify ="))) + "\n")
    own = run(scene, folder / "own.nc").load()
    said, check = slideway.resolution(own), own.slideway.group("verification")
    assert said is not None
    result: dict[str, Any] = {
        "number": study.number, "family": study.family, "good": study.is_good, "chaotic": study.chaotic, "method": study.method, "rtol": study.rtol,
        "members": study.members, "resolution": said.verdict, "share": float(check.attrs["share_of_work"]), "summary": said.summary[:300],
        "verify": "verify =" in study.text, "numbers": [],
    }  # fmt: skip
    if not said.numbers:
        return result
    columns = [column for column in map(str, said.numbers.checked.values) if "at the end" not in column]
    settings: dict[str, Any] = {"integrator.rtol": 1e-9 if study.method in ("rk4", "moreau_jean") else min(max(1e-13, 1e-3 * study.rtol), 1e-6), "study.verify": 0}
    errors: dict[tuple[str, str], list[float]] = {}
    for method in ("auto", "verner65"):
        truth = run(bare, folder / "truth.nc", set=settings | {"integrator.method": method}).load()
        ended = slideway.finished(own).values
        both = ended & slideway.finished(truth).values
        result.setdefault("lost", []).append(int(ended.sum() - both.sum()))
        for group in map(str, said.numbers.members_of.values):
            of = both if group == "all members" else both & np.isclose(own.mechanism_crank_speed.values, float(group.split(" = ")[1]), rtol=1e-5)
            now, then = means(truth, columns, of), means(own, columns, of)
            for column in columns:
                errors.setdefault((group, column), []).append(now[column] - then[column])
    for (group, column), found in errors.items():
        number = said.numbers.sel(members_of=group, checked=column)
        result["numbers"].append({"group": group, "name": column, "verdict": str(number.verdict.values), "margin": float(number.margin),
                                  "value": float(number.number), "bound": float(number.error_bound), "errors": found})  # fmt: skip
    return result


def judge(results: list[dict[str, Any]]) -> dict[str, Any]:
    """The table of verdicts against what is true."""
    table: Counter[tuple[str, str, str]] = Counter()
    wrong = []
    held = counted = 0
    for result in results:
        for row in result["numbers"]:
            errors = np.abs(row["errors"])
            truth = "wrong" if errors.min() > row["margin"] else "right" if errors.max() < 0.5 * row["margin"] else "between"
            together = "part" if result["chaotic"] else "together"
            table[(together, truth, row["verdict"])] += 1
            if row["verdict"] == "error_bounded":
                counted += 1
                held += bool(errors.min() <= row["bound"])
            if truth == "wrong" and row["verdict"] == "resolved":
                wrong.append((result["number"], row["name"], row["group"], row["margin"], row["errors"]))
    right = sum(n for (_, truth, _), n in table.items() if truth == "right")
    alarms = sum(n for (_, truth, verdict), n in table.items() if truth == "right" and verdict == "not_resolved")
    return {
        "studies": len(results), "good": sum(r["good"] for r in results), "not_checked": sum(not r["numbers"] for r in results),
        "resolutions": {f"{'good' if good else 'bad'} {name}": sum(r["good"] == good and r["resolution"] == name for r in results)
                        for good in (True, False) for name in ("resolved", "error_bounded", "undecided", "not_resolved", "not_checked")},
        "table": {" ".join(key): n for key, n in sorted(table.items())}, "wrongly_resolved": wrong,
        "false_alarms": f"{alarms} of {right} right numbers", "bounds_that_hold": f"{held} of {counted}",
        "largest_share_unasked": max((r["share"] for r in results if not r["verify"]), default=0),
    }


def main() -> None:
    """Runs what is missing and prints the table."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("folder", type=Path)
    parser.add_argument("--studies", type=int, default=400)
    parser.add_argument("--first", type=int, default=0)
    parser.add_argument("--seed", type=int, default=1)
    arguments = parser.parse_args()
    arguments.folder.mkdir(parents=True, exist_ok=True)
    record = arguments.folder / f"verdicts_{arguments.seed}_{arguments.first}.jsonl"
    results = [json.loads(line) for line in record.read_text().splitlines()] if record.exists() else []
    done = {r["number"] for r in results}
    for number in range(arguments.first, arguments.first + arguments.studies):
        if number in done:
            continue
        try:
            results.append(look_at(arguments.program, Study(number, arguments.seed), arguments.folder))
        except slideway.SlidewayError as error:
            print(number, error, flush=True)
            continue
        with record.open("a") as file:
            file.write(json.dumps(results[-1]) + "\n")
    print(json.dumps(judge(results), indent=1))


if __name__ == "__main__":
    main()
