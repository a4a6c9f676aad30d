"""The map from revolution to revolution: Fig. 17."""

from __future__ import annotations

from functools import partial

import numpy as np
import slideway
from slideway.figures.marks import Axis, Cloud, Panel

from .claims import UNTOLD, Claim, Finding, Verdict, claim, said
from .estimates import estimate
from .plan import MAPS, crank
from .sections import Bench, Quantity, Section, by_law, draw

CRANK, ROD = 0.05, 0.1422  # m
SPEED = np.pi  # rad/s


def section(bench: Bench) -> Section:
    """Judges Fig. 17: x and vx of the slider once a revolution, at crank angle 0, over 150 revolutions after 20."""
    page = Section(
        "Fig. 17: the map of (x, vx)",
        [
            "x and vx follow from the states across the way, for the rod is rigid: at crank angle 0 x = r + √(L² − y² − z²), so that x is of second order in the "
            "clearance (micrometres and less), and vx of first order. The paper does not say at which angle its map is taken."
        ],
    )
    page.claims = [_scattered(bench)]
    cases = {words: str(clearance) for words, clearance in MAPS.items()}
    for what, index, unit, factor in (("x", 0, "nm", 1e9), ("vx", 1, "µm/s", 1e6)):
        # What a drift of the resting slider by a thousandth of its room makes is no scatter.
        words, floor = f"The map spreads wider with larger clearance (sd of {what}).", 1e-3 * _room(0.08)[index]
        page.claims.append(bench.growth("Fig. 17a–d", words, _spread_of(index, False), cases, "settled", unit, factor, floor))
        words = f"The map spreads wider, even in units of what the clearance allows with larger clearance (sd of {what})."
        page.claims.append(bench.growth("Fig. 17a–d", words, _spread_of(index, True), cases, "settled", "", 1.0, 1e-3))
    page.claims.append(_dimension(bench))
    page.figures = [draw(f"Fig. 17: the map, {words}, 150 revolutions of one start.", partial(_map, bench, c)) for words, c in MAPS.items()]

    def cells(clearance: float, law: str) -> list[str]:
        x, vx = _spread(bench, clearance, law)
        mean = np.array([v.mean() for _, v in _points(bench, clearance, law)])
        return [said(estimate(x), "", 1e9), said(estimate(vx), "", 1e6), said(estimate(mean), "", 1e6)]

    columns = ("sd of x [nm]", "sd of vx [µm/s]", "mean of vx [µm/s]")
    page.tables = [
        by_law("Spread of the map.", "clearance", columns, {words: partial(cells, c) for words, c in MAPS.items()}),
        bench.audit("map", [(w, crank(c)) for w, c in MAPS.items()], "settled", bench.scale.map_transient + bench.scale.map_revolutions),
    ]
    return page


def along(y: np.ndarray, z: np.ndarray, vy: np.ndarray, vz: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """x − r − L [m] and vx [m/s] at crank angle 0, from the rod of fixed length (model.md 6): pin A = (r, 0, 0), v_A = (0, r ω, 0).

    D = √(L² − y² − z²), vx = −(y (vy − r ω) + z vz)/D; x without L, of which 1e-9 is what moves.
    """
    reach = np.sqrt(ROD**2 - y**2 - z**2)
    return -(y**2 + z**2) / (ROD + reach), -(y * (vy - CRANK * SPEED) + z * vz) / reach


def correlation_dimension(points: np.ndarray) -> float:
    """Slope of ln C(r) over ln r, C the share of pairs nearer than r, between its 2 % and 20 % quantiles.

    Source: Grassberger and Procaccia, Physica D 9 (1983) 189. Coordinates are scaled to unit deviation.

    >>> line = np.linspace(0, 1, 400)
    >>> round(correlation_dimension(np.stack([line, line], axis=1)), 1)
    1.0
    """
    deviation = points.std(axis=0)
    if len(points) < 10 or not (deviation > 0).all():
        return float("nan")
    scaled = (points - points.mean(axis=0)) / deviation
    pairs = np.sqrt(((scaled[:, None] - scaled[None]) ** 2).sum(axis=2))[np.triu_indices(len(points), 1)]
    shares = np.geomspace(0.02, 0.2, 12)
    radii = np.quantile(pairs, shares)
    return float(np.polyfit(np.log(radii), np.log(shares), 1)[0]) if (radii > 0).all() else float("nan")


def _points(bench: Bench, clearance: float, law: str) -> list[tuple[np.ndarray, np.ndarray]]:
    """(x, vx) of each member that finished."""
    result = bench.result("map", crank(clearance), "settled", law)
    rows = slideway.sections(result)
    done = result["member"].values[slideway.finished(result).values]
    return [along(*(rows[s].values[rows["member"].values == m] for s in ("y", "z", "vy", "vz"))) for m in done]


def _spread(bench: Bench, clearance: float, law: str) -> tuple[np.ndarray, np.ndarray]:
    points = _points(bench, clearance, law)
    return np.array([x.std() for x, _ in points]), np.array([v.std() for _, v in points])


def _spread_of(index: int, of_room: bool) -> Quantity:
    """Of x (0) or vx (1), or in units of what the clearance allows."""
    return lambda bench, case, window, law: _spread(bench, float(case), law)[index] / (_room(float(case))[index] if of_room else 1)


def _room(clearance: float) -> tuple[float, float]:
    """Deviations of x [m] and vx [m/s] that y = c makes; the clearance c in mm."""
    y = 1e-3 * clearance
    return y**2 / (2 * ROD), y * CRANK * SPEED / ROD


def _scattered(bench: Bench) -> Claim:
    def finding(law: str) -> Finding:
        taken = [estimate(_spread(bench, c, law)[1] / _room(c)[1]) for c in MAPS.values()]
        lines = tuple(f"{w}: {said(t, '')}" for w, t in zip(MAPS, taken, strict=True))
        return Finding(lines, True if all(t.low > 0.01 for t in taken) else False if all(t.high < 0.01 for t in taken) else None)

    words = "The map is scattered: the motion does not repeat (sd of vx above a hundredth of c r ω/L, what the clearance allows)."
    return claim("Fig. 17", words, finding)


def _dimension(bench: Bench) -> Claim:
    def finding(law: str) -> Finding:
        taken = said(estimate(np.array([correlation_dimension(np.stack(p, axis=1)) for p in _points(bench, 0.1, law)])), "")
        return Finding((f"correlation dimension at 0.1 mm: {taken}" if law == "paper" else f"of what is left of the spread: {taken}",), None)

    verdict = Verdict("cannot be told from 150 points; 2 would be a plane that is filled without structure", UNTOLD.kind)
    return claim("4.7.1", 'The points have "certain fractal dimension characteristics".', finding, verdict)


def _map(bench: Bench, clearance: float, law: str) -> Panel:
    x, vx = _points(bench, clearance, law)[0]
    # A map that repeats is one dot in the room that the clearance leaves, not a magnified rounding error.
    room_x, room_vx = _room(clearance)
    across, up = Axis("x − (r + L)", "nm", low=-2.2e9 * room_x, high=0.1e9 * room_x), Axis("vx", "mm/s", low=-1.3e3 * room_vx, high=1.3e3 * room_vx)
    return Panel([Cloud(1e9 * x, 1e3 * vx, opacity=0.8, size=14)], across, up)
