"""Result files as xarray Datasets."""

from __future__ import annotations

import os
import warnings
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Union

import numpy as np
import xarray as xr

from . import netcdf, sizes
from .arguments import dataset, one_line, text
from .arguments import path as path_text
from .errors import FileError, RunError, SceneError, SlidewayError
from .former_names import words_of_now
from .program import call, find_program
from .temporary import TemporaryPath, temporary_path

StrPath = Union[str, "os.PathLike[str]"]

_newest_format = 3  # format_version of results that this package knows
_checked: dict[str, tuple[int, ...]] = {}  # files that the program found intact, and what they were then
_groups_of: dict[str, tuple[tuple[int, ...], list[str]]] = {}  # groups of results that were opened, and what they were then: to open one takes 10 ms


@one_line
def open(  # noqa: A001
    path: StrPath, group: str | None = None, *, check: bool = True, variables: Sequence[str] | None = None, members: tuple[int, int] | None = None
) -> xr.Dataset:
    """Open a result file of slideway, or one of its groups. Any thread may call this.

    Up to 256 MB of numbers are read at once. More are read from the file when they are used; ``.load()`` reads all of them. The file
    does not stay open, and may not be replaced in between. Every variable has ``units`` and ``long_name``. Dimensions have labels wherever the file has some: ``member`` their numbers in
    the scene's ensemble, ``apex``, ``mode_class``, ``axis`` and the like their names, and samples are also found by ``time``.
    Sections of all members lie one after the other; ``section_member`` says whose they are (see :func:`slideway.sections`).

    The program looks at the file first, in a process of its own: whether all numbers and attributes are what was written. Where there
    is no program, a warning says that the file was not checked.

    Args:
        path: the result, OUT.nc of ``slideway run -o OUT.nc``.
        group: a group of the file, as :func:`slideway.groups` lists them: "statistics", "yield", "sensitivity", "verification".
        check: False opens the file as it is. Some damaged files end Python when they are opened.
        variables: names of those that are wanted, without their labels; left out: all.
        members: the first and the last that are wanted, by their numbers; left out: all. Groups speak of all in any case.

    Raises:
        FileError: the file is not what was written; the text says which part is damaged.
        SlidewayError: the file is missing, damaged or no result of slideway, has no such group, or is so large (hundreds of millions of
            members) that `variables` or `members` should be given; the text says how large.

    >>> result = slideway.open(example_file)
    >>> result.peak_normal_force.units
    'N'
    >>> float(result.y.sel(member=3, time=0.01, method="nearest").time)
    0.01
    """
    name = path_text(path, "path")
    if group is None and variables is None and members is None and os.path.isfile(name):
        sizes.require_choice_before_check(name)
    known = _check(name, check)
    if group is not None and text(group, "group") not in known:
        there = ", ".join(known) or "no groups"
        raise SlidewayError(f'{name}: has no group "{group}", but {there}; see slideway.groups(path)')
    try:
        opened = _whole(name, variables, members) if group is None else _group(name, group, variables)
    except SlidewayError:
        raise
    except (ArithmeticError, AttributeError, LookupError, OSError, RuntimeError, TypeError, ValueError) as error:
        raise SlidewayError(f"{name}: is damaged ({' '.join(str(error).split())}); copy it again, or run its scene again") from error
    return _from(name, opened)


def _whole(name: str, variables: Sequence[str] | None, members: Any) -> xr.Dataset:
    with netcdf.opened(name) as file:
        if variables is None and members is None:
            sizes.require_choice(name, sizes.size_of(file))
        wanted = None if variables is None else sizes.with_labels(file, variables)
        read = netcdf.read(file, name, None, wanted, None if members is None else sizes.rows_of(file, members))
    return labelled(netcdf.decoded(*read))


def _group(name: str, group: str, variables: Sequence[str] | None) -> xr.Dataset:
    """A group shares the file's dimensions, whose labels lie outside it."""
    with netcdf.opened(name) as file:
        place = netcdf.place_of(file, group)
        wanted = None if variables is None else sizes.with_labels(place, variables)
        read = netcdf.read(file, name, group, wanted)
        dimensions = {dimension for variable in read[0].values() for dimension in variable.dims}
        shared = netcdf.read(file, name, None, frozenset(f"{d}{end}" for d in dimensions for end in ("", "_name")))
    opened, whole = labelled(netcdf.decoded(*read)), labelled(netcdf.decoded(*shared))
    return opened.assign_coords({d: whole[d] for d in opened.dims if d in whole.indexes and d not in opened.coords})


