"""Each experiment: the runs that it needs, and the table that they come to."""

from __future__ import annotations

import shutil
from pathlib import Path
from typing import Any

import numpy as np
import slideway
import xarray as xr
from reproduction.estimates import estimate
from reproduction.plan import AUDIT, starts
from reproduction.runs import Laboratory, Run
from reproduction.sections import Table

from .experiment import Build, Experiment, Size
from .loop import loop

LAWS: dict[str, dict[str, Any]] = {
    "published": {"contact.law": "paper"},
    "published, n = 1.4": {"contact.law": "paper", "contact.hertz_exponent": 1.4},
    "published, n = 1.3": {"contact.law": "paper", "contact.hertz_exponent": 1.3},
    "published, radii 5 mm": {"contact.law": "paper", "contact.apex_radius": "5 mm", "contact.edge_radius": "5 mm"},
    "published, η = 0.001": {"contact.law": "paper", "contact.eta": 0.001},
    "published, η = 0.1": {"contact.law": "paper", "contact.eta": 0.1},
    "published, χ = 10 s/m": {"contact.law": "paper", "contact.chi_line": 10, "contact.chi_surface": 10},
    "published, χ = 100 s/m, rtol 1e-8": {"contact.law": "paper", "contact.chi_line": 100, "contact.chi_surface": 100, "integrator.rtol": 1e-8},
    "published, E/10": {"contact.law": "paper", "contact.young_modulus": 2.07e10},
    "published, no friction": {"contact.law": "paper", "friction.enabled": False},
    "published, 2π rad/s": {"contact.law": "paper", "mechanism.crank_speed": "6.283185307179586 rad/s"},
    "published, switches leapt": {"contact.law": "paper", "integrator.locate_modes": False},
    "conservative": {"contact.law": "conservative"},
    "conservative, χ = 10 s/m": {"contact.law": "conservative", "contact.chi_line": 10, "contact.chi_surface": 10},
    "conservative, no damping": {"contact.law": "conservative", "contact.eta": 0},
    "springs at the apices": {"contact.law": "kelvin_voigt", "contact.eta": None},
    "springs and dampers at the apices": {"contact.law": "kelvin_voigt", "contact.eta": None, "contact.apex_damping": 100},
    "an elastic bed": {"contact.law": "foundation", "contact.eta": None},
    "an elastic bed, χ = 10 s/m": {"contact.law": "foundation", "contact.eta": None, "contact.chi_surface": 10},
}
"""Variants of the slider-crank, by what the tables call them: overrides of the standard scene (0.1 mm, π rad/s, n = 1.5, η = 0.01, radii 0.5 mm)."""

_QUANTITIES = [*AUDIT, "mode_time", "contact_onsets"]


SIZES = {
    "full": Size(),
    "quick": Size(
        falls=8, seconds=0.05, members=8, turns=0.05, exponents=8, draws=16, verify=None, laws=("published", "conservative")
    ),
}


def resolution(path: Path, *quantities: str) -> str:
    """What the run says of its own numbers: the worst verdict where no quantities are named, else of each of these the bound of its error."""
    found = slideway.resolution(path)
    if found is None or not found.numbers:
        return "not checked"
    if not quantities:
        return found.verdict.replace("_", " ")
    numbers = found.numbers.isel(members_of=0)
    labels = {str(name).split(" [")[0]: name for name in numbers["checked"].values}
    return "; ".join(_bound(numbers.sel(checked=labels[name])) for name in quantities if name in labels)


def _bound(number: xr.Dataset) -> str:
    """The error of a number at most, as a share of it, with the verdict where that is another."""
    verdict, bound, value = (number[name].item() for name in ("verdict", "error_bound", "number"))
    if verdict == "resolved":
        return "resolved"
    if verdict == "undecided" and value == bound == 0:
        return "0 in all members"
    share = 100 * bound / abs(value) if value else np.inf
    words = f"{share:.{0 if share >= 10 else 1}f} %" if np.isfinite(share) else "unknown"
    return words if verdict == "error_bounded" else f"{words} ({verdict.replace('_', ' ')})"


