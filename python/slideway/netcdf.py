"""NetCDF files, opened, read and closed by one thread at a time, for neither netCDF nor HDF5 may be called by two at once.

No file stays open: what is small is read at once, and what is large is opened anew for each reading. So nothing is left that another
thread, a collection of garbage or a forked process could close or read without the lock.
"""

from __future__ import annotations

import os
import threading
from collections.abc import Iterator, Mapping
from contextlib import ExitStack, contextmanager
from typing import TYPE_CHECKING, Any

import numpy as np
import xarray as xr
from xarray.backends import AbstractDataStore, BackendArray
from xarray.backends.netCDF4_ import NETCDF4_PYTHON_LOCK
from xarray.core import indexing

from .errors import SlidewayError
from .former_names import first_format, name_of_now

if TYPE_CHECKING:
    import netCDF4

largest_at_once = 1 << 28  # bytes of numbers that are read when a file is opened
_small_column = 1 << 20  # bytes: read at once in any case

_ours = threading.RLock()
_inside = False  # whether the thread that has our lock has xarray's too


@contextmanager
def exclusive() -> Iterator[None]:
    """The only thread of this process inside netCDF and HDF5; xarray's readers of other files wait too."""
    global _inside
    # In this order everywhere, or two threads could wait for each other.
    with _ours:
        if _inside:  # xarray's lock can be had once only, and a handler of a signal may fork here
            yield
            return
        with NETCDF4_PYTHON_LOCK:
            _inside = True
            try:
                yield
            finally:
                _inside = False


# While a process forks no other thread is inside the libraries: the child would have them as they were in the middle of a call, and with locks
# that no thread of its own ever releases.
_fork = ExitStack()
os.register_at_fork(before=lambda: _fork.enter_context(exclusive()), after_in_parent=_fork.close, after_in_child=_fork.close)


@contextmanager
def opened(name: str) -> Iterator[netCDF4.Dataset]:
    """A file for the length of a block, which no other thread enters meanwhile. Values come as they are stored."""
    import netCDF4

    with exclusive(), netCDF4.Dataset(name) as file:
        file.set_auto_maskandscale(False)
        file.set_auto_chartostring(False)
        yield file


class StoredArray(BackendArray):  # type: ignore[misc, unused-ignore]
    """A variable that is read when it is used. It holds no file and no lock, and goes to other processes as it is."""

    def __init__(self, name: str, state: tuple[int, ...], group: str | None, variable: netCDF4.Variable) -> None:
        # As it is where it can be: a temporary file lives as long as its path.
        self._name = name if os.path.isabs(name) else os.path.abspath(name)
        self._state, self._group, self._variable = state, group, str(variable.name)
        self.shape = tuple(int(length) for length in variable.shape)
        self.dtype = _type_of(variable)

    def __getitem__(self, key: indexing.ExplicitIndexer) -> Any:
        return indexing.explicit_indexing_adapter(key, self.shape, indexing.IndexingSupport.OUTER, self._read)

    def _read(self, key: tuple[Any, ...]) -> Any:
        if not os.path.exists(self._name) or state_of(self._name) != self._state:
            raise SlidewayError(f"{self._name}: is gone, or another file than when it was opened; open it again")
        with opened(self._name) as file:
            return np.asarray(place_of(file, self._group)[self._variable][key])


def state_of(name: str) -> tuple[int, ...]:
    """What changes when a file is written or replaced."""
    now = os.stat(name)
    return now.st_dev, now.st_ino, now.st_size, now.st_mtime_ns, now.st_ctime_ns


def place_of(file: netCDF4.Dataset, group: str | None) -> Any:
    """A group of a file, or the file itself."""
    return file if group is None else file.groups[group]


def variables_of(place: Any) -> dict[str, netCDF4.Variable]:
    """The variables of a file or group under their names of now; a file of this format has no others."""
    file = place
    while file.parent is not None:
        file = file.parent
    if int(getattr(file, "format_version", 1)) >= first_format:
        return dict(place.variables)
    return {name_of_now(name): variable for name, variable in place.variables.items()}


def bytes_of(variable: netCDF4.Variable) -> int:
    """Bytes of a variable's values."""
    return int(np.prod(variable.shape, dtype=np.float64)) * _type_of(variable).itemsize


def read(
    file: netCDF4.Dataset, name: str, group: str | None = None, names: frozenset[str] | None = None, rows: Mapping[str, slice] | None = None
) -> tuple[dict[str, xr.Variable], dict[str, Any]]:
    """Variables and attributes of an opened file as they are stored; at most `largest_at_once` bytes of them are read.

    Args:
        names: of the variables that are wanted; left out: all.
        rows: which entries of a dimension; of those left out all.
    """
    place = place_of(file, group)
    wanted = {key: variable for key, variable in variables_of(place).items() if names is None or key in names}
    keys = {key: tuple((rows or {}).get(d, slice(None)) for d in variable.dimensions) for key, variable in wanted.items()}
    sizes = {key: _bytes_within(variable, keys[key]) for key, variable in wanted.items()}
    all_at_once = sum(sizes.values()) <= largest_at_once
    state = state_of(name)
    columns = {}
    for key, variable in wanted.items():
        attributes = {str(attribute): variable.getncattr(attribute) for attribute in variable.ncattrs()}
        if all_at_once or sizes[key] <= _small_column or key in variable.dimensions:
            columns[key] = xr.Variable(variable.dimensions, np.asarray(variable[keys[key] or ...]), attributes)
        else:
            stored = indexing.LazilyIndexedArray(StoredArray(name, state, group, variable))
            columns[key] = xr.Variable(variable.dimensions, stored, attributes)[keys[key]]
    return columns, {str(attribute): place.getncattr(attribute) for attribute in place.ncattrs()}


def decoded(columns: Mapping[str, xr.Variable], attributes: Mapping[str, Any]) -> xr.Dataset:
    """What :func:`read` gave as a Dataset: texts for characters, NaN for what was not written.

    Called outside of :func:`opened`: labels that are read later take the lock.
    """
    # Times are numbers of seconds: xarray would make dates or durations of some units.
    return xr.open_dataset(_Columns(columns, attributes), engine="store", decode_times=False, decode_timedelta=False)


class _Columns(AbstractDataStore):  # type: ignore[misc, unused-ignore]
    """Variables as xarray's reader takes them."""

    def __init__(self, columns: Mapping[str, xr.Variable], attributes: Mapping[str, Any]) -> None:
        self._columns, self._attributes = columns, attributes

    def get_variables(self) -> Mapping[str, xr.Variable]:
        return self._columns

    def get_attrs(self) -> Mapping[str, Any]:
        return self._attributes

    def get_dimensions(self) -> Mapping[str, int]:
        return {d: n for variable in self._columns.values() for d, n in variable.sizes.items()}


def _bytes_within(variable: netCDF4.Variable, key: tuple[slice, ...]) -> int:
    lengths = [len(range(*part.indices(length))) for part, length in zip(key, variable.shape, strict=True)]
    return int(np.prod(lengths, dtype=np.float64)) * _type_of(variable).itemsize


def _type_of(variable: netCDF4.Variable) -> np.dtype[Any]:
    return np.dtype(object) if variable.dtype is str else np.dtype(variable.dtype)
