// --- drawing: when a chart comes near the window, and again when it is stale --------------------
const places = new Map(); // name -> { chart, plot, readout, drawn, stale, near, marks }
let paperWidth = null; // px, while printing

function config(chart) {
  return {
    displaylogo: false, responsive: true, showSendToCloud: false, showEditInChartStudio: false, plotlyServerURL: "",
    modeBarButtonsToRemove: ["lasso2d", "select2d", "autoScale2d", "zoom3d", "pan3d", "orbitRotation", "tableRotation", "toImage"],
    modeBarButtonsToAdd: [
      { name: "svg", title: "Download chart as SVG", icon: Plotly.Icons.camera, click: (plot) => Plotly.downloadImage(plot, { format: "svg", filename: chart.name }) },
      { name: "csv", title: "Download data as CSV", icon: Plotly.Icons.disk, click: () => download(chart) },
    ],
  };
}

// What a chart draws, as a table: a row a sample and flight (of the timeline: a stretch), numbers as they are shown.
const quoted = (text) => `"${text.replaceAll('"', '""')}"`;
function csv(chart) {
  if (chart.kind === "timeline") {
    const stretches = flights.flatMap((flight, i) => (shown.on[i] ? flight.timeline.map((each) =>
      [quoted(flight.title), quoted(each.event), quoted(each.what), each.from_s, each.to_s].join(",")) : []));
    return `${["flight,event,what,from_s,to_s", ...stretches].join("\n")}\n`;
  }
  const names = [...new Set(chart.rows.flatMap((row) => row.lines.flatMap((line) => line.columns)))];
  const lines = [["flight", "time_s", ...names].join(",")];
  flights.forEach((flight, i) => {
    const series = names.map((name) => column(i, name));
    if (!shown.on[i]) return;
    column(i, "time").forEach((time, n) => {
      const cells = series.map((values) => (values === undefined || Number.isNaN(values[n]) ? "" : values[n].toPrecision(7)));
      lines.push([quoted(flight.title), time.toPrecision(7), ...cells].join(","));
    });
  });
  return `${lines.join("\n")}\n`;
}
function download(chart) {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(new Blob([csv(chart)], { type: "text/csv" }));
  link.download = `${chart.name}.csv`;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 1000);
}

const overTime = (chart) => chart.kind === "time" || chart.kind === "timeline";
function draw(place) {
  const { chart, plot } = place, width = paperWidth ?? plot.clientWidth;
  const { data, layout } = FIGURES[chart.kind](chart, width);
  if (paperWidth) layout.width = paperWidth;
  data.forEach((trace) => { trace.visible = visible(trace); });
  place.stale = false;
  plot.style.minHeight = `${heightOf(chart, width)}px`;
  Plotly.react(plot, data, layout, config(chart));
  if (!place.drawn) {
    place.drawn = true;
    if (overTime(chart)) listen(place);
  }
  placeMarks(place);
  plot.dataset.drawn = "yes";
}
const redraw = () => places.forEach((place) => { place.stale = true; if (place.near && place.drawn) draw(place); });

const watcher = new IntersectionObserver((entries) => entries.forEach((entry) => {
  const place = places.get(entry.target.dataset.chart);
  place.near = entry.isIntersecting;
  if (place.near && (!place.drawn || place.stale)) draw(place);
}), { rootMargin: "300px 0px" });
charts.forEach((chart) => {
  const figure = byId(`chart-${chart.name}`), plot = figure.querySelector(".plot");
  plot.style.minHeight = `${heightOf(chart, plot.clientWidth)}px`;
  places.set(chart.name, { chart, plot, drawn: false, stale: false, near: false, marks: [] });
  watcher.observe(figure);
});

// --- the time cursor, what it reads, and the window, the same in every chart --------------------
const timeAxes = (plot) => Object.keys(plot._fullLayout).filter((key) => /^xaxis\d*$/.test(key)).map((key) => plot._fullLayout[key]);

function listen(place) {
  const { plot } = place;
  place.readout = plot.parentElement.appendChild(Object.assign(document.createElement("div"), { className: "readout", hidden: true }));
  plot.addEventListener("pointermove", (event) => {
    const x = event.clientX - plot.getBoundingClientRect().left;
    const under = timeAxes(plot).find((each) => x >= each._offset && x <= each._offset + each._length);
    if (!under) return;
    setTime(under.p2d(x - under._offset));
    read(place);
  });
  plot.addEventListener("pointerleave", () => { place.readout.hidden = true; });
  plot.on("plotly_relayout", (change) => {
    const keys = Object.keys(change), low = keys.find((key) => /^xaxis\d*\.range\[0\]$/.test(key));
    if (low) setWindow(change[low], change[low.replace("[0]", "[1]")]);
    else if (keys.some((key) => /^xaxis\d*\.autorange$/.test(key))) setWindow(0, end);
    else placeMarks(place);
  });
}

