"""What an experiment is: a section of the page."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path

from reproduction.runs import Laboratory
from reproduction.sections import Table


@dataclass(frozen=True)
class Size:
    """Members and lengths; `seconds` of the falls, `turns` of the cranks; `laws` of the variants, None: all."""

    falls: int = 32
    seconds: float = 4.0
    members: int = 48
    turns: float = 1.0
    exponents: int = 16
    draws: int = 240
    verify: int | None = 48
    laws: tuple[str, ...] | None = None


@dataclass
class Experiment:
    """One section of the page."""

    title: str
    words: list[str]
    tables: list[Table] = field(default_factory=list)


Build = Callable[[Laboratory, Size, Path], Experiment]