def mean(values: Any, scale: float = 1.0) -> str:
    """Mean with its 95 % interval, of the numbers that are there."""
    of = estimate(np.asarray(values) * scale)
    if of.count < 2:
        return "–" if of.count == 0 else f"{of.mean:.3g}"
    return f"{of.mean:.3g} ± {of.half_width:.1g}"


def _done(result: xr.Dataset) -> xr.Dataset:
    return result.sel(member=result["member"].values[slideway.finished(result).values])


def fall(laboratory: Laboratory, size: Size, output: Path) -> Experiment:
    """A slider that nothing drives and no friction holds falls once through its clearance."""
    rows = []
    variants: dict[str, dict[str, Any]] = {
        "published": {"contact.law": "paper"},
        "conservative": {"contact.law": "conservative"},
        "conservative, rtol 1e-9": {"contact.law": "conservative", "integrator.rtol": 1e-9},
        "an elastic bed": {"contact.law": "foundation", "contact.eta": None},
    }
    runs = {}
    for name, law in variants.items():
        keys = {
            **law, "friction.enabled": False, "initial.vx": 0.0, "study.members": size.falls, "study.duration": size.seconds, "study.samples": 0,
            "study.quantities": ["energy_change", "damping_loss", "energy_residual", "contact_onsets", "mode_time"], "study.vary": starts(0.1),
        }  # fmt: skip
        if size.verify:
            # What lies on its way takes an explicit method a hundred times as long: there a run at a hundredth of the tolerance stands beside.
            keys["study.verify"] = 0 if name.startswith("conservative") else size.verify
        runs[name] = Run("fall_" + name.replace(" ", "_").replace(",", ""), "free_slider_drop.toml", keys)
    laboratory.make(list(runs.values()))
    for name, run in runs.items():
        result = _done(laboratory.result(run.name))
        free = result["mode_time"].sel(mode_class="free") / size.seconds
        rows.append(
            [
                name, mean(result["damping_loss"], 1e3), mean(result["energy_residual"], 1e3), mean(free, 100), mean(result["contact_onsets"]),
                resolution(output / f"{run.name}.nc", "damping_loss", "energy_residual", "mode_time[free]", "contact_onsets"),
            ]  # fmt: skip
        )
    head = ["law", "taken by damping [mJ]", "made from nothing [mJ]", "in flight [%]", "landings", "errors at most"]
    words = [
        "A slider on its way, without friction, crank or rod, starts at rest within its clearance of 0.1 mm and falls. All the energy that it can "
        f"ever lose is that of its fall, some 0.2 mJ. What contact damping has taken after {size.seconds:g} s is a matter of counting."
    ]
    return Experiment("The experiment that settles it: a fall", words, [Table("Free slider, no friction; mean per member ± 95 %", head, rows)])


