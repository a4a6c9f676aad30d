"""Quasi-static work of the contact forces around a closed loop of poses."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import slideway
from reproduction.runs import Laboratory
from reproduction.sections import Table

from .experiment import Experiment, Size

SCENE = Path(__file__).resolve().parents[2] / "scenes/free_slider_drop.toml"
LAWS = {"published": "paper", "conservative": "conservative", "springs at the apices": "kelvin_voigt", "an elastic bed": "foundation"}
SHARINGS = {
    "published, shared equally": lambda depths: np.ones_like(depths),
    "published, by the depth squared": lambda depths: depths**2,
    "published, all at the deepest": lambda depths: (depths == depths.max(axis=0)).astype(float),
}
"""Other places where a surface's or a line's force may act: weights of the apices that touch."""


def _path(depth: float, points: int) -> np.ndarray:
    """Poses (y, pitch) of a closed loop: onto one edge, rocked flat, lifted; depth of the lower edge [m]."""
    half, clearance = 0.02, 1e-4
    tilt = 4 * depth / half
    press = np.linspace(-depth, depth, points)
    edge = np.column_stack([-(clearance + press) + half * tilt, np.full(points, tilt)])
    angles = np.linspace(tilt, 0, points)
    rock = np.column_stack([-(clearance + depth) + half * angles, angles])
    lift = np.column_stack([-(clearance + np.linspace(depth, -depth, points)), np.zeros(points)])
    return np.vstack([edge, rock[1:], lift[1:]])


def _contacts(law: str, poses: np.ndarray, output: Path) -> tuple[np.ndarray, np.ndarray]:
    """Depths and forces [apex][pose] on the Y faces; an elastic bed pushes apices whose depth is negative, too."""
    table, answer = output / "loop.csv", output / "loop_forces.csv"
    states = dict.fromkeys(("t", "z", "vy", "vz", "roll", "yaw", "wx", "wy", "wz", "x", "vx"), np.zeros(len(poses)))
    states |= {"y": poses[:, 0], "pitch": poses[:, 1]}
    np.savetxt(table, np.column_stack(list(states.values())), delimiter=",", header=",".join(states), comments="", fmt="%.17g")
    still = ["--set", f"contact.law={law}", "friction.enabled=false", "initial.roll=0", "initial.yaw=0"]
    slideway.program.call(None, ["probe", str(SCENE), *still, "--csv", str(table), "-o", str(answer), "--force"])
    data = np.genfromtxt(answer, delimiter=",", names=True)
    depths, forces = (np.array([data[f"{name}_y_P{apex}"] for apex in range(1, 9)]) for name in ("pen", "fn"))
    return depths, forces


def _work(depths: np.ndarray, forces: np.ndarray) -> float:
    """W = −∮ Σ F_i dδ_i [J], by the trapezoidal rule."""
    return -float(np.sum(0.5 * (forces[:, 1:] + forces[:, :-1]) * np.diff(depths, axis=1)))


def _shared(depths: np.ndarray, forces: np.ndarray, weights: np.ndarray) -> np.ndarray:
    """The same total force, shared by other weights among the apices that touch."""
    weights = np.where(forces > 0, weights, 0.0)
    total = weights.sum(axis=0)
    return forces.sum(axis=0) * np.divide(weights, total, out=np.zeros_like(weights), where=total > 0)


def loop(laboratory: Laboratory, size: Size, output: Path) -> Experiment:
    """Work of the contact forces around a closed loop of poses: nothing moves by itself, no method integrates."""
    del laboratory
    points = 4001 if size.verify else 401
    works: dict[str, list[str]] = {name: [] for name in (*LAWS, *SHARINGS)}
    for depth in (1e-7, 3e-7, 1e-6):
        there = _path(depth, points)
        for name, law in LAWS.items():
            both = [_contacts(law, poses, output) for poses in (there, there[::-1])]
            works[name].append(", ".join(f"{_work(*contacts):+.2g}" for contacts in both))
            for sharing, weights in SHARINGS.items() if law == "paper" else ():
                moved = [(depths, _shared(depths, forces, weights(depths))) for depths, forces in both]
                works[sharing].append(", ".join(f"{_work(*contacts):+.2g}" for contacts in moved))
    words = [
        "Quasi-static: the slider is led onto one edge, rocked flat and lifted, and the same way back. W = −∮ Σ F_i dδ_i is what the contact gives "
        "to the hand that leads it. A law with a potential gives nothing; the published law gives or takes the jump between the potentials of a "
        "line and of a surface, by direction. The paper does not say where a surface's force acts; here it is shared by the depths of its apices, "
        "for which a surface by itself has a potential. Other sharings change what a round makes, and none makes it nothing."
    ]
    head = ["law", "0.1 µm deep: W [J], there and back", "0.3 µm", "1 µm"]
    return Experiment("A closed loop of poses", words, [Table(f"Work around the loop, {points} poses a side", head, [[k, *v] for k, v in works.items()])])
