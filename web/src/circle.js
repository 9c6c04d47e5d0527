// Floquet multipliers (or eigenvalues) on a drawing of the complex plane. What lies far outside is drawn at the rim, with its size.
import { drawing } from "./dom.js";
import { number } from "./format.js";

/** Half the width of the drawing in its own units, where the unit circle has radius 1. */
const REACH = 1.62;

const complex = ([re, im]) => `${number(re, 6)} ${im < 0 ? "−" : "+"} ${number(Math.abs(im), 6)}i`;

function frame(label, ...parts) {
  const svg = drawing("svg", {
    class: "plane",
    viewBox: `${-REACH} ${-REACH} ${2 * REACH} ${2 * REACH}`,
    role: "img",
    "aria-label": label,
  });
  svg.append(
    drawing("path", { class: "plane-axis", d: `M${-REACH} 0H${REACH}M0 ${-REACH}V${REACH}` }),
    ...parts,
    drawing("text", { class: "plane-word", x: REACH - 0.05, y: 0.15, "text-anchor": "end" }, "Re"),
    drawing("text", { class: "plane-word", x: 0.07, y: -REACH + 0.14 }, "Im"),
  );
  return svg;
}

/** Points [re, im], by logarithm of the size beyond radius 1 so that a large multiplier still has a place. */
export function multiplierCircle(multipliers) {
  const largest = Math.log(
    Math.max(...multipliers.map((multiplier) => Math.hypot(...multiplier)), 10),
  );
  const compressed = ([re, im]) => {
    const size = Math.hypot(re, im);
    const drawn = size <= 1 ? size : 1 + (0.5 * Math.log(size)) / largest;
    return size > 0 ? [(re / size) * drawn, (im / size) * drawn] : [0, 0];
  };
  const dots = multipliers.map((multiplier) => {
    const size = Math.hypot(...multiplier);
    const [x, y] = compressed(multiplier);
    const kind = size > 1 + 1e-7 ? "grows" : size < 1 - 1e-7 ? "decays" : "stays";
    return drawing(
      "g",
      { class: `dot ${kind}` },
      drawing("title", {}, `${complex(multiplier)}, size ${number(size, 6)}`),
      kind === "grows"
        ? drawing("rect", {
            x: x - 0.05,
            y: -y - 0.05,
            width: 0.1,
            height: 0.1,
            transform: `rotate(45 ${x} ${-y})`,
          })
        : drawing("circle", { cx: x, cy: -y, r: 0.055 }),
    );
  });
  const grows = multipliers.filter((multiplier) => Math.hypot(...multiplier) > 1 + 1e-7).length;
  return frame(
    `Floquet multipliers in the complex plane: ${grows || "none"} of ${multipliers.length} outside the unit circle`,
    drawing("circle", { class: "unit-circle", r: 1 }),
    ...dots,
  );
}
