// A figure as SVG: what is drawn on the page, with axes in words. Saved, it has its heading and key with it; printed, it is half a
// page wide, its lines differ by dashes too, and each has its name at its end.
import { drawing, themed } from "./dom.js";
import { labelRoom, powers, ticks } from "./format.js";

/** Sheets: sizes in pixels of the drawing. `wide` is the width of a letter; `steps` are how many an axis should have. */
const SAVED = {
  width: 880,
  height: 440,
  margin: { left: 78, right: 20, top: 66, bottom: 50 },
  font: 12,
  wide: 7.4,
  steps: [10, 6],
  paint: themed,
  tint: (color) => (color.startsWith("var(") ? themed(color.slice(4, -1)) : color),
};
const PRINTED = {
  width: 340,
  height: 176,
  margin: { left: 46, right: 8, top: 6, bottom: 35 },
  font: 10,
  wide: 6,
  steps: [6, 6],
  // the style sheet of the paper has these colours when it is printed, not now
  paint: (name) => `var(${name})`,
  tint: (color) => color,
};

/** Dashes that tell lines apart without colours. */
const DASHES = [null, [7, 2], [2.5, 2], [8, 2, 2, 2], [1.2, 1.8], [8, 2, 1.5, 2, 1.5, 2]];

/** Round steps (1, 2, 5 times a power of ten) between two numbers. */
export function roundSteps(least, greatest, count) {
  const raw = (greatest - least) / count;
  const power = 10 ** Math.floor(Math.log10(raw));
  const step = [1, 2, 5, 10]
    .map((digit) => digit * power)
    .find((candidate) => candidate >= raw * 0.999);
  const steps = [];
  for (let k = Math.ceil(least / step - 1e-9); k * step <= greatest + 1e-9 * step; k++)
    steps.push(k * step);
  return steps;
}

/** From numbers to places on the sheet; the margin at the left has room for the numbers and the ordinate's name. */
function placesOf({ xRange, yRange, logarithmic }, sheet) {
  const { right, top, bottom } = sheet.margin;
  const shown = logarithmic ? Math.log10 : (value) => value;
  const [x0, x1] = xRange;
  const [y0, y1] = yRange.map(shown);
  const ySteps = logarithmic
    ? roundSteps(y0, y1, sheet.steps[1])
        .filter((power) => Math.abs(power % 1) < 1e-9)
        .map((power) => 10 ** power)
    : roundSteps(y0, y1, sheet.steps[1]);
  const beside = logarithmic ? powers(ySteps) : ticks(ySteps);
  const name = 2 * sheet.font;
  const left = labelRoom(beside, sheet.margin.left - name, sheet.wide) + name;
  const [across, down] = [sheet.width - left - right, sheet.height - top - bottom];
  return {
    sheet,
    left,
    right: sheet.width - right,
    top,
    bottom: sheet.height - bottom,
    beside,
    ySteps,
    x: (value) => left + ((value - x0) / (x1 - x0 || 1)) * across,
    y: (value) => sheet.height - bottom - ((shown(value) - y0) / (y1 - y0 || 1)) * down,
    xSteps: roundSteps(x0, x1, sheet.steps[0]),
  };
}

const words = (x, y, text, attributes = {}) => drawing("text", { x, y, ...attributes }, text);

/** Grid with its labels. */
function grid(places) {
  const { left, right, top, bottom, beside, sheet } = places;
  const stroke = sheet.paint("--rule");
  const below = ticks(places.xSteps);
  return [
    ...places.xSteps.flatMap((value, index) => [
      drawing("path", { d: `M${places.x(value)} ${top}V${bottom}`, stroke }),
      words(places.x(value), bottom + 1.4 * sheet.font, below[index], {
        "text-anchor": "middle",
        class: "tick-x",
      }),
    ]),
    ...places.ySteps.flatMap((value, index) => [
      drawing("path", { d: `M${left} ${places.y(value)}H${right}`, stroke }),
      words(left - 6, places.y(value) + 0.35 * sheet.font, beside[index], {
        "text-anchor": "end",
        class: "tick-y",
      }),
    ]),
  ];
}

