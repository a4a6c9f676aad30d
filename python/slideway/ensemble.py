"""Scenes that stay in memory: parsed once, run many times, in this process and without files."""

from __future__ import annotations

import os
import threading
from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np
import xarray as xr

from . import arguments
from .errors import FileError, RunError, SceneError, SlidewayError, StoppedEarly
from .results import StrPath, in_memory, labelled
from .scene_files import scene_text
from .toml_writer import to_value

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

try:
    from . import _native
except ImportError as error:  # the sources alone, without what pip builds
    _native = None  # type: ignore[assignment]
    _missing = str(error)

_kept_forms = 8
_process = os.getpid()


def is_available() -> bool:
    """Whether the module that runs scenes in this process was built with the package."""
    return _native is not None


def _no_module() -> str:
    return f"this package has no module for runs in memory ({_missing}); install it with pip install . in the source tree"


class Ensemble:
    """A scene in memory, with its kernels and threads, for those who run it many times: optimisation, calibration, notebooks.

    Several threads may use one at once. It pickles: its copy in another process reads the scene anew, and has the same members.

    Args:
        scene: path of a TOML file, or the scene as nested dictionaries.
        threads: left out: all that this process may use. 1 where a run takes a few milliseconds, or where other programs use the cores.
        isa: "auto", or one of the instruction sets that ``slideway list`` names.
        verify: also check each run, as the program does: some members run again with tighter tolerances and by another method. The
            group "verification" of the result then says what is resolved. It takes up to a tenth of a long run, and more of a
            short one, so that it is off unless it is asked for.
        set: dotted keys and their values, in place of those of the scene: ``{"joint.clearance": "0.2 mm"}``.
        **overrides: the same as `set`, with two underscores for the dot: ``study__members=64``.

    Raises:
        SceneError: the scene is wrong; the text says where and what to do.
        SlidewayError: the package was installed without its module.

    >>> ensemble = slideway.Ensemble({"schema": 1, "study": {"kind": "ensemble", "members": 4, "duration": "1 ms",
    ...                               "quantities": ["peak_tilt"], "vary": {"initial.y": {"dist": "unif", "low": 0, "high": 1e-5}}}})
    >>> len(ensemble), ensemble.inputs
    (4, ['initial.y'])
    >>> ensemble.run().peak_tilt.dims
    ('member', 'axis')
    >>> ensemble.run(joint__clearance="0.2 mm").sizes["member"]
    4
    >>> ensemble.run(inputs={"initial.y": [0.0, 1e-5, 2e-5]}).initial_y.values
    array([0.e+00, 1.e-05, 2.e-05])
    """

    def __init__(
        self,
        scene: StrPath | Mapping[str, Any],
        *,
        threads: int | None = None,
        isa: str = "auto",
        verify: bool = False,
        set: Mapping[str, Any] | None = None,  # noqa: A002 (named as the program's --set)
        **overrides: Any,
    ) -> None:
        if _native is None:
            raise SlidewayError(_no_module())
        self._threads = 0 if threads is None else arguments.whole(threads, "threads", 1)
        self._isa = arguments.text(isa, "isa")
        self._verify = bool(verify)
        self._file = scene_text(scene)
        self._settings = _settings(set, overrides)
        self._read()

    def _read(self) -> None:
        self._native = self._told(_native.Ensemble.parse, self._file.text, self._file.path, self._settings)
        self._forms: dict[int, xr.Dataset] = {}

    def __getstate__(self) -> dict[str, Any]:
        # Another process may have another folder, beside which it would look for the scene's table.
        file = self._file if self._file.keys else replace(self._file, path=os.path.abspath(self._file.path))
        kept = {name: value for name, value in self.__dict__.items() if name not in ("_native", "_forms")}
        return {**kept, "_file": file}

    def __setstate__(self, state: dict[str, Any]) -> None:
        if _native is None:
            raise SlidewayError(_no_module())
        self.__dict__.update(state)
        self._read()

    def __len__(self) -> int:
        """How many members a run has."""
        return int(self._native.members)

    @property
    def inputs(self) -> list[str]:
        """Dotted keys that vary between members, in the order of the columns of ``run(inputs=array)``."""
        return list(self._native.draws()[0])

    @property
    def states(self) -> list[str]:
        """Names of the mechanism's state, in the order of the columns of :meth:`probe`."""
        return list(self._native.state_names)

    @property
    def resolved(self) -> str:
        """The scene as TOML in SI units, all defaults filled in."""
        return str(self._native.resolved)

    @property
    def result_bytes(self) -> int:
        """Bytes of the numbers of a result."""
        return int(self._native.result_bytes)

    @property
    def warnings(self) -> list[str]:
        """Keys of the scene that have no effect, numbers that are likely slips of a unit, and starts inside the way, one line each."""
        return self.warnings_before_run(of_starts=True)

    def warnings_before_run(self, *, of_starts: bool) -> list[str]:
        """The same, without starts unless they are to be taken: a run that does not take them raises what is said of them."""
        return [self._file.said(line) for line in self._told(self._native.warnings, of_starts)]

    def run(
        self,
        inputs: Mapping[str, ArrayLike] | ArrayLike | None = None,
        *,
        progress: bool = False,
        any_start: bool = False,
        set: Mapping[str, Any] | None = None,  # noqa: A002
        **overrides: Any,
    ) -> xr.Dataset:
        """Integrate all members; nothing is written to disk.

        Args:
            inputs: values of members instead of those that the scene draws, in SI units: dotted keys with an array [members] each, or
                an array [members, keys] whose columns are those of `inputs`.
            progress: tell on stderr how far the run is.
            any_start: take starts that no mechanism has, such as inside the way.
            set: dotted keys and their values, for this run alone.
            **overrides: the same as `set`, with two underscores for the dot.

        Returns:
            What :func:`slideway.open` gives of the program's result file of the same scene: the same variables with the same bits.

        Raises:
            SceneError: an override or an input cannot be used, or members start where no mechanism can be.
            KeyboardInterrupt: Ctrl-C; its `__cause__` is a StoppedEarly, whose `dataset` holds the members that had ended.
        """
        native = self._native
        if set or overrides:
            native = self._told(native.with_settings, _settings(set, overrides))
        if inputs is not None:
            native = self._told(native.with_members, *self._rows(inputs))
        is_main = threading.current_thread() is threading.main_thread()
        # OpenMP's threads do not survive a fork.
        threads = self._threads if os.getpid() == _process else 1
        result = self._told(native.run, threads, self._isa, self._verify, progress, bool(any_start), is_main)
        dataset = self._dataset(result)
        if not result.is_complete:
            line = f"stopped early (signal): {dataset.attrs['completeness']}"
            raise KeyboardInterrupt from StoppedEarly(5, line, "", "", dataset)
        return dataset

    def members(self) -> xr.Dataset:
        """What members draw of the keys that vary: a variable [member] for each, named as in a result.

        >>> slideway.Ensemble({"schema": 1, "study": {"kind": "ensemble", "members": 3, "duration": "1 ms",
        ...                    "vary": {"initial.y": {"dist": "unif", "low": 0, "high": 1e-5}}}}).members().initial_y.shape
        (3,)
        """
        names, values = self._native.draws()
        columns = {name.replace(".", "_"): ("member", values[:, i].copy()) for i, name in enumerate(names)}
        return xr.Dataset(columns, {"member": np.arange(len(self), dtype=np.int32)})

    def probe(self, states: Mapping[str, ArrayLike] | ArrayLike, times: ArrayLike | None = None) -> dict[str, NDArray[np.float64]]:
        """The equations of the nominal mechanism at single states.

        Args:
            states: an array [rows, states] in the order of `states`, or its columns by name; those left out are 0.
            times: [s] of each row, for driven mechanisms; left out: 0.

        Returns:
            Arrays [rows]: derivatives ``d_y`` …, powers [W], penetrations [m] and normal forces [N] of the apices, numbers of surfaces,
            lines and points in contact, energies [J], ``crank_torque`` [N m], signals of a mechanism of one's own, and ``status``, 0 where
            the state can be evaluated. Of rigid contacts penetrations and energy; all else is NaN, for it depends on how contacts began.

        >>> forces = slideway.Ensemble({"schema": 1}).probe({"y": [0.0, 1.001e-4]})
        >>> forces["surfaces"]
        array([0., 1.])
        """
        names = self.states
        if isinstance(states, Mapping):
            if unknown := [name for name in states if name not in names]:
                raise SlidewayError(f"{arguments.shown(unknown[0])} is no state of this mechanism; it has {', '.join(names)}")
            columns = np.broadcast_arrays(*(arguments.numbers(states.get(name, 0.0), name) for name in names))
            rows = np.stack([column.ravel() for column in columns], axis=1)
        else:
            rows = arguments.numbers(states, "states")
            if rows.ndim != 2 or rows.shape[1] != len(names):
                raise SlidewayError(f"states has the shape {rows.shape}; give one column for each of {', '.join(names)}")
        when = np.zeros(0) if times is None else np.broadcast_to(arguments.numbers(times, "times"), rows.shape[:1])
        columns_, values = self._told(self._native.probe, np.ascontiguousarray(rows), np.ascontiguousarray(when))
        return {name: values[:, i].copy() for i, name in enumerate(columns_)}

    def _rows(self, inputs: Mapping[str, ArrayLike] | ArrayLike) -> tuple[list[str], NDArray[np.float64]]:
        if isinstance(inputs, Mapping):
            names: Sequence[str] = [arguments.text(name, "a key of inputs") for name in inputs]
            columns = np.broadcast_arrays(*(np.atleast_1d(arguments.numbers(column, name)) for name, column in inputs.items())) if names else [np.zeros(0)]
            if any(column.ndim != 1 for column in columns):
                raise SlidewayError("inputs: give one number for each member of a key, an array [members]")
            values = np.stack(columns, axis=1)
        else:
            names, values = self.inputs, arguments.numbers(inputs, "inputs")
            if values.ndim != 2 or values.shape[1] != len(names) or not names:
                raise SlidewayError(f"inputs has the shape {values.shape}; give an array [members, {len(names)}] of {', '.join(names) or 'what varies'}")
        return list(names), np.ascontiguousarray(values)

    def _dataset(self, result: Any) -> xr.Dataset:
        form = result.form
        known = self._forms.get(form)
        stem = os.path.splitext(os.path.basename(self._file.path))[0]
        if known is not None:
            dataset = _refilled(known, result.arrays())
        else:
            dataset = labelled(_built(result.variables()))
            # Rows of sections belong to members in another way in each run.
            if "section" not in dataset.dims:
                if len(self._forms) >= _kept_forms:
                    self._forms.clear()
                self._forms[form] = dataset.copy()
        dataset.attrs = result.attributes()
        return in_memory(dataset, result, stem)

    def _told(self, call: Any, *words: Any) -> Any:
        """The call's result, or its error as the package has it."""
        try:
            return call(*words)
        except _native.Error as error:
            code, line = error.args[0], self._file.said(error.args[1])
            raise {2: SceneError, 4: FileError}.get(code, RunError)(code, line) from None


