// Shapes of a machine that a study does not give, for the scene and for drawings by lines: plates through the joints, the load's
// ellipsoid, cylinder and piston of a leg. All thicknesses follow the base radius.
import { equalEllipsoid } from "./inertia.js";

/** Radii and plates in base radii: margin around the joints, lower and upper side along z. */
export const THICK = {
  cylinder: 0.036,
  piston: 0.02,
  base: { margin: 0.13, low: -0.11, high: -0.05 },
  top: { margin: 0.075, low: 0.02, high: 0.07 },
  ghost: { margin: 0.085, low: 0.015, high: 0.075 },
  baseJoint: 0.042,
  topJoint: 0.034,
};

/** Joints in order around their centre, pushed outwards by `margin`: the outline of a plate. */
export function outline(joints, margin) {
  const centre = [0, 1, 2].map(
    (axis) => joints.reduce((sum, joint) => sum + joint[axis], 0) / joints.length,
  );
  return joints
    .map((joint) => ({ joint, angle: Math.atan2(joint[1] - centre[1], joint[0] - centre[0]) }))
    .sort((a, b) => a.angle - b.angle)
    .map(({ joint }) => {
      const [dx, dy] = [joint[0] - centre[0], joint[1] - centre[1]];
      const distance = Math.hypot(dx, dy) || 1;
      return [joint[0] + (dx / distance) * margin, joint[1] + (dy / distance) * margin, joint[2]];
    });
}

/** Semi-axes of the load's ellipsoid as vectors of the top frame, right-handed. */
export function loadAxes(machine) {
  const { axes, vectors } = equalEllipsoid(machine.mass, machine.inertia);
  const [u, v, w] = [0, 1, 2].map((k) => vectors.map((line) => line[k]));
  const volume =
    u[0] * (v[1] * w[2] - v[2] * w[1]) -
    u[1] * (v[0] * w[2] - v[2] * w[0]) +
    u[2] * (v[0] * w[1] - v[1] * w[0]);
  const right = volume > 0 ? 1 : -1;
  return [u, v, w.map((part) => right * part)].map((vector, k) => vector.map((part) => part * axes[k]));
}

/** How far the load rises over the top frame's origin: the ellipsoid's height along z. */
export const loadRise = (machine, semi = loadAxes(machine)) =>
  Math.max(
    0.15 * machine.base_radius,
    machine.center_of_mass[2] + Math.hypot(semi[0][2], semi[1][2], semi[2][2]),
  );

/** Length of a leg's cylinder, which ends before the piston does. */
export function cylinderLength(machine, leg, length) {
  const least = machine.limits?.length?.[0];
  return Math.min(least ? 0.92 * least : 0.6 * machine.home_length[leg], 0.96 * length);
}
