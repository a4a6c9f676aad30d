"""The picture of the worked study."""

from __future__ import annotations

import numpy as np
from pictures.figures import frame
from pictures.style import as_svg, panels
from slideway.palette import colours, limit_colour

from .runs import Outcome, fits, impact_limit


def picture(rigid: list[Outcome], compliant: list[Outcome]) -> str:
    """How the energy of impacts is distributed for each fit, and the limit; as SVG."""
    figure, (ax,) = panels(height=3.6)
    frame(ax, "energy lost in impacts, a turn [mJ]", "share of crossheads below")
    for colour, fit, stiff, soft in zip(colours, fits, rigid, compliant, strict=False):
        for of, style, label in ((stiff, "-", fit.name), (soft, ":", None)):
            ordered = 1e3 * np.sort(of.impacts)
            chosen = np.unique(np.linspace(0, ordered.size - 1, 160).astype(int))
            ax.plot(ordered[chosen], (chosen + 0.5) / ordered.size, style, color=colour, lw=2, label=label)
    ax.plot([], [], ":", color="#555555", lw=2, label="compliant contacts")
    ax.axvline(1e3 * impact_limit, color=limit_colour, lw=1.2, label="limit")
    ax.set_xscale("log")
    ax.set_xticks([0.02, 0.05, 0.1, 0.2, 0.5, 1, 2], ["0.02", "0.05", "0.1", "0.2", "0.5", "1", "2"])
    ax.minorticks_off()
    ax.set_ylim(0, 1.01)
    figure.legend(loc="outside lower center", ncols=3, frameon=False)
    return as_svg(figure)
