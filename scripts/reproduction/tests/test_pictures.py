"""Parts of the pictures whose answer is known."""

import doctest
import re
from pathlib import Path

import pytest
import slideway
from pictures import figures, impacts, mechanisms, regimes

ROOT = Path(__file__).resolve().parents[3]
PICTURES = ROOT / "docs" / "pictures"
GEOMETRY = ("mechanism.", "joint.", "slider.", "way.", "way_ends.", "initial.")


def test_examples_in_docstrings_hold() -> None:
    for module in (figures, impacts, regimes):
        assert doctest.testmod(module).failed == 0, module.__name__


def keys_on(picture: str) -> set[str]:
    """The keys that a drawing's labels name, each by itself or between commas; their colour says in which table."""
    svg = (PICTURES / f"{picture}.svg").read_text(encoding="utf-8")
    tables = {colour.lower(): table for table, colour in mechanisms.TABLES.items()}
    labels = [(tables[colour], text) for colour, text in re.findall(r"<text style=\"[^\"]*fill: (#\w+)\"[^>]*>([^<>]+)</text>", svg) if colour in tables]
    return {f"{table}.{name.strip()}" for table, text in labels for name in text.split(",")}


def test_every_key_of_a_mechanism_is_on_its_drawings() -> None:
    keys = slideway.keys()
    kinds = [kind for kind in keys["mechanism.kind"].domain.removeprefix("one of ").split(", ") if kind != "linkage"]  # its keys are of bodies and joints
    assert len(kinds) >= 5
    for kind in kinds:
        pictures = [f"keys_{kind}"] + ([] if kind.startswith("planar") else ["keys_joint", "keys_slider", "keys_way"])
        drawn = set().union(*map(keys_on, pictures))
        counted = {key for key in keys if key.startswith(GEOMETRY) and kind in keys[key].counts_for.get("mechanisms", kinds)}
        missing = counted - drawn - {"mechanism.kind"}
        if kind.startswith("planar"):
            missing -= {"way_ends.from", "way_ends.to"}  # which the program refuses there
        assert not missing, f"on none of {', '.join(pictures)}, which scripts/pictures/mechanisms.py draws: {missing}"


@pytest.mark.parametrize("name", mechanisms.KEYS)
def test_drawings_name_no_key_that_there_is_not(name: str) -> None:
    words = {"mechanism.x rod_length"} | {f"mechanism.{axis}_{side}" for axis in "yz" for side in ("plus", "minus")}  # a product; faces
    named = {key for key in keys_on(name) if "[" not in key and not re.search(r"\.(X|Y|Z|[CP]\d)$", key)}
    assert named - words <= set(slideway.keys())


def test_the_same_drawing_is_the_same_text() -> None:
    assert mechanisms.free_slider(ROOT) == mechanisms.free_slider(ROOT)
