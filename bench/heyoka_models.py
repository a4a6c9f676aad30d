"""What the programs with heyoka share: members read from files, callbacks, and the small models of tests/models in batches.

A touch or a parting is a terminal event whose callback sets a parameter.  heyoka's callbacks are Python objects; these are compiled from
heyoka_callback.c.  `relu` and `select` would need the events too: a step that passes a kink goes on with the series from before it, and an
event without a callback ends the propagation of all lanes.
"""

from __future__ import annotations

import csv
import enum
import importlib.util
import pathlib
import subprocess
import sysconfig
import tempfile

import heyoka as hy
import numpy as np

lanes = hy.recommended_simd_size()  # of this processor: 4 with AVX2, 8 with AVX-512
options = {"fast_math": True}  # up to a tenth faster; 512-bit vectors on request change nothing


def _compiled() -> object:
    """The module of heyoka_callback.c."""
    source = pathlib.Path(__file__).with_name("heyoka_callback.c")
    with tempfile.TemporaryDirectory() as folder:
        library = pathlib.Path(folder) / "heyoka_callback.so"
        subprocess.run(["cc", "-O2", "-shared", "-fPIC", f"-I{sysconfig.get_paths()['include']}", source, "-o", library], check=True)
        found = importlib.util.spec_from_file_location("heyoka_callback", library)
        module = importlib.util.module_from_spec(found)
        found.loader.exec_module(module)
    return module


_callbacks = _compiled()


class Act(enum.IntEnum):
    """What a callback does with its number of a lane."""

    count_only = 0
    store = 1  # what is given as the event function rises, 0 as it falls
    scale = 2


class Callback:
    """Called at an event."""

    def __init__(self, act: Act, given: np.ndarray) -> None:
        self.function, self._capsule = _callbacks.make(act, given)

    def aim(self, table: np.ndarray, row: int) -> None:
        """Says on which row of an integrator's states or parameters it acts."""
        _callbacks.aim(self._capsule, table, row)

    @property
    def events(self) -> int:
        return _callbacks.events(self._capsule)


class Contacts:
    """Events that set parameters, one each from `first` on, while a contact lasts."""

    def __init__(self, depths: list, first: int) -> None:
        self._first = first
        self.touching = np.ones(lanes)  # what a parameter is then
        self._callbacks = [Callback(Act.store, self.touching) for _ in depths]
        self.events = [hy.t_event_batch(depth, callback=c.function) for depth, c in zip(depths, self._callbacks, strict=True)]

    def aim(self, parameters: np.ndarray) -> None:
        for row, callback in enumerate(self._callbacks, self._first):
            callback.aim(parameters, row)

    def count(self) -> int:
        """Events so far."""
        return sum(callback.events for callback in self._callbacks)


class Members:
    """The members of a problem whose errors count, from a file that `work_precision --members` writes."""

    def __init__(self, file: pathlib.Path) -> None:
        with file.open() as lines:
            rows = list(csv.DictReader(lines))
        self._columns = {name: np.array([float(row[name]) for row in rows]) for name in rows[0]}
        self.end_time = float(self["end_time"][0])
        components = range(sum(name.startswith("end.") for name in self._columns))
        self.scale, self.end = (np.array([self[f"{what}.{i}"] for i in components]) for what in ("scale", "end"))

    def __getitem__(self, key: str) -> np.ndarray:
        return self._columns[key]

    def __len__(self) -> int:
        return self.end.shape[1]

    def same(self, key: str) -> float:
        """A number that all members share."""
        (value,) = set(self[key])
        return float(value)

    def batches(self) -> list[slice]:
        return [slice(first, first + lanes) for first in range(0, len(self), lanes)]

    def errors(self, found: np.ndarray) -> np.ndarray:
        """Root mean square over the components, of each member.  `found`: [component, member]."""
        return np.sqrt((((found - self.end) / (self.scale + np.abs(self.end))) ** 2).mean(axis=0))


class Lorenz:
    """sigma and beta are numbers of the equations, rho is a parameter."""

    def __init__(self, members: Members, tolerance: float) -> None:
        x, y, z = hy.make_vars("x", "y", "z")
        sigma, beta = members.same("sigma"), members.same("beta")
        self._members = members
        self._start = np.array([members[name] for name in "xyz"])
        self.found = np.empty_like(self._start)
        self._batch = hy.taylor_adaptive_batch(
            [(x, sigma * (y - x)), (y, x * (hy.par[0] - z) - y), (z, x * y - beta * z)], np.ones((3, lanes)), pars=np.ones((1, lanes)), tol=tolerance, **options
        )

    def run(self) -> None:
        for here in self._members.batches():
            self._batch.state[:] = self._start[:, here]
            self._batch.pars[0] = self._members["rho"][here]
            self._batch.set_time(0.0)
            self._batch.propagate_until(self._members.end_time)
            self.found[:, here] = self._batch.state


