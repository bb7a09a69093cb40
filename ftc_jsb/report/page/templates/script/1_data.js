// --- data, what is shown of it, colours -------------------------------------------------------
const { flights, charts, panels, outlines, events, sigmas } = JSON.parse(document.getElementById("data").textContent);
const byId = (id) => document.getElementById(id);

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

const end = Math.max(...flights.map((_, i) => column(i, "time").at(-1)));
const shown = { on: flights.map(() => true), window: [0, end], time: null };
const whole = () => shown.window[0] <= 0 && shown.window[1] >= end;
const visible = (trace) => trace.owners.some((i) => shown.on[i]);
const unitOf = (label) => (/\[([^\]]+)\]$/.exec(label) || ["", "-"])[1].replace(/^-$/, "");

const probe = document.body.appendChild(document.createElement("span"));
probe.hidden = true;
function colour(name, alpha = 1) {
  probe.style.color = `var(--${name})`;
  const [r, g, b] = getComputedStyle(probe).color.match(/[\d.]+/g);
  return `rgba(${r},${g},${b},${alpha})`;
}
const inkOf = (flight, alpha = 1) => colour(`line-${flights[flight].colour}`, alpha);
