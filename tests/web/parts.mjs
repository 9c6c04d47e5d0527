// The page's parts that need no browser, in Node: thinning, tables as text, poses, the load's shape, energies, numbers in words.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { join } from "node:path";
import test from "node:test";
import { deflateSync, inflateSync } from "node:zlib";
import { csv } from "../../web/src/csv.js";
import { Table } from "../../web/src/data.js";
import { legWork, loadEnergy } from "../../web/src/energy.js";
import { amount, below, fixed, known, number, ticks, unit, shower } from "../../web/src/format.js";
import { equalEllipsoid, symmetricEigen } from "../../web/src/inertia.js";
import { unpacked } from "../../web/src/packed.js";
import { legsOf, poseOf } from "../../web/src/pose.js";
import { Player } from "../../web/src/player.js";
import { holdsFrom, modesAtRest, thresholdsOf, verdictOf } from "../../web/src/stability.js";
import { lowerBound, thin } from "../../web/src/thin.js";

const { GOUGH, SOURCE } = process.env;
const near = (actual, wanted, tolerance, what = "") =>
  assert.ok(Math.abs(actual - wanted) <= tolerance, `${what} ${actual} for ${wanted}`);

const DEGREES = 180 / Math.PI;
/** A study in SI as far as energies ask for it. */
const studyOf = (run, { center_of_mass: centre, ...load }) => ({
  run,
  inside: { ...load, centre },
  factor: (kind) => (["angle", "angular_speed"].includes(kind) ? DEGREES : 1),
});

// a generator with known numbers (Park and Miller), so that a failure can be repeated
function generator(seed) {
  let state = seed;
  return () => (state = (state * 48271) % 2147483647) / 2147483647;
}

test("thinning keeps the least and the greatest value of each stretch, in their order", () => {
  const random = generator(7);
  const x = Float64Array.from({ length: 60001 }, (_, row) => 0.01 * row);
  const y = x.map(() => random() - 0.5);
  const thinned = thin(x, [y], 0, 600, 300);
  assert.equal(thinned.x.length, 600);
  assert.ok(thinned.x.every((time, index) => index === 0 || time > thinned.x[index - 1]));
  for (let bucket = 0; bucket < 300; bucket++) {
    const [from, to] = [bucket, bucket + 1].map((k) => Math.floor((k * x.length) / 300));
    const part = Array.from(y.subarray(from, to));
    const kept = thinned.lines[0].slice(2 * bucket, 2 * bucket + 2);
    assert.equal(Math.min(...kept), Math.min(...part));
    assert.equal(Math.max(...kept), Math.max(...part));
    assert.equal(
      kept[0] === Math.min(...part),
      part.indexOf(Math.min(...part)) < part.indexOf(Math.max(...part)),
    );
  }
});

test("few points are not thinned, and reach beyond the range by one", () => {
  const x = Float64Array.from({ length: 101 }, (_, row) => row);
  const { x: kept, lines } = thin(x, [x], 10.5, 20.5, 100);
  assert.deepEqual(
    kept,
    Array.from({ length: 13 }, (_, row) => row + 10),
  );
  assert.deepEqual(lines[0], kept);
});

test("what is not finite is a gap, thinned or not", () => {
  const x = Float64Array.from({ length: 1000 }, (_, row) => row);
  const y = x.map((value) => (value < 500 ? NaN : value));
  assert.equal(thin(x, [y], 0, 999, 2000).lines[0][10], null);
  const { lines } = thin(x, [y], 0, 999, 10);
  assert.deepEqual(lines[0].slice(0, 10), Array(10).fill(null));
  assert.deepEqual(lines[0].slice(10, 12), [500, 599]);
});

test("the first index at or after a value is found", () => {
  const x = Float64Array.of(0, 1, 1, 3);
  assert.deepEqual(
    [-1, 0, 0.5, 1, 2, 3, 4].map((value) => lowerBound(x, value)),
    [0, 0, 1, 1, 3, 3, 4],
  );
});

test("a table as text gives each double back", () => {
  const values = Float64Array.of(
    0,
    -0,
    1 / 3,
    5e-324,
    1.7976931348623157e308,
    -1.1102230246251565e-16,
    123456789012345680,
    NaN,
    Infinity,
  );
  const [head, ...lines] = csv([
    { name: "a", values },
    { name: "b", values },
  ]).split("\n");
  assert.equal(head, "a,b");
  lines
    .slice(0, 7)
    .forEach((line, row) =>
      line.split(",").forEach((text) => assert.ok(Object.is(Number(text), values[row]), text)),
    );
  assert.deepEqual(lines.slice(7), ["nan,nan", "inf,inf", ""]);
});

/** The 64 bits of a double. */
const bits = (value) => new BigUint64Array(Float64Array.of(value).buffer)[0];

