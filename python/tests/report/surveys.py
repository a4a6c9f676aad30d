"""What tests read off an open page without changing it: opening one costs seconds, reading it nothing."""

from __future__ import annotations

# Each a body of JavaScript that returns what it found.
PLOTS = """
  const drawn = [...document.querySelectorAll(".plot")].map((plot) =>
    [plot.id, plot.querySelectorAll(".scatterlayer .trace, .barlayer .point").length]);
  const wide = [...document.querySelectorAll(".plot, .views svg")].map((one) =>
    Math.max(...[one, ...one.querySelectorAll(".main-svg")].map((part) => part.getBoundingClientRect().right)));
  return { drawn: Object.fromEntries(drawn), beyond: Math.max(...wide) - document.documentElement.clientWidth,
           overflow: document.documentElement.scrollWidth - document.documentElement.clientWidth };
"""

COLOURS = """
  const light = (text) => { const [r, g, b] = text.match(/[\\d.]+/g).map(Number); return (0.3 * r + 0.6 * g + 0.1 * b) / 255; };
  return { paper: light(getComputedStyle(document.body).backgroundColor), ink: light(getComputedStyle(document.body).color),
           label: light(getComputedStyle(document.querySelector(".plot text")).fill) };
"""

PHONE = """
  const inside = [...document.querySelectorAll("#summary .scroll, #endings .scroll")];
  const small = [...document.querySelectorAll("#summary td, #summary th, #summary p")].map((one) => one.getBoundingClientRect());
  return { beyond: Math.max(...inside.map((one) => one.scrollWidth - one.clientWidth)), tables: inside.length,
           right: Math.max(...small.map((one) => one.right)), left: Math.min(...small.map((one) => one.left)),
           size: Math.min(...[...document.querySelectorAll("#summary td")].map((one) => parseFloat(getComputedStyle(one).fontSize))),
           named: getComputedStyle(document.querySelector("#summary td"), "::before").content };
"""

LEGENDS = """
  const meets = (a, b) => Math.min(a.right, b.right) - Math.max(a.left, b.left) > 1 && Math.min(a.bottom, b.bottom) - Math.max(a.top, b.top) > 1;
  return [...document.querySelectorAll(".plot")].filter((plot) => {
    const legend = plot.querySelector(".legend .bg");
    return legend && [...plot.querySelectorAll(".plot > rect, .bglayer rect, .nsewdrag")].some((area) =>
      meets(legend.getBoundingClientRect(), area.getBoundingClientRect()));
  }).map((plot) => plot.id);
"""

# One that cannot be read on a page is a text there, and fails the test that asks for it.
ALL = "const read = (one) => { try { return one(); } catch (error) { return String(error); } };\nreturn {" + ",".join(
    f"{name}: read(() => {{{probe}}})" for name, probe in {"plots": PLOTS, "colours": COLOURS, "phone": PHONE, "legends": LEGENDS}.items()
) + "};"
