// --- lines over time ---------------------------------------------------------------------------
const STRETCH = 3; // px over which a line that swings faster than can be seen is gathered
const SWINGS = 0.22; // changes of direction a pixel from which on it is

// What is drawn of a series in `width` pixels: its samples; or, of a line that swings too fast to be
// seen, the mean of every few pixels, between the least and the largest value there.
function drawnLine(x, y, width, logarithmic) {
  const [from, to] = shown.window;
  let first = 0, last = x.length - 1;
  while (first < last && x[first + 1] < from) first += 1;
  while (last > first && x[last - 1] > to) last -= 1;
  let turns = 0, before = 0;
  for (let n = first + 1; n <= last; n += 1) {
    const step = Math.sign(y[n] - y[n - 1]);
    if (step && before && step !== before) turns += 1;
    if (step) before = step;
  }
  if (turns < SWINGS * width) return { x, y };
  const many = Math.max(Math.floor(width / STRETCH), 20), span = (to - from) / many;
  const drawn = { x: [], y: [], low: [], high: [] };
  let n = first;
  for (let k = 0; k < many; k += 1) {
    const until = from + (k + 1) * span;
    let count = 0, sum = 0, low = Infinity, high = -Infinity;
    for (; n <= last && (x[n] <= until || k === many - 1); n += 1) {
      if (Number.isNaN(y[n])) continue;
      count += 1; sum += logarithmic ? Math.log(y[n]) : y[n];
      low = Math.min(low, y[n]); high = Math.max(high, y[n]);
    }
    if (n > last && !count) break;
    drawn.x.push(until - span / 2);
    drawn.y.push(count ? (logarithmic ? Math.exp(sum / count) : sum / count) : NaN);
    drawn.low.push(count ? low : NaN);
    drawn.high.push(count ? high : NaN);
  }
  return drawn;
}

const sidesOf = (centre, deviation) => [-1, 1].map(
  (side) => deviation.map((value, n) => (centre ? centre[n] : 0) + side * sigmas * value));

function band(base, ink, x, low, high) {
  const edge = { ...base, x, line: { width: 0, color: ink } };
  return [{ ...edge, y: low }, { ...edge, y: high, fill: "tonexty", fillcolor: ink }];
}

// Traces of one line of a row, for every flight. `place(flight)` gives the axes of a flight's panel.
function lineTraces(line, place, width, logarithmic) {
  const traces = [], drawnGroups = new Set();
  flights.forEach((flight, i) => {
    const series = line.columns.map((name) => column(i, name));
    if (series.some((values) => values === undefined)) return;
    const time = column(i, "time"), ink = inkOf(i), dash = panels.length > 1 ? "solid" : flight.dash;
    const base = {
      type: "scatter", mode: "lines", x: time, y: series[0], ...place(i), owners: [i], name: flight.title, connectgaps: false,
      hoverinfo: "skip", line: { color: ink, width: panels.length > 1 ? 1.2 : 1.6, dash },
    };
    if (line.kind === "line") {
      const drawn = drawnLine(time, series[0], width, logarithmic);
      if (drawn.low) traces.push(...band(base, inkOf(i, 0.2), drawn.x, drawn.low, drawn.high));
      traces.push({ ...base, x: drawn.x, y: drawn.y, of: "line" });
    } else if (line.kind === "wide") {
      traces.push({ ...base, name: `${flight.title}: commanded`, line: { color: inkOf(i, 0.3), width: 5 } });
    } else if (line.kind === "mark") {
      traces.push({ ...base, line: { color: inkOf(i, 0.45), width: 6 } });
    } else if (line.kind === "bound") {
      traces.push({ ...base, name: `${flight.title}: bound`, line: { color: ink, width: 1.1, dash: "dot" } });
    } else if (line.kind === "band") {
      const [low, high] = series.length > 1 ? sidesOf(...series) : sidesOf(null, series[0]);
      traces.push(...band(base, inkOf(i, 0.18), time, low, high));
    } else {
      const key = `${flight.group}/${flight.panel}`;
      if (drawnGroups.has(key)) return;
      drawnGroups.add(key);
      const sharing = flights.flatMap((other, k) => (other.group === flight.group && other.panel === flight.panel ? [k] : []));
      const name = line.columns[0].endsWith("_true") ? "truth" : "reference";
      traces.push({ ...base, owners: sharing, name, line: { color: colour("ink"), width: 1 } });
    }
  });
  return traces;
}

const MOST_BEYOND = 0.05; // part of a line that may be beyond the span that a row has at first

function widened(span, traces) {
  let [low, high] = span;
  traces.filter((trace) => visible(trace) && trace.of === "line").forEach((trace) => {
    const values = Array.from(trace.y).filter(Number.isFinite).sort((a, b) => a - b);
    if (!values.length) return;
    low = Math.min(low, values[Math.floor((MOST_BEYOND / 2) * (values.length - 1))]);
    high = Math.max(high, values[Math.ceil((1 - MOST_BEYOND / 2) * (values.length - 1))]);
  });
  return [low, high];
}

// Range of a row's axis: of what is visible of its lines in the window, and of its bounds. Of the whole
// flight, where the row has a span, that span, or as much more as nearly all of every line asks for.
function rangeOf(row, traces) {
  if (row.span && whole()) return widened(row.span, traces);
  let low = Infinity, high = -Infinity;
  traces.filter(visible).forEach((trace) => {
    for (let n = 0; n < trace.x.length; n += 1) {
      const value = trace.y[n];
      if (trace.x[n] < shown.window[0] || trace.x[n] > shown.window[1] || !Number.isFinite(value) || (row.decades && value <= 0)) continue;
      low = Math.min(low, value); high = Math.max(high, value);
    }
  });
  if (!(low <= high)) return row.decades ? [0, 1] : [-1, 1];
  row.bounds.forEach((value) => { if (whole()) { low = Math.min(low, value); high = Math.max(high, value); } });
  if (row.decades) [low, high] = [Math.log10(low), Math.log10(high)];
  const least = row.decades ? 0.2 : 1e-6 * Math.max(Math.abs(low), Math.abs(high), 1e-3);
  const margin = Math.max(0.06 * (high - low), least);
  return [low - margin, high + margin];
}