/** A column packed as the page has it, in whole numbers of any size: differences of bits from the polynomial through the last
 *  `order` numbers. */
function packed(values, order) {
  const planes = Array.from({ length: 8 }, () => []);
  values.forEach((value, row) => {
    let guess = 0;
    let weight = -1;
    for (let j = 1; j <= Math.min(order, row); j++) {
      weight = (-weight * (Math.min(order, row) - j + 1)) / j;
      guess += weight * values[row - j];
    }
    const apart = BigInt.asIntN(64, bits(value) - bits(Number.isFinite(guess) ? guess : 0));
    const code = BigInt.asUintN(64, apart < 0n ? -2n * apart - 1n : 2n * apart);
    planes.forEach((plane, k) => plane.push(Number((code >> BigInt(8 * k)) & 255n)));
  });
  return {
    rows: values.length,
    order,
    packed: deflateSync(Uint8Array.from(planes.flat())).toString("base64"),
  };
}

test("packed columns come back to the last bit, whatever their numbers are", () => {
  const random = generator(2026);
  const word = () => BigInt(Math.floor(random() * 2 ** 32));
  const words = Array.from({ length: 400 }, () => word() * 4294967296n + word());
  const any = new Float64Array(new BigUint64Array(words).buffer).map((value) => (Number.isNaN(value) ? 1 : value));
  const columns = [
    [],
    [0.1],
    [0, -0, 5e-324, -5e-324, 1.7e308, -1.7e308, 1.7e308, Infinity, -Infinity, 0.3, NaN, 1],
    Array.from({ length: 300 }, (_, row) => Math.sin(0.07 * row) * 1e-3),
    Array.from(any),
  ];
  for (const values of columns)
    for (const order of [0, 1, 4, 8]) {
      const back = unpacked(packed(values, order), inflateSync);
      assert.equal(back.length, values.length);
      values.forEach((value, row) =>
        assert.ok(Object.is(back[row], value), `row ${row} at order ${order}: ${back[row]} for ${value}`),
      );
    }
});

const machine = JSON.parse(
  JSON.stringify({ mass: 2, center_of_mass: [0.1, -0.2, 0.3], gravity: [0, 0, -9] }),
);
const encoded = (name, values) => ({
  name,
  unit: "1",
  long_name: name,
  ...packed(Array.from(values), 2),
});

test("a pose between rows goes straight, and angles turn the short way", () => {
  const names = ["x", "y", "z", "roll", "pitch", "yaw"];
  const table = new Table(
    [
      encoded("t", [0, 0.1, 0.2]),
      ...names.map((name) =>
        encoded(name, { pitch: [10, -10, -30], yaw: [179, -179, -177] }[name] ?? [0, 1, 4]),
      ),
    ],
    DEGREES,
    undefined,
    inflateSync,
  );
  near(table.value("x", 0.15), 2.5, 1e-12);
  near(table.value("x", 0.125), 1.75, 1e-12);
  near(Math.cos((table.value("yaw", 0.05) * Math.PI) / 180), -1, 1e-12);
  near(table.value("pitch", 0.025), 5, 1e-12);
  near(table.value("pitch", 0.15), -20, 1e-12);
  assert.equal(table.value("x", 0.1), 1);
  assert.equal(table.value("x", 99), 4);
});

for (const order of ["zyx", "xyz"])
  test(`legs have the lengths of the command's table in a pose of all six freedoms, ${order}`, () =>
    holdLengths(order));

function holdLengths(order) {
  const file = join(SOURCE, "examples/all-six.yaml");
  const options = ["-q", "-o", "-", "--set", `motion.order=${order}`];
  const lines = execFileSync(GOUGH, ["simulate", file, ...options], {
    encoding: "utf8",
    maxBuffer: 1 << 26,
  })
    .trim()
    .split("\n");
  const names = lines[0].split(",");
  const row = lines[215].split(",").map(Number);
  const at = (name) => row[names.indexOf(name)];
  const ring = (radius, angles) =>
    angles.map((angle) => [
      radius * Math.cos((angle * Math.PI) / 180),
      radius * Math.sin((angle * Math.PI) / 180),
      0,
    ]);
  const half = 6.4688478326275441;
  const base = ring(1, [10, 110, 130, 230, 250, 350]);
  const top = ring(0.6, [60 - half, 60 + half, 180 - half, 180 + half, 300 - half, 300 + half]);
  const pose = poseOf(["x", "y", "z", "roll", "pitch", "yaw"].map(at), DEGREES, order);
  legsOf({ base, top }, pose).forEach(({ length }, leg) =>
    near(length, at(`l${leg + 1}`), 1e-13, `leg ${leg + 1}`),
  );
}

