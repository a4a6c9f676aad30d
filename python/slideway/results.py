"""Result files as xarray Datasets."""

from __future__ import annotations

import os
import warnings
from typing import Any, Union

import numpy as np
import xarray as xr

from .arguments import dataset, one_line, text
from .arguments import path as path_text
from .errors import FileError, RunError, SceneError, SlidewayError
from .program import call, find_program
from .temporary import TemporaryPath, temporary_path

StrPath = Union[str, "os.PathLike[str]"]

_newest_format = 2  # format_version of results that this package knows
_checked: dict[str, tuple[int, ...]] = {}  # files that the program found intact, and what they were then


@one_line
def open(path: StrPath, group: str | None = None, *, check: bool = True) -> xr.Dataset:  # noqa: A001
    """Open a result file of slideway, or one of its groups.

    Numbers are read from the file when they are used; ``.load()`` reads all of them, ``.close()`` (or ``with``) closes the file.
    Every variable has ``units`` and ``long_name``. Dimensions have labels wherever the file has some: ``member`` their numbers in
    the scene's ensemble, ``apex``, ``mode_class``, ``axis`` and the like their names, and samples are also found by ``time``.
    Sections of all members lie one after the other; ``section_member`` says whose they are (see :func:`slideway.sections`).

    The program looks at the file first, in a process of its own: whether all numbers and attributes are what was written. Where there
    is no program, a warning says that the file was not checked.

    Args:
        path: the result, OUT.nc of ``slideway run -o OUT.nc``.
        group: a group of the file, as :func:`slideway.groups` lists them: "statistics", "yield", "sensitivity", "verification".
        check: False opens the file as it is. Some damaged files end Python when they are opened.

    Raises:
        FileError: the file is not what was written; the text says which part is damaged.
        SlidewayError: the file is missing, damaged or no result of slideway, or has no such group.

    >>> result = slideway.open(example_file)
    >>> result.peak_normal_force.units
    'N'
    >>> float(result.y.sel(member=3, time=0.01, method="nearest").time)
    0.01
    """
    name = path_text(path, "path")
    known = _check(name, check)
    if group is not None and text(group, "group") not in known:
        there = ", ".join(known) or "no groups"
        raise SlidewayError(f'{name}: has no group "{group}", but {there}; see slideway.groups(path)')
    raw = None
    try:
        raw = _opened(name, group)
        opened = labelled(raw)
        if group is not None:
            # A group shares the file's dimensions, whose labels lie outside it.
            with labelled(_opened(name, None)) as whole:
                shared = {d: whole[d].load() for d in opened.dims if d in whole.indexes and d not in opened.coords}
            opened = opened.assign_coords(shared)
    except (ArithmeticError, AttributeError, LookupError, OSError, RuntimeError, TypeError, ValueError) as error:
        if raw is not None:
            raw.close()
        raise SlidewayError(f"{name}: is damaged ({' '.join(str(error).split())}); copy it again, or run its scene again") from error
    return _from(name, raw, opened)


@one_line
def groups(result: StrPath | xr.Dataset) -> list[str]:
    """Names of the groups of a result file, given by its path or its Dataset.

    >>> slideway.groups(example_file)
    ['verification']
    """
    name = file_of(result)
    return _check(name, not isinstance(result, xr.Dataset))


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
    import netCDF4

    with netCDF4.Dataset(path_of(result)) as file:
        stored = len(file.dimensions["member"]) if "member" in file.dimensions else 0
    return int(result["member"].size if "member" in result.coords else 0) == stored


def _from(name: str, raw: xr.Dataset, labelled: xr.Dataset) -> xr.Dataset:
    """Says of a Dataset and its variables which file they are from, and lets it close the file."""
    opened = labelled.copy() if labelled is raw else labelled  # what closes the file must not hold the Dataset itself
    source = name if isinstance(name, TemporaryPath) else os.path.abspath(name)
    opened.encoding["source"] = source
    for variable in opened.variables.values():
        variable.encoding["source"] = source
    opened.set_close(raw.close)
    return opened


