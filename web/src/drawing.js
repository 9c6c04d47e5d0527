// A machine drawn by lines: polygons, rods and outlines of its shapes by central projection, the far ones first. The picture of
// the printed page, and of the screen where there is no WebGL.
import { forceCss, LEGS } from "./color.js";
import { drawing } from "./dom.js";
import { legsOf, placed, turned } from "./pose.js";
import { ellipsoidOutline } from "./projection.js";
import { cylinderLength, loadAxes, outline, THICK } from "./shape.js";

/** Points of a path that is drawn: more are not told apart. */
const PATH_POINTS = 700;

const minus = (a, b) => a.map((part, axis) => part - b[axis]);
const mean = (points) =>
  [0, 1, 2].map((axis) => points.reduce((sum, point) => sum + point[axis], 0) / points.length);
const normalOf = ([a, b, c]) => {
  const [u, v] = [minus(b, a), minus(c, b)];
  return [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
};
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const text = ([x, y]) => `${x.toFixed(1)} ${y.toFixed(1)}`;

/** Attributes of a line between two places. */
const ends = ([x1, y1], [x2, y2]) => ({ x1, y1, x2, y2 });

/** What draws on a sheet: points in base axes of a machine that stands at `shift` and is drawn `scale` times as large. */
class Pen {
  constructor(projection, shift, scale) {
    Object.assign(this, { projection, shift, scale });
  }

  /** A point of the machine's base frame in the scene. */
  world(point) {
    return point.map((part, axis) => this.shift[axis] + this.scale * part);
  }

  /** Places of points; null if one of them is behind the reader. */
  places(points) {
    const found = points.map((point) => this.projection.place(this.world(point)));
    return found.every(Boolean) ? found : null;
  }

  polygon(points, name) {
    const found = this.places(points);
    return found && drawing("path", { class: name, d: `M${found.map(text).join("L")}Z` });
  }

  polyline(points, name) {
    const found = points.length > 1 && this.places(points);
    return found && drawing("path", { class: name, d: `M${found.map(text).join("L")}` });
  }

  /** A round rod: its edge, and its inside in a colour. */
  rod(from, to, radius, name, color) {
    const found = this.places([from, to]);
    if (!found) return null;
    const width = 2 * radius * this.scale * this.projection.scaleAt(this.world(mean([from, to])));
    return drawing(
      "g",
      { class: name },
      drawing("line", { class: "rod-edge", ...ends(...found), "stroke-width": width }),
      drawing("line", {
        class: "rod",
        ...ends(...found),
        "stroke-width": Math.max(width - 1.4, 0.6 * width),
        style: color ? { stroke: color } : {},
      }),
    );
  }

  ball(point, radius, name, color) {
    const found = this.places([point]);
    return (
      found &&
      drawing("circle", {
        class: name,
        cx: found[0][0],
        cy: found[0][1],
        r: radius * this.scale * this.projection.scaleAt(this.world(point)),
        style: color ? { fill: color } : {},
      })
    );
  }

  /** Distance of a point from the reader. */
  depth(point) {
    return this.projection.depth(this.world(point));
  }

  /** Whether the reader is on the side of a face that its normal points to. */
  faces(point, normal) {
    return this.projection.faces(this.world(point), normal);
  }
}

/** The faces of a plate that the reader sees, the far ones first. @param move takes a point of the plate's frame to base axes. */
function plate(pen, joints, { margin, low, high }, size, name, move = (point) => point) {
  const rim = outline(joints, margin * size);
  const [below, above] = [low, high].map((z) => rim.map(([x, y, h]) => move([x, y, h + z * size])));
  const middle = mean([...below, ...above]);
  const faces = [
    { part: "side", points: below },
    { part: "face", points: above },
    ...rim.map((_, k) => {
      const next = (k + 1) % rim.length;
      return { part: "side", points: [below[k], below[next], above[next], above[k]] };
    }),
  ];
  return faces
    .filter(({ points }) => {
      const normal = normalOf(points);
      const outwards = dot(normal, minus(mean(points), middle)) > 0 ? 1 : -1;
      return pen.faces(points[0], normal.map((part) => outwards * part));
    })
    .sort((a, b) => pen.depth(mean(b.points)) - pen.depth(mean(a.points)))
    .map(({ part, points }) => pen.polygon(points, `${name} ${part}`));
}

/** A leg: cylinder in the colour of its force, piston, joints; the farther end first. */
function leg(pen, machine, { base, top, along, length }, index, { forces, glow }, peak) {
  const size = machine.base_radius;
  const share = cylinderLength(machine, index, length) / (length || 1);
  const end = base.map((part, axis) => part + share * along[axis]);
  const parts = [
    pen.rod(base, end, THICK.cylinder * size, glow?.[index] ? "cylinder glow" : "cylinder", forceCss(forces[index] / peak)),
    pen.rod(end, top, THICK.piston * size, "piston"),
  ];
  if (pen.depth(top) > pen.depth(base)) parts.reverse();
  const joints = [
    { at: base, node: pen.ball(base, THICK.baseJoint * size, "joint", LEGS[index]) },
    { at: top, node: pen.ball(top, THICK.topJoint * size, "joint", LEGS[index]) },
  ].sort((a, b) => pen.depth(b.at) - pen.depth(a.at));
  return { depth: pen.depth(mean([base, top])), nodes: [joints[0].node, ...parts, joints[1].node] };
}

/** The load as the outline of its ellipsoid, and the mark of its centre of mass. */
function load(pen, machine, pose) {
  const centre = placed(pose, machine.center_of_mass);
  const semi = loadAxes(machine).map((axis) => turned(pose.rotation, axis));
  const eye = minus(pen.projection.eye, pen.shift).map((part) => part / pen.scale);
  return [
    pen.polygon(ellipsoidOutline(centre, semi, eye), "load"),
    ...centreMark(pen, centre, 0.05 * machine.base_radius),
  ];
}

/** The usual mark of a centre of mass: a disc whose quarters are dark and light in turn. */
function centreMark(pen, point, radius) {
  const [place] = pen.places([point]) ?? [];
  if (!place) return [];
  const r = radius * pen.scale * pen.projection.scaleAt(pen.world(point));
  const quarter = (x, y) => `M${text(place)}h${x * r}A${r} ${r} 0 0 ${x * y > 0 ? 1 : 0} ${place[0]} ${place[1] + y * r}Z`;
  return [
    drawing("circle", { class: "centre-disc", cx: place[0], cy: place[1], r }),
    drawing("path", { class: "centre-quarters", d: quarter(1, 1) + quarter(-1, -1) }),
  ];
}

/** The program's pose beside the actual one: its "legs", which the machine may cover, or its "top". */
function ghost(pen, part, machine, pose, accent) {
  const { margin, high } = THICK.ghost;
  const size = machine.base_radius;
  const rim = outline(machine.top, margin * size);
  const face = rim.map(([x, y, h]) => placed(pose, [x, y, h + high * size]));
  return drawing(
    "g",
    { class: "ghost", style: accent ? { "--accent-of": accent } : {} },
    part === "top"
      ? pen.polygon(face, "ghost-face")
      : legsOf(machine, pose).map(({ base, top }) => pen.polyline([base, top], "ghost-leg")),
  );
}

/** The first so many points of a path that is given as x, y, z, …; thinned. */
function points(path, count = Infinity) {
  const all = Math.min(count, (path?.length ?? 0) / 3);
  const stride = Math.max(1, Math.ceil(all / PATH_POINTS));
  const found = [];
  for (let k = 0; k < all; k += stride) found.push(path.slice(3 * k, 3 * k + 3));
  if (all > 1 && (all - 1) % stride) found.push(path.slice(3 * all - 3, 3 * all));
  return found;
}

function paths(pen, { run, plan, accent }, count) {
  return drawing(
    "g",
    { class: "paths", style: accent ? { "--accent-of": accent } : {} },
    pen.polyline(points(plan), "plan-path"),
    pen.polyline(points(run, count), "run-path"),
  );
}

/** Numbers of the legs, beside the joints of the base. */
function numbers(pen, machine) {
  const size = machine.base_radius;
  return machine.base.map((joint, index) => {
    const outwards = 1 + (0.2 * size) / (Math.hypot(joint[0], joint[1]) || 1);
    const place = pen.places([[joint[0] * outwards, joint[1] * outwards, joint[2] - 0.08 * size]]);
    return (
      place &&
      drawing(
        "text",
        { class: "leg-number", x: place[0][0], y: place[0][1] + 4, "text-anchor": "middle" },
        String(index + 1),
      )
    );
  });
}

/** A machine at a moment as nodes of an SVG.
 *  @param entry {machine, peak, accent, run, plan}; @param moment {pose, forces, glow, plan, points}; @param place
 *  {shift, scale} of the machine in the scene; @param shown {ghost, paths, load, labels}; @param poses further poses
 *  that are drawn as outlines. */
function machineNodes(projection, entry, moment, place, shown, poses = []) {
  const { machine, peak } = entry;
  const { pose } = moment;
  const pen = new Pen(projection, place.shift, place.scale);
  const size = machine.base_radius;
  const move = (point) => placed(pose, point);
  const up = turned(pose.rotation, [0, 0, 1]);
  const base = plate(pen, machine.base, THICK.base, size, "base-plate");
  const top = plate(pen, machine.top, THICK.top, size, "top-plate", move);
  const legs = legsOf(machine, pose)
    .map((each, index) => leg(pen, machine, each, index, moment, peak))
    .sort((a, b) => b.depth - a.depth)
    .flatMap(({ nodes }) => nodes);
  const carried = shown.load ? load(pen, machine, pose) : [];
  const above = pen.faces(pose.position, up);
  const heavy = dot(minus(placed(pose, machine.center_of_mass), pose.position), up) >= 0;
  const upper = heavy === above ? [top, carried] : [carried, top];
  const body = above ? [legs, ...upper] : [...upper, legs];
  const ghostly = (part) =>
    shown.ghost && moment.plan && ghost(pen, part, machine, moment.plan, entry.accent);
  const seenFromAbove = pen.faces(mean(machine.base), [0, 0, 1]);
  return [
    ...(seenFromAbove ? [base, ghostly("legs"), body] : [ghostly("legs"), body, base]),
    poses.map((other) =>
      drawing(
        "g",
        { class: other.other ? "other-pose mirrored" : "other-pose" },
        pen.polygon(
          outline(machine.top, THICK.top.margin * size).map((point) => placed(other, point)),
          "pose-face",
        ),
        legsOf(machine, other).map((each) => pen.polyline([each.base, each.top], "pose-leg")),
      ),
    ),
    ghostly("top"),
    shown.paths && paths(pen, entry, moment.points),
    shown.labels && numbers(pen, machine),
  ];
}

/** Lines on the ground around a machine. */
export function groundNodes(projection, { size, low, count }) {
  const reach = 3 + count;
  const lines = [];
  for (let k = -reach; k <= reach; k++)
    for (const turn of [false, true]) {
      const line = [-reach, reach].map((end) => {
        const flat = [0.5 * k * size, 0.5 * end * size];
        return [...(turn ? flat.reverse() : flat), low];
      });
      const [from, to] = line.map((point) => projection.place(point));
      if (from && to) lines.push(drawing("line", { class: "ground", ...ends(from, to) }));
    }
  return lines;
}

/** All machines of a scene, the far ones first. @param room as arrange() gives it. */
export function machinesDrawn(projection, room, models, moments, shown) {
  const alone = models.length === 1;
  return models
    .map((model, index) => ({ model, moment: moments[index], place: room.places[index] }))
    .sort((a, b) => projection.depth(b.place.shift) - projection.depth(a.place.shift))
    .map(({ model: { entry, poses }, moment, place }) =>
      machineNodes(projection, entry, moment, place, { ...shown, labels: shown.labels && alone }, poses),
    );
}

/** Three arrows along the axes, of a length on the sheet, and their names. */
export function triad(projection, [x, y], length) {
  const axes = [
    [1, 0, 0],
    [0, 1, 0],
    [0, 0, 1],
  ];
  return drawing(
    "g",
    { class: "triad" },
    axes.map((axis, k) => {
      const [right, down] = [dot(axis, projection.right), -dot(axis, projection.up)];
      if (Math.hypot(right, down) < 0.12) return null;
      const end = [x + length * right, y + length * down];
      return [
        drawing("line", ends([x, y], end)),
        drawing(
          "text",
          { x: x + (length + 9) * right, y: y + (length + 9) * down + 4, "text-anchor": "middle" },
          "xyz"[k],
        ),
      ];
    }),
  );
}