@one_line
def groups(result: StrPath | xr.Dataset) -> list[str]:
    """Names of the groups of a result file, given by its path or its Dataset.

    >>> slideway.groups(example_file)
    ['verification']
    """
    name = file_of(result)
    return _check(name, not isinstance(result, xr.Dataset))


@one_line
def tree(result: StrPath | xr.Dataset) -> xr.DataTree:
    """A result file, given by its path or its Dataset, with all of its groups: the members at the root, each group below it by its name.

    Groups have the labels of the file's dimensions, as :func:`slideway.open` gives them, and speak of all members of the file.

    Raises:
        FileError: the file is not what was written; the text says which part is damaged.
        SlidewayError: as :func:`slideway.open`, and where xarray is older than 2024.10.

    >>> members = slideway.tree(tolerance_file)
    >>> members["statistics"].peak_normal_force_mean.units
    'N'
    >>> sorted(members.children)
    ['sensitivity', 'statistics', 'verification', 'yield']
    """
    if not hasattr(xr, "DataTree"):
        raise SlidewayError(f"trees need xarray 2024.10 or newer, and this is {xr.__version__}; install it, or take slideway.open(path, group=...)")
    name = file_of(result)
    # Together, so that all parts are of one file: what was checked is not checked again.
    return xr.DataTree.from_dict({"/": open(name), **{group: open(name, group) for group in groups(name)}})


def path_of(result: xr.Dataset) -> str:
    """The file that a Dataset of :func:`slideway.open` comes from.

    Raises:
        SlidewayError: the Dataset does not come from a file.
    """
    source = dataset(result).encoding.get("source")
    if isinstance(source, InMemory):
        return source.path()
    if not isinstance(source, str) or not source:
        raise SlidewayError("this Dataset does not know its file; use the one that slideway.open or slideway.run returned")
    return source  # as it is, for a temporary file lives as long as its path


def file_of(result: StrPath | xr.Dataset) -> str:
    """The file of a result that is given by its path or its Dataset."""
    return path_of(result) if isinstance(result, xr.Dataset) else path_text(result, "the result")


def holds_all(result: xr.Dataset) -> bool:
    """Whether a result holds all members of its file, for which alone the groups of the file speak.

    >>> result = slideway.open(example_file)
    >>> holds_all(result), holds_all(result.sel(member=[0, 1]))
    (True, False)
    """
    with netcdf.opened(path_of(result)) as file:
        stored = len(file.dimensions["member"]) if "member" in file.dimensions else 0
    return int(result["member"].size if "member" in result.coords else 0) == stored


def _from(name: str, opened: xr.Dataset) -> xr.Dataset:
    """Says of a Dataset and its variables which file they are from."""
    source = name if isinstance(name, TemporaryPath) else os.path.abspath(name)
    opened.encoding["source"] = source
    for variable in opened.variables.values():
        variable.encoding["source"] = source
    return opened


class InMemory:
    """Where a Dataset comes from that was computed in this process: a result file that is written once somebody asks for it."""

    def __init__(self, result: Any, stem: str) -> None:
        self._result, self._stem = result, stem
        self._path: TemporaryPath | None = None
        self._owner = os.getpid()

    def path(self) -> str:
        """The file, which is gone when nothing from its Dataset is used any more. A forked process makes one of its own."""
        with netcdf.exclusive():
            if self._path is None or self._owner != os.getpid():
                path = temporary_path(self._stem + ".nc")
                self._result.write(str(path), False)
                self._path, self._owner = path, os.getpid()
            return self._path

    def __deepcopy__(self, memo: dict[int, object]) -> InMemory:
        return self

    def __reduce__(self) -> tuple[Any, ...]:
        """To another process goes what would be in the file."""
        return InMemory, (_Content(Path(self.path()).read_bytes()), self._stem)


@dataclass(frozen=True)
class _Content:
    """A result of another process."""

    content: bytes

    def write(self, path: str, replace: bool) -> None:
        Path(path).write_bytes(self.content)


def in_memory(computed: xr.Dataset, result: Any, stem: str) -> xr.Dataset:
    """Says of a Dataset and its variables that they are of a result in memory."""
    source = {"source": InMemory(result, stem)}
    computed.encoding = source
    for variable in computed.variables.values():
        variable.encoding = source
    return computed


