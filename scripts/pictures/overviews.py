"""Pictures of the program's own output and of how it is built."""

from __future__ import annotations

import io
import shutil
import subprocess
import tempfile
from dataclasses import replace
from pathlib import Path

import numpy as np
import pandas as pd
import slideway
from PIL import Image
from slideway.figures.base import panel_of
from slideway.figures.marks import Axis, Curve, Level, Panel, box
from slideway.palette import colours
from slideway.plot.axes import picture

from .drawings import Sheet
from .figures import run


def stability(root: Path) -> str:
    """Energy error over the tolerance of each method, and of rk4 over its step (bench/results/stability.csv)."""
    table = pd.read_csv(root / "bench/results/stability.csv", comment="#")
    table = table[table.law == "conservative"]

    def curve(x: pd.Series, rows: pd.DataFrame, words: str, colour: str) -> Curve:
        return Curve(x.to_numpy(), rows.median_relative_residual.to_numpy(), words, colour, marker="o", size=3.5)

    left, right = [], []
    for colour, method in zip(colours, ("auto", "dopri5", "bs32", "ros34pw2")):
        own = table[(table.axis == "tolerance") & (table.method == method) & (table.finished == table.members)]
        left.append(curve(own.tolerance, own, method, colour))
    for axis, words, colour in (("step", "falling", colours[4]), ("step_lying", "lying", colours[5])):
        own = table[(table.axis == axis) & table.median_relative_residual.notna()].sort_values("step_s")
        right.append(curve(own.step_s / own.linear_limit_s, own, words, colour))
    residual, tolerances = Axis("residual over the losses, median", log=True), np.concatenate([curve.x for curve in left])
    across = Axis("rtol", log=True, low=2 * tolerances.max(), high=tolerances.min() / 2)
    return picture([
        Panel(left, across, residual, "falling, by tolerance"),
        Panel([*right, Level(1, "x", dash="--")], Axis("step over 2√2/Ω", log=True), Axis("", log=True), "rk4, by step"),
    ], 2, 3.4, sharey=True)  # fmt: skip


def plots(root: Path) -> str:
    """Two plots of the Python package (docs/how_to/python.md), of a tolerance study."""
    result = run(root, "scenes/tolerance_0.1mm.toml", "conservative", study__base=256)
    panels = (panel_of(plot, result, "peak_normal_force") for plot in (slideway.plot.quantiles, slideway.plot.sensitivity))
    # Beside the axes the legends would take half of so narrow a picture.
    return picture([replace(panel, legend="lower right") for panel in panels], height=7.4)


def linkage(root: Path) -> str:
    """The four-bar with loose pins at its start (docs/how_to/linkages.md)."""
    return picture([panel_of(slideway.plot.mechanism, root / "scenes/four_bar_journals.toml", angle="40 deg")], height=3.6)


def explain(root: Path) -> str:
    """The state with the largest force of a member, apex by apex (docs/how_to/command_line.md)."""
    result = run(root, "scenes/ensemble_starts.toml", "conservative", study__members=2, study__duration="40 ms", study__samples=4001,
                 study__quantities=["normal_force"])  # fmt: skip
    largest = float(result.time[int(result.normal_force.values[1].argmax())])
    state = slideway.explain(result, member=1, time=largest)
    return picture([panel_of(slideway.plot.apex_forces, state, view=view) for view in ("end", "side")], 2, 3.0)


def report(root: Path) -> bytes:
    """The upper part of the page that `slideway report` writes of a tolerance study, as a browser shows it."""
    browser = shutil.which("chromium") or shutil.which("google-chrome")
    if browser is None:
        raise slideway.SlidewayError("no chromium to show the page; install it (Debian: chromium)")
    result = run(root, "scenes/tolerance_0.1mm.toml", "conservative", study__base=128, study__verify=64)
    with tempfile.TemporaryDirectory() as folder:
        page, shot = Path(folder) / "page.html", Path(folder) / "page.png"
        slideway.report.write(result, page)
        subprocess.run([browser, "--headless=new", "--no-sandbox", "--disable-gpu", "--hide-scrollbars", f"--user-data-dir={folder}/profile",
                        "--window-size=980,1500", "--virtual-time-budget=20000", f"--screenshot={shot}", page.as_uri()],
                       check=True, capture_output=True, timeout=120)  # fmt: skip
        small = io.BytesIO()
        Image.open(shot).convert("RGB").quantize(64, dither=Image.Dither.NONE).save(small, "png", optimize=True)
    return small.getvalue()


_floors = (  # ARCHITECTURE.md, from above
    ("commands", "parse, call, print", 0), ("library, Python module", "in memory", 0), ("study", "what to run, what to conclude", 0),
    ("store", "shards, results, merge", 0), ("run", "blocks over threads and ranks", 0), ("chaos, statistics", "plain numbers", 0),
    ("config, sampling, base", "keys, scenes, designs, files", 0), ("backend", "kernels per instruction set, GPUs", 0),
    ("lanes, rigid", "one member per lane; rigid contacts", 1), ("steppers, observers", "methods, events, quantities", 1),
    ("mechanisms, joint", "equations; eight apices to a wrench", 1), ("laws", "one call per face", 1), ("math, real", "numbers of each instruction set", 1),
)  # fmt: skip


def layers(_: Path) -> str:
    """The layers of the program: host above, kernels below; an upper one includes lower ones."""
    sheet = Sheet(108, 98)
    top = 96.0
    sides: dict[int, list[float]] = {0: [], 1: []}
    for name, words, side in _floors:
        top -= 3.0 if side == 1 and not sides[1] else 0.0
        sheet.shape(box(13.7, top - 5.9, 92.6, 5.4), ("#e3eef8", "#fbe9dd")[side], colours[side], 1.0)
        sheet.text(name, (17, top - 3.2), across="left", bold=True, size=10)
        sheet.text(words, (103, top - 3.2), across="right", size=9.5, colour="#444444")
        sides[side] += [top, top - 6.4]
        top -= 6.9
    for side, words in ((0, "host: moves members, knows no physics"), (1, "kernels: physics")):
        low, high = min(sides[side]), max(sides[side])
        sheet.text(words, (5, (low + high) / 2), colour=colours[side], turn=90, size=10)
        sheet.line([(9.5, low), (9.5, high)], colours[side], 2)
    return sheet.svg()
