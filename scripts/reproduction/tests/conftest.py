"""Where the package is, and the scenes."""

import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[3]
sys.path.insert(0, str(ROOT / "scripts"))


@pytest.fixture(scope="session")
def scenes() -> Path:
    return ROOT / "scenes"