function placeMarks(place) {
  if (!overTime(place.chart) || !place.drawn) return;
  const axes = timeAxes(place.plot);
  while (place.marks.length < axes.length) {
    place.marks.push(place.plot.appendChild(Object.assign(document.createElement("div"), { className: "mark" })));
  }
  place.marks.forEach((mark, k) => {
    const x = axes[k];
    const inside = x && shown.time !== null && shown.time >= x.range[0] && shown.time <= x.range[1];
    mark.style.display = inside ? "block" : "none";
    if (!inside) return;
    mark.style.left = `${x._offset + x.d2p(shown.time)}px`;
    mark.style.height = `${place.plot._fullLayout.height - MARGIN.b}px`;
  });
}

const cell = (tag, text) => Object.assign(document.createElement(tag), { textContent: text });
const tableRow = (tag, texts) => { const made = document.createElement("tr"); made.append(...texts.map((text) => cell(tag, text))); return made; };
function valueText(value, label) {
  if (value === undefined || Number.isNaN(value)) return "–";
  return `${Math.abs(value) >= 1e5 || (value !== 0 && Math.abs(value) < 1e-3) ? value.toExponential(2) : Number(value.toPrecision(5))} ${unitOf(label)}`.trim();
}

// The values under the cursor, beside the chart and not on it: below, or above where there is no room.
function read(place) {
  const { chart, plot, readout } = place, time = shown.time;
  const table = document.createElement("table");
  const named = (i) => {
    const head = cell("th", flights[i].title);
    head.style.setProperty("--c", `var(--line-${flights[i].colour})`);
    return head;
  };
  if (chart.kind === "timeline") {
    table.append(tableRow("th", [`${time.toFixed(2)} s`, "what happens then"]));
    flights.forEach((flight, i) => {
      if (!shown.on[i]) return;
      const now = flight.timeline.filter((each) => each.from_s <= time && time <= each.to_s);
      const row = document.createElement("tr");
      row.append(named(i), cell("td", now.map((each) => `${each.event}${each.what ? ` (${each.what})` : ""} ${each.from_s.toFixed(2)} to ${each.to_s.toFixed(2)} s`).join("; ") || "–"));
      table.append(row);
    });
  } else {
    const rows = chart.rows.map((row) => [row.label, row.lines.find((line) => line.kind === "line").columns[0]]);
    table.append(tableRow("th", [`${time.toFixed(2)} s`, ...rows.map(([label]) => label.replace(/ \[.*\]$/, ""))]));
    flights.forEach((flight, i) => {
      if (!shown.on[i] || !rows.some(([, name]) => column(i, name))) return;
      const n = sampleAt(i, time), past = time > column(i, "time").at(-1), row = document.createElement("tr");
      row.append(named(i), ...rows.map(([label, name]) => cell("td", past ? "–" : valueText(column(i, name)?.[n], label))));
      table.append(row);
    });
  }
  readout.replaceChildren(table);
  readout.hidden = false;
  const box = plot.getBoundingClientRect();
  readout.classList.toggle("above", box.bottom + readout.offsetHeight > innerHeight && box.top > readout.offsetHeight);
}

let waiting = false;
function setTime(time) {
  shown.time = Math.min(Math.max(Number(time), 0), end);
  byId("cursor").value = shown.time;
  byId("now").textContent = `${shown.time.toFixed(2)} s`;
  if (waiting) return;
  waiting = true;
  requestAnimationFrame(() => {
    waiting = false;
    places.forEach((place) => {
      placeMarks(place);
      if (!overTime(place.chart) && place.drawn && place.near) moveRings(place);
    });
    if (byId("values").open) fillValues();
  });
}

function moveRings(place) {
  const names = place.chart.rows[0].lines[0].columns, moved = [], change = { x: [], y: [], z: [] };
  place.plot.data.forEach((trace, k) => {
    if (!trace.cursor) return;
    const n = sampleAt(trace.owners[0], shown.time);
    moved.push(k);
    ["x", "y", "z"].forEach((axisName, m) => change[axisName].push(names[m] ? [column(trace.owners[0], names[m])[n]] : undefined));
  });
  if (names.length < 3) delete change.z;
  Plotly.restyle(place.plot, change, moved);
}

function setWindow(from, to) {
  const window = [Math.max(Math.min(from, to), -0.05 * end), Math.min(Math.max(from, to), 1.05 * end)];
  if (!(window[1] > window[0])) return;
  const same = window.every((value, i) => Math.abs(value - shown.window[i]) < 1e-9);
  shown.window = window;
  byId("from").value = Number(window[0].toFixed(3));
  byId("to").value = Number(window[1].toFixed(3));
  if (same) { places.forEach(placeMarks); return; }
  places.forEach((place) => {
    if (!overTime(place.chart) || !place.drawn) return;
    if (place.near) draw(place); else place.stale = true;
  });
}
