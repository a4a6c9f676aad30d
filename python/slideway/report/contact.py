"""Contacts of a stored pose: the penetrations and modes of model.md sections 3, 4 and 7, for drawings and histograms."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from slideway.way import APEX_SIGNS

Array = NDArray[np.float64]
Flags = NDArray[np.bool_]

# Faces as rings of apices, so that neighbours in a ring share an edge; numbers from 0.
Y_FACES = ((0, 3, 7, 4), (1, 2, 6, 5))  # top, bottom
Z_FACES = ((0, 1, 5, 4), (3, 2, 6, 7))  # front, back


def spatial_depths(y: Array, z: Array, attitude: Array, length: float, width: float, depth: float, gap_y: float, gap_z: float) -> Array:
    """Penetrations of the sixteen apex-face pairs (model.md section 3, evaluated clearance first).

    Args:
        y, z: place of the slider's centre in way coordinates [m], (n).
        attitude: of the slider in way coordinates, (n, 3, 3).
        length, width, depth: L_k, w_a, w_b [m].
        gap_y, gap_z: clearances per side [m].

    Returns:
        (n, 16) [m], > 0 in contact: the Y faces at P1 ... P8, then the Z faces.
    """
    arm = np.stack(
        np.broadcast_arrays(
            APEX_SIGNS[:, 0] * length / 2, APEX_SIGNS[:, 1] * width / 2 - np.asarray(y)[:, None], APEX_SIGNS[:, 2] * depth / 2 - np.asarray(z)[:, None]
        ),
        -1,
    )
    depths = []
    for axis, place, gap in ((1, y, gap_y), (2, z, gap_z)):
        normal = attitude[:, None, :, axis]
        across = [k for k in range(3) if k != axis]
        q = sum(normal[..., k] ** 2 for k in across)
        short = -q / (1 + np.sqrt(1 - q))  # n - 1 along its own axis
        lift = short * arm[..., axis] - np.asarray(place)[:, None] + sum(normal[..., k] * arm[..., k] for k in across)
        depths.append(-gap + APEX_SIGNS[:, axis] * lift)
    return np.concatenate(depths, -1)


def spatial_modes(touching: Flags) -> NDArray[np.int64]:
    """Surfaces, lines and points of each configuration (model.md section 4).

    Args:
        touching: (n, 16), pairs in the order of :func:`spatial_depths`.

    Returns:
        (n, 3).

    >>> flags = np.zeros((1, 16), bool)
    >>> flags[0, [0, 3, 7]] = True  # three apices of the top face: two lines that share one
    >>> spatial_modes(flags).tolist()
    [[0, 2, 0]]
    """
    triple = np.zeros((len(touching), 3), dtype=np.int64)
    faces = [list(face) for face in Y_FACES] + [[8 + apex for apex in face] for face in Z_FACES]
    for face in faces:
        on = touching[:, face]
        surface: Flags = np.all(on, axis=1)
        other = np.logical_not(surface)[:, None]
        edge = on & np.roll(on, -1, 1) & other
        on_line = edge | np.roll(edge, 1, 1)
        triple += np.stack([surface, edge.sum(1), (on & ~on_line & other).sum(1)], 1)
    return triple


def planar_depths(y: Array, pitch: Array, length: float, height: float, gap: float) -> Array:
    """Penetrations of a block's corners into its walls (model.md section 7, planar_slider_crank).

    Args:
        y: place of the block's centre [m], (n); pitch: its angle [rad], (n).
        length, height: of the block [m]; gap: clearance per side [m].

    Returns:
        (n, 4) [m], > 0 in contact: upper corners ahead (+X) and behind, then the lower ones.
    """
    sink = 2 * (height / 2) * np.sin(pitch / 2) ** 2
    return np.stack([side * (y + end * length / 2 * np.sin(pitch)) - sink - gap for side in (1, -1) for end in (1, -1)], -1)


def planar_modes(touching: Flags) -> NDArray[np.int64]:
    """Surfaces (both corners of a wall), lines (none) and points of each configuration (model.md section 7).

    >>> planar_modes(np.array([[True, True, False, False], [True, False, False, True]])).tolist()
    [[1, 0, 0], [0, 0, 2]]
    """
    walls = touching.reshape(-1, 2, 2)
    surface = walls.all(2)
    points = walls.sum(2) * ~surface
    return np.stack([surface.sum(1), np.zeros(len(walls), int), points.sum(1)], 1)
