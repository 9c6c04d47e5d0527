// Energies along a run: of the load, and the work that the legs have done.
import { rotation, turned } from "./pose.js";

/** Work of each leg since the first row: the integral of its power by the trapezoidal rule over the rows. */
export function legWork(study) {
  const table = study.run;
  const scale = study.factor("energy") / (study.factor("power") * study.factor("time"));
  return [1, 2, 3, 4, 5, 6].map((leg) => {
    const power = table.column(`p${leg}`);
    const work = new Float64Array(table.rows);
    for (let row = 1; row < table.rows; row++)
      work[row] =
        work[row - 1] + 0.5 * scale * (table.t[row] - table.t[row - 1]) * (power[row] + power[row - 1]);
    return work;
  });
}

/** What friction of all legs has taken since the first row: the integral of (drive force − leg force) times rate, likewise. */
export function frictionLoss(study) {
  const table = study.run;
  const scale =
    study.factor("energy") / (study.factor("force") * study.factor("speed") * study.factor("time"));
  const lost = new Float64Array(table.rows);
  const columns = [1, 2, 3, 4, 5, 6].map((leg) =>
    ["f", "h", "dl"].map((name) => table.column(`${name}${leg}`)),
  );
  const power = (row) => columns.reduce((sum, [f, h, v]) => sum + (f[row] - h[row]) * v[row], 0);
  for (let row = 1; row < table.rows; row++)
    lost[row] =
      lost[row - 1] + 0.5 * scale * (table.t[row] - table.t[row - 1]) * (power(row) + power(row - 1));
  return lost;
}

/** Kinetic and potential energy of the load: ½ m v_c² + ½ ω·Jω, and −m g·r_c counted from the first row. */
export function loadEnergy(study) {
  const { run: table, inside } = study;
  const [length, speed, radian, spinning, joule] = [
    "length",
    "speed",
    "angle",
    "angular_speed",
    "energy",
  ].map((kind) => study.factor(kind));
  const names = ["x", "y", "z", "roll", "pitch", "yaw", "vx", "vy", "vz", "wx", "wy", "wz"];
  const columns = names.map((name) => table.column(name));
  const kinetic = new Float64Array(table.rows);
  const potential = new Float64Array(table.rows);
  for (let row = 0; row < table.rows; row++) {
    const numbers = columns.map((column) => column[row]);
    const [x, y, z] = numbers.slice(0, 3).map((value) => value / length);
    const [roll, pitch, yaw] = numbers.slice(3, 6).map((value) => value / radian);
    const [vx, vy, vz] = numbers.slice(6, 9).map((value) => value / speed);
    const [wx, wy, wz] = numbers.slice(9).map((value) => value / spinning);
    const r = rotation(roll, pitch, yaw, table.order);
    const arm = turned(r, inside.centre);
    // velocity of the centre of mass: v + ω × R c
    const velocity = [
      vx + wy * arm[2] - wz * arm[1],
      vy + wz * arm[0] - wx * arm[2],
      vz + wx * arm[1] - wy * arm[0],
    ];
    // ω in the top's axes: Rᵀω
    const own = [0, 1, 2].map((axis) => r[axis] * wx + r[3 + axis] * wy + r[6 + axis] * wz);
    const spun = inside.inertia.map(
      (line) => line[0] * own[0] + line[1] * own[1] + line[2] * own[2],
    );
    kinetic[row] =
      joule *
      (0.5 * inside.mass * velocity.reduce((sum, v) => sum + v * v, 0) +
        0.5 * own.reduce((sum, w, axis) => sum + w * spun[axis], 0));
    const centre = [x + arm[0], y + arm[1], z + arm[2]];
    potential[row] =
      -joule * inside.mass * inside.gravity.reduce((sum, g, axis) => sum + g * centre[axis], 0);
  }
  const zero = potential[0] ?? 0;
  return { kinetic, potential: potential.map((value) => value - zero) };
}
