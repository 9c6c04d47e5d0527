// Central projection of the scene on a flat sheet, in plain numbers: for drawings by lines, on paper and without WebGL. z is up;
// places on the sheet have x to the right and y down.

const minus = (a, b) => a.map((part, axis) => part - b[axis]);
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a, b) => [
  a[1] * b[2] - a[2] * b[1],
  a[2] * b[0] - a[0] * b[2],
  a[0] * b[1] - a[1] * b[0],
];
const along = (a) => a.map((part) => part / (Math.hypot(...a) || 1));

export class Projection {
  /** @param eye where the reader stands; @param target the point in the middle of the sheet; @param field the angle of the sheet's
   *  height in degrees; @param width and height of the sheet. */
  constructor({ eye, target, field, width, height }) {
    this.eye = eye;
    this.middle = [width / 2, height / 2];
    this.forward = along(minus(target, eye));
    this.right = along(cross(this.forward, [0, 0, 1]));
    this.up = cross(this.right, this.forward);
    this.zoom = height / 2 / Math.tan((field * Math.PI) / 360);
  }

  /** Distance of a point from the eye along the direction of view; not positive behind the reader. */
  depth(point) {
    return dot(minus(point, this.eye), this.forward);
  }

  /** Place of a point: [x, y]; null behind the reader. */
  place(point) {
    const offset = minus(point, this.eye);
    const depth = dot(offset, this.forward);
    if (!(depth > 0)) return null;
    return [
      this.middle[0] + (this.zoom * dot(offset, this.right)) / depth,
      this.middle[1] - (this.zoom * dot(offset, this.up)) / depth,
    ];
  }

  /** Length on the sheet of a unit of length at a point, across the direction of view. */
  scaleAt(point) {
    return this.zoom / Math.max(this.depth(point), 1e-9);
  }

  /** Whether the eye lies on the side of a face that its normal points to. */
  faces(point, normal) {
    return dot(minus(this.eye, point), normal) > 0;
  }
}

/** Points of the outline of an ellipsoid as an eye sees it: x = c + A u with |u| = 1, the columns of A being the semi-axes as
 *  vectors. A point is on the outline if the ray from the eye touches it: with e = A⁻¹(eye − c), u·e = 1. These u lie on a
 *  circle with the centre e/|e|² and the radius √(1 − 1/|e|²). Without points if the eye is inside.
 *  @param semi the three semi-axes as vectors at right angles to each other. */
export function ellipsoidOutline(centre, semi, eye, count = 48) {
  const from = minus(eye, centre);
  const e = semi.map((axis) => dot(from, axis) / dot(axis, axis));
  const size = Math.hypot(...e);
  if (!(size > 1)) return [];
  const direction = along(e);
  const least = direction.map(Math.abs).indexOf(Math.min(...direction.map(Math.abs)));
  const first = along(cross(direction, [0, 1, 2].map((axis) => Number(axis === least))));
  const second = cross(direction, first);
  const radius = Math.sqrt(1 - 1 / size ** 2);
  return Array.from({ length: count }, (_, step) => {
    const [c, s] = [Math.cos((2 * Math.PI * step) / count), Math.sin((2 * Math.PI * step) / count)];
    const u = direction.map((part, k) => part / size + radius * (c * first[k] + s * second[k]));
    return centre.map((part, k) => part + u[0] * semi[0][k] + u[1] * semi[1][k] + u[2] * semi[2][k]);
  });
}
