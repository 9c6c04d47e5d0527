// A figure as a standalone SVG: what is drawn on the page, with heading, key and axes in words.
import { drawing, themed } from "./dom.js";
import { labelRoom, powers, ticks } from "./format.js";

const SIZE = { width: 880, height: 440 };
const MARGIN = { left: 78, right: 20, top: 66, bottom: 50 };

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
function placesOf({ xRange, yRange, logarithmic }) {
  const { right, top, bottom } = MARGIN;
  const shown = logarithmic ? Math.log10 : (value) => value;
  const [x0, x1] = xRange;
  const [y0, y1] = yRange.map(shown);
  const ySteps = logarithmic
    ? roundSteps(y0, y1, 6)
        .filter((power) => Math.abs(power % 1) < 1e-9)
        .map((power) => 10 ** power)
    : roundSteps(y0, y1, 6);
  const beside = logarithmic ? powers(ySteps) : ticks(ySteps);
  const left = labelRoom(beside, MARGIN.left - 24, 7.4) + 24;
  const [across, down] = [SIZE.width - left - right, SIZE.height - top - bottom];
  return {
    left,
    beside,
    ySteps,
    x: (value) => left + ((value - x0) / (x1 - x0 || 1)) * across,
    y: (value) => SIZE.height - bottom - ((shown(value) - y0) / (y1 - y0 || 1)) * down,
    xSteps: roundSteps(x0, x1, 10),
  };
}

const words = (x, y, text, attributes = {}) => drawing("text", { x, y, ...attributes }, text);

/** Grid with its labels. */
function grid(places) {
  const { right, top, bottom } = MARGIN;
  const { left, beside } = places;
  const stroke = themed("--rule");
  const below = ticks(places.xSteps);
  return [
    ...places.xSteps.flatMap((value, index) => [
      drawing("path", { d: `M${places.x(value)} ${top}V${SIZE.height - bottom}`, stroke }),
      words(places.x(value), SIZE.height - bottom + 18, below[index], { "text-anchor": "middle" }),
    ]),
    ...places.ySteps.flatMap((value, index) => [
      drawing("path", { d: `M${left} ${places.y(value)}H${SIZE.width - right}`, stroke }),
      words(left - 8, places.y(value) + 4, beside[index], { "text-anchor": "end" }),
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

function plot(figure, places) {
  const { right, top, bottom } = MARGIN;
  const { left } = places;
  const frame = {
    x: left,
    y: top,
    width: SIZE.width - left - right,
    height: SIZE.height - top - bottom,
  };
  return [
    drawing("clipPath", { id: "plot" }, drawing("rect", frame)),
    drawing(
      "g",
      { "clip-path": "url(#plot)", fill: "none", "stroke-linejoin": "round" },
      (figure.limits ?? []).map(({ value }) =>
        drawing("path", {
          d: `M${left} ${places.y(value)}H${SIZE.width - right}`,
          stroke: themed("--limit"),
          "stroke-dasharray": "3 4",
        }),
      ),
      figure.lines.map((line) =>
        drawing("path", {
          d: path(figure, places, line),
          stroke: line.color,
          "stroke-width": line.width ?? 1.5,
          "stroke-dasharray": line.dash?.join(" "),
        }),
      ),
    ),
  ];
}

/** The key in a row; letters are taken to be 7.2 wide. */
function key({ lines }, left) {
  let x = left;
  return lines.flatMap((line) => {
    const start = x;
    const label = line.leg ? `leg ${line.label}` : line.label;
    x += 41 + 7.2 * label.length;
    return [
      drawing("path", {
        d: `M${start} 45h18`,
        stroke: line.color,
        "stroke-width": 2.5,
        "stroke-dasharray": line.dash?.join(" "),
      }),
      words(start + 23, 49, label),
    ];
  });
}

/** A curve as text of an SVG.
 *  @param figure {title, ordinate, abscissa, x, lines: [{y, label, color, dash, width}], xRange, yRange, logarithmic, limits}. */
export function svgOf(figure) {
  const { width, height } = SIZE;
  const { right, top, bottom } = MARGIN;
  const places = placesOf(figure);
  const { left } = places;
  const middle = (top + height - bottom) / 2;
  const sheet = drawing(
    "svg",
    {
      viewBox: `0 0 ${width} ${height}`,
      width,
      height,
      "font-family": "system-ui, sans-serif",
      "font-size": 12,
      fill: themed("--ink"),
    },
    drawing("rect", { width, height, fill: themed("--card") }),
    grid(places),
    plot(figure, places),
    words(left, 24, figure.title, { "font-size": 16, "font-weight": 600 }),
    key(figure, left),
    words((left + width - right) / 2, height - 10, figure.abscissa, { "text-anchor": "middle" }),
    drawing(
      "text",
      { transform: `translate(18 ${middle}) rotate(-90)`, "text-anchor": "middle" },
      figure.ordinate,
    ),
  );
  return `${new XMLSerializer().serializeToString(sheet)}\n`;
}
