"""The flat slider-crank of bench/rigid_peers.py by Siconos: Moreau and Jean's time stepping with Newton's restitution.

Siconos is a package of Debian (python3-siconos), not of PyPI; it needs numpy 1.  What it has to know of the mechanism is compiled:
siconos_crank.c, by cc.
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
from rigid_mechanism import end, restitution, rod, samples
from rigid_mechanism import crank as crank_length

version = "4.4.0"  # of Debian 12; the package does not say
settings = [1e-4, 1e-5, 1e-6]  # steps
_corners = "upper_front", "upper_back", "lower_front", "lower_back"
_folder = tempfile.TemporaryDirectory()


def _loaded() -> ctypes.CDLL:
    """The compiled functions, which Siconos then finds by the name of their library."""
    made = pathlib.Path(_folder.name) / "SiconosCrank.so"
    source = pathlib.Path(__file__).with_name("siconos_crank.c")
    subprocess.run(["cc", "-O2", "-shared", "-fPIC", f"-Wl,-soname,{made.name}", "-o", str(made), str(source), "-lm"], check=True)
    return ctypes.CDLL(str(made), mode=ctypes.RTLD_GLOBAL)


_library = _loaded()


def _mechanism() -> Any:
    """Angles of crank, rod and block from the way."""
    made = sk.LagrangianDS([0.0, 0.0, 0.0], [150.0, -75.0, 0.0], "SiconosCrank:mass")
    made.setComputeFGyrFunction("SiconosCrank", "gyroscopic")
    made.setComputeJacobianFGyrqFunction("SiconosCrank", "gyroscopic_by_q")
    made.setComputeJacobianFGyrqDotFunction("SiconosCrank", "gyroscopic_by_v")
    made.setComputeFIntFunction("SiconosCrank", "weight")
    made.setComputeJacobianFIntqFunction("SiconosCrank", "weight_by_q")
    made.setComputeJacobianFIntqDotFunction("SiconosCrank", "nothing_by_v")
    return made


def _run_once(step: float) -> tuple[np.ndarray, float]:
    """Heights at the samples, and seconds of processor time."""
    mechanism = _mechanism()
    system = sk.NonSmoothDynamicalSystem(0.0, end)
    system.insertDynamicalSystem(mechanism)
    for corner in _corners:
        gap = sk.LagrangianScleronomousR(f"SiconosCrank:gap_{corner}", f"SiconosCrank:gap_{corner}_by_q")
        system.link(sk.Interaction(sk.NewtonImpactNSL(restitution), gap), mechanism)
    stepping = sk.TimeStepping(system, sk.TimeDiscretisation(0.0, step), sk.MoreauJeanOSI(0.5), sk.LCP())
    angles, heights, steps = mechanism.q(), np.empty(samples), round(end / samples / step)
    began = time.process_time()
    for i in range(samples):
        for _ in range(steps):
            stepping.computeOneStep()
            stepping.nextStep()
        heights[i] = crank_length * np.sin(angles[0]) + rod * np.sin(angles[1])
    return heights, time.process_time() - began


def run(step: float, rounds: int) -> tuple[np.ndarray, float]:
    """Heights at the samples, and seconds of processor time of a member."""
    runs = [_run_once(step) for _ in range(rounds)]
    return runs[0][0], float(np.median([seconds for _, seconds in runs]))
