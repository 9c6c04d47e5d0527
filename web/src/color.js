// Colours of lines, from the table that figures of `gough plot` take theirs from too (src/figure/palette.def), and the diverging
// scale of forces. Each is a property of the theme (style.css): darker by day, lighter at night.
import { axes, legs, tables } from "virtual:palette";
import { themed } from "./dom.js";

const property = (name) => `var(--${name})`;

/** What is none of these: the program beside an actual motion. */
export const GREY = "var(--grey)";

/** Legs 1 … 6. */
export const LEGS = legs.map(property);

/** Studies beside each other, by order. */
export const STUDIES = tables.map(property);

/** Components x, y, z (roll, pitch, yaw). */
export const AXES = axes.map(property);

/** A colour of the theme in force as a canvas wants it: "var(--blue)" gives "#0072b2". */
export const plain = (color) => (color.startsWith("var(") ? themed(color.slice(4, -1)) : color);

export const studyColor = (index) => STUDIES[index % STUDIES.length];

// from full pull (blue) over none (pale) to full push (orange): lightness falls to both sides, hue tells which
const PULL = ["#0b3c7d", "#2f74b5", "#7fb2d9", "#c3d7e4"];
const NONE = "#dcdcd6";
const PUSH = ["#f0d2a8", "#f0a653", "#dd7220", "#9c3c00"];
const SCALE = [...PULL, NONE, ...PUSH].map((hex) =>
  [1, 3, 5].map((start) => parseInt(hex.slice(start, start + 2), 16)),
);

/** Colour of a force as [red, green, blue] of 255; `share` from −1 (greatest pull) to 1 (greatest push). */
export function forceColor(share) {
  const position =
    ((Math.min(Math.max(Number.isFinite(share) ? share : 0, -1), 1) + 1) / 2) * (SCALE.length - 1);
  const low = Math.min(Math.floor(position), SCALE.length - 2);
  const blend = position - low;
  return SCALE[low].map((part, index) => Math.round(part + blend * (SCALE[low + 1][index] - part)));
}

/** The same as CSS. */
export const forceCss = (share) => `rgb(${forceColor(share).join(" ")})`;

/** The scale as a CSS gradient from pull to push. */
export const forceGradient = `linear-gradient(90deg, ${[...PULL, NONE, ...PUSH].join(", ")})`;
