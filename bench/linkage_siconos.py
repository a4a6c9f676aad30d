"""The four-bar of bench/linkage_peers.py by Siconos: rigid journals, Newton's restitution, Moreau and Jean's time stepping and LSODAR.

Siconos is a package of Debian (python3-siconos).  What it has to know of the mechanism is compiled: siconos_four_bar.c, by cc.
"""

from __future__ import annotations

import ctypes
import pathlib
import subprocess
import tempfile
import time
from typing import Any

import numpy as np
import siconos.kernel as sk

version = "4.4.0"  # of Debian 12; the package does not say
settings = [1e-4, 1e-5, 1e-6]  # steps
tolerances = [1e-3, 1e-6, 1e-12]  # of LSODAR
_folder = tempfile.TemporaryDirectory()
_name = "SiconosFourBar"


def _loaded() -> ctypes.CDLL:
    """The compiled functions, which Siconos then finds by the name of their library."""
    made = pathlib.Path(_folder.name) / f"{_name}.so"
    source = pathlib.Path(__file__).with_name("siconos_four_bar.c")
    subprocess.run(["cc", "-O2", "-shared", "-fPIC", f"-Wl,-soname,{made.name}", "-o", str(made), str(source), "-lm"], check=True)
    return ctypes.CDLL(str(made), mode=ctypes.RTLD_GLOBAL)


_library = _loaded()


def _system(places: list[float], rates: list[float], restitution: float, end: float) -> tuple[Any, Any]:
    mechanism = sk.LagrangianDS(places, rates, f"{_name}:mass")
    mechanism.setComputeFIntFunction(_name, "weight")
    mechanism.setComputeJacobianFIntqFunction(_name, "weight_by_q")
    mechanism.setComputeJacobianFIntqDotFunction(_name, "nothing_by_v")
    system = sk.NonSmoothDynamicalSystem(0.0, end)
    system.insertDynamicalSystem(mechanism)
    for pin in ("crank_pin", "coupler_pin", "rocker_pin"):
        gap = sk.LagrangianScleronomousR(f"{_name}:gap_{pin}", f"{_name}:gap_{pin}_by_q")
        system.link(sk.Interaction(sk.NewtonImpactNSL(restitution), gap), mechanism)
    return mechanism, system


def run(step: float, places: list[float], rates: list[float], restitution: float, end: float, samples: int) -> tuple[np.ndarray, float]:
    """Coordinates at the samples, and seconds of processor time of a member, by time stepping."""
    mechanism, system = _system(places, rates, restitution, 2 * end)
    stepping = sk.TimeStepping(system, sk.TimeDiscretisation(0.0, step), sk.MoreauJeanOSI(0.5), sk.LCP())
    coordinates, states, steps = mechanism.q(), np.empty((samples, 7)), round(end / samples / step)
    began = time.process_time()
    for i in range(samples):
        for _ in range(steps):
            stepping.computeOneStep()
            stepping.nextStep()
        states[i] = coordinates
    return states, time.process_time() - began


def run_events(tolerance: float, places: list[float], rates: list[float], restitution: float, end: float, samples: int) -> tuple[np.ndarray, float]:
    """The same from event to event, by LSODAR."""
    mechanism, system = _system(places, rates, restitution, end * (1 + 1e-9))
    simulation = sk.EventDriven(system, sk.TimeDiscretisation(0.0, end / samples))
    integrator = sk.LsodarOSI()
    integrator.setTol(1, tolerance, tolerance)
    simulation.insertIntegrator(integrator)
    problems = sk.LCP(), sk.LCP()  # kept here, for Siconos holds no reference
    simulation.insertNonSmoothProblem(problems[0], sk.SICONOS_OSNSP_ED_IMPACT)
    simulation.insertNonSmoothProblem(problems[1], sk.SICONOS_OSNSP_ED_SMOOTH_ACC)
    coordinates, states, found = mechanism.q(), np.empty((samples, 7)), 0
    began = time.process_time()
    while found < samples:
        simulation.advanceToEvent()
        simulation.processEvents()
        if abs(simulation.startingTime() - end * (found + 1) / samples) < 1e-9:
            states[found] = coordinates
            found += 1
    return states, time.process_time() - began
