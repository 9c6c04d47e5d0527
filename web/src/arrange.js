// Machines side by side: where each stands, what room they take, how far their tops have left it. For the scene and for drawings.
import { loadRise } from "./shape.js";

/** Distance between machines side by side, in base radii. */
const SPACING = 2.5;

/** Places of machines, in a row across the direction of view: {size, places: [{shift, scale}], low}. `mixed` machines have no unit
 *  of length in common: each is drawn with the same base radius. @param view unit vector from the machines to the reader. */
export function arrange(entries, mixed, view) {
  const size = Math.max(...entries.map(({ machine }) => machine.base_radius));
  const flat = Math.hypot(view[0], view[1]);
  const across = [-view[1] / flat, view[0] / flat];
  const places = entries.map(({ machine }, index) => {
    const along = (index - (entries.length - 1) / 2) * SPACING * size;
    return {
      scale: mixed ? size / machine.base_radius : 1,
      shift: [across[0] * along, across[1] * along, 0],
    };
  });
  const low = Math.min(
    ...entries.map(
      ({ machine }, index) =>
        places[index].scale *
        (Math.min(...machine.base.map((joint) => joint[2])) - 0.112 * machine.base_radius),
    ),
  );
  return { size, places, low };
}

/** Half the distance between the outermost machines. */
export const halfRow = (count) => 0.5 * SPACING * (count - 1);

/** Room that machines at home take: {size, height, width}. */
export function extent(entries, { size, places }) {
  const height = Math.max(
    ...entries.map(
      ({ machine }, index) =>
        places[index].scale * (machine.height + loadRise(machine)) - 0.15 * size,
    ),
    0.4 * size,
  );
  return { size, height, width: (2.5 + SPACING * (entries.length - 1)) * size };
}

/** How far the tops have left the first view: upwards or sideways. */
export function riseOf(entries, { size, places }, moments) {
  let rise = 0;
  moments.forEach(({ pose }, index) => {
    const { scale } = places[index];
    const high = pose.position[2] - entries[index].machine.height;
    const aside = Math.hypot(pose.position[0], pose.position[1]);
    rise = Math.max(rise, scale * high - 0.35 * size, scale * aside - 0.6 * size);
  });
  return Number.isFinite(rise) ? Math.min(rise, 100 * size) : 0;
}
