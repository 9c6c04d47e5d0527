// Columns of a table from others: those of the legs by the C core, from pose and rates; powers from forces and rates; deviations
// from the poses of run and program.

/** Columns that the core takes, with the kind of their unit. The tables of programs have poses only. */
const POSE = [
  ...["x", "y", "z"].map((name) => [name, "length"]),
  ...["roll", "pitch", "yaw"].map((name) => [name, "angle"]),
];
const RATES = [
  ...["vx", "vy", "vz"].map((name) => [name, "speed"]),
  ...["wx", "wy", "wz"].map((name) => [name, "angular_speed"]),
];
const SIX = [1, 2, 3, 4, 5, 6];
/** Columns that the core gives. */
const FOUND = [
  ...SIX.map((leg) => [`l${leg}`, "length"]),
  ...SIX.map((leg) => [`dl${leg}`, "speed"]),
  ["condition", null],
];
/** Rows of a call to the core. */
const ROWS = 4096;

/** Leg lengths, rates and condition numbers of a table. */
export function legColumns(core, study, table) {
  const wanted = FOUND.map(([name, kind], place) => ({
    name,
    place,
    factor: kind ? study.factor(kind) : 1,
    values: new Float64Array(table.rows),
  })).filter(({ name }) => table.computed.includes(name));
  if (!wanted.length) return;
  const given = [...POSE, ...RATES].map(([name, kind]) => ({
    values: table.column(name),
    factor: study.factor(kind),
  }));
  for (let first = 0; first < table.rows; first += ROWS) {
    const count = Math.min(ROWS, table.rows - first);
    const rows = new Float64Array(12 * count);
    given.forEach(({ values, factor }, place) => {
      for (let row = 0; values && row < count; row++)
        rows[12 * row + place] = values[first + row] / factor;
    });
    const found = core.derived(rows);
    for (const { place, factor, values } of wanted)
      for (let row = 0; row < count; row++) values[first + row] = factor * found[13 * row + place];
  }
  for (const { name, values } of wanted) table.set(name, values);
}

/** Power of each leg: force of its drive times rate. */
export function powerColumns(study) {
  const { run } = study;
  const scale = study.factor("power") / (study.factor("force") * study.factor("speed"));
  for (const leg of SIX) {
    if (!run.computed.includes(`p${leg}`)) continue;
    const [force, rate] = [run.column(`f${leg}`), run.column(`dl${leg}`)];
    run.set(`p${leg}`, force.map((value, row) => scale * value * rate[row]));
  }
}

/** Pose less the program's; angles to half a turn either way. */
export function deviationColumns(study) {
  const { run, plan } = study;
  const half = Math.PI * study.factor("angle");
  const wrapped = (angle) =>
    angle > half ? angle - 2 * half : angle <= -half ? angle + 2 * half : angle;
  for (const [name, kind] of POSE) {
    if (!run.computed.includes(`e${name}`)) continue;
    const [actual, wanted] = [run.column(name), plan.column(name)];
    const turned = kind === "angle" ? wrapped : (value) => value;
    run.set(`e${name}`, actual.map((value, row) => turned(value - wanted[row])));
  }
}
