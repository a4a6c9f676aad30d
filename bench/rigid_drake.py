"""The flat slider-crank of bench/rigid_peers.py by Drake: its discrete solvers and its error-controlled ones.

Contacts of Drake return a share of a speed by damping: of a linear spring (SAP), tuned here for the step; or by Hunt and Crossley's law, which
returns more of a lower speed, tuned for one speed.
"""

from __future__ import annotations

import logging
import math
import time
from dataclasses import dataclass
from importlib.metadata import version as version_of
from typing import Any

import numpy as np
from pydrake.geometry import (
    AddCompliantHydroelasticPropertiesForHalfSpace,
    AddContactMaterial,
    AddRigidHydroelasticProperties,
    Box,
    HalfSpace,
    ProximityProperties,
    Sphere,
)
from pydrake.math import RigidTransform, RotationMatrix
from pydrake.multibody.plant import AddMultibodyPlant, CoulombFriction, MultibodyPlant, MultibodyPlantConfig
from pydrake.multibody.tree import FixedOffsetFrame, RevoluteJoint, RotationalInertia, SpatialInertia
from pydrake.systems.analysis import ApplySimulatorConfig, Simulator, SimulatorConfig
from pydrake.systems.framework import DiagramBuilder
from rigid_mechanism import (
    corner_radius,
    corners,
    damping_ratio,
    end,
    half_height,
    half_length,
    height,
    hunt_crossley_dissipation,
    links,
    pressed_mass,
    restitution,
    samples,
    start_speeds,
    wall,
    where_it_falls_to,
)

version = version_of("drake")
logging.getLogger("drake").setLevel(logging.ERROR)  # It warns that half-spaces do not deform.


@dataclass
class Setting:
    """How contacts are made and steps taken; a step of 0 is that of an integrator with error control, at this accuracy."""

    name: str
    step: float
    accuracy: float = 0
    scheme: str = ""
    solver: str = "sap"
    stiffness: float = 0  # of a corner [N/m]
    relaxation: float = 0  # damping over stiffness of a linear spring [s]
    dissipation: float = 0  # of Hunt and Crossley's law [s/m]
    modulus: float = 0  # of walls 1 cm deep with a pressure field; 0: spheres at the corners [Pa]


def rebound(frequency: float, relaxation: float, step: float) -> float:
    """Share of a unit speed that an implicit step with a spring and damper returns, in the mean over the phases of the first step.

    >>> ratio = damping_ratio(0.4)
    >>> round(rebound(1, 2 * ratio, 1e-3), 2)
    0.4
    """
    shares = []
    for phase in range(16):
        gap, speed, pushed, force = (phase + 0.5) / 16 * step, -1.0, False, 0.0
        while not pushed or force > 0:
            slower = (speed - step * frequency**2 * gap) / (1 + step * frequency**2 * (step + relaxation))
            force = -gap - (step + relaxation) * slower
            pushed = pushed or force > 0
            speed = slower if force > 0 else speed
            gap += step * speed
        shares.append(max(speed, 0.0))
    return float(np.mean(shares))


def by_linear_springs(step: float, impact_steps: int) -> Setting:
    """Impacts take so many steps; damping as the step needs it."""
    frequency = math.pi / (impact_steps * step)
    relaxation = where_it_falls_to(restitution, lambda tau: rebound(frequency, tau, step), 0, 4 / frequency)
    return Setting(f"SAP, linear springs, {impact_steps} steps an impact", step, stiffness=pressed_mass * frequency**2 / 2, relaxation=relaxation)


def by_error_control(scheme: str, accuracy: float, speed: float) -> Setting:
    """Hunt and Crossley's law, tuned for a speed."""
    return Setting(f"{scheme}, Hunt–Crossley for {speed} m/s", 0, accuracy, scheme, stiffness=1e7, dissipation=hunt_crossley_dissipation(restitution, speed))


def by_pressure_fields(step: float) -> Setting:
    """Hydroelastic contact of a rigid block with compliant walls."""
    dissipation = hunt_crossley_dissipation(restitution, 0.4)
    return Setting("hydroelastic, lagged, Hunt–Crossley for 0.4 m/s", step, solver="lagged", dissipation=dissipation, modulus=1e10)