test("the ellipsoid has the mass and inertia that it stands for", () => {
  const inertia = [
    [410, 8, -35],
    [8, 520, 12],
    [-35, 12, 460],
  ];
  const { axes, vectors } = equalEllipsoid(1050, inertia);
  // J = Σ over the axes of m/5 (sum of the other two squares), turned back
  const moments = axes.map(
    (_, k) =>
      (1050 / 5) * axes.reduce((sum, axis, other) => sum + (other === k ? 0 : axis * axis), 0),
  );
  for (let r = 0; r < 3; r++)
    for (let c = 0; c < 3; c++)
      near(
        moments.reduce((sum, moment, k) => sum + vectors[r][k] * moment * vectors[c][k], 0),
        inertia[r][c],
        1e-9,
      );
  const { values } = symmetricEigen([
    [2, 0, 0],
    [0, 3, 0],
    [0, 0, 4],
  ]);
  assert.deepEqual(values, [2, 3, 4]);
});

test("in a run the load's energy changes by the work of the legs", () => {
  const file = join(SOURCE, "examples/all-six.yaml");
  const lines = execFileSync(
    GOUGH,
    [
      "simulate",
      file,
      "-q",
      "-o",
      "-",
      "--set",
      "simulation.output_step=0.005",
      "--set",
      "disturbance.force=[0,0,0]",
      "--set",
      "disturbance.moment=[0,0,0]",
    ],
    { encoding: "utf8", maxBuffer: 1 << 26 },
  )
    .trim()
    .split("\n");
  const names = lines[0].split(",");
  const rows = lines.slice(1).map((line) => line.split(",").map(Number));
  const table = new Table(
    names.map((name, column) =>
      encoded(
        name,
        rows.map((row) => row[column]),
      ),
    ),
    DEGREES,
    undefined,
    inflateSync,
  );
  const load = {
    mass: 1,
    center_of_mass: [0.03, -0.02, 0.15],
    gravity: [0, 0, -1],
    inertia: [
      [0.08, 0.004, -0.006],
      [0.004, 0.09, 0.003],
      [-0.006, 0.003, 0.12],
    ],
  };
  const study = studyOf(table, load);
  const work = legWork(study);
  const { kinetic, potential } = loadEnergy(study);
  let worst = 0;
  let most = 0;
  for (let row = 0; row < table.rows; row++) {
    const gained = kinetic[row] + potential[row] - kinetic[0];
    most = Math.max(most, Math.abs(gained));
    worst = Math.max(worst, Math.abs(gained - work.reduce((sum, leg) => sum + leg[row], 0)));
  }
  // the trapezoidal rule at steps of 0.005: T h²/12 of a second derivative below 1
  assert.ok(most > 0.05 && worst < 4e-5, `${worst} of ${most}`);
});

test("a resting load has the energy of its height", () => {
  const columns = ["t", "x", "y", "z", "roll", "pitch", "yaw", "vx", "vy", "vz", "wx", "wy", "wz"];
  const table = new Table(
    columns.map((name) => encoded(name, { t: [0, 1], z: [1, 1.5] }[name] ?? [0, 0])),
    DEGREES,
    undefined,
    inflateSync,
  );
  const inertia = [
    [1, 0, 0],
    [0, 1, 0],
    [0, 0, 1],
  ];
  const { kinetic, potential } = loadEnergy(studyOf(table, { ...machine, inertia }));
  assert.deepEqual([...kinetic], [0, 0]);
  near(potential[1], 9, 1e-12);
});

test("numbers read well", () => {
  assert.deepEqual(
    [0, 0.25, -1.5, 1e-7, 123456, 2.5e7, NaN, null, Infinity].map((value) => number(value)),
    ["0", "0.25", "−1.5", "1·10⁻⁷", "123500", "2.5·10⁷", "–", "–", "∞"],
  );
  assert.equal(fixed(-0.0001, 2), "0.00");
  assert.deepEqual(ticks([0.15, 0.175, 0.2]), ["0.150", "0.175", "0.200"]);
  assert.deepEqual(ticks([0, 5, 10]), ["0", "5", "10"]);
  assert.deepEqual(ticks([11.400042, 11.4000422, 11.4000424]), [
    "11.4000420",
    "11.4000422",
    "11.4000424",
  ]);
  assert.deepEqual(ticks([0, 5e-16, 1e-15]), ["0", "0.5·10⁻¹⁵", "1.0·10⁻¹⁵"]);
  assert.deepEqual(ticks([1.5e-4, null, 1.6e-4]), ["1.5·10⁻⁴", "", "1.6·10⁻⁴"]);
  assert.deepEqual(ticks([-2e7, 0, 2e7]), ["−2·10⁷", "0", "2·10⁷"]);
  assert.deepEqual(ticks([1000000.25, 1000000.5]), ["1000000.25", "1000000.50"]);
  assert.deepEqual(
    [3e-9, -2e-8, 1.23456e-5, 12.3456, NaN].map((value) => known(value, 1e-8)),
    ["0", "−2·10⁻⁸", "1.235·10⁻⁵", "12.346", "–"],
  );
  // a magnitude is never said to be 0 where it is only not known
  assert.deepEqual(
    [0, 3e-9, 1e-8, 1.1e-8, 0.5, NaN].map((value) => below(value, 1e-8)),
    ["below 1·10⁻⁸", "below 1·10⁻⁸", "below 1·10⁻⁸", "1·10⁻⁸", "0.5", "–"],
  );
  assert.equal(below(0, 2.31e-9), "below 3·10⁻⁹");
  assert.equal(below(0, 0.012), "below 0.02");
  assert.equal(below(0, 2.31e-9, 3, true), "3·10⁻⁹");
  assert.equal(below(0, 0), "0"); // without a scale

  assert.deepEqual(["m/s2", "degree/s", "1", "N m", ""].map(unit), ["m/s²", "°/s", "", "N m", ""]);
  assert.equal(amount(3, "degree"), "3 °");
});