/** A line's path; null breaks it, undefined is no point of this line. */
function path(figure, places, { y }) {
  let d = "";
  let pen = "M";
  figure.x.forEach((x, index) => {
    const value = y[index];
    if (value === undefined) return;
    if (value === null || (figure.logarithmic && !(value > 0))) pen = "M";
    else {
      d += `${pen}${places.x(x).toFixed(2)} ${places.y(value).toFixed(2)}`;
      pen = "L";
    }
  });
  return d;
}

function plot(figure, places, id) {
  const { left, right, top, bottom, sheet } = places;
  const frame = { x: left, y: top, width: right - left, height: bottom - top };
  return [
    drawing("clipPath", { id }, drawing("rect", frame)),
    drawing(
      "g",
      { "clip-path": `url(#${id})`, fill: "none", "stroke-linejoin": "round" },
      (figure.limits ?? []).map(({ value }) =>
        drawing("path", {
          d: `M${left} ${places.y(value)}H${right}`,
          class: "limit",
          stroke: sheet.paint("--limit"),
          "stroke-dasharray": "3 4",
        }),
      ),
      figure.lines.map((line) =>
        drawing("path", {
          d: path(figure, places, line),
          class: "line",
          stroke: sheet.tint(line.color),
          "stroke-width": line.width ?? 1.5,
          "stroke-dasharray": line.dash?.join(" "),
        }),
      ),
    ),
  ];
}

const labelOf = (line) => (line.leg ? `leg ${line.label}` : line.label);

/** The key in rows; letters are taken to be 0.6 of the font's size wide. @return nodes and the count of rows. */
function key({ lines }, left, right, top, sheet) {
  let x = left;
  let row = 0;
  const height = 1.5 * sheet.font;
  const nodes = lines.flatMap((line) => {
    const label = labelOf(line);
    const room = 1.5 * sheet.font + 5 + 0.6 * sheet.font * label.length;
    if (x > left && x + room > right) [x, row] = [left, row + 1];
    const start = x;
    x += room + 18;
    const y = top + row * height;
    return [
      drawing("path", {
        d: `M${start} ${y - 4}h${1.5 * sheet.font}`,
        stroke: sheet.tint(line.color),
        "stroke-width": sheet === PRINTED ? 1.3 : 2.5,
        "stroke-dasharray": line.dash?.join(" "),
      }),
      words(start + 1.5 * sheet.font + 5, y, label),
    ];
  });
  return { nodes, rows: row + 1 };
}

/** Gives names with places `y`, in order, places `at` that are a step apart or more: names that would touch become a group around
 *  the mean of their places, and groups that touch become one. */
function spread(ends, step, top, bottom) {
  const groups = [];
  const half = (group) => (0.5 * step * group.ends.length);
  for (const end of ends) {
    let group = { ends: [end], middle: end.y };
    const before = () => groups[groups.length - 1];
    while (before() && before().middle + half(before()) > group.middle - half(group)) {
      const joined = [...groups.pop().ends, ...group.ends];
      group = { ends: joined, middle: joined.reduce((sum, { y }) => sum + y, 0) / joined.length };
    }
    group.middle = Math.max(Math.min(group.middle, bottom - half(group)), top + half(group));
    groups.push(group);
  }
  for (const { ends: members, middle } of groups)
    members.forEach((end, k) => (end.at = middle + (k - 0.5 * (members.length - 1)) * step));
}

/** Where a line ends within the range of time: {line, x, y, place}; null without a point. */
function endOf(figure, places, line, place) {
  const { right, top, bottom } = places;
  for (let k = line.y.length - 1; k >= 0; k--)
    if (Number.isFinite(line.y[k]) && figure.x[k] <= figure.xRange[1] + 1e-9)
      return {
        line,
        place,
        x: Math.min(places.x(figure.x[k]), right),
        y: Math.min(Math.max(places.y(line.y[k]), top), bottom),
      };
  return null;
}

