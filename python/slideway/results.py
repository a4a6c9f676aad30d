"""Result files as xarray Datasets."""

from __future__ import annotations

import os
from typing import Union

import numpy as np
import xarray as xr

from .errors import SlidewayError

StrPath = Union[str, "os.PathLike[str]"]


def open(path: StrPath, group: str | None = None) -> xr.Dataset:  # noqa: A001
    """Open a result file of slideway, or one of its groups.

    Numbers are read from the file when they are used; ``.load()`` reads all of them, ``.close()`` (or ``with``) closes the file.
    Every variable has ``units`` and ``long_name``. Dimensions have labels wherever the file has some: ``member`` their numbers in
    the scene's ensemble, ``apex``, ``mode_class``, ``axis`` and the like their names, and samples are also found by ``time``.
    Sections of all members lie one after the other; ``section_member`` says whose they are (see :func:`slideway.sections`).

    Args:
        path: the result, OUT.nc of ``slideway run -o OUT.nc``.
        group: a group of the file, as :func:`slideway.groups` lists them: "statistics", "yield", "sensitivity", "verification".

    Raises:
        SlidewayError: the file is missing, is no result of slideway, or has no such group.

    >>> result = slideway.open(example_file)
    >>> result.peak_normal_force.units
    'N'
    >>> float(result.y.sel(member=3, time=0.01, method="nearest").time)
    0.01
    """
    name = os.fspath(path)
    _check(name)
    if group is not None and group not in groups(name):
        there = ", ".join(groups(name)) or "no groups"
        raise SlidewayError(f'{name}: has no group "{group}", but {there}; see slideway.groups(path)')
    dataset = _labelled(_opened(name, group))
    if group is not None:
        # A group shares the file's dimensions, whose labels lie outside it.
        with _labelled(_opened(name, None)) as whole:
            shared = {d: whole[d].load() for d in dataset.dims if d in whole.indexes and d not in dataset.coords}
        dataset = dataset.assign_coords(shared)
    dataset.encoding["source"] = os.path.abspath(name)
    return dataset


def groups(result: StrPath | xr.Dataset) -> list[str]:
    """Names of the groups of a result file, given by its path or its Dataset.

    >>> slideway.groups(example_file)
    ['verification']
    """
    import netCDF4

    name = path_of(result) if isinstance(result, xr.Dataset) else os.fspath(result)
    _check(name)
    with netCDF4.Dataset(name) as file:
        return list(file.groups)


def path_of(result: xr.Dataset) -> str:
    """The file that a Dataset of :func:`slideway.open` comes from.

    Raises:
        SlidewayError: the Dataset does not come from a file.
    """
    source = result.encoding.get("source")
    if not source:
        raise SlidewayError("this Dataset does not know its file; use the one that slideway.open or slideway.run returned")
    return str(source)


def _opened(name: str, group: str | None) -> xr.Dataset:
    # Times are numbers of seconds: xarray would make dates or durations of some units.
    return xr.open_dataset(name, engine="netcdf4", group=group, decode_times=False, decode_timedelta=False)


def _check(name: str) -> None:
    """Raises where there is no result of slideway."""
    import netCDF4

    if not os.path.exists(name):
        raise SlidewayError(f"{name}: there is no such file; check the path")
    if os.path.isdir(name):
        hint = "; slideway merge makes one file of its shards" if name.rstrip("/").endswith(".shards") else ""
        raise SlidewayError(f"{name}: is a folder, not a result file{hint}")
    try:
        with netCDF4.Dataset(name) as file:
            source = getattr(file, "source", "")
    except OSError as error:
        raise SlidewayError(f"{name}: is no NetCDF file that can be read ({error.strerror or error})") from error
    if not str(source).startswith("slideway"):
        raise SlidewayError(f"{name}: is a NetCDF file, but not a result of slideway; open it with xarray.open_dataset")


def _labelled(dataset: xr.Dataset) -> xr.Dataset:
    """Names of a dimension's entries become its labels, samples are found by time, sections know their member."""
    for name in [str(v) for v in dataset.variables]:
        stem = name.removesuffix("_name")
        if stem != name and dataset[name].dims == (stem,):
            labels = np.asarray(dataset[name].values).astype(str)
            dataset = dataset.drop_vars(name).assign_coords({stem: (stem, labels, dataset[name].attrs)})
    if "time" in dataset and dataset["time"].dims == ("sample",):
        dataset = dataset.set_coords("time").set_xindex("time")
    if "section_count" in dataset and "member" in dataset.coords:
        owners = np.repeat(dataset["member"].values, dataset["section_count"].values)
        attributes = {"units": "1", "long_name": "member of the section"}
        dataset = dataset.assign_coords(section_member=("section", owners, attributes))
    return dataset
