// The slider in its way, frame by frame.  Bodies are drawn to scale; what parts them, gaps and tilts, is magnified by one factor.
// A face of the slider at the place (X, Z) stands at Y = w_a/2 + m (c + y + pitch X - roll Z), a graph over the drawing's own
// coordinates: so drawn faces meet drawn apices exactly when the penetration vanishes.
"use strict";

(function () {
  const film = dataOf("film");
  if (!film) return;
  const at = (id) => document.getElementById(id);
  const NS = "http://www.w3.org/2000/svg";
  const svgOf = (id, box) => {
    const svg = at(id);
    svg.setAttribute("viewBox", box.join(" "));
    svg.replaceChildren();
    return svg;
  };
  const add = (parent, name, attributes, words) => {
    const element = document.createElementNS(NS, name);
    for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, value);
    if (words) element.textContent = words;
    parent.append(element);
    return element;
  };
  const polygon = (corners) => "M" + corners.map((corner) => corner.map((v) => v.toFixed(3)).join(",")).join("L") + "Z";

  // Signs of P1 ... P8 along X, Y, Z, and the faces as rings of apices (model.md section 3).
  const signs = [[1, 1, 1], [1, -1, 1], [1, -1, -1], [1, 1, -1], [-1, 1, 1], [-1, -1, 1], [-1, -1, -1], [-1, 1, -1]];
  const rings = [[1, 1, [0, 3, 7, 4]], [1, -1, [1, 2, 6, 5]], [2, 1, [0, 1, 5, 4]], [2, -1, [3, 2, 6, 7]]];

  // What the faces' contacts are: per face its class (0 free ... 3 surface), its lines, and the class of each apex.
  function contactsOf(bits) {
    const apices = new Array(8).fill(0);
    const faces = rings.map(([axis, side, ring]) => {
      const on = ring.map((apex) => (bits >> (axis === 1 ? apex : 8 + apex)) & 1);
      const all = on.every(Boolean);
      const edges = [0, 1, 2, 3].filter((k) => on[k] && on[(k + 1) % 4]).map((k) => [ring[k], ring[(k + 1) % 4]]);
      const lined = new Set(edges.flat());
      ring.forEach((apex, k) => {
        if (on[k]) apices[apex] = Math.max(apices[apex], all ? 3 : lined.has(apex) ? 2 : 1);
      });
      return { axis, side, kind: all ? 3 : edges.length ? 2 : on.some(Boolean) ? 1 : 0, edges: all ? [] : edges };
    });
    return { apices, faces };
  }

  // A view: h and v are the drawing's axes (0 X, 1 Y, 2 Z), d looks at the reader from `near`; up is the sign of v on the page.
  const plans = {
    end: { h: 2, v: 1, d: 0, near: -1, up: -1, names: ["Z", "Y"] },
    side: { h: 0, v: 1, d: 2, near: 1, up: -1, names: ["X", "Y"] },
    top: { h: 0, v: 2, d: 1, near: 1, up: 1, names: ["X", "Z"] },
  };

  function spatialView(id, one, m) {
    const { h, v, d, near, up, names } = plans[id];
    const half = [one.length / 2, one.width / 2, one.depth / 2];
    const room = [0, m * one.gaps[0], m * one.gaps[1]]; // drawn clearance
    const wall = 0.3 * Math.min(half[1], half[2]);
    const closed = h !== 0; // the slider is open at the ends of the way
    const reach = closed ? half[h] + 2 * room[h] + wall : half[0] * 1.35;
    const rise = half[v] + 2 * room[v] + wall;
    const svg = svgOf("view-" + id, [-reach * 1.06, -rise * 1.1, reach * 2.12, rise * 2.2]);
    const spot = (r) => [r[h], up * r[v]];
    const long = closed ? half[h] : reach * 1.06;
    add(svg, "rect", { class: "way", x: -long, y: -half[v], width: 2 * long, height: 2 * half[v] });
    const far = add(svg, "path", { class: "far" });
    const body = add(svg, "path", { class: "near" });
    const faces = rings.map(() => add(svg, "path", {}));
    const edges = add(svg, "g", {});
    const size = 0.022 * reach;
    const apexOf = (k, front) => {
      const [x, y] = spot(half.map((size, axis) => signs[k][axis] * size));
      return { k, front, mark: add(svg, "circle", { cx: x, cy: y, r: front ? size : size * 1.9 }) };
    };
    const order = [...signs.keys()];
    const apices = [
      ...order.filter((k) => signs[k][d] !== near).map((k) => apexOf(k, false)),
      ...order.filter((k) => signs[k][d] === near).map((k) => apexOf(k, true)),
    ];
    const font = 0.055 * reach + "px";
    add(svg, "text", { x: reach * 0.99, y: -reach * 0.02, "text-anchor": "end", style: "font-size:" + font }, names[0]);
    const above = up < 0 ? "hanging" : "auto";
    add(svg, "text", { x: reach * 0.02, y: up * rise * 1.02, style: "font-size:" + font, "dominant-baseline": above }, names[1]);

    // Displacement of the slider's faces normal to `axis`, m times: constant part and slope along the other axis of the drawing.
    const outline = (f, depth) => {
      const place = [0, one.y[f], one.z[f]];
      const turn = [one.roll[f], one.yaw[f], one.pitch[f]];
      const crossed = (r, i, j) => turn[i] * r[j] - turn[j] * r[i];
      const cross = (r) => [crossed(r, 1, 2), crossed(r, 2, 0), crossed(r, 0, 1)];
      const unit = (axis, size) => [0, 1, 2].map((k) => (k === axis ? size : 0));
      const base = cross(unit(d, depth));
      const shift = (axis) => m * (place[axis] + base[axis]);
      const slope = m * cross(unit(h, 1))[v]; // of v over h; of h over v it is the negative
      const corner = (sh, sv, more) => {
        const b = sh * (half[h] + room[h] + more * (closed ? 1 : 0)) + (closed ? shift(h) : 0);
        const a = sv * (half[v] + room[v] + more) + shift(v);
        if (!closed) return [b, up * (a + slope * b)];
        const cv = (a + slope * b) / (1 + slope * slope);
        return [b - slope * cv, up * cv];
      };
      const ring = (more) => polygon([corner(-1, -1, more), corner(1, -1, more), corner(1, 1, more), corner(-1, 1, more)]);
      if (closed) return ring(wall) + ring(0);
      const block = (sv) => polygon([corner(-1, sv, 0), corner(1, sv, 0), corner(1, sv, wall), corner(-1, sv, wall)]);
      return block(-1) + block(1);
    };

    return (f, contacts) => {
      body.setAttribute("d", outline(f, near * half[d]));
      far.setAttribute("d", outline(f, -near * half[d]));
      edges.replaceChildren();
      contacts.faces.forEach((face, k) => {
        const seen = face.kind && face.axis === v ? 0 : face.kind && face.axis === h ? 1 : -1;
        faces[k].setAttribute("class", seen < 0 ? "" : "face of" + face.kind);
        const across = seen === 0 ? h : v;
        const signOf = (axis, end) => (axis === face.axis ? face.side : axis === across ? end : 0);
        const ends = [-1, 1].map((end) => spot(half.map((size, axis) => signOf(axis, end) * size)));
        faces[k].setAttribute("d", seen < 0 ? "" : "M" + ends.join("L"));
        for (const edge of seen < 0 ? [] : face.edges) {
          const [from, to] = edge.map((apex) => spot(half.map((size, axis) => signs[apex][axis] * size)));
          add(edges, "path", { class: "edge of2", d: `M${from}L${to}` });
        }
      });
      for (const { k, front, mark } of apices) {
        mark.setAttribute("class", "apex" + (front ? "" : " back") + (contacts.apices[k] ? " on" + contacts.apices[k] : ""));
      }
    };
  }

  // A block between two walls; corners upper +X, upper -X, lower +X, lower -X.
  function planarView(one, m) {
    const a = one.length / 2, b = one.width / 2, room = m * one.gaps[0], wall = 0.35 * b;
    const reach = a * 1.25, rise = b + room + wall;
    const svg = svgOf("view-side", [-reach, -rise, 2 * reach, 2 * rise]);
    for (const side of [-1, 1]) {
      add(svg, "rect", { class: "way", x: -reach, y: side < 0 ? -rise : b + room, width: 2 * reach, height: wall });
    }
    const faces = [1, -1].map((side) => add(svg, "path", { d: `M${-a},${-side * (b + room)}L${a},${-side * (b + room)}` }));
    const body = add(svg, "path", { class: "near" });
    const marks = [0, 1, 2, 3].map(() => add(svg, "circle", { r: 0.02 * reach }));
    return (f, contacts) => {
      const corner = (end, side) => [end * a, -(side * b + m * (one.y[f] + one.pitch[f] * end * a))];
      body.setAttribute("d", polygon([corner(-1, -1), corner(1, -1), corner(1, 1), corner(-1, 1)]));
      marks.forEach((mark, k) => {
        const [x, y] = corner(k % 2 ? -1 : 1, k < 2 ? 1 : -1);
        const wallKind = contacts.walls[k < 2 ? 0 : 1];
        mark.setAttribute("cx", x);
        mark.setAttribute("cy", y);
        mark.setAttribute("class", "apex" + (contacts.bits >> k & 1 ? " on" + wallKind : ""));
      });
      faces.forEach((face, k) => face.setAttribute("class", contacts.walls[k] ? "face of" + contacts.walls[k] : ""));
    };
  }

  function cornersOf(bits) {
    const count = (two) => (two & 1) + (two >> 1 & 1);
    return { bits, walls: [bits & 3, bits >> 2 & 3].map((two) => [0, 1, 3][count(two)]) };
  }

  // The whole mechanism, to scale.
  function strip(one) {
    const svg = at("view-strip");
    if (!svg || !one.x) return () => {};
    const [r, rod] = one.links || [0, 0];
    const low = Math.min(...one.x), high = Math.max(...one.x);
    const left = Math.min(one.links ? -r : Infinity, low - one.length) - 8, right = high + one.length + 8;
    const tall = Math.max(r, one.width) + 8;
    svgOf("view-strip", [left, -tall, right - left, 2 * tall]);
    add(svg, "line", { class: "axis", x1: left, x2: right, y1: 0, y2: 0 });
    const thin = one.width * (film.planar ? 1.1 : 0.5);
    if (film.planar) {
      for (const y of [-thin / 2, thin / 2]) add(svg, "line", { class: "wall", x1: low - one.length, x2: right, y1: y, y2: y });
    } else {
      const place = { x: low - one.length, width: right - low + one.length, y: -thin / 2, height: thin };
      add(svg, "rect", { class: "way", ...place });
    }
    const block = add(svg, "rect", { class: "near", y: -one.width * 0.5, width: one.length, height: one.width });
    if (one.links) add(svg, "circle", { class: "axis", cx: 0, cy: 0, r });
    const links = add(svg, "path", { class: "rod" });
    return (f) => {
      block.setAttribute("x", one.x[f] - one.length / 2);
      if (!one.links) return;
      const pin = [r * Math.cos(one.crank[f]), -r * Math.sin(one.crank[f])];
      links.setAttribute("d", `M0,0L${pin}L${one.x[f]},0`);
    };
  }

  const classOf = (modes, f) => (modes[3 * f] ? 3 : modes[3 * f + 1] ? 2 : modes[3 * f + 2] ? 1 : 0);
  const slide = at("frame"), play = at("play"), stage = at("stage");
  const secondsOfWhole = 24; // at speed 1
  let one, views, frame = 0, playing = false, last = 0, rest = 0;

  function timeline() {
    const canvas = at("timeline");
    canvas.width = Math.max(canvas.clientWidth, 300);
    canvas.height = 12;
    const pen = canvas.getContext("2d");
    const colours = ["free", "point", "line", "surface"].map(colour);
    for (let column = 0; column < canvas.width; ++column) {
      const from = Math.floor((column / canvas.width) * one.count);
      const to = Math.max(from + 1, Math.floor(((column + 1) / canvas.width) * one.count));
      let most = 0;
      for (let f = from; f < to && f < one.count; ++f) most = Math.max(most, classOf(one.modes, f));
      pen.fillStyle = colours[most];
      pen.fillRect(column, 0, 1, 12);
    }
  }

  function show(f) {
    frame = Math.max(0, Math.min(one.count - 1, f));
    const contacts = film.planar ? cornersOf(one.touching[frame]) : contactsOf(one.touching[frame]);
    for (const view of views) view(frame, contacts);
    const [surfaces, lines, points] = one.modes.subarray(3 * frame, 3 * frame + 3);
    const counts = [[surfaces, "surface"], [lines, "line"], [points, "point"]].filter(([count]) => count);
    const held = counts.map(([count, noun]) => `${count} ${noun}${count === 1 ? "" : "s"}`).join(", ");
    const mm = (value) => value.toFixed(4).replace("-", "−") + " mm";
    at("now-time").textContent = one.time[frame].toFixed(4) + " s";
    at("now-mode").textContent = `(${surfaces}, ${lines}, ${points}) ${held || "free flight"}`;
    at("now-place").textContent = film.planar
      ? `y ${mm(one.y[frame])}, pitch ${(1e3 * one.pitch[frame]).toFixed(3).replace("-", "−")} mrad`
      : `y ${mm(one.y[frame])}, z ${mm(one.z[frame])}`;
    slide.value = frame;
    slide.setAttribute("aria-valuetext", `${one.time[frame].toFixed(4)} s`);
    stage.dataset.frame = frame;
  }

  function choose() {
    one = film.members[at("film-choice") ? at("film-choice").selectedIndex : 0];
    slide.max = one.count - 1;
    const m = film.magnification;
    views = film.planar ? [planarView(one, m)] : Object.keys(plans).map((id) => spatialView(id, one, m));
    views.push(strip(one));
    timeline();
    pace();
    show(Math.min(frame, one.count - 1));
  }

  const short = (value) => (value < 10 ? value.toPrecision(2) : Math.round(value).toLocaleString("en"));

  function pace() {
    const length = one.time[one.count - 1] - one.time[0];
    const real = (length / secondsOfWhole) * Number(at("speed").value);
    at("pace").textContent = real > 1 ? `${short(real)} times real time` : `slowed down ${short(1 / real)} times`;
  }

  function stop() {
    playing = false;
    play.textContent = "Play";
  }

  function tick(now) {
    if (!playing) return;
    rest += ((now - last) / 1000) * (one.count / secondsOfWhole) * Number(at("speed").value);
    last = now;
    const whole = Math.floor(rest);
    rest -= whole;
    if (whole) show(frame + whole);
    if (frame >= one.count - 1) return stop();
    requestAnimationFrame(tick);
  }

  play.addEventListener("click", () => {
    if (playing) return stop();
    if (frame >= one.count - 1) show(0);
    playing = true;
    play.textContent = "Pause";
    last = performance.now();
    rest = 0;
    requestAnimationFrame(tick);
  });
  const step = (by) => () => (stop(), show(frame + by));
  at("back").addEventListener("click", step(-1));
  at("forward").addEventListener("click", step(1));
  at("contact").addEventListener("click", () => {
    stop();
    for (let k = 1; k <= one.count; ++k) {
      const f = (frame + k) % one.count;
      if (one.touching[f]) return show(f);
    }
  });
  slide.addEventListener("input", () => (stop(), show(Number(slide.value))));
  at("speed").addEventListener("change", pace);
  if (at("film-choice")) at("film-choice").addEventListener("change", () => (stop(), choose()));
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", timeline);
  choose();
})();