/** Names of lines at their ends, moved apart where they would cover each other. A run that ended early ends within the figure. */
function endNames(figure, places) {
  const { sheet, top, bottom } = places;
  const ends = figure.lines.map((line, k) => endOf(figure, places, line, k)).filter(Boolean);
  // lines that look the same have their names in order
  const row = ({ y }) => Math.round(y);
  ends.sort((a, b) => row(a) - row(b) || a.place - b.place);
  const columns = new Set(ends.map(({ x }) => Math.round(x)));
  for (const column of columns)
    spread(ends.filter(({ x }) => Math.round(x) === column), 0.95 * sheet.font, top, bottom);
  return ends.map(({ line, x, y, at }) => [
    drawing("path", {
      d: `M${x.toFixed(1)} ${y.toFixed(1)}L${(x + 6).toFixed(1)} ${at.toFixed(1)}`,
      stroke: sheet.tint(line.color),
      "stroke-width": 0.7,
      fill: "none",
    }),
    words(x + 8, at + 0.35 * sheet.font, line.label, { class: "end-name" }),
  ]);
}

/** The word at the lines of limits, which dashes alone do not tell from those of legs. */
const limitWords = (figure, { left, top, bottom, y }) =>
  (figure.limits ?? [])
    .map(({ value, beyond }) => ({ at: y(value), side: beyond > 0 ? 10 : -4 }))
    .filter(({ at }) => at >= top && at <= bottom)
    .map(({ at, side }) => words(left + 4, at + side, "limit", { class: "limit-word" }));

/** Names of both axes. */
function axisNames(figure, places) {
  const { left, right, top, bottom, sheet } = places;
  return [
    words((left + right) / 2, sheet.height - (sheet.wide > 7 ? 10 : 4), figure.abscissa, {
      "text-anchor": "middle",
    }),
    drawing(
      "text",
      {
        transform: `translate(${1.3 * sheet.font} ${(top + bottom) / 2}) rotate(-90)`,
        "text-anchor": "middle",
      },
      figure.ordinate,
    ),
  ];
}

/** The frame of a drawing. */
const frame = (sheet, attributes, ...children) =>
  drawing(
    "svg",
    {
      viewBox: `0 0 ${sheet.width} ${sheet.height}`,
      "font-family": "system-ui, sans-serif",
      "font-size": sheet.font,
      fill: sheet.paint("--ink"),
      ...attributes,
    },
    ...children,
  );

/** A curve as text of an SVG.
 *  @param figure {title, ordinate, abscissa, x, lines: [{y, label, color, dash, width}], xRange, yRange, logarithmic, limits}. */
export function svgOf(figure) {
  const { width, height } = SAVED;
  const places = placesOf(figure, SAVED);
  const sheet = frame(
    SAVED,
    { width, height },
    drawing("rect", { width, height, fill: themed("--card") }),
    grid(places),
    plot(figure, places, "plot"),
    words(places.left, 24, figure.title, { "font-size": 16, "font-weight": 600 }),
    key(figure, places.left, places.right, 49, SAVED).nodes,
    axisNames(figure, places),
  );
  return `${new XMLSerializer().serializeToString(sheet)}\n`;
}

/** A curve as a node for the printed page. @param id of the figure; @param wide whether it is as wide as the page. */
export function printedSvg(figure, id, wide) {
  const lines = figure.lines.map((line, index) => ({
    ...line,
    width: 0.8 * (line.width ?? 1.5),
    dash: line.dash ?? (figure.lines.length > 1 ? DASHES[index % DASHES.length] : null),
  }));
  const drawn = { ...figure, lines };
  const longest = Math.max(0, ...lines.map(({ label }) => label.length));
  const named = lines.length > 1 && longest <= 7;
  const base = { ...PRINTED, width: wide ? 2.06 * PRINTED.width : PRINTED.width };
  const { left, right, top } = base.margin;
  const legend = lines.length > 1 ? key(drawn, left, base.width - right, top + base.font, PRINTED) : { nodes: [], rows: 0 };
  const above = legend.rows * 1.5 * base.font;
  const sheet = {
    ...base,
    height: base.height + above,
    margin: {
      ...base.margin,
      top: top + above,
      right: named ? 14 + 0.6 * base.font * longest : right,
    },
  };
  const places = placesOf(drawn, sheet);
  return frame(
    sheet,
    { class: "printed", role: "img", "aria-label": figure.title },
    grid(places),
    plot(drawn, places, `printed-${id}`),
    legend.nodes,
    named ? endNames(drawn, places) : [],
    limitWords(drawn, places),
    axisNames(drawn, places),
  );
}