class Bouncing:
    """y' = v, v' = −1 − p (y − 1) − q (y + 1) in the units of tests/models/bouncing_mass.hpp.  p and q are parameters, 0 but on their face."""

    def __init__(self, members: Members, tolerance: float) -> None:
        y, v = hy.make_vars("y", "v")
        self._members = members
        self._start = np.array([members["y"], members["v"]])
        self._end_time = members.end_time * members["rate"]
        self.found = np.zeros_like(members.end)
        self.contacts = Contacts([y - 1.0, -1.0 - y], 0)
        self._batch = hy.taylor_adaptive_batch(
            [(y, v), (v, -1.0 - hy.par[0] * (y - 1.0) - hy.par[1] * (y + 1.0))],
            np.zeros((2, lanes)),
            pars=np.zeros((2, lanes)),
            tol=tolerance,
            t_events=self.contacts.events,
            **options,
        )
        self._parameters, self._states = self._batch.pars, self._batch.state
        self.contacts.aim(self._parameters)

    def run(self) -> None:
        for here in self._members.batches():
            self._states[:] = self._start[:, here]
            self._parameters[:] = 0
            self.contacts.touching[:] = self._members["stiffness"][here]
            self._batch.reset_cooldowns()
            self._batch.set_time(0.0)
            self._batch.propagate_until(self._end_time[here])
            self.found[:2, here] = self._states


class Valves:
    """Sixteen relief valves (tests/models/relief_valve.hpp) while they bounce: impacts and extrema of the lift are events."""

    end = 200.0

    def __init__(self, tolerance: float) -> None:
        x, v, p = hy.make_vars("x", "v", "p")
        self._inflows = np.linspace(5.0, 7.0, 2 * lanes)
        self._start = np.tile([[0.2], [0.0], [1.0]], (1, lanes))
        self._impact, self._extremum = (Callback(act, np.full(lanes, -0.8)) for act in (Act.scale, Act.count_only))
        lifts = self._lifts = [[] for _ in range(lanes)]

        def bounce(batch: hy.taylor_adaptive_batch, _sign: int, lane: int) -> bool:
            batch.state[1, lane] *= -0.8
            lifts[lane].append(0.0)
            return True

        def record(batch: hy.taylor_adaptive_batch, when: float, _sign: int, lane: int) -> None:
            batch.update_d_output(np.full(lanes, when))
            lifts[lane].append(float(batch.d_output[0, lane]))

        self._batch, self._recording = (
            hy.taylor_adaptive_batch(
                [(x, v), (v, -1.25 * v - (x + 10.0) + p), (p, 20.0 * (hy.par[0] - x * hy.sqrt(p)))],
                self._start,
                pars=np.ones((1, lanes)),
                tol=tolerance,
                t_events=[hy.t_event_batch(x, callback=impact, direction=hy.event_direction.negative)],
                nt_events=[hy.nt_event_batch(v, callback=extremum)],
                **options,
            )
            for impact, extremum in ((self._impact.function, self._extremum.function), (bounce, record))
        )
        self._impact.aim(self._batch.state, 1)

    def _propagate(self, batch: hy.taylor_adaptive_batch, first: int) -> None:
        batch.reset_cooldowns()
        batch.state[:] = self._start
        batch.pars[0] = self._inflows[first : first + lanes]
        batch.set_time(0.0)
        batch.propagate_until(self.end)

    def run(self) -> int:
        """@return how many events there were."""
        before = self._impact.events + self._extremum.events
        for first in range(0, len(self._inflows), lanes):
            self._propagate(self._batch, first)
        return self._impact.events + self._extremum.events - before

    def last_lifts(self) -> np.ndarray:
        """Of each valve those at its last eight events, in their order of size."""
        found = []
        for first in range(0, len(self._inflows), lanes):
            for lifts in self._lifts:
                lifts.clear()
            self._propagate(self._recording, first)
            found += [sorted(lifts[-8:]) for lifts in self._lifts]
        return np.array(found)