def open_temporary(path: TemporaryPath) -> xr.Dataset:
    """A temporary result, whose folder is removed when it is closed, or when nothing uses it any more."""
    opened = open(path, check=False)  # the program has just written it, and read it again
    opened.set_close(_Removal(path))
    return opened


@dataclass(frozen=True)
class _Removal:
    """Removes a temporary result; a copy in another process has the path as plain text, and owns nothing."""

    path: str

    def __call__(self) -> None:
        if isinstance(self.path, TemporaryPath):
            self.path.remove()


def _check(name: str, whole: bool) -> list[str]:
    """The groups of a file; raises where there is no result of slideway, or, if the `whole` file counts, one that is damaged."""
    if not os.path.exists(name):
        raise SlidewayError(f"{name}: there is no such file; check the path")
    if os.path.isdir(name):
        hint = "; slideway merge makes one file of its shards" if name.rstrip("/").endswith(".shards") else ""
        raise SlidewayError(f"{name}: is a folder, not a result file{hint}")
    if not os.path.isfile(name) or os.path.getsize(name) == 0:
        raise SlidewayError(f"{name}: is {'empty' if os.path.isfile(name) else 'no file'}, and so no result; check the path")
    if whole:
        _require_intact(name)
    now = netcdf.state_of(name)
    if (seen := _groups_of.get(os.path.abspath(name))) and seen[0] == now:
        return list(seen[1])
    try:
        with netcdf.opened(name) as file:
            source, version, groups_there = getattr(file, "source", ""), getattr(file, "format_version", 1), list(file.groups)
    except (OSError, RuntimeError, ValueError, AttributeError) as error:
        why = getattr(error, "strerror", None) or error
        raise SlidewayError(f"{name}: is no NetCDF file that can be read ({why}); check the path") from error
    if not str(source).startswith("slideway"):
        raise SlidewayError(f"{name}: is a NetCDF file, but not a result of slideway; open it with xarray.open_dataset")
    if not isinstance(version, (int, np.integer)) or version > _newest_format:
        raise SlidewayError(f"{name}: is of format {version}, and this package reads formats 1 to {_newest_format}; install a newer one")
    _groups_of[os.path.abspath(name)] = now, groups_there
    return list(groups_there)


def _require_intact(name: str) -> None:
    """Has the program look at a file, once as long as it does not change."""
    now = netcdf.state_of(name)
    if _checked.get(os.path.abspath(name)) == now:
        return
    sizes.say_before_check(name, 5)  # the caller of open or groups
    try:
        call(find_program(), ["info", "--check", "--", os.path.abspath(name)])
    except FileError as error:
        raise FileError(error.code, error.line.replace(os.path.abspath(name), name)) from None
    except SceneError as error:  # of an older version, which knows no --check
        _warn(name, str(error))
    except RunError:
        raise
    except SlidewayError:
        _warn(name, "the program slideway was not found")
    else:
        _checked[os.path.abspath(name)] = now


def _warn(name: str, why: str) -> None:
    line = f"{name}: was not checked for damage ({why}); set SLIDEWAY_PROGRAM, or give check=False"
    warnings.warn(" ".join(line.split()), stacklevel=6)  # the caller of open or groups


def labelled(dataset: xr.Dataset) -> xr.Dataset:
    """Names of a dimension's entries become its labels, samples are found by time (or angle), sections know their member."""
    for name in [str(v) for v in dataset.variables]:
        stem = name.removesuffix("_name")
        if stem != name and dataset[name].dims == (stem,):
            labels = np.array([words_of_now(label) for label in np.asarray(dataset[name].values).astype(str)], dtype=str)
            dataset = dataset.drop_vars(name).assign_coords({stem: (stem, labels, dataset[name].attrs)})
    if "member_label" in dataset:
        dataset = dataset.set_coords("member_label")
    if "time" in dataset and dataset["time"].dims == ("sample",):
        dataset = dataset.set_coords("time").set_xindex("time")
    if "turned" in dataset:
        dataset = dataset.set_coords([name for name in ("turned", "time") if name in dataset]).set_xindex("turned")
    if "section_count" in dataset and "member" in dataset.coords:
        owners = np.repeat(dataset["member"].values, dataset["section_count"].values)
        attributes = {"units": "1", "long_name": "member of the section"}
        dataset = dataset.assign_coords(section_member=("section", owners, attributes))
    return dataset