def variants(laboratory: Laboratory, size: Size, output: Path) -> Experiment:
    """Energy, flight, amplitude and exponents of each law and each number that the paper leaves open."""
    runs, exponents = {}, {}
    for name in size.laws or LAWS:
        slug = "".join(c if c.isascii() and c.isalnum() else "_" for c in name)
        located = name.startswith("published") and "leapt" not in name
        keys = {
            **LAWS[name], "study.members": size.members, "study.revolutions": size.turns, "study.samples_per_revolution": 2000,
            "study.quantities": _QUANTITIES + (["switching_energy"] if located else []), "study.vary": starts(0.1),
        }  # fmt: skip
        study = {
            **LAWS[name], "study.members": size.exponents, "study.transient_revolutions": size.turns, "study.revolutions": size.turns, "study.history": 0,
            "study.quantities": ["energy_residual"],
        }  # fmt: skip
        if size.verify:
            keys["study.verify"] = size.verify
            # What lies on its way takes an explicit method a hundred times as long, and with shadows longer still: the others take some minutes.
            if name not in ("conservative", "conservative, χ = 10 s/m"):
                study["study.verify"] = size.verify
        runs[name] = Run(f"turn_{slug}", "slider_crank_0.1mm.toml", keys)
        if "leapt" not in name and "rtol" not in name:
            exponents[name] = Run(f"exponent_{slug}", "lyapunov_0.1mm.toml", study)
    laboratory.make([*runs.values(), *exponents.values()])
    rows = []
    for name, run in runs.items():
        result = _done(laboratory.result(run.name))
        seconds = float(result["time"][-1])
        late = result["y"].isel(sample=slice(result.sizes["sample"] // 2, None))
        made = result["energy_residual"]
        work = float(result["drive_work"].mean())
        switches = "–"
        if "switching_energy" in result:
            apart = float(np.abs(made - result["switching_energy"]).sum()) / max(float(np.abs(made).sum()), 1e-30)
            switches = f"{100 * apart:.1g} %"
        largest, seen = "–", "–"
        if name in exponents:
            of = _done(laboratory.result(exponents[name].name))
            largest = mean(of["lyapunov_exponent"].values[:, 0])
            seen = resolution(output / f"{exponents[name].name}.nc", "lyapunov_exponent[1]")
        rows.append(
            [
                name, mean(made / seconds, 1e3), f"{100 * float(made.mean()) / work:.2g} %" if LAWS[name].get("friction.enabled", True) else "–", switches,
                mean(result["mode_time"].sel(mode_class="free") / seconds, 100), f"{1e6 * float(late.std('sample').median()):.2g}", largest,
                f"{resolution(output / f'{run.name}.nc', 'energy_residual', 'mode_time[free]')}; {seen}",
            ]  # fmt: skip
        )
    head = [
        "law", "made [mJ/s]", "of the crank's work", "off Σ jumps of U", "in flight [%]", "amplitude [µm]", "λ₁ [1/s]", "errors at most",
    ]
    words = [
        f"The slider-crank of 0.1 mm at π rad/s, {size.members} starts, {size.turns:g} revolution(s); 0.1 mm, n = 1.5, η = 0.01, radii 0.5 mm, steel, rtol 1e-6, "
        "where nothing else is said. Amplitude: median over the members of the standard deviation of y in the second half, which holds the slow "
        "motion along the way, too. λ₁ of the revolution after the first, from other starts. *Off Σ jumps of U*: how far the residual of the energy "
        "audit is from the sum of the potential's jumps at located switches.",
    ]
    return Experiment("Each law, and each number that the paper leaves open", words, [Table("Slider-crank; mean ± 95 %", head, rows)])


def scatter(laboratory: Laboratory, size: Size, output: Path) -> Experiment:
    """All open numbers at once: a Latin hypercube under the published law."""
    vary = {
        **starts(0.1), "contact.hertz_exponent": {"dist": "unif", "low": 1.3, "high": 1.5}, "contact.eta": {"dist": "unif", "low": 0.001, "high": 0.1},
        "contact.chi_line": {"dist": "unif", "low": 0, "high": 50}, "contact.chi_surface": {"dist": "unif", "low": 0, "high": 50},
        "contact.apex_radius": {"dist": "unif", "low": "0.2 mm", "high": "5 mm"}, "contact.edge_radius": {"dist": "unif", "low": "0.2 mm", "high": "5 mm"},
        "contact.slider_young_modulus": {"dist": "unif", "low": 5e10, "high": 2.1e11}, "friction.kinetic": {"dist": "unif", "low": 0.02, "high": 0.15},
        "mechanism.crank_speed": {"dist": "unif", "low": 1.5, "high": 6.3},
    }  # fmt: skip
    runs = {}
    for words, located in (("located", True), ("leapt", False)):
        keys = {
            "contact.law": "paper", "integrator.locate_modes": located, "study.kind": "tolerance", "study.design": "lhs", "study.members": size.draws,
            "study.revolutions": None, "study.duration": 2 * size.turns, "study.samples_per_revolution": None, "study.samples": 0,
            "study.quantities": _QUANTITIES, "study.vary": vary,
        }  # fmt: skip
        if size.verify:
            keys["study.verify"] = size.verify
        runs[words] = Run(f"scatter_{words}", "slider_crank_0.1mm.toml", keys)
    laboratory.make(list(runs.values()))
    rows, influences = [], []
    for words, run in runs.items():
        result = _done(laboratory.result(run.name))
        made = result["energy_residual"] / (2 * size.turns)
        rows.append(
            [words, *(f"{1e3 * float(made.quantile(q)):.3g}" for q in (0.05, 0.25, 0.5, 0.75, 0.95)),
             f"{100 * float((made > 0).mean()):.0f} %", f"{result.sizes['member']}", resolution(output / f"{run.name}.nc", "energy_residual")]
        )
        for key in vary:
            if key.startswith("initial"):
                continue
            ranks = [np.argsort(np.argsort(values)) for values in (result[key.replace(".", "_")].values, made.values)]
            rho = float(np.corrcoef(*ranks)[0, 1])
            half = 1.96 / np.sqrt(result.sizes["member"] - 3)
            low, high = np.tanh(np.arctanh(rho) + np.array([-half, half]))
            influences.append([words, key, f"{rho:+.2f}", f"{low:+.2f} … {high:+.2f}"])
    quantiles = Table(
        "Energy made under the published law [mJ/s]: quantiles over the draws",
        ["switches", "5 %", "25 %", "50 %", "75 %", "95 %", "above zero", "draws", "errors at most"], rows,
    )
    influence = Table("What it goes with: Spearman's rank correlation, 95 % interval", ["switches", "key", "ρ", "interval"], influences)
    return Experiment(
        "All that is not printed, at once",
        ["A Latin hypercube over the Hertz exponent (1.3 … 1.5, as the paper says), damping, radii, modulus, friction and speed: not what one mechanism does, but what the law does."],
        [quantiles, influence],
    )


def shipped(laboratory: Laboratory, size: Size, output: Path) -> Experiment:
    """Whether the scenes that are shipped are resolved at the settings that they have."""
    folder = Path(__file__).resolve().parents[2] / "scenes"
    clearances = {"carriage_2": 0.075, "carriage": 0.125, "0.08mm": 0.08, "0.15mm": 0.15, "0.22mm": 0.22, "0.3mm": 0.3, "0.5mm": 0.5}
    runs = []
    for path in sorted(folder.glob("*.toml")):
        stem = path.stem
        keys: dict[str, Any] = {"study.verify": max(6, size.exponents // 2)}
        if stem.startswith(("tolerance", "ensemble")):
            keys |= {"study.samples_per_revolution": None, "study.samples": 0}
        elif stem.startswith("planar"):
            keys |= {"study.members": size.exponents, "study.vary": {"initial.y": {"dist": "unif", "low": "-0.3 mm", "high": "0.3 mm"}}}
        else:
            gap = next((c for name, c in clearances.items() if name in stem), 0.1)
            keys |= {"study.members": size.exponents, "study.vary": starts(gap)}
            if stem.startswith(("lyapunov", "poincare")):
                keys |= {"study.transient_revolutions": size.turns, "study.revolutions": size.turns}
            elif stem.startswith("sweep"):
                keys |= {"study.members": 2, "study.transient_revolutions": size.turns, "study.revolutions": 2 * size.turns}
                keys |= {"study.from": "0.1 mm", "study.to": "0.4 mm", "study.points": 4}
            elif not stem.startswith("free"):
                keys["study.revolutions"] = size.turns
        if size.verify:
            runs.append(Run(f"shipped_{stem}", path.name, keys))
    for table in folder.glob("*.csv"):
        shutil.copy(table, output)
    laboratory.make(runs)
    rows = []
    for run in runs:
        result = laboratory.result(run.name)
        rows.append([run.scene, f"{result.sizes['member']}", resolution(output / f"{run.name}.nc")])
    words = [f"Each shipped scene at its own settings, from {size.exponents} scattered starts where it has one, over {size.turns:g} revolution(s), half of the members run again."]
    return Experiment("The shipped scenes", words, [Table("Resolution", ["scene", "members", "figures"], rows)])


EXPERIMENTS: tuple[Build, ...] = (fall, loop, variants, scatter, shipped)
