// --- light, dark, print -------------------------------------------------------------------------
const root = document.documentElement, dark = matchMedia("(prefers-color-scheme: dark)");
byId("theme").addEventListener("click", () => {
  const isDark = root.dataset.theme ? root.dataset.theme === "dark" : dark.matches;
  root.dataset.theme = isDark ? "light" : "dark";
  redraw();
});
dark.addEventListener("change", redraw);

const MOST_VECTORS = 1.0e6; // characters of all curves; of a printed page about as many bytes; data-vectors of the page overrides it
const DENSITY = 3; // dots of a picture for each px: 290 an inch on paper
const curves = () => [...document.querySelectorAll(".plot .scatterlayer path")];

// Curves of a chart as a picture above its axes, drawn at once: the page is printed when this returns.
function rasterise(plot) {
  const { width, height } = plot._fullLayout;
  const canvas = Object.assign(document.createElement("canvas"), { className: "raster", width: width * DENSITY, height: height * DENSITY });
  canvas.style.width = `${width}px`;
  canvas.style.height = `${height}px`;
  const context = canvas.getContext("2d", { willReadFrequently: true });
  const origin = plot.getBoundingClientRect();
  plot.querySelectorAll(".scatterlayer path").forEach((path) => {
    if (!path.getAttribute("d")) return;
    const matrix = path.getScreenCTM(), style = getComputedStyle(path), outline = new Path2D(path.getAttribute("d"));
    const subplot = plot._fullLayout._plots[path.closest(".subplot").classList[1]];
    context.setTransform(DENSITY, 0, 0, DENSITY, 0, 0);
    context.save();
    context.beginPath();
    context.rect(subplot.xaxis._offset, subplot.yaxis._offset, subplot.xaxis._length, subplot.yaxis._length);
    context.clip();
    context.setTransform(DENSITY * matrix.a, DENSITY * matrix.b, DENSITY * matrix.c, DENSITY * matrix.d, DENSITY * (matrix.e - origin.left), DENSITY * (matrix.f - origin.top));
    if (style.fill !== "none") {
      context.globalAlpha = Number(style.fillOpacity);
      context.fillStyle = style.fill;
      context.fill(outline);
    }
    if (style.stroke !== "none" && parseFloat(style.strokeWidth) > 0) {
      context.globalAlpha = Number(style.strokeOpacity);
      context.strokeStyle = style.stroke;
      context.lineWidth = parseFloat(style.strokeWidth);
      context.setLineDash(style.strokeDasharray === "none" ? [] : style.strokeDasharray.split(/[ ,]+/).map(parseFloat));
      context.stroke(outline);
    }
    context.restore();
  });
  plot.classList.add("rastered");
  plot.append(canvas);
}

let theme;
addEventListener("beforeprint", () => {
  theme = root.dataset.theme;
  root.dataset.theme = "light";
  paperWidth = 700;
  document.querySelectorAll("details.scenario").forEach((details) => { details.open = true; });
  places.forEach(draw);
  const size = curves().reduce((sum, path) => sum + (path.getAttribute("d") ?? "").length, 0);
  if (size > Number(root.dataset.vectors ?? MOST_VECTORS)) places.forEach((place) => { if (place.chart.kind !== "space") rasterise(place.plot); });
});
addEventListener("afterprint", () => {
  if (theme === undefined) delete root.dataset.theme; else root.dataset.theme = theme;
  paperWidth = null;
  document.querySelectorAll(".raster").forEach((canvas) => { canvas.parentElement.classList.remove("rastered"); canvas.remove(); });
  places.forEach(draw);
});
