// --- controls -----------------------------------------------------------------------------------
const VALUES = [
  ["airspeed", "Airspeed [m/s]", 2], ["flight_path", "Flight path [deg]", 2], ["heading", "Heading [deg]", 2],
  ["thrust_command", "Thrust command [kN]", 1], ["load_factor_flown", "Load factor", 2], ["bank_angle_flown", "Bank [deg]", 1],
  ["effectiveness_thrust_estimate", "Effectiveness, estimate", 4], ["effectiveness_thrust_true", "true", 4],
];
function fillValues() {
  const table = byId("values").querySelector("table");
  table.tHead.replaceChildren(tableRow("th", ["Flight", ...VALUES.map(([, title]) => title)]));
  const time = shown.time ?? 0;
  table.tBodies[0].replaceChildren(...flights.flatMap((flight, i) => {
    if (!shown.on[i]) return [];
    const n = sampleAt(i, time);
    const past = time > column(i, "time").at(-1);
    return [tableRow("td", [flight.title, ...VALUES.map(([name, , digits]) => {
      const values = column(i, name);
      return past || !values || Number.isNaN(values[n]) ? "–" : values[n].toFixed(digits);
    })])];
  }));
}

Object.assign(byId("cursor"), { max: end, step: end > 600 ? 0.1 : 0.01 });
byId("cursor").addEventListener("input", (event) => setTime(event.target.value));
byId("values").addEventListener("toggle", fillValues);

const PACE = 10; // times real time
let playing = null; // when the last frame of a played flight was [ms]
const players = document.querySelectorAll("button.play");
const say = () => players.forEach((button) => { button.textContent = playing === null ? "▶ Play" : "❚❚ Pause"; });
function play(now) {
  if (playing === null) return;
  setTime((shown.time ?? 0) + (PACE * (now - playing)) / 1000);
  playing = shown.time < end ? now : null;
  say();
  if (playing !== null) requestAnimationFrame(play);
}
players.forEach((button) => button.addEventListener("click", () => {
  if (shown.time === null || shown.time >= end) setTime(0);
  playing = playing === null ? performance.now() : null;
  say();
  if (playing !== null) requestAnimationFrame(play);
}));

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
let resized;
addEventListener("resize", () => { clearTimeout(resized); resized = setTimeout(() => { if (!paperWidth) redraw(); }, 200); });
