// Poses: position of the top frame's origin and its rotation in the base frame, R = Rz(yaw) Ry(pitch) Rx(roll), or in the order
// "xyz" R = Rx(roll) Ry(pitch) Rz(yaw).

/** R as nine numbers by rows, from angles in radians. */
export function rotation(roll, pitch, yaw, order) {
  // Rx Ry Rz of three angles is the transpose of Rz Ry Rx of the opposite ones
  if (order === "xyz") {
    const back = rotation(-roll, -pitch, -yaw);
    return [0, 3, 6, 1, 4, 7, 2, 5, 8].map((place) => back[place]);
  }
  const [cr, sr] = [Math.cos(roll), Math.sin(roll)];
  const [cp, sp] = [Math.cos(pitch), Math.sin(pitch)];
  const [cy, sy] = [Math.cos(yaw), Math.sin(yaw)];
  return [
    cy * cp,
    cy * sp * sr - sy * cr,
    cy * sp * cr + sy * sr,
    sy * cp,
    sy * sp * sr + cy * cr,
    sy * sp * cr - cy * sr,
    -sp,
    cp * sr,
    cp * cr,
  ];
}

/** R v. */
export const turned = (r, v) => [
  r[0] * v[0] + r[1] * v[1] + r[2] * v[2],
  r[3] * v[0] + r[4] * v[1] + r[5] * v[2],
  r[6] * v[0] + r[7] * v[1] + r[8] * v[2],
];

/** A point of the top frame in the base frame. */
export function placed(pose, point) {
  const [x, y, z] = turned(pose.rotation, point);
  return [pose.position[0] + x, pose.position[1] + y, pose.position[2] + z];
}

/** Pose from x, y, z, roll, pitch, yaw; `radian` is a radian in the unit of the angles, `order` theirs. */
export const poseOf = ([x, y, z, roll, pitch, yaw], radian, order) => ({
  position: [x, y, z],
  rotation: rotation(roll / radian, pitch / radian, yaw / radian, order),
});

/** Between two angles, the short way round; `radian` is a radian in their unit. */
export function blendAngle(a, b, share, radian) {
  const turn = 2 * Math.PI * radian;
  const difference = ((((b - a) % turn) + 1.5 * turn) % turn) - turn / 2;
  return a + share * difference;
}

/** Vector from base joint to top joint of each leg, and its length. */
export function legsOf(machine, pose) {
  return machine.base.map((base, leg) => {
    const top = placed(pose, machine.top[leg]);
    const along = [top[0] - base[0], top[1] - base[1], top[2] - base[2]];
    return { base, top, along, length: Math.hypot(...along) };
  });
}