test("thresholds are told once for each value, and a mode holds from its greatest", () => {
  const stability = {
    thresholds: [
      ["sway–tilt", 0.894],
      ["sway–tilt", 0.894],
      ["yaw", 0.466],
      ["sway–tilt", 0.13],
      ["heave", 0],
    ].map(([mode, stiffness]) => ({ mode, stiffness })),
  };
  assert.deepEqual(
    thresholdsOf(stability).map(({ stiffness }) => stiffness),
    [0, 0.13, 0.466, 0.894],
  );
  assert.deepEqual(holdsFrom(stability), [
    { mode: "yaw", stiffness: 0.466 },
    { mode: "sway–tilt", stiffness: 0.894 },
  ]);
  assert.deepEqual(holdsFrom(null), []);
});

test("a mode that drifts is not said to grow, nor one that grows to drift", () => {
  const loop = (...settings) =>
    JSON.parse(
      execFileSync(
        GOUGH,
        [
          "stability",
          join(SOURCE, "examples/own-machine.yaml"),
          "--json",
          "-q",
          ...settings.flatMap((setting) => ["--set", setting]),
        ],
        { encoding: "utf8", stdio: ["ignore", "pipe", "ignore"] },
      ),
    );
  assert.equal(verdictOf(loop()), "stays");
  assert.equal(
    verdictOf(loop("gravity=0", "control.stiffness=0", "control.damping=0")),
    "drifts",
  );
  assert.equal(verdictOf(loop("control.stiffness=0", "control.damping=0")), "grows");
});

test("modes at rest: both of each complex pair once, the least damped first", () => {
  const found = JSON.parse(
    execFileSync(GOUGH, ["stability", join(SOURCE, "examples/own-machine.yaml"), "--json", "-q"], {
      encoding: "utf8",
    }),
  );
  const modes = modesAtRest(found);
  assert.equal(
    modes.reduce((sum, { frequency }) => sum + (frequency > 0 ? 2 : 1), 0),
    12,
  );
  assert.ok(modes.every(({ rate }, index) => index === 0 || rate <= modes[index - 1].rate));
  for (const { rate, frequency, mode } of modes)
    assert.ok(
      found.eigenvalues.some(
        ([re, im], index) => re === rate && im === frequency && found.modes[index].name === mode,
      ),
    );
});

test("the clock does not run backwards", () => {
  const player = new Player(8, 0.02);
  player.play();
  player.advance(-0.5);
  assert.equal(player.time, 0);
  player.advance(NaN);
  assert.equal(player.time, 0);
  player.advance(0.25);
  assert.equal(player.time, 0.25);
});

test("the clock stays within the recording", () => {
  const player = new Player(8, 0.02);
  const after = (action) => {
    action();
    return player.time;
  };
  assert.equal(after(() => player.seek(9)), 8);
  assert.equal(after(() => player.seek(-1)), 0);
  assert.equal(after(() => player.stepRows(-1)), 0);
  assert.equal(after(() => player.seek(7.9)), 7.9);
  player.play();
  assert.equal(after(() => player.advance(0.3)), 8);
  player.pause();
  assert.equal(after(() => player.stepRows(1)), 8);
});

test("changing numbers fit their place for machines of any size", () => {
  assert.equal(shower(0.2657)(0.2034426), "0.20344");
  assert.equal(shower(80)(-15.75612), "\u221215.756");
  assert.equal(shower(1.9e12)(1878355390555), "1.8784·10¹²");
  assert.equal(shower(1e-12)(3.14159e-13), "3.1416·10⁻¹³");
  assert.equal(shower(1, 6)(1.0249149), "1.02491");
});
