"""What tests read off an open page, and what they do with it: opening one costs seconds, reading it nothing."""

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

# What follows changes a page: it comes after, page by page.
PLAY = """
  const stage = document.getElementById("stage"), wait = (ms) => new Promise((done) => setTimeout(done, ms));
  const state = () => [Number(stage.dataset.frame), document.getElementById("now-time").textContent,
                       document.querySelector("#view-end .near").getAttribute("d")];
  const start = state();
  document.getElementById("play").click();
  await wait(600);
  const later = state();
  document.getElementById("play").click();
  const paused = state();
  await wait(200);
  document.getElementById("contact").click();
  const still = Number(stage.dataset.frame), mode = document.getElementById("now-mode").textContent;
  const slide = document.getElementById("frame");
  slide.value = 5;
  slide.dispatchEvent(new Event("input"));
  return { start, later, paused, still, mode, slid: state() };
"""

# Distance of the drawn slider from each apex, by the outline of the end at which the apex is, in millimetres of the drawing.
TOUCH = """
  const near = (px, py, [ax, ay], [bx, by]) => {
    const t = Math.max(0, Math.min(1, ((px - ax) * (bx - ax) + (py - ay) * (by - ay)) / ((bx - ax) ** 2 + (by - ay) ** 2)));
    return Math.hypot(px - ax - t * (bx - ax), py - ay - t * (by - ay));
  };
  const rows = [];
  for (let k = 0; k < 40; ++k) {
    document.getElementById("contact").click();
    for (const apex of document.querySelectorAll("#view-end .apex")) {
      const end = apex.classList.contains("back") ? "#view-end .far" : "#view-end .near";
      const hole = document.querySelector(end).getAttribute("d").split("Z")[1].slice(1);
      const ring = hole.split("L").map((corner) => corner.split(",").map(Number));
      const [x, y] = [Number(apex.getAttribute("cx")), Number(apex.getAttribute("cy"))];
      const distance = Math.min(...ring.map((corner, i) => near(x, y, corner, ring[(i + 1) % 4])));
      rows.push([/ on[123]/.test(apex.getAttribute("class")), distance]);
    }
  }
  return rows;
"""

COMPLAINTS = """
  setTimeout(() => { throw new Error("on purpose") });
  const answer = await fetch("https://example.org").catch(() => "refused");
  await new Promise((done) => setTimeout(done, 100));
  return answer;
"""

CHANGING = {"ensemble": {"play": PLAY, "touch": TOUCH}, "stored": {"complaints": COMPLAINTS}}
