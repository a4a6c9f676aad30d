"""Runs of the program, each made once: a result of the same scene is taken as it is, one that was cut short goes on."""

from __future__ import annotations

import hashlib
import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import slideway
import xarray as xr
from slideway.program import call
from slideway.scenes import tomllib
from slideway.toml_writer import to_toml


UNITS = {"y": "m", "z": "m", "vy": "m/s", "vz": "m/s", "roll": "rad", "yaw": "rad", "pitch": "rad", "wx": "rad/s", "wy": "rad/s", "wz": "rad/s"}
"""Of the states that a start has."""


@dataclass(frozen=True)
class Run:
    """One result file.

    Attributes:
        name: of the file, without .nc.
        scene: name of the scene in scenes/.
        overrides: dotted keys and their values.
        after: name of the run whose last states are the starts of this one; its end is at the angle at which the scene starts.
        members: how many starts of `after` are taken; None: all.
    """

    name: str
    scene: str
    overrides: Mapping[str, Any] = field(default_factory=dict)
    after: str | None = None
    members: int | None = None


class Missing(Exception):
    """A result that a section needs and that could not be made; the text says why."""


class Laboratory:
    """Makes results and hands them out.

    Args:
        scenes: folder of the scenes.
        output: folder of the results.
        threads: of the program; None: all that this process may use.
        say: takes lines of progress.

    Attributes:
        version: what the program says of itself.
    """

    def __init__(self, scenes: Path, output: Path, threads: int | None = None, say: Callable[[str], None] = print) -> None:
        self._scenes, self._output, self._threads, self._say = scenes, output.resolve(), threads, say
        self.version = call(None, ["--version"]).strip()
        self._failed: dict[str, str] = {}
        self._open: dict[str, xr.Dataset] = {}
        output.mkdir(parents=True, exist_ok=True)

    @property
    def failures(self) -> dict[str, str]:
        """Why runs failed, by their names."""
        return dict(self._failed)

    def make(self, runs: list[Run]) -> None:
        """Makes all that are not there; one that fails does not stop the others."""
        for number, run in enumerate(runs, 1):
            place = f"[{number:3}/{len(runs)}] {run.name}"
            began = time.monotonic()
            try:
                fresh = self._make(run)
            except (slideway.SlidewayError, Missing, OSError) as error:
                self._failed[run.name] = str(error)
                self._say(f"{place}: failed: {error}")
                continue
            self._say(f"{place}: {time.monotonic() - began:.1f} s" if fresh else f"{place}: is there")

    def result(self, name: str) -> xr.Dataset:
        """The result of a run.

        Raises:
            Missing: it could not be made.
        """
        if name not in self._open:
            path = self._output / f"{name}.nc"
            if name in self._failed or not path.exists():
                raise Missing(f"{name}: {self._failed.get(name, 'there is no such result')}")
            self._open[name] = slideway.open(path)
        return self._open[name]

    def _make(self, run: Run) -> bool:
        path, scene_path = self._output / f"{run.name}.nc", self._output / f"{run.name}.toml"
        overrides = dict(run.overrides)
        header = f"# {self.version}\n"
        if run.after is not None:
            table = _starts(self.result(run.after), run.members)
            scene_path.with_suffix(".csv").write_text(table, encoding="utf-8")
            overrides |= {"study.design": "table", "study.table": f"{run.name}.csv", "study.members": None}
            header += f"# starts: {hashlib.sha256(table.encode()).hexdigest()}\n"
        scene = header + to_toml(_merged(self._scenes / run.scene, overrides))
        # Shards beside a result are those of a run that did not come to its end.
        whole = path.exists() and not path.with_name(path.name + ".shards").exists()
        if whole and scene_path.exists() and scene_path.read_text(encoding="utf-8") == scene:
            return False
        path.unlink(missing_ok=True)
        # Beside its result for whoever wants to run it alone: slideway run OUTDIR/NAME.toml
        scene_path.write_text(scene, encoding="utf-8")
        slideway.run(scene_path, path, threads=self._threads, progress=False, resume=True, max_failures="10%").close()
        return True


def _merged(path: Path, overrides: Mapping[str, Any]) -> dict[str, Any]:
    """A scene with other values under dotted keys; None takes a key away."""
    scene = tomllib.loads(path.read_text(encoding="utf-8"))
    for dotted, value in overrides.items():
        table, key = dotted.split(".", 1)
        if value is None:
            scene.get(table, {}).pop(key, None)
        else:
            scene.setdefault(table, {})[key] = value
    return scene


def _starts(result: xr.Dataset, members: int | None) -> str:
    """A table of the states at the end of a result, a row for each member that finished."""
    done = result["member"].values[slideway.finished(result).values][:members]
    if done.size == 0:
        raise Missing("no member of the run before it finished")
    columns = [result[f"final_{name}"].sel(member=done).values for name in UNITS]
    lines = [",".join(f"initial.{name} [{UNITS[name]}]" for name in UNITS)]
    lines += [",".join(f"{value:.17g}" for value in row) for row in zip(*columns, strict=True)]
    return "\n".join(lines) + "\n"
