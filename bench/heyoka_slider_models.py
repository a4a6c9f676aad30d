"""The free slider in heyoka: tumbling in flight, and rattling on linear springs.  The equations are those of docs/explanation/model.md (M1.1), (M1.2),
(M3.2), (M4.11), (M4.13), (M6.6), (M7.1) and (M7.4), written for heyoka."""

from __future__ import annotations

import itertools

import heyoka as hy
import numpy as np
from heyoka_models import Contacts, Members, lanes, options

state = ("y", "z", "vy", "vz", "roll", "yaw", "pitch", "wx", "wy", "wz", "x", "vx")


class FreeSlider:
    """Twelve equations of a slider on which nothing but its weight and what a subclass adds acts."""

    in_units = False  # of the error's norm; heyoka's tolerances are relative to the largest number of the state, or to 1

    def __init__(self, members: Members, tolerance: float) -> None:
        self._members = members
        self._units = members.scale.mean(axis=1, keepdims=True) if self.in_units else np.ones((len(state), 1))
        self._numbers = dict(zip(state, hy.make_vars(*state), strict=True))
        self._state = {name: unit * self._numbers[name] for name, (unit,) in zip(state, self._units, strict=True)}
        self._start = np.array([members[f"initial.{name}"] for name in state]) / self._units
        self.found = np.empty_like(self._start)
        self._batch = hy.taylor_adaptive_batch(
            self._system(), np.zeros_like(self._start[:, :lanes]), tol=tolerance, **options, **self._events()
        )

    def _forces(self) -> tuple[list, list]:
        """Force along X, Y, Z and torque about the slider's axes."""
        return [0.0] * 3, [0.0] * 3

    def _events(self) -> dict:
        return {}

    def _begin(self, here: slice) -> None:
        """Before the members of a batch run."""

    def _system(self) -> list:
        _, _, vy, vz, roll, yaw, _, wx, wy, wz, _, vx = self._state.values()
        mass, gravity = self._members.same("mechanism.slider_mass"), self._members.same("mechanism.gravity")
        ix, iy, iz = (self._members.same(f"mechanism.slider_inertia_{axis}") for axis in "xyz")
        force, torque = self._forces()
        pitch_rate = (wy * hy.sin(roll) + wz * hy.cos(roll)) / hy.cos(yaw)
        rates = [
            vy, vz, force[1] / mass - gravity, force[2] / mass, wx + pitch_rate * hy.sin(yaw), wy * hy.cos(roll) - wz * hy.sin(roll), pitch_rate,
            (iy - iz) / ix * wy * wz + torque[0] / ix, (iz - ix) / iy * wz * wx + torque[1] / iy, (ix - iy) / iz * wx * wy + torque[2] / iz, vx,
            force[0] / mass,
        ]  # fmt: skip
        return [(self._numbers[name], hy.expression(rate / unit)) for name, rate, (unit,) in zip(state, rates, self._units, strict=True)]

    def run(self) -> None:
        for here in self._members.batches():
            self._batch.state[:] = self._start[:, here]
            self._begin(here)
            self._batch.set_time(0.0)
            self._batch.propagate_until(self._members.end_time)
            self.found[:, here] = self._units * self._batch.state


class Springs(FreeSlider):
    """A spring at each of the sixteen pairs of apex and face.  Parameters: the clearances, then one for each pair, 1 where it touches."""

    in_units = True

    def __init__(self, members: Members, tolerance: float) -> None:
        super().__init__(members, tolerance)
        self.contacts.aim(self._batch.pars)

    def _depths(self) -> list[tuple]:
        """δ of the pairs, the side s, the normal n in the inertial frame, and the apex ρ from the slider's centre in that frame."""
        y, z, roll, yaw, pitch = (self._state[name] for name in ("y", "z", "roll", "yaw", "pitch"))
        sr, cr, sy, cy, sp, cp = hy.sin(roll), hy.cos(roll), hy.sin(yaw), hy.cos(yaw), hy.sin(pitch), hy.cos(pitch)
        self._axes = [
            [cp * cy, sp * cy, -sy],
            [cp * sy * sr - sp * cr, sp * sy * sr + cp * cr, cy * sr],
            [cp * sy * cr + sp * sr, sp * sy * cr - cp * sr, cy * cr],
        ]
        length, width, depth = (self._members.same(f"joint.{name}") for name in ("slider_length", "way_width", "way_depth"))
        pairs = []
        for axis, half, clearance in ((1, width / 2, hy.par[0]), (2, depth / 2, hy.par[1])):
            normal = self._axes[axis]
            for end, one, two in itertools.product((1, -1), repeat=3):
                apex = [end * length / 2, one * width / 2 - y, two * depth / 2 - z]
                side = one if axis == 1 else two
                reach = normal[0] * apex[0] + normal[1] * apex[1] + normal[2] * apex[2]
                pairs.append((side * reach - half - clearance, side, normal, apex))
        return pairs

    def _forces(self) -> tuple[list, list]:
        member = self._members.same
        e1, e2 = member("contact.slider_young_modulus"), member("contact.way_young_modulus")
        modulus = 2 * e1 * e2 / (e1 + e2)
        length, width, depth = (member(f"joint.{name}") for name in ("slider_length", "way_width", "way_depth"))
        stiffness = [modulus * length * depth / (4 * member("joint.thickness_y")), modulus * length * width / (4 * member("joint.thickness_z"))]
        self._pairs = self._depths()
        force, turn = [0.0] * 3, [0.0] * 3
        for i, (delta, side, n, rho) in enumerate(self._pairs):
            push = hy.par[2 + i] * (side * stiffness[i // 8]) * delta
            f = [push * n[k] for k in range(3)]
            moment = [rho[1] * f[2] - rho[2] * f[1], rho[2] * f[0] - rho[0] * f[2], rho[0] * f[1] - rho[1] * f[0]]
            force = [0.0, force[1] + f[1], force[2] + f[2]]
            turn = [turn[k] + moment[k] for k in range(3)]
        return force, [sum((axis[k] * turn[k] for k in range(1, 3)), axis[0] * turn[0]) for axis in self._axes]

    def _events(self) -> dict:
        unit = float(self._units[0, 0])
        self.contacts = Contacts([pair[0] / unit for pair in self._pairs], 2)
        return {"pars": np.zeros((2 + len(self._pairs), lanes)), "t_events": self.contacts.events}

    def _begin(self, here: slice) -> None:
        parameters = self._batch.pars
        parameters[:] = 0
        parameters[0], parameters[1] = self._members["joint.clearance_y"][here], self._members["joint.clearance_z"][here]
        self._batch.reset_cooldowns()
