// Draws the figures of a report from the numbers beside them, and moves the marks on its ways.
"use strict";

const colours = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9"];

function element(name, parent, className, text) {
  const made = document.createElement(name);
  if (className) made.className = className;
  if (text !== undefined) made.textContent = text;
  parent.appendChild(made);
  return made;
}

function dataOf(figure) {
  return JSON.parse(figure.querySelector("script").textContent);
}

function shown(value) {
  return value === null || value === undefined ? "" : String(Number(value.toPrecision(5)));
}

// The choice of curves above a panel, with their values under the pointer.
function addHead(panel, box) {
  const head = element("div", box, "panel-head");
  if (panel.label) element("b", head, "", panel.label);
  const time = element("output", head);
  const outputs = panel.curves.map((curve, k) => {
    const label = element("label", head);
    const choice = element("input", label);
    choice.type = "checkbox";
    choice.checked = true;
    element("i", label).style.background = colours[k % colours.length];
    if (panel.curves.length > 1) element("span", label, "", curve.label);
    const output = element("output", label);
    choice.addEventListener("change", () => {
      label.classList.toggle("off", !choice.checked);
      panel.graph.setVisibility(k, choice.checked);
    });
    return output;
  });
  return { time, outputs };
}

function rowsOf(panel) {
  return panel.x.map((x, row) => [x].concat(panel.curves.map((curve) => curve.y[row])));
}

function drawPanel(panel, data, figure, together) {
  const box = element("div", figure, "panel");
  const head = addHead(panel, box);
  const chart = element("div", box, "chart");
  panel.graph = new Dygraph(chart, rowsOf(panel), {
    labels: [data.x || "x"].concat(panel.curves.map((curve, k) => curve.label + "\u200b".repeat(k))),
    colors: panel.curves.map((curve, k) => colours[k % colours.length]),
    strokeWidth: data.points ? 0 : 1.6,
    drawPoints: data.points,
    pointSize: 2.5,
    highlightCircleSize: 4,
    legend: "never",
    connectSeparatedPoints: true,
    axisLineColor: "#98a4b0",
    gridLineColor: "#e4e8ec",
    digitsAfterDecimal: 5,
    labelsKMB: false,
    yRangePad: 12,
    xRangePad: data.points ? 12 : 0,
    axes: { y: { axisLabelWidth: 56 }, x: { drawGrid: true } },
    highlightCallback: (event, x, points) => {
      head.time.textContent = shown(x);
      for (const output of head.outputs) output.textContent = "";
      for (const point of points) {
        const k = panel.graph.getLabels().indexOf(point.name) - 1;
        head.outputs[k].textContent = shown(point.yval);
      }
    },
    unhighlightCallback: () => {
      head.time.textContent = "";
      for (const output of head.outputs) output.textContent = "";
    },
    zoomCallback: (from, to) => {
      for (const other of together) {
        if (other !== panel && other.graph) other.graph.updateOptions({ dateWindow: panel.graph.isZoomed("x") ? [from, to] : null });
      }
    },
  });
}

function drawFigure(figure) {
  const data = dataOf(figure);
  for (const panel of data.panels) drawPanel(panel, data, figure, data.panels);
  element("p", figure, "x-label", data.x);
  element("p", figure, "hint", "Drag to zoom, shift and drag to move, double-click for everything; click on a name to hide its curve.");
}

// The row of a way at a time: the last one that is not later.
function rowAt(way, time) {
  let low = 0, high = way.time.length - 1;
  while (low < high) {
    const middle = (low + high + 1) >> 1;
    if (way.time[middle] <= time) low = middle; else high = middle - 1;
  }
  return low;
}

function poseAt(way, time) {
  const k = rowAt(way, time), next = Math.min(k + 1, way.time.length - 1);
  const width = way.time[next] - way.time[k];
  const part = width > 0 ? Math.min(Math.max((time - way.time[k]) / width, 0), 1) : 0;
  const between = (values) => values[k] + part * (values[next] - values[k]);
  let heading = 0;
  if (way.heading.length > 0) {
    const turn = way.heading[next] - way.heading[k];
    heading = way.heading[k] + part * Math.atan2(Math.sin(turn), Math.cos(turn));
  }
  return { x: between(way.x), y: between(way.y), heading };
}

function animate(figure) {
  const data = dataOf(figure);
  const marks = figure.querySelectorAll(".mark");
  const begin = Math.min(...data.ways.map((way) => way.time[0]));
  const end = Math.max(...data.ways.map((way) => way.time[way.time.length - 1]));
  const player = element("div", figure, "player");
  const button = element("button", player, "", "Play");
  const slider = element("input", player);
  const clock = element("output", player);
  Object.assign(slider, { type: "range", min: 0, max: 1000, value: 1000 });
  slider.setAttribute("aria-label", "time");

  function show(time) {
    data.ways.forEach((way, k) => {
      const pose = poseAt(way, time);
      const x = data.left + data.scale * pose.x, y = data.bottom - data.scale * pose.y;
      marks[k].setAttribute("transform", `translate(${x} ${y}) rotate(${(-pose.heading * 180) / Math.PI})`);
      marks[k].classList.add("shown");
    });
    clock.textContent = `${time.toFixed(2)} s`;
  }
  const timeOf = () => begin + ((end - begin) * Number(slider.value)) / 1000;

  let started = null;
  function frame(now) {
    if (started === null) return;
    // A run takes ten seconds to watch, or its own time where that is less.
    const whole = Math.min(10, Math.max(end - begin, 0.5)) * 1000;
    slider.value = Math.min(1000, ((now - started) / whole) * 1000);
    show(timeOf());
    if (Number(slider.value) < 1000) requestAnimationFrame(frame);
    else stop();
  }
  function stop() {
    started = null;
    button.textContent = "Play";
  }
  button.addEventListener("click", () => {
    if (started !== null) return stop();
    button.textContent = "Pause";
    requestAnimationFrame((now) => {
      const done = Number(slider.value) < 1000 ? Number(slider.value) / 1000 : 0;
      started = now - done * Math.min(10, Math.max(end - begin, 0.5)) * 1000;
      frame(now);
    });
  });
  slider.addEventListener("input", () => {
    stop();
    show(timeOf());
  });
  show(end);
}

document.querySelectorAll("figure.curves").forEach(drawFigure);
document.querySelectorAll("figure.plane").forEach(animate);
