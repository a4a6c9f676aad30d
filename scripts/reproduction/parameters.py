"""What was put in: Tables 1 and 6 to 8, the print beside what was run."""

from __future__ import annotations

from typing import Any

import slideway

from .plan import CASES, MAPS, crank
from .sections import Bench, Section, Table


def section(bench: Bench) -> Section:
    """The parameters as the results carry them. Where print and run differ, docs/explanation/model.md 10 has the reason."""
    return Section(
        "Tables 1 and 6–8: parameters",
        ["Read from the results' own resolved scenes. Where the print cannot be meant as it stands, the last column says what was taken instead."],
        tables=[_bodies(bench), _holes(bench), _carriages(bench), _departures()],
    )


def _scene(bench: Bench, family: str, case: str) -> dict[str, Any]:
    return slideway.scene(bench.result(family, case, "settled", "paper"), derived=True)


def _bodies(bench: Bench) -> Table:
    scene = _scene(bench, "crank", "0.1mm")
    mechanism, joint, contact, friction = (scene[group] for group in ("mechanism", "joint", "contact", "friction"))
    rows = [
        ["crank: length; 5 × 2.5 mm section", "50 mm, 7.8e3 kg/m³", f"{_millimetres(mechanism['crank_length'])}, {1e3 * mechanism['crank_mass']:.4g} g",
         "as printed"],
        ["rod: length; 14.2 × 7.1 mm section", "142.2 mm, 7.8e3 kg/m³", f"{_millimetres(mechanism['rod_length'])}, {1e3 * mechanism['rod_mass']:.4g} g",
         "as printed"],
        ["slider", "40 × 20 × 30 mm, 7.8e3 kg/m³", f"{_millimetres(joint['slider_length'])} long, {1e3 * mechanism['slider_mass']:.4g} g",
         "mass of the solid block, hole or not"],
        ["slide way", "250 × 20 × 30 mm", f"{_millimetres(joint['way_width'])} × {_millimetres(joint['way_depth'])}, endless",
         "the slider does not reach its ends"],
        ["elastic modulus; Poisson's ratio", "2.07e11 N/m²; 0.29", f"{contact['slider_young_modulus']:.3g} Pa; {contact['slider_poisson_ratio']:g}",
         "as printed, of both bodies (Table 7)"],
        ["speed", "π rad/s", f"{mechanism['crank_speed']:.6g} rad/s", "as printed"],
        ["Hertz exponent (18)", "1.3 to 1.5", f"{contact['hertz_exponent']:g}", "within the print's range"],
        ["point damping C (18)", "0.1 to 1 % of K", f"{100 * contact['eta']:g} % of K", "within the print's range"],
        ["friction", "no values", f"μs {friction['static']:g}, μd {friction['kinetic']:g}", "own choice"],
        ["edge and apex radius", "no values", f"{_millimetres(contact['edge_radius'])}, {_millimetres(contact['apex_radius'])}", "own choice"],
        ["start", "no values", "scattered within the clearance", "own choice: an ensemble in place of one orbit"],
    ]  # fmt: skip
    return Table("Tables 6 and 7 (Table 7 names symbols, without values).", ["part", "print", "here", "remark"], rows)


def _millimetres(metres: float) -> str:
    return f"{1e3 * metres:g} mm"


def _holes(bench: Bench) -> Table:
    rows = []
    for number, ((words, c), width, depth) in enumerate(zip(MAPS.items(), (2.016, 2.02, 2.06, 2.1), (3.016, 3.02, 3.06, 3.1), strict=True), 1):
        joint = _scene(bench, "crank", crank(c))["joint"]
        clearance = 1e3 * float(joint["clearance_y"])
        hole = (1e3 * float(joint["way_width"]) + 2 * clearance, 1e3 * float(joint["way_depth"]) + 2 * 1e3 * float(joint["clearance_z"]))
        rows.append([str(number), f"{width} × {depth} mm", f"{hole[0]:.2f} × {hole[1]:.2f} mm, {words} per side", "the print's numbers are centimetres"])
    return Table("Table 8: the hole of the slider.", ["case", "print", "here", "remark"], rows)


def _carriages(bench: Bench) -> Table:
    rows = []
    printed = (("0.25 mm", "6 cm/s", "0°"), ("0.15 mm", "6 cm/s", "0°"), ("0.25 mm", "9.3 cm/s", "0°"), ("0.25 mm", "6 cm/s", "30°"))
    for (words, case), print_ in zip(CASES.items(), printed, strict=True):
        scene = _scene(bench, "carriage", case)
        angle = float(scene["mechanism"].get("inclination", 0.0)) * 180 / 3.141592653589793
        here = f"{1e3 * float(scene['joint']['clearance_y']):g} mm per side, {100 * float(scene['mechanism']['carriage_speed']):g} cm/s, {angle:.3g}°"
        rows.append([words.removeprefix("case "), ", ".join(print_), here, "the print's clearance is the difference of the widths"])
    return Table("Table 1: the experiment. Stroke (150 mm) and the time to turn round (20 ms) are not printed.", ["case", "print", "here", "remark"], rows)


def _departures() -> Table:
    return Table(
        "Where the model departs from the print (docs/explanation/model.md 10).",
        ["print", "here", "why"],
        [
            ["Table 8 widths 2.016 … 2.1 mm", "20.16 … 21 mm", "the way is 20 × 30 mm; these are the clearances of Fig. 17"],
            ["(9)–(14): Lambert W, no branch named", "W₋₁", "the force must vanish with the approach"],
            ["(15): F = 2P/(πal)", "the load P itself", "2P/(πal) is a pressure"],
            ["(16): E* = E/(1 − ν²)", "E* of both bodies", "Table 7 lists both"],
            ["(6): two cases garbled", "continuous at both speeds", "friction has no jump"],
            ["face 4: P4 P3 P7 P5", "P4 P3 P7 P8", "the other listing of the same face"],
            ["axes named inconsistently (4.3 to 4.7)", "X along the way, Y up, Z to the side", "gravity is −Y"],
            ["where forces act, δ', friction, start", "model.md 3 to 5", "not printed"],
        ],
    )
