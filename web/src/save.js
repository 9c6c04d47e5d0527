// Saving from the page: a blob under a name, a curve as SVG.
import { element, themed } from "./dom.js";
import { ticks as tickLabels, powers } from "./format.js";

/** Offers a blob or text under a name. */
export function download(content, name, type = "text/plain") {
  const blob = content instanceof Blob ? content : new Blob([content], { type });
  const address = URL.createObjectURL(blob);
  element("a", { href: address, download: name }).click();
  setTimeout(() => URL.revokeObjectURL(address), 10000);
}

/** A file name from a title: letters, digits and dashes. */
export const fileName = (text) =>
  text
    .normalize("NFKD")
    .replace(/[^\p{L}\p{N}]+/gu, "-")
    .replace(/^-+|-+$/g, "")
    .slice(0, 60)
    .toLowerCase() || "study";

const escaped = (text) => text.replace(/[&<>"']/g, (character) => `&#${character.codePointAt(0)};`);

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

/** A curve as a standalone SVG.
 *  @param figure {title, ordinate, abscissa, x, lines: [{y, label, color, dash, width}], xRange, yRange, logarithmic, limits}. */
export function svgOf(figure) {
  const [width, height, left, right, top, bottom] = [880, 440, 78, 20, 66, 50];
  const [x0, x1] = figure.xRange;
  const toLog = figure.logarithmic ? Math.log10 : (value) => value;
  const [y0, y1] = figure.yRange.map(toLog);
  const px = (x) => left + ((x - x0) / (x1 - x0 || 1)) * (width - left - right);
  const py = (y) => height - bottom - ((toLog(y) - y0) / (y1 - y0 || 1)) * (height - top - bottom);
  const ink = themed("--ink");
  const faint = themed("--rule");
  const xs = roundSteps(x0, x1, 10);
  const ys = figure.logarithmic
    ? roundSteps(y0, y1, 6)
        .filter((power) => Math.abs(power % 1) < 1e-9)
        .map((power) => 10 ** power)
    : roundSteps(y0, y1, 6);
  const parts = [];
  const text = (x, y, words, more = "") =>
    parts.push(`<text x="${x.toFixed(1)}" y="${y.toFixed(1)}" ${more}>${escaped(words)}</text>`);
  parts.push(`<rect width="${width}" height="${height}" fill="${themed("--card")}"/>`);
  const xWords = tickLabels(xs);
  xs.forEach((x, index) => {
    parts.push(`<path d="M${px(x).toFixed(1)} ${top}V${height - bottom}" stroke="${faint}"/>`);
    text(px(x), height - bottom + 18, xWords[index], 'text-anchor="middle"');
  });
  const yWords = figure.logarithmic ? powers(ys) : tickLabels(ys);
  ys.forEach((y, index) => {
    parts.push(`<path d="M${left} ${py(y).toFixed(1)}H${width - right}" stroke="${faint}"/>`);
    text(left - 8, py(y) + 4, yWords[index], 'text-anchor="end"');
  });
  parts.push(
    `<clipPath id="plot"><rect x="${left}" y="${top}" width="${width - left - right}" height="${height - top - bottom}"/></clipPath><g clip-path="url(#plot)" fill="none">`,
  );
  for (const { value } of figure.limits ?? [])
    parts.push(
      `<path d="M${left} ${py(value).toFixed(1)}H${width - right}" stroke="${themed("--limit")}" stroke-dasharray="3 4"/>`,
    );
  for (const line of figure.lines) {
    let path = "";
    let pen = "M";
    figure.x.forEach((x, index) => {
      const y = line.y[index];
      if (y === undefined) return;
      if (y === null || (figure.logarithmic && !(y > 0))) pen = "M";
      else {
        path += `${pen}${px(x).toFixed(2)} ${py(y).toFixed(2)}`;
        pen = "L";
      }
    });
    parts.push(
      `<path d="${path}" stroke="${line.color}" stroke-width="${line.width ?? 1.5}" stroke-linejoin="round"${line.dash ? ` stroke-dasharray="${line.dash.join(" ")}"` : ""}/>`,
    );
  }
  parts.push("</g>");
  text(left, 24, figure.title, 'font-size="16" font-weight="600"');
  let x = left;
  for (const line of figure.lines) {
    parts.push(
      `<path d="M${x} 45h18" stroke="${line.color}" stroke-width="2.5"${line.dash ? ` stroke-dasharray="${line.dash.join(" ")}"` : ""}/>`,
    );
    text(x + 23, 49, line.label);
    x += 23 + 7.2 * line.label.length + 18;
  }
  text((left + width - right) / 2, height - 10, figure.abscissa, 'text-anchor="middle"');
  parts.push(
    `<text transform="translate(18 ${(top + height - bottom) / 2}) rotate(-90)" text-anchor="middle">${escaped(figure.ordinate)}</text>`,
  );
  return `<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 ${width} ${height}" width="${width}" height="${height}" font-family="system-ui, sans-serif" font-size="12" fill="${ink}">${parts.join("")}</svg>\n`;
}