settings = [
    *(by_linear_springs(step, steps) for step, steps in ((1e-4, 10), (1e-5, 10), (1e-5, 20), (1e-5, 40), (1e-6, 20), (1e-6, 40), (1e-6, 80))),
    *(by_error_control("cenic", accuracy, speed) for accuracy in (1e-4, 1e-5, 1e-6) for speed in (0.4, 0.7, 1.0)),
    by_error_control("runge_kutta3", 1e-5, 0.7),
    by_pressure_fields(1e-4),
    by_pressure_fields(1e-5),
]


def material(setting: Setting) -> ProximityProperties:
    """Of either side: springs in series, so twice as stiff and half as damped."""
    made = ProximityProperties()
    AddContactMaterial(dissipation=setting.dissipation or None, point_stiffness=2 * setting.stiffness or None, friction=CoulombFriction(0, 0), properties=made)
    if setting.relaxation > 0:
        made.AddProperty("material", "relaxation_time", setting.relaxation / 2)
    return made


def add_contacts(plant: MultibodyPlant, block: Any, setting: Setting) -> None:
    """Walls above and below, and the block's corners or faces."""
    for name, at, turn in (("lower", -wall, -math.pi / 2), ("upper", wall, math.pi / 2)):
        of_wall = material(setting)
        if setting.modulus > 0:
            AddCompliantHydroelasticPropertiesForHalfSpace(0.01, setting.modulus, of_wall)
        plant.RegisterCollisionGeometry(plant.world_body(), RigidTransform(RotationMatrix.MakeXRotation(turn), [0, at, 0]), HalfSpace(), name, of_wall)
    if setting.modulus > 0:
        faces = material(setting)
        AddRigidHydroelasticProperties(faces)
        plant.RegisterCollisionGeometry(block, RigidTransform(), Box(2 * half_length, 2 * half_height, 0.01), "faces", faces)
        return
    for i, (x, y) in enumerate(corners):
        plant.RegisterCollisionGeometry(block, RigidTransform([x, y, 0]), Sphere(corner_radius), f"corner {i}", material(setting))


def simulator(setting: Setting) -> tuple[MultibodyPlant, Simulator]:
    """The mechanism, its joints' angles relative, and what runs it."""
    builder = DiagramBuilder()
    config = MultibodyPlantConfig(time_step=setting.step, contact_model="hydroelastic" if setting.modulus > 0 else "point",
                                  discrete_contact_approximation=setting.solver)
    plant, _ = AddMultibodyPlant(config, builder)
    plant.mutable_gravity_field().set_gravity_vector([0, -9.81, 0])
    body = plant.world_body()
    for link in links:
        pin = plant.AddFrame(FixedOffsetFrame(f"pin of {link.name}", body.body_frame(), RigidTransform([link.at, 0, 0])))
        inertia = RotationalInertia(link.inertia, link.inertia, link.inertia)
        body = plant.AddRigidBody(link.name, SpatialInertia.MakeFromCentralInertia(link.mass, [link.centre, 0, 0], inertia))
        plant.AddJoint(RevoluteJoint(f"hinge of {link.name}", pin, body.body_frame(), [0, 0, 1]))
    add_contacts(plant, body, setting)
    plant.Finalize()
    made = Simulator(builder.Build())
    if setting.scheme:
        ApplySimulatorConfig(SimulatorConfig(integration_scheme=setting.scheme, accuracy=setting.accuracy, max_step_size=1e-3, use_error_control=True), made)
    return plant, made


def run(setting: Setting, rounds: int) -> tuple[np.ndarray, float]:
    """Heights at the samples, and seconds of processor time of a member."""
    taken = []
    heights = np.empty(samples)
    for _ in range(rounds):
        plant, made = simulator(setting)
        context = plant.GetMyMutableContextFromRoot(made.get_mutable_context())
        plant.SetPositions(context, np.zeros(len(links)))
        plant.SetVelocities(context, start_speeds)
        made.Initialize()
        began = time.process_time()
        for i in range(samples):
            made.AdvanceTo((i + 1) * end / samples)
            angles = plant.GetPositions(context)
            heights[i] = height(angles[0], angles[1])
        taken.append(time.process_time() - began)
    return heights, float(np.median(taken))
