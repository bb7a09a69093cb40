// --- charts as Plotly takes them ----------------------------------------------------------------
const rowHeight = () => (paperWidth ? 116 : 132); // px, of a row of a chart: seven fit on a page
const TITLE = 18; // px above a row of panels
const MARGIN = { l: 62, r: 12, t: 8, b: 40 };
const LEAST_PANEL = 215; // px
const numbered = (letter, n) => (n === 0 ? letter : `${letter}${n + 1}`);

function axis(extra) {
  return {
    gridcolor: colour("rule"), zerolinecolor: colour("rule"), linecolor: colour("soft"), color: colour("soft"),
    showline: true, ticks: "outside", ticklen: 3, automargin: false, ...extra,
  };
}

function paper(height) {
  return {
    height, margin: MARGIN, paper_bgcolor: "rgba(0,0,0,0)", plot_bgcolor: "rgba(0,0,0,0)", showlegend: false,
    font: { color: colour("ink"), size: 11, family: "system-ui, sans-serif" },
    modebar: { bgcolor: "rgba(0,0,0,0)", color: colour("soft"), activecolor: colour("ink") },
    hoverlabel: { bgcolor: colour("card", 0.72), bordercolor: colour("rule"), font: { color: colour("ink"), size: 11 }, namelength: -1 },
  };
}

const faultLines = (refs) => [...new Set(flights.flatMap((flight) => flight.faults))].flatMap((time) => refs.map((xref) => ({
  type: "line", xref, x0: time, x1: time, yref: "paper", y0: 0, y1: 1, line: { color: colour("soft"), width: 1.2, dash: "dot" },
})));

// Panels beside each other, in as many bands as the width asks for.
function gridOf(width) {
  const across = Math.max(Math.min(panels.length, 3, Math.floor((width - MARGIN.l) / LEAST_PANEL)), 1);
  return { across, bands: Math.ceil(panels.length / across) };
}
function heightOf(chart, width) {
  if (chart.kind === "timeline") return timelineHeight();
  if (chart.kind !== "time") return chart.kind === "plane" ? 330 : 440;
  const { bands } = gridOf(width);
  return bands * (chart.rows.length * rowHeight() + (panels.length > 1 ? TITLE : 0)) + MARGIN.t + MARGIN.b;
}

function timeFigure(chart, width) {
  const ROW = rowHeight(), rows = chart.rows.length, { across, bands } = gridOf(width), titled = panels.length > 1;
  const height = heightOf(chart, width), inner = height - MARGIN.t - MARGIN.b;
  const wide = (width - MARGIN.l - MARGIN.r - (across - 1) * 26) / across;
  const data = [], layout = { ...paper(height), hovermode: false, dragmode: "zoom", shapes: [], annotations: [] };
  const across01 = (column) => [column, column + 1].map((n, k) => (n * (wide + 26) - k * 26) / (width - MARGIN.l - MARGIN.r));
  const axesOf = (panel, row) => {
    const column = panel % across, level = Math.floor(panel / across) * rows + row;
    return { x: column + across * Math.floor(panel / across), y: level * across + column, column, level };
  };
  chart.rows.forEach((row, r) => {
    const axes = (i) => { const at = axesOf(flights[i].panel, r); return { xaxis: numbered("x", at.x), yaxis: numbered("y", at.y) }; };
    const traces = row.lines.flatMap((line) => lineTraces(line, axes, wide, row.decades > 0));
    data.push(...traces);
    const range = rangeOf(row, traces);
    panels.forEach((title, p) => {
      const at = axesOf(p, r), band = Math.floor(p / across);
      const top = (band * (rows * ROW + (titled ? TITLE : 0)) + (titled ? TITLE : 0) + r * ROW) / inner;
      const gap = r === rows - 1 ? (band === bands - 1 ? 0 : 34) : 17;
      layout[numbered("yaxis", at.y)] = axis({
        domain: [Math.max(1 - top - (ROW - gap) / inner, 0), 1 - top], anchor: numbered("x", at.x), type: row.decades ? "log" : "linear",
        ...(row.decades ? { dtick: row.decades } : { nticks: 5 }), range, autorange: false, fixedrange: true, exponentformat: "power",
        showticklabels: at.column === 0, ...(at.column === 0 ? { title: { text: row.label, standoff: 4, font: { size: 11 } } } : {}),
      });
      if (r === rows - 1) {
        layout[numbered("xaxis", at.x)] = axis({
          domain: across01(at.column), anchor: numbered("y", at.y), range: [...shown.window], autorange: false, nticks: across > 1 ? 5 : 0,
          ...(band === bands - 1 || p + across >= panels.length ? { title: { text: "Time [s]", standoff: 6 } } : {}),
        });
        if (titled) layout.annotations.push({
          text: title, showarrow: false, xref: "paper", yref: "paper", x: across01(at.column)[0], xanchor: "left", y: 1 - (band * (rows * ROW + TITLE)) / inner,
          yanchor: "top", yshift: 4, font: { size: 11, color: colour("ink") },
        });
      }
      const bound = { type: "line", xref: `${numbered("x", at.x)} domain`, x0: 0, x1: 1, yref: numbered("y", at.y), line: { color: colour("soft"), width: 1.2, dash: "dash" } };
      row.bounds.forEach((value) => layout.shapes.push({ ...bound, y0: value, y1: value }));
    });
  });
  layout.shapes.push(...faultLines(panels.map((_, p) => numbered("x", axesOf(p, 0).x))));
  return { data, layout };
}