class InMemory:
    """Where a Dataset comes from that was computed in this process: a result file that is written once somebody asks for it."""

    def __init__(self, result: Any, stem: str) -> None:
        self._result, self._stem = result, stem
        self._path: TemporaryPath | None = None

    def path(self) -> str:
        """The file, which is gone when nothing from its Dataset is used any more."""
        if self._path is None:
            path = temporary_path(self._stem + ".nc")
            self._result.write(str(path), False)
            self._path = path
        return self._path

    def __deepcopy__(self, memo: dict[int, object]) -> InMemory:
        return self


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
    # What removes the folder must not hold the Dataset itself, which would then live until the next collection.
    closing = opened.copy()
    closing.encoding = dict(opened.encoding)

    def end() -> None:
        opened.close()
        path.remove()

    closing.set_close(end)
    return closing


def _opened(name: str, group: str | None) -> xr.Dataset:
    # Times are numbers of seconds: xarray would make dates or durations of some units.
    return xr.open_dataset(name, engine="netcdf4", group=group, decode_times=False, decode_timedelta=False)


def _check(name: str, whole: bool) -> list[str]:
    """The groups of a file; raises where there is no result of slideway, or, if the `whole` file counts, one that is damaged."""
    import netCDF4

    if not os.path.exists(name):
        raise SlidewayError(f"{name}: there is no such file; check the path")
    if os.path.isdir(name):
        hint = "; slideway merge makes one file of its shards" if name.rstrip("/").endswith(".shards") else ""
        raise SlidewayError(f"{name}: is a folder, not a result file{hint}")
    if not os.path.isfile(name) or os.path.getsize(name) == 0:
        raise SlidewayError(f"{name}: is {'empty' if os.path.isfile(name) else 'no file'}, and so no result; check the path")
    if whole:
        _require_intact(name)
    try:
        with netCDF4.Dataset(name) as file:
            source, version, groups_there = getattr(file, "source", ""), getattr(file, "format_version", 1), list(file.groups)
    except (OSError, RuntimeError, ValueError, AttributeError) as error:
        why = getattr(error, "strerror", None) or error
        raise SlidewayError(f"{name}: is no NetCDF file that can be read ({why}); check the path") from error
    if not str(source).startswith("slideway"):
        raise SlidewayError(f"{name}: is a NetCDF file, but not a result of slideway; open it with xarray.open_dataset")
    if not isinstance(version, (int, np.integer)) or version > _newest_format:
        raise SlidewayError(f"{name}: is of format {version}, and this package reads formats 1 to {_newest_format}; install a newer one")
    return groups_there


def _require_intact(name: str) -> None:
    """Has the program look at a file, once as long as it does not change."""
    state = os.stat(name)
    now = (state.st_dev, state.st_ino, state.st_size, state.st_mtime_ns, state.st_ctime_ns)
    if _checked.get(os.path.abspath(name)) == now:
        return
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
    """Names of a dimension's entries become its labels, samples are found by time, sections know their member."""
    for name in [str(v) for v in dataset.variables]:
        stem = name.removesuffix("_name")
        if stem != name and dataset[name].dims == (stem,):
            labels = np.asarray(dataset[name].values).astype(str)
            dataset = dataset.drop_vars(name).assign_coords({stem: (stem, labels, dataset[name].attrs)})
    if "member_label" in dataset:
        dataset = dataset.set_coords("member_label")
    if "time" in dataset and dataset["time"].dims == ("sample",):
        dataset = dataset.set_coords("time").set_xindex("time")
    if "section_count" in dataset and "member" in dataset.coords:
        owners = np.repeat(dataset["member"].values, dataset["section_count"].values)
        attributes = {"units": "1", "long_name": "member of the section"}
        dataset = dataset.assign_coords(section_member=("section", owners, attributes))
    return dataset
