"""The experiments behind docs/evidence/findings.md, at a size of seconds: every table is there, and the two that need no statistics say what they say."""

from __future__ import annotations

from pathlib import Path

import pytest
import slideway
import xarray as xr
from evidence.__main__ import page, text
from evidence.experiment import Experiment
from evidence.experiments import EXPERIMENTS, SIZES, fall, resolution
from evidence.loop import loop
from reproduction.runs import Laboratory

SCENES = Path(__file__).resolve().parents[3] / "scenes"


@pytest.fixture(scope="module")
def made(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Experiment]:
    output = tmp_path_factory.mktemp("evidence")
    laboratory = Laboratory(SCENES, output, 1, lambda line: None)
    experiments = {build.__name__: build(laboratory, SIZES["quick"], output) for build in EXPERIMENTS}
    assert laboratory.failures == {}
    return experiments


def test_every_experiment_has_its_table(made: dict[str, Experiment]) -> None:
    for name, experiment in made.items():
        assert experiment.words
        if name != "shipped":  # nothing of it is quick
            assert all(table.rows for table in experiment.tables)
    assert all(experiment.title in page(list(made.values()), []) for experiment in made.values())
    assert "|---|" in text(list(made.values()))


def test_a_fall_pays_for_all_that_damping_takes_under_the_conservative_law_alone(made: dict[str, Experiment]) -> None:
    def first(cell: str) -> float:
        return float(cell.split(" ")[0])

    rows = {row[0]: row for row in made[fall.__name__].tables[0].rows}
    assert first(rows["published"][2]) > 0.1  # mJ made within 50 ms
    assert abs(first(rows["conservative"][2])) < 1e-3
    assert first(rows["conservative"][1]) < 0.4  # the fall through 0.1 mm, twice its clearance at most


def test_a_loop_of_poses_gives_work_under_the_published_law_alone(made: dict[str, Experiment]) -> None:
    rows = {row[0]: [float(x) for x in row[2].split(",")] for row in made[loop.__name__].tables[0].rows}
    there, back = rows["published"]
    assert there == pytest.approx(-back, rel=1e-6)
    assert there > 1e-4
    for law in ("conservative", "springs at the apices"):
        assert abs(rows[law][0]) < 1e-2 * there
    sharings = [name for name in rows if name.startswith("published,")]
    assert len(sharings) == 3
    for name in sharings:
        assert rows[name][0] == pytest.approx(-rows[name][1], rel=1e-6)
        assert rows[name][0] > 1e-5


def test_errors_are_told_as_shares_of_their_numbers_with_the_verdict_where_it_is_another(monkeypatch: pytest.MonkeyPatch) -> None:
    names = ["landings [1]", "loss [J]", "flight [s]", "rest [s]", "lines [s]"]
    verdicts = ["error_bounded", "resolved", "undecided", "not_resolved", "undecided"]
    values = {"number": [40.0, 1.0, -2.0, 0.5, 0.0], "error_bound": [2.0, 0.001, 3.0, 0.1, 0.0]}
    numbers = xr.Dataset(
        {name: (("members_of", "checked"), [row]) for name, row in {**values, "verdict": verdicts}.items()},
        {"members_of": ["all members"], "checked": names},
    )
    said = slideway.Resolution("not_resolved", "", numbers)
    monkeypatch.setattr(slideway, "resolution", lambda path: said)
    assert resolution(Path("any"), "landings", "loss", "flight", "rest", "lines") == "5.0 %; resolved; 150 % (undecided); 20 % (not resolved); 0 in all members"
    assert resolution(Path("any")) == "not resolved"