// A lane for each kind of event, a thin bar in it for each flight.
const LANE = { bar: 7, gap: 12 };
const lanes = () => events.filter((event) => flights.some((flight) => flight.timeline.some((each) => each.event === event)));
const laneHeight = () => flights.length * LANE.bar + LANE.gap;
function timelineHeight() { return lanes().length * laneHeight() + MARGIN.t + MARGIN.b; }
function timelineFigure() {
  const kinds = lanes(), height = timelineHeight(), data = [];
  const layout = {
    ...paper(height), margin: { ...MARGIN, l: 108 }, hovermode: false, dragmode: "zoom", shapes: faultLines(["x"]),
    xaxis: axis({ title: { text: "Time [s]", standoff: 6 }, range: [...shown.window], autorange: false }),
    yaxis: axis({
      range: [kinds.length * laneHeight(), 0], autorange: false, fixedrange: true, ticks: "", showgrid: false, zeroline: false,
      tickvals: kinds.map((_, k) => (k + 0.5) * laneHeight()), ticktext: kinds,
    }),
  };
  kinds.forEach((kind, k) => {
    if (k) layout.shapes.push({ type: "line", xref: "paper", x0: 0, x1: 1, y0: k * laneHeight(), y1: k * laneHeight(), line: { color: colour("rule"), width: 1 } });
    flights.forEach((flight, i) => {
      const found = flight.timeline.filter((each) => each.event === kind);
      if (!found.length) return;
      const y = k * laneHeight() + LANE.gap / 2 + (i + 0.5) * LANE.bar;
      data.push({
        type: "scatter", mode: "lines", owners: [i], name: flight.title, hoverinfo: "skip", line: { color: inkOf(i), width: 4 },
        x: found.flatMap((each) => [each.from_s, each.to_s, null]), y: found.flatMap(() => [y, y, null]),
      }, {
        type: "scatter", mode: "markers", owners: [i], name: flight.title, hoverinfo: "skip",
        x: found.map((each) => each.from_s), y: found.map(() => y), marker: { symbol: "line-ns-open", size: 7, color: inkOf(i), line: { width: 2, color: inkOf(i) } },
      });
    });
  });
  return { data, layout };
}

function eye(degrees) {
  const angle = (degrees * Math.PI) / 180;
  return { x: 2.25 * Math.cos(angle), y: 2.25 * Math.sin(angle), z: 1.1 };
}

// Dot where the first fault sets in, ring at the time cursor.
function markers(i, base, of) {
  return [[flights[i].faults[0] ?? null, "circle", 1], [shown.time, "circle-open", 1.5]].map(([time, symbol, size], k) => ({
    ...base, mode: "markers", hoverinfo: "skip", cursor: k === 1, ...of(time === null ? [] : [sampleAt(i, time)]),
    marker: { color: inkOf(i), size: size * (base.type === "scatter3d" ? 4 : 7), symbol, ...(k ? { line: { width: 2, color: inkOf(i) } } : {}) },
  }));
}

