"""How the forces of one stored state come about: what ``slideway probe --explain`` says of it."""

from __future__ import annotations

import json
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from . import arguments
from .program import call
from .results import StrPath, file_of

if TYPE_CHECKING:
    import pandas as pd


@dataclass(frozen=True)
class Explanation:
    """The forces of one state, step by step (model.md sections 3 to 5). What rigid contacts do not tell is NaN.

    Attributes:
        member: its number in the ensemble.
        time: of the state [s].
        stored: where the result has it: "sample", "section" or "end".
        state: the mechanism's state in SI units, by name.
        law: name of the contact law; damping: what damps it, in words.
        pairs: the sixteen pairs of an apex ("P1" … "P8") and a face of the way ("y_plus" …): whether it touches, depth [m], its rate
            [m/s], normal_force [N], sliding_speed [m/s], friction_coefficient and friction [N].
        modes: contacts of each face: face, kind ("surface", "line" or "point") and apices.
        friction: on the slider, along the way's axes [N].
        force: of the way on the slider, friction included, along the ground's axes [N].
        torque: of that about the centre of the slider's hole, likewise [N m].
        sizes: slider_length, way_width and way_depth [m].
        joints: of a linkage, which has none of these but law and damping, its joints with clearance: joint, first and second body, whether it touches,
            x and y of the journal in its bearing (of a block y across its walls, and tilt) [m], depth [m], normal_force, and that on the first body along
            the ground's axes, force_x and force_y [N].
    """

    member: int
    time: float
    stored: str
    state: dict[str, float]
    law: str
    damping: str
    pairs: tuple[dict[str, Any], ...]
    modes: tuple[dict[str, Any], ...]
    friction: NDArray[np.float64]
    force: NDArray[np.float64]
    torque: NDArray[np.float64]
    sizes: dict[str, float]
    joints: tuple[dict[str, Any], ...] = ()

    def table(self) -> pd.DataFrame:
        """The pairs, or a linkage's joints, as a table of pandas, one row each."""
        import pandas as pd

        rows, index = (list(self.joints), ["joint"]) if self.joints else (list(self.pairs), ["apex", "face"])
        return pd.DataFrame(rows).set_index(index)


@arguments.one_line
def explain(result: StrPath | xr.Dataset, member: int | None = None, time: float | None = None, *, program: StrPath | None = None) -> Explanation:
    """Follows how the forces of a state that a result has stored come about: apices, depths, modes, normal forces, friction, their sum.

    Args:
        result: a Dataset of slideway.open or slideway.run, or the path of its file.
        member: its number; left out: the first of the selection, or of the file.
        time: [s]; the stored state that is nearest to it is taken; left out: the member's end.
        program: path of the program; left out: SLIDEWAY_PROGRAM, else the PATH.

    Raises:
        SceneError: there is no such member or no state of it, or the slider has no eight apices.
        FileError: the file cannot be read.

    >>> found = slideway.explain(example_file, member=3, time=0.01)
    >>> found.stored, round(found.time, 4), len(found.pairs)
    ('sample', 0.01, 16)
    """
    if member is None and isinstance(result, xr.Dataset) and "member" in result.coords:
        member = int(np.atleast_1d(result["member"].values)[0])
    options = [] if member is None else ["--member", str(arguments.whole(member, "member", 0))]
    if time is not None:
        options += ["--time", repr(float(arguments.numbers(time, "time")))]
    said = json.loads(call(program, ["probe", file_of(result), "--explain", "--json", *options]))
    (row,) = said["states"]
    how = row["explanation"]

    def number(value: float | None) -> float:
        return np.nan if value is None else float(value)

    def vector(name: str) -> NDArray[np.float64]:
        return np.array([number(value) for value in how.get(name, [None] * 3)])

    def rows(name: str) -> tuple[dict[str, Any], ...]:
        return tuple({key: np.nan if value is None else value for key, value in row.items()} for row in how.get(name, []))

    return Explanation(
        member=int(said["member"]),
        time=float(row["time"]),
        stored=str(said["stored"]),
        state={name: number(value) for name, value in row["state"].items()},
        law=str(how["law"]),
        damping=str(how["damping"]),
        pairs=rows("pairs"),
        modes=rows("modes"),
        friction=vector("friction"),
        force=vector("force"),
        torque=vector("torque"),
        sizes=dict(how.get("joint", {})),
        joints=rows("joints"),
    )