def _built(variables: Sequence[tuple[str, tuple[str, ...], Any, dict[str, Any]]]) -> xr.Dataset:
    """A Dataset of (name, dimensions, values, attributes)."""

    def attributes(given: dict[str, Any]) -> dict[str, Any]:
        # Which coordinates a variable has is the Dataset's to know, as of a file that xarray opens.
        return {
            name: np.asarray(value, dtype=np.int8) if isinstance(value, list) else value
            for name, value in given.items()
            if name not in ("coordinates", "_Encoding")
        }

    columns = {name: xr.Variable(dims, np.asarray(values), attributes(given)) for name, dims, values, given in variables}
    return xr.Dataset(columns)


def _refilled(known: xr.Dataset, arrays: Mapping[str, NDArray[Any]]) -> xr.Dataset:
    """A Dataset of the same form with other values."""
    if not hasattr(known, "_replace"):
        return known.copy(data=arrays)
    # The same in a fifth of the time: nothing has to be compared or aligned.
    variables: dict[Any, xr.Variable] = {}
    for name, variable in known.variables.items():
        values = arrays.get(str(name))
        variables[name] = variable.copy(deep=False) if values is None else xr.Variable(variable.dims, values, variable.attrs, fastpath=True)
    return known._replace(variables=variables)


def _settings(given: Mapping[str, Any] | None, words: Mapping[str, Any]) -> list[tuple[str, str]]:
    named = arguments.overrides(given, words, lambda word: f"there is no argument {word}; keys of the scene have two underscores, as in study__members=64")
    return [(key, to_value(value, key)) for key, value in named.items()]