function spaceFigure(chart) {
  const [names] = chart.rows[0].lines.map((line) => line.columns), data = [];
  flights.forEach((flight, i) => {
    const [x, y, z] = names.map((name) => column(i, name));
    if (!x || !y || !z) return;
    const base = { type: "scatter3d", owners: [i], name: flight.title };
    data.push({
      ...base, mode: "lines", x, y, z, line: { color: inkOf(i), width: 4, dash: flight.dash },
      hovertemplate: "east %{x:.2f} km, north %{y:.2f} km, altitude %{z:.3f} km",
    }, ...markers(i, base, (at) => ({ x: at.map((n) => x[n]), y: at.map((n) => y[n]), z: at.map((n) => z[n]) })));
  });
  const plain = (text) => ({
    title: { text, font: { size: 11 } }, gridcolor: colour("rule"), zerolinecolor: colour("rule"), color: colour("soft"), backgroundcolor: "rgba(0,0,0,0)", nticks: 6,
  });
  const scale = byId("true-scale").checked ? { aspectmode: "data" } : { aspectmode: "manual", aspectratio: { x: 1, y: 1.3, z: 0.7 } };
  return {
    data,
    layout: {
      ...paper(440), uirevision: "kept", margin: { l: 0, r: 0, t: 24, b: 0 },
      scene: {
        xaxis: plain("East [km]"), yaxis: plain("North [km]"), zaxis: plain("Altitude [km]"), ...scale,
        camera: { center: { x: 0, y: 0, z: -0.12 }, eye: eye(Number(byId("turn").value)) },
      },
    },
  };
}

// Range of what is visible, with some room around it.
function around(data, key) {
  let low = Infinity, high = -Infinity;
  data.filter(visible).forEach((trace) => trace[key].forEach((value) => {
    if (Number.isFinite(value)) { low = Math.min(low, value); high = Math.max(high, value); }
  }));
  const margin = Math.max(0.05 * (high - low), 0.02);
  return low <= high ? [low - margin, high + margin] : [-1, 1];
}

// One variable over another: the ground track with north up, V-n and Mach-altitude with their limits.
function planeFigure(chart) {
  const [row] = chart.rows, data = [], groups = new Set(), plan = chart.kind === "plan";
  outlines.filter((each) => each.chart === chart.name).forEach((each) => data.push({
    type: "scatter", mode: "lines", x: each.x, y: each.y, owners: each.owners, name: each.name, connectgaps: false,
    hovertemplate: `${each.name}<extra></extra>`, line: { color: colour("soft"), width: 1.2, dash: "dash" },
  }));
  row.lines.forEach((line) => flights.forEach((flight, i) => {
    const [x, y] = line.columns.map((name) => column(i, name));
    if (!x || !y || (line.kind === "reference" && groups.has(flight.group))) return;
    const ink = line.kind === "reference" ? { color: colour("ink"), width: 1 } : { color: inkOf(i, panels.length > 1 ? 0.6 : 1), width: panels.length > 1 ? 1 : 1.5, dash: plan || panels.length < 2 ? flight.dash : "solid" };
    const base = { type: "scatter", owners: [i], name: flight.title };
    if (line.kind === "reference") {
      groups.add(flight.group);
      base.owners = flights.flatMap((other, k) => (other.group === flight.group ? [k] : []));
      base.name = "reference";
    }
    data.push({ ...base, mode: "lines", x, y, line: ink, hovertemplate: `%{x:.4~g} ${unitOf(chart.across)}, %{y:.4~g} ${unitOf(row.label)}` });
    if (line.kind === "line") data.push(...markers(i, base, (at) => ({ x: at.map((n) => x[n]), y: at.map((n) => y[n]) })));
  }));
  const layout = {
    ...paper(heightOf(chart)), hovermode: "closest", dragmode: "zoom",
    xaxis: axis({ title: { text: chart.across, standoff: 6 }, range: around(data, "x"), ...(plan ? { constrain: "domain" } : {}) }),
    yaxis: axis({ title: { text: row.label, standoff: 4 }, range: around(data, "y"), ...(plan ? { scaleanchor: "x", scaleratio: 1, constrain: "domain" } : {}) }),
  };
  if (plan) {
    const north = { xref: "paper", yref: "paper", x: 0.98, y: 0.91, xanchor: "center", font: { size: 12, color: colour("ink") } };
    layout.annotations = [
      { ...north, text: "", ax: 0, ay: 34, showarrow: true, arrowhead: 2, arrowwidth: 1.6, arrowcolor: colour("ink") },
      { ...north, text: "<b>N</b>", showarrow: false, yshift: 15 },
    ];
  }
  return { data, layout };
}

const FIGURES = { time: timeFigure, timeline: timelineFigure, space: spaceFigure, plan: planeFigure, plane: planeFigure };
