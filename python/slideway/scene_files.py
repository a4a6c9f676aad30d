"""Scenes given as dictionaries: files for the program, and its words about them without these files."""

from __future__ import annotations

import os
import re
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Any

from .arguments import one_line, path
from .errors import SceneError
from .results import StrPath
from .temporary import temporary_folder
from .toml_writer import keys_of_lines, to_toml


@dataclass(frozen=True)
class SceneFile:
    """A scene where the program reads it.

    Attributes:
        path: of the TOML file.
        keys: the dotted key in each of its lines, of a scene that was a dictionary; empty of the user's own file.
        text: what stands in it, where it is read here.
    """

    path: str
    keys: tuple[str, ...] = ()
    text: str = ""

    def said(self, line: str) -> str:
        """What the program says, without a file that the user has never seen: "scene.toml:7: text" becomes "key: text".

        >>> SceneFile("/tmp/s.toml", ("study", "study.members")).said("/tmp/s.toml:1: a quantity is missing")
        'study: a quantity is missing'
        """
        if not self.keys:
            return line

        def named(place: re.Match[str]) -> str:
            number, rest = int(place[1] or 0), line[place.end() :]
            key = self.keys[number - 1] if 0 < number <= len(self.keys) else "" if number else "scene"
            return "" if not key or key in rest.split(" (")[0] else f"{key}: "

        return re.sub(rf"{re.escape(self.path)}(?::(\d+))?(?::\d+)?: ", named, line).replace(self.path, "the scene")


@contextmanager
def scene_file(scene: StrPath | Mapping[str, Any]) -> Iterator[SceneFile]:
    """The scene's file, for the length of a block; of a dictionary a temporary one."""
    if not isinstance(scene, Mapping):
        yield SceneFile(path(scene, "scene"))
        return
    with temporary_folder() as folder:
        yield _written(scene, os.path.join(folder, "scene.toml"))


def scene_text(scene: StrPath | Mapping[str, Any]) -> SceneFile:
    """The scene as text, with the path that messages name; of a dictionary there is no file.

    Raises:
        SceneError: the file cannot be read.
    """
    if isinstance(scene, Mapping):
        return _in_memory(scene, "scene.toml")
    name = path(scene, "scene")
    try:
        with open(name, encoding="utf-8") as file:
            return SceneFile(name, text=file.read())
    except (OSError, UnicodeDecodeError) as error:
        why = error.strerror if isinstance(error, OSError) else error
        raise SceneError(2, f"{name}: cannot be read: {why}") from None


@one_line
def _in_memory(scene: Mapping[str, Any], name: str) -> SceneFile:
    study = scene.get("study")
    if isinstance(study, Mapping) and isinstance(study.get("table"), (str, os.PathLike)) and study["table"]:
        # The program looks for a table beside the scene, which has no place of its own; members of Ensemble.run(inputs=...) have none.
        scene = {**scene, "study": {**study, "table": os.path.abspath(study["table"])}}
    text = to_toml(scene)
    text.encode("utf-8")  # or it is no text that a scene can hold
    return SceneFile(name, keys_of_lines(text), text)


def _written(scene: Mapping[str, Any], name: str) -> SceneFile:
    made = _in_memory(scene, name)
    with open(name, "w", encoding="utf-8") as file:
        file.write(made.text)
    return made
