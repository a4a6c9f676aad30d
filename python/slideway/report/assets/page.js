// Figures of the page: packed numbers become arrays, names of colours the theme's colours, and Plotly draws them.
"use strict";

const kinds = { f4: Float32Array, f8: Float64Array, u1: Uint8Array, u2: Uint16Array };

function unpacked(block) {
  const bytes = Uint8Array.from(atob(block.bdata), (sign) => sign.charCodeAt(0));
  return new kinds[block.dtype](bytes.buffer);
}

function dataOf(id) {
  const element = document.getElementById(id);
  return element && JSON.parse(element.textContent, (key, value) => (value && value.bdata !== undefined ? unpacked(value) : value));
}

function colour(name) {
  return getComputedStyle(document.documentElement).getPropertyValue("--" + name).trim();
}

// "@c1" is the theme's colour c1, "@c1/0.3" the same with an opacity.
function themed(value) {
  if (typeof value === "string" && value[0] === "@") {
    const [name, opacity] = value.slice(1).split("/");
    const hex = colour(name);
    if (!opacity) return hex;
    const part = (from) => parseInt(hex.slice(from, from + 2), 16);
    return `rgba(${part(1)},${part(3)},${part(5)},${opacity})`;
  }
  if (Array.isArray(value)) return value.map(themed);
  if (value && typeof value === "object" && !ArrayBuffer.isView(value)) {
    return Object.fromEntries(Object.entries(value).map(([key, part]) => [key, themed(part)]));
  }
  return value;
}

const axisStyle = { gridcolor: "@grid", zerolinecolor: "@rule", linecolor: "@rule", automargin: true };

const legend = { orientation: "h", x: 0, y: 1, xanchor: "left", yanchor: "top", yref: "container", itemsizing: "constant", bgcolor: "rgba(0,0,0,0)" };

function layoutOf(figure, layout) {
  const whole = {
    font: { family: "system-ui, 'Segoe UI', 'DejaVu Sans', sans-serif", size: 13, color: "@ink" },
    paper_bgcolor: "rgba(0,0,0,0)",
    plot_bgcolor: "rgba(0,0,0,0)",
    margin: { l: 64, r: 16, t: 36, b: 44 },
    height: figure.height,
    hovermode: "x",
    hoverlabel: { bgcolor: "@panel", bordercolor: "@rule", font: { color: "@ink" } },
    modebar: { bgcolor: "rgba(0,0,0,0)", color: "@muted", activecolor: "@link" },
    ...layout,
  };
  whole.legend = { ...legend, ...layout.legend };
  for (const key of Object.keys(whole)) {
    if (/^[xy]axis\d*$/.test(key)) whole[key] = { ...axisStyle, ...whole[key] };
  }
  return themed(whole);
}

const settings = { responsive: true, displaylogo: false, displayModeBar: innerWidth > 720 ? "hover" : false, modeBarButtons: [["toImage", "zoom2d", "pan2d", "zoomIn2d", "zoomOut2d", "resetScale2d"]] };

function draw(name, figure) {
  const chosen = document.getElementById(name + "-choice");
  const variant = figure.variants[chosen ? chosen.selectedIndex : 0];
  return Plotly.react(name, themed(variant.data), layoutOf(figure, variant.layout), settings);
}

async function drawAll(figures) {
  for (const [name, figure] of Object.entries(figures)) {
    await draw(name, figure);
    await new Promise((done) => setTimeout(done));
  }
  document.documentElement.dataset.drawn = Object.keys(figures).length;
}

const figures = dataOf("figures") || {};
for (const [name, figure] of Object.entries(figures)) {
  const choice = document.getElementById(name + "-choice");
  if (choice) choice.addEventListener("change", () => draw(name, figure));
}
matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => drawAll(figures));
drawAll(figures);
