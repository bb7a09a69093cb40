"use strict";
(() => {
  const { flights, charts } = JSON.parse(document.getElementById("data").textContent);
  const ROW = 132; // px, height of a row of a chart
  const MARGIN = { l: 62, r: 12, t: 8, b: 40 };
  const byId = (id) => document.getElementById(id);

  // --- data ---------------------------------------------------------------------------------
  const decoded = new Map();
  function column(flight, name) {
    const key = `${flight}/${name}`;
    if (!decoded.has(key)) {
      const text = flights[flight].columns[name];
      if (text === undefined) return undefined;
      const bytes = Uint8Array.from(atob(text), (c) => c.charCodeAt(0));
      decoded.set(key, new Float32Array(bytes.buffer));
    }
    return decoded.get(key);
  }
  function sampleAt(flight, time) {
    const times = column(flight, "time");
    let low = 0, high = times.length - 1;
    while (high - low > 1) {
      const middle = (low + high) >> 1;
      if (times[middle] <= time) low = middle; else high = middle;
    }
    return time - times[low] <= times[high] - time ? low : high;
  }

  // --- what is shown ------------------------------------------------------------------------
  const end = Math.max(...flights.map((_, i) => column(i, "time").at(-1)));
  const shown = { on: flights.map(() => true), window: [0, end], time: null };
  const probe = document.body.appendChild(document.createElement("span"));
  probe.hidden = true;
  function colour(name, alpha = 1) {
    probe.style.color = `var(--${name})`;
    const [r, g, b] = getComputedStyle(probe).color.match(/[\d.]+/g);
    return `rgba(${r},${g},${b},${alpha})`;
  }
  const visible = (trace) => trace.owners.some((i) => shown.on[i]);

  // --- a chart as Plotly takes it -----------------------------------------------------------
  const axisName = (row) => (row === 0 ? "y" : `y${row + 1}`);

  const unitOf = (label) => (/\[([^\]]+)\]$/.exec(label) || ["", "-"])[1].replace(/^-$/, "");

  function lineTraces(line, row, label) {
    const traces = [];
    const drawnGroups = new Set();
    flights.forEach((flight, i) => {
      const series = line.columns.map((name) => column(i, name));
      if (series.some((values) => values === undefined)) return;
      const ink = colour(`line-${flight.colour}`);
      const base = {
        type: "scatter", mode: "lines", x: column(i, "time"), y: series[0], yaxis: axisName(row), owners: [i],
        name: flight.title, connectgaps: false, hovertemplate: `%{y:.5~g} ${unitOf(label)}`,
        line: { color: ink, width: 1.6, dash: flight.dash },
      };
      if (line.kind === "line") traces.push(base);
      else if (line.kind === "wide") {
        const pale = { color: colour(`line-${flight.colour}`, 0.3), width: 5 };
        traces.push({ ...base, name: `${flight.title}: commanded`, line: pale });
      } else if (line.kind === "mark") {
        traces.push({ ...base, hoverinfo: "skip", hovertemplate: null, line: { color: colour(`line-${flight.colour}`, 0.45), width: 6 } });
      } else if (line.kind === "bound") {
        traces.push({ ...base, name: `${flight.title}: bound`, line: { color: ink, width: 1.1, dash: "dot" } });
      } else if (line.kind === "band") {
        const none = { ...base, hoverinfo: "skip", hovertemplate: null, line: { width: 0, color: ink } };
        traces.push(none);
        traces.push({ ...none, y: series[1], fill: "tonexty", fillcolor: colour(`line-${flight.colour}`, 0.18) });
      } else if (!drawnGroups.has(flight.group)) {
        drawnGroups.add(flight.group);
        const owners = flights.flatMap((other, k) => (other.group === flight.group ? [k] : []));
        const several = flights.some((other) => other.group !== flight.group);
        const name = (line.columns[0].endsWith("_true") ? "truth" : "reference") + (several ? ` (${flight.title})` : "");
        traces.push({ ...base, owners, name, line: { color: colour("ink"), width: 1 } });
      }
    });
    return traces;
  }

  function axis(extra) {
    return {
      gridcolor: colour("rule"), zerolinecolor: colour("rule"), linecolor: colour("soft"), color: colour("soft"),
      showline: true, ticks: "outside", ticklen: 3, automargin: false, ...extra,
    };
  }

  function timeFigure(chart) {
    const rows = chart.rows.length, gap = 0.14 / rows;
    const data = chart.rows.flatMap((row, i) => row.lines.flatMap((line) => lineTraces(line, i, row.label)));
    const layout = {
      ...paper(rows * ROW + MARGIN.t + MARGIN.b), hovermode: "x unified", showlegend: false, dragmode: "zoom", shapes: [],
      xaxis: axis({ anchor: axisName(rows - 1), title: { text: "Time [s]", standoff: 6 }, range: [...shown.window], hoverformat: ".2f" }),
    };
    chart.rows.forEach((row, i) => {
      const span = row.span && (row.decades ? row.span.map(Math.log10) : row.span);
      layout[i === 0 ? "yaxis" : `yaxis${i + 1}`] = axis({
        domain: [1 - (i + 1) / rows + (i === rows - 1 ? 0 : gap), 1 - i / rows], anchor: "x", type: row.decades ? "log" : "linear", ...(row.decades ? { dtick: row.decades } : { nticks: 5 }),
        title: { text: row.label, standoff: 4, font: { size: 11 } }, exponentformat: "power",
        ...(span ? { range: span, autorange: false } : {}),
      });
      const bound = { type: "line", xref: "paper", x0: 0, x1: 1, yref: axisName(i), line: { color: colour("soft"), width: 1.2, dash: "dash" } };
      row.bounds.forEach((value) => layout.shapes.push({ ...bound, y0: value, y1: value }));
    });
    const times = new Set(flights.flatMap((flight) => flight.faults));
    times.forEach((time) => layout.shapes.push({
      type: "line", x0: time, x1: time, yref: "paper", y0: 0, y1: 1, line: { color: colour("soft"), width: 1.2, dash: "dot" },
    }));
    return { data, layout };
  }

  function paper(height) {
    return {
      height, margin: MARGIN, paper_bgcolor: "rgba(0,0,0,0)", plot_bgcolor: "rgba(0,0,0,0)", uirevision: "kept",
      font: { color: colour("ink"), size: 11, family: "system-ui, sans-serif" },
      modebar: { bgcolor: "rgba(0,0,0,0)", color: colour("soft"), activecolor: colour("ink") },
      hoverlabel: { bgcolor: colour("card", 0.72), bordercolor: colour("rule"), font: { color: colour("ink"), size: 11 }, namelength: -1 },
    };
  }

  function eye(degrees) {
    const angle = (degrees * Math.PI) / 180;
    return { x: 2.1 * Math.cos(angle), y: 2.1 * Math.sin(angle), z: 1.0 };
  }

  function spaceFigure(chart) {
    const [names] = chart.rows[0].lines.map((line) => line.columns);
    const data = [];
    flights.forEach((flight, i) => {
      const [x, y, z] = names.map((name) => column(i, name));
      if (!x || !y || !z) return;
      const ink = colour(`line-${flight.colour}`);
      const base = { type: "scatter3d", owners: [i], name: flight.title };
      data.push({
        ...base, mode: "lines", x, y, z, line: { color: ink, width: 4, dash: flight.dash },
        hovertemplate: "east %{x:.2f} km, north %{y:.2f} km, altitude %{z:.3f} km",
      });
      const marks = [[flight.faults[0] ?? null, "circle", 4], [shown.time, "circle-open", 6]];
      marks.forEach(([time, symbol, size], k) => {
        const at = time === null ? [] : [sampleAt(i, time)];
        data.push({
          ...base, mode: "markers", hoverinfo: "skip", cursor: k === 1, x: at.map((n) => x[n]), y: at.map((n) => y[n]), z: at.map((n) => z[n]),
          marker: { color: ink, size, symbol },
        });
      });
    });
    const plain = (text) => ({
      title: { text }, gridcolor: colour("rule"), zerolinecolor: colour("rule"), color: colour("soft"), backgroundcolor: "rgba(0,0,0,0)", nticks: 6,
    });
    const scale = byId("true-scale").checked ? { aspectmode: "data" } : { aspectmode: "manual", aspectratio: { x: 1, y: 1.6, z: 0.7 } };
    return {
      data,
      layout: {
        ...paper(440), margin: { l: 16, r: 0, t: 24, b: 0 }, showlegend: false,
        scene: {
          xaxis: plain("East [km]"), yaxis: plain("North [km]"), zaxis: plain("Altitude [km]"), ...scale,
          camera: { center: { x: 0, y: 0, z: -0.15 }, eye: eye(Number(byId("turn").value)) },
        },
      },
    };
  }

  // --- drawing: when a chart comes near the window, and again when it is stale ----------------
  const places = new Map(); // name -> { chart, plot, drawn, stale, near, mark }
  function config(chart) {
    return {
      displaylogo: false, responsive: true, showSendToCloud: false, showEditInChartStudio: false,
      modeBarButtonsToRemove: ["lasso2d", "select2d", "autoScale2d"],
      modeBarButtonsToAdd: [{ name: "csv", title: "Download data as CSV", icon: Plotly.Icons.disk, click: () => download(chart) }],
      toImageButtonOptions: { format: "svg", filename: chart.name },
    };
  }

  // What a chart draws, as a table: a row a sample and flight, numbers as they are shown.
  function csv(chart) {
    const names = [...new Set(chart.rows.flatMap((row) => row.lines.flatMap((line) => line.columns)))];
    const quoted = (text) => `"${text.replaceAll('"', '""')}"`;
    const lines = [["flight", "time_s", ...names].join(",")];
    flights.forEach((flight, i) => {
      const series = names.map((name) => column(i, name));
      column(i, "time").forEach((time, n) => {
        const cells = series.map((values) => (values === undefined || Number.isNaN(values[n]) ? "" : values[n].toPrecision(7)));
        if (shown.on[i]) lines.push([quoted(flight.title), time.toPrecision(7), ...cells].join(","));
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

  function draw(place) {
    const build = place.chart.name === "trajectory" ? spaceFigure : timeFigure;
    const { data, layout } = build(place.chart);
    data.forEach((trace) => { trace.visible = visible(trace); });
    place.stale = false;
    if (place.drawn) return Plotly.react(place.plot, data, layout, config(place.chart));
    place.drawn = true;
    Plotly.newPlot(place.plot, data, layout, config(place.chart));
    if (place.chart.name !== "trajectory") {
      place.mark = place.plot.appendChild(Object.assign(document.createElement("div"), { className: "mark" }));
      place.plot.on("plotly_hover", (event) => setTime(event.xvals ? event.xvals[0] : event.points[0].x));
      place.plot.on("plotly_relayout", (change) => {
        if ("xaxis.range[0]" in change) setWindow(change["xaxis.range[0]"], change["xaxis.range[1]"]);
        else if (change["xaxis.range"]) setWindow(...change["xaxis.range"]);
        else if (change["xaxis.autorange"]) setWindow(0, end);
        else placeMark(place);
      });
    }
    placeMark(place);
    place.plot.dataset.drawn = "yes";
    return undefined;
  }
  const redraw = () => places.forEach((place) => { place.stale = true; if (place.near && place.drawn) draw(place); });

  const watcher = new IntersectionObserver((entries) => entries.forEach((entry) => {
    const place = places.get(entry.target.dataset.chart);
    place.near = entry.isIntersecting;
    if (place.near && (!place.drawn || place.stale)) draw(place);
  }), { rootMargin: "300px 0px" });
  charts.forEach((chart) => {
    const figure = byId(`chart-${chart.name}`), plot = figure.querySelector(".plot");
    plot.style.minHeight = `${chart.name === "trajectory" ? 440 : chart.rows.length * ROW + MARGIN.t + MARGIN.b}px`;
    places.set(chart.name, { chart, plot, drawn: false, stale: false, near: false, mark: null });
    watcher.observe(figure);
  });

  // --- the time cursor and the window, the same in every chart ----------------------------------
  function placeMark(place) {
    if (!place.mark) return;
    const x = place.plot._fullLayout.xaxis;
    const inside = shown.time !== null && shown.time >= x.range[0] && shown.time <= x.range[1];
    place.mark.style.display = inside ? "block" : "none";
    if (!inside) return;
    place.mark.style.left = `${x._offset + x.d2p(shown.time)}px`;
    place.mark.style.height = `${place.plot._fullLayout.height - MARGIN.b}px`;
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
      places.forEach(placeMark);
      if (byId("values").open) fillValues();
      const space = places.get("trajectory");
      if (space && space.drawn && space.near) moveRings(space);
    });
  }

  function moveRings(place) {
    const traces = place.plot.data, moved = [], x = [], y = [], z = [];
    traces.forEach((trace, k) => {
      if (!trace.cursor) return;
      const n = sampleAt(trace.owners[0], shown.time);
      const [east, north, up] = ["east", "north", "altitude"].map((name) => [column(trace.owners[0], name)[n]]);
      moved.push(k); x.push(east); y.push(north); z.push(up);
    });
    Plotly.restyle(place.plot, { x, y, z }, moved);
  }

  const VALUES = [
    ["airspeed", "Airspeed [m/s]", 2], ["flight_path", "Flight path [deg]", 2], ["heading", "Heading [deg]", 2],
    ["thrust_command", "Thrust command [kN]", 1], ["load_factor_flown", "Load factor", 2], ["bank_angle_flown", "Bank [deg]", 1],
    ["effectiveness_thrust_estimate", "Effectiveness, estimate", 4], ["effectiveness_thrust_true", "true", 4],
  ];
  function fillValues() {
    const table = byId("values").querySelector("table");
    const cells = (tag, texts) => texts.map((text) => Object.assign(document.createElement(tag), { textContent: text }));
    const row = (tag, texts) => { const made = document.createElement("tr"); made.append(...cells(tag, texts)); return made; };
    table.tHead.replaceChildren(row("th", ["Flight", ...VALUES.map(([, title]) => title)]));
    const time = shown.time ?? 0;
    table.tBodies[0].replaceChildren(...flights.flatMap((flight, i) => {
      if (!shown.on[i]) return [];
      const n = sampleAt(i, time);
      const past = time > column(i, "time").at(-1);
      return [row("td", [flight.title, ...VALUES.map(([name, , digits]) => {
        const values = column(i, name);
        return past || !values || Number.isNaN(values[n]) ? "–" : values[n].toFixed(digits);
      })])];
    }));
  }

  function setWindow(from, to) {
    const window = [Math.max(Math.min(from, to), -0.05 * end), Math.min(Math.max(from, to), 1.05 * end)];
    if (!(window[1] > window[0])) return;
    const same = window.every((value, i) => Math.abs(value - shown.window[i]) < 1e-9);
    shown.window = window;
    byId("from").value = Number(window[0].toFixed(3));
    byId("to").value = Number(window[1].toFixed(3));
    if (same) { places.forEach(placeMark); return; }
    places.forEach((place) => {
      if (place.chart.name === "trajectory" || !place.drawn) return;
      if (place.near) Plotly.relayout(place.plot, { "xaxis.range": [...window] });
      else place.stale = true;
    });
  }

  // --- controls ---------------------------------------------------------------------------------
  Object.assign(byId("cursor"), { max: end, step: end > 600 ? 0.1 : 0.01 });
  byId("cursor").addEventListener("input", (event) => setTime(event.target.value));
  byId("values").addEventListener("toggle", fillValues);
  const PACE = 10; // times real time
  let playing = null; // when the last frame of a played flight was [ms]
  function play(now) {
    if (playing === null) return;
    setTime((shown.time ?? 0) + (PACE * (now - playing)) / 1000);
    playing = shown.time < end ? now : null;
    byId("play").textContent = playing === null ? "▶ Play" : "❚❚ Pause";
    if (playing !== null) requestAnimationFrame(play);
  }
  byId("play").addEventListener("click", () => {
    if (shown.time === null || shown.time >= end) setTime(0);
    playing = playing === null ? performance.now() : null;
    byId("play").textContent = playing === null ? "▶ Play" : "❚❚ Pause";
    if (playing !== null) requestAnimationFrame(play);
  });
  byId("from").value = 0;
  byId("to").value = Number(end.toFixed(3));
  ["from", "to"].forEach((id) => byId(id).addEventListener("change", () => setWindow(Number(byId("from").value), Number(byId("to").value))));
  byId("all").addEventListener("click", () => setWindow(0, end));
  document.querySelectorAll("#chips input").forEach((box) => box.addEventListener("change", () => {
    shown.on[Number(box.dataset.flight)] = box.checked;
    redraw();
    if (byId("values").open) fillValues();
  }));
  const space = places.get("trajectory");
  if (space) {
    byId("turn").addEventListener("input", (event) => {
      if (space.drawn) Plotly.relayout(space.plot, { "scene.camera.eye": eye(Number(event.target.value)) });
    });
    byId("true-scale").addEventListener("change", () => draw(space));
  }

  // --- light, dark, print -------------------------------------------------------------------------
  const root = document.documentElement, dark = matchMedia("(prefers-color-scheme: dark)");
  byId("theme").addEventListener("click", () => {
    const isDark = root.dataset.theme ? root.dataset.theme === "dark" : dark.matches;
    root.dataset.theme = isDark ? "light" : "dark";
    redraw();
  });
  dark.addEventListener("change", redraw);
  let theme;
  addEventListener("beforeprint", () => {
    theme = root.dataset.theme;
    root.dataset.theme = "light";
    document.querySelectorAll("details.scenario").forEach((details) => { details.open = true; });
    places.forEach((place) => { draw(place); Plotly.relayout(place.plot, { width: 700 }); });
  });
  addEventListener("afterprint", () => {
    if (theme === undefined) delete root.dataset.theme; else root.dataset.theme = theme;
    places.forEach((place) => { draw(place); Plotly.relayout(place.plot, { width: undefined, autosize: true }); });
  });
})();
