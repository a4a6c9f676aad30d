"""Laws and mechanisms of one's own, and linkages, compiled for scenes."""

from __future__ import annotations

import json
import os
from collections.abc import Sequence
from dataclasses import dataclass

from .arguments import path
from .program import call
from .results import StrPath
from .temporary import temporary_folder


@dataclass(frozen=True)
class Module:
    """A law or mechanism that scenes know by its name, or a linkage that they find by its bodies and joints.

    Attributes:
        kind: "law", for contact.law, "mechanism", for mechanism.kind, or "linkage".
        name: as scenes have it.
        source: hash of its source, which is part of a run's identity.
        files: one for each instruction set.
        was_there: it was compiled of this source already.
    """

    kind: str
    name: str
    source: str
    files: tuple[str, ...]
    was_there: bool


def compile(  # noqa: A001 (slideway.compile is named as the program's command)
    header: StrPath, output: StrPath | None = None, *, isa: str | Sequence[str] | None = None, program: StrPath | None = None
) -> list[Module]:
    """Compiles a header with a contact law, a mechanism or both, so that scenes know them by name, or the linkage of a scene, so that it runs sooner.

    What such a header holds: docs/how_to/extending.md. It is compiled by the compiler that CXX names, else by g++.

    Args:
        header: path of the header, or its text, in several lines; what the text includes in quotes is looked for nowhere but in slideway. Or path of the scene.
        output: folder of the modules, which scenes name: ``set={"modules.search": [folder]}``. Left out: one that every scene finds.
        isa: instruction sets; left out: all of the program that this machine has.
        program: path of the program; left out: SLIDEWAY_PROGRAM, else that of the package, else the PATH.

    Raises:
        SceneError: the header cannot be used; its attribute ``stderr`` has the compiler's words.
        FileError: there is no compiler, or no headers of slideway, or the folder cannot be written.

    >>> try:
    ...     slideway.compile("#pragma once\\n#define SLIDEWAY_LAW Missing\\n")
    ... except slideway.SceneError as error:
    ...     print("Missing" in error.stderr)
    True
    """
    options = ["--json"]
    if output is not None:
        options += ["-o", path(output, "output")]
    if isa:
        options += ["--isa", isa if isinstance(isa, str) else ",".join(isa)]
    if isinstance(header, str) and "\n" in header:
        with temporary_folder() as folder:
            file = os.path.join(folder, "own.hpp")
            with open(file, "w", encoding="utf-8") as text:
                text.write(header)
            return _modules(call(program, ["compile", file, *options]))
    return _modules(call(program, ["compile", path(header, "header"), *options]))


def _modules(said: str) -> list[Module]:
    return [Module(one["kind"], one["name"], one["source"], tuple(one["files"]), one["was_there"]) for one in json.loads(said)["modules"]]
