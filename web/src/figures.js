// Which curves a study has, and which a comparison of studies has.
import { AXES, GREY, LEGS, studyColor } from "./color.js";
import { frictionLoss, legWork, loadEnergy } from "./energy.js";
import { number, unitAfter } from "./format.js";

const SIX = [1, 2, 3, 4, 5, 6];
const DASH = [5, 4];

const magnitude = (...arrays) =>
  arrays[0].map((_, row) => Math.hypot(...arrays.map((array) => array[row])));

/** A line of each leg for a column such as "f", and the program's beside it. */
function legLines(study, column, planned = true) {
  const { run, plan } = study;
  const lines = SIX.map((leg) => ({
    label: String(leg),
    name: `${column}${leg}`,
    long: run.longName(`${column}${leg}`),
    leg,
    color: LEGS[leg - 1],
    t: run.t,
    y: run.column(`${column}${leg}`),
  }));
  if (!planned || !plan.rows) return lines;
  return [
    ...lines,
    ...SIX.map((leg) => ({
      label: `${leg} program`,
      name: `program-${column}${leg}`,
      leg,
      program: true,
      off: true,
      color: LEGS[leg - 1],
      dash: DASH,
      width: 1,
      t: plan.t,
      y: plan.column(`${column}${leg}`),
    })),
  ];
}

/** Where a leg's limits lie, in words: the drawing has room for the near ones only. */
function limitsNote(study, column) {
  const limits = limitsOf(study, column).map(
    ({ value }) => `${number(value)}${unitAfter(study.unit(`${column}1`))}`,
  );
  return limits.length ? `Limits: ${limits.join(", ")}.` : "";
}

/** Says so where the six lines are one, lest five seem lost. */
function equalNote(study, column) {
  const [first, ...others] = SIX.map((leg) => study.run.column(`${column}${leg}`));
  const scale = first.reduce((most, value) => Math.max(most, Math.abs(value)), 0);
  const equal = others.every((values) =>
    values.every((value, row) => Math.abs(value - first[row]) <= 2e-3 * scale),
  );
  return equal ? "The six legs look the same: one line covers the others." : "";
}

const joined = (...notes) => notes.filter(Boolean).join(" ");

/** Least and greatest force if they are those of all legs, else null. */
function forceRange(study) {
  const ranges = study.machine.all_limits.legs.force;
  return ranges.every((range) => range.every((value, side) => value === ranges[0][side]))
    ? ranges[0]
    : null;
}

function limitsOf(study, kind) {
  const { length, speed, force } = study.machine.limits ?? {};
  const both = (value) =>
    value
      ? [
          { value, beyond: 1 },
          { value: -value, beyond: -1 },
        ]
      : [];
  if (kind === "l")
    return [
      length?.[0] ? { value: length[0], beyond: -1 } : null,
      length?.[1] ? { value: length[1], beyond: 1 } : null,
    ].filter(Boolean);
  const [least, greatest] = (!force && kind === "f" && forceRange(study)) || [null, null];
  if (greatest !== null)
    return [
      { value: least, beyond: -1 },
      { value: greatest, beyond: 1 },
    ];
  return both(kind === "dl" ? speed : kind === "f" ? force : null);
}

/** Figure 3 of the paper: the force in one rod along its program. All six are equal there, or it is not its machine. */
function figure3(study) {
  const { plan } = study;
  const force = plan.column("f1");
  const spread = SIX.reduce(
    (most, leg) =>
      Math.max(
        most,
        plan
          .column(`f${leg}`)
          .reduce((worst, value, row) => Math.max(worst, Math.abs(value - force[row])), 0),
      ),
    0,
  );
  const equal = spread < 1e-9;
  return {
    id: "figure-3",
    title: "Figure 3 · the force in the rod",
    unit: plan.unit("f1"),
    note: equal
      ? "The program's force F(t), the same in each of the six legs: equation (3.1) through the six equations of motion."
      : "The program's forces for equation (3.1). In this machine the six legs differ.",
    lines: (equal ? [1] : SIX).map((leg) => ({
      label: equal ? "F" : String(leg),
      name: `f${leg}`,
      leg: equal ? undefined : leg,
      color: LEGS[leg - 1],
      width: 2,
      t: plan.t,
      y: plan.column(`f${leg}`),
    })),
  };
}

/** Figure 4 of the paper: the height of the top over its mean, actual and program. */
function figure4(studies) {
  const [first] = studies;
  const over = (table, study) => table.column("z").map((z) => z - study.machine.height);
  const alone = studies.length === 1;
  const fed = alone && !first.openLoop;
  return {
    id: "figure-4",
    title: "Figure 4 · the platform's motion",
    unit: first.run.unit("z"),
    note: fed
      ? "Height over the mean, as in the paper's Figure 4, but with feedback: G holds it."
      : alone
        ? "Height over the mean under the given forces, η*, and the program η of equation (3.1)."
        : "Height over the mean, η*, and the program η of equation (3.1).",
    lines: [
      ...studies.map((study) => ({
        label: alone ? "η*" : study.label,
        name: `${study.index}`,
        color: alone ? AXES[0] : studyColor(study.index),
        width: 2,
        t: study.run.t,
        y: over(study.run, study),
      })),
      {
        label: "η program",
        name: "program",
        color: GREY,
        dash: DASH,
        width: 1.5,
        t: first.plan.t,
        y: over(first.plan, first),
      },
    ],
  };
}

const three = (study, names, labels, planned) => [
  ...names.map((name, axis) => ({
    label: labels[axis],
    name,
    long: study.run.longName(name),
    color: AXES[axis],
    t: study.run.t,
    y: study.run.column(name),
  })),
  ...(planned && study.plan.rows
    ? names.map((name, axis) => ({
        label: `${labels[axis]} program`,
        name: `program-${name}`,
        program: true,
        off: true,
        color: AXES[axis],
        dash: DASH,
        width: 1,
        t: study.plan.t,
        y: study.plan.column(name),
      }))
    : []),
];

/** Curves of the legs, by their columns. */
function legFigures(study) {
  const { run } = study;
  const takesForce = run.has("h1");
  const leg = (id, title, column, note, limited) => ({
    id,
    title,
    note,
    unit: run.unit(`${column}1`),
    noise: study.noise(`${column}1`),
    lines: legLines(study, column),
    ...(limited && { limits: limitsOf(study, column) }),
  });
  const notes = (column) => joined(limitsNote(study, column), equalNote(study, column));
  return [
    leg(
      "forces",
      takesForce ? "Drive forces" : "Leg forces",
      "f",
      joined("Push is positive.", takesForce && "With friction.", notes("f")),
      true,
    ),
    ...(takesForce
      ? [
          leg(
            "leg-forces",
            "Leg forces",
            "h",
            joined("Drive forces less friction.", equalNote(study, "h")),
            false,
          ),
        ]
      : []),
    leg("lengths", "Leg lengths", "l", notes("l"), true),
    leg("rates", "Leg rates", "dl", notes("dl"), true),
    leg("power", "Leg power", "p", equalNote(study, "p"), false),
  ];
}

/** Where the top is, and how far from the program. */
function topFigures(study) {
  const { run, machine } = study;
  const unit = (name) => run.unit(name);
  const aboveHome = (table) => table.column("z").map((z) => z - machine.height);
  const position = three(study, ["x", "y", "z"], ["x", "y", "z"], true);
  position[2] = { ...position[2], label: "z − h", y: aboveHome(run) };
  if (position[5])
    position[5] = { ...position[5], label: "z − h program", y: aboveHome(study.plan) };
  return [
    {
      id: "position",
      title: "Position of the top",
      note: `From the home position, at height h = ${number(machine.height)}${unitAfter(unit("z"))} over the base.`,
      unit: unit("x"),
      noise: study.noise("x"),
      lines: position,
    },
    {
      id: "orientation",
      title: "Orientation of the top",
      unit: unit("roll"),
      noise: study.noise("roll"),
      lines: three(study, ["roll", "pitch", "yaw"], ["roll", "pitch", "yaw"], true),
    },
    {
      id: "deviation",
      title: "Deviation from the program",
      logable: true,
      unit: unit("ex"),
      noise: study.noise("ex"),
      lines: three(study, ["ex", "ey", "ez"], ["x", "y", "z"]),
    },
    {
      id: "deviation-angle",
      title: "Deviation of the angles",
      logable: true,
      unit: unit("eroll"),
      noise: study.noise("eroll"),
      lines: three(study, ["eroll", "epitch", "eyaw"], ["roll", "pitch", "yaw"]),
    },
  ];
}

/** Energy of the load, and the work of the legs. */
function energyFigures(study) {
  const { run, machine } = study;
  const takesForce = run.has("h1");
  const doers = takesForce ? "drives" : "legs";
  const work = legWork(study);
  const { kinetic, potential } = loadEnergy(study);
  const total = kinetic.map((value, row) => value + potential[row]);
  const done = total.map((_, row) => work.reduce((sum, leg) => sum + leg[row], 0));
  const energyUnit = study.unitOf("energy");
  return [
    {
      id: "energy",
      title: "Energy of the load",
      note: joined(
        "Potential energy from that at t = 0.",
        `The work of the ${doers} is the sum over six of the integral of ${takesForce ? "drive force" : "force"} times rate.`,
        machine.legs_have_mass &&
          "The energies are the load's alone: those of the legs' own mass are not drawn.",
        machine.externals > 0 && "The work of the external loads is not drawn.",
        takesForce && "Lost by friction: the same integral of drive force less leg force.",
      ),
      unit: energyUnit,
      noise: study.noise("energy"),
      lines: [
        { label: "kinetic", color: AXES[0], t: run.t, y: kinetic },
        { label: "potential", color: AXES[1], t: run.t, y: potential },
        { label: "sum", color: AXES[2], t: run.t, y: total, width: 2 },
        { label: `work of the ${doers}`, color: GREY, dash: DASH, t: run.t, y: done },
        ...(takesForce
          ? [{ label: "lost by friction", color: LEGS[4], t: run.t, y: frictionLoss(study) }]
          : []),
      ],
    },
    {
      id: "work",
      title: takesForce ? "Work of each drive" : "Work of each leg",
      unit: energyUnit,
      noise: study.noise("energy"),
      lines: SIX.map((leg) => ({
        label: String(leg),
        name: `w${leg}`,
        leg,
        color: LEGS[leg - 1],
        t: run.t,
        y: work[leg - 1],
      })),
    },
  ];
}

/** How well the numbers can be trusted. */
function qualityFigures(study) {
  const { run } = study;
  return [
    {
      id: "drift",
      title: "Drift of the constraints",
      logable: true,
      note: "Largest violation of the six orthonormality conditions (1.2) before each projection.",
      unit: "1",
      noise: study.noise("drift"),
      lines: [{ label: "drift", color: AXES[2], t: run.t, y: run.column("drift") }],
    },
    {
      id: "condition",
      title: "Condition number of the leg Jacobian",
      logable: true,
      note: "1 is best; 10⁸ counts as singular.",
      unit: "1",
      lines: [{ label: "condition", color: AXES[2], t: run.t, y: run.column("condition") }],
    },
  ];
}

/** Curves of one study, in order. */
export function figuresOf(study) {
  if (!study.run.rows) return [];
  return [
    ...(study.isPaper ? [figure3(study), figure4([study])] : []),
    ...legFigures(study),
    ...topFigures(study),
    ...energyFigures(study),
    ...qualityFigures(study),
  ];
}

/** One line for each study, in the study's colour. */
const linesOf = (studies, make) =>
  studies.map((study) => ({
    label: study.label,
    name: `study-${study.index}`,
    color: studyColor(study.index),
    width: 1.75,
    t: study.run.t,
    y: make(study),
  }));

/** In each row the greatest or least force of the six legs. */
const extremeForce = (study, pick) => {
  const columns = SIX.map((leg) => study.run.column(`f${leg}`));
  return columns[0].map((_, row) => pick(...columns.map((column) => column[row])));
};

const leastNoise = (studies, name) => Math.min(...studies.map((study) => study.noise(name)));

/** How far each study is from its program. */
function deviationsOfAll(shown) {
  const [first] = shown;
  const lines = (make) => linesOf(shown, make);
  const noise = (name) => leastNoise(shown, name);
  return [
    {
      id: "all-deviation",
      logarithmic: true,
      title: "Deviation of the position",
      note: "Distance of the top frame's origin from the program.",
      logable: true,
      unit: first.run.unit("ex"),
      noise: noise("ex"),
      lines: lines(({ run }) => magnitude(run.column("ex"), run.column("ey"), run.column("ez"))),
    },
    {
      id: "all-angle",
      logarithmic: true,
      title: "Deviation of the angles",
      note: "Root of the sum of squares of roll, pitch and yaw.",
      logable: true,
      unit: first.run.unit("eroll"),
      noise: noise("eroll"),
      lines: lines(({ run }) =>
        magnitude(run.column("eroll"), run.column("epitch"), run.column("eyaw")),
      ),
    },
  ];
}

/** Height, forces and condition of each study. */
function statesOfAll(shown) {
  const [first] = shown;
  const lines = (make) => linesOf(shown, make);
  const noise = (name) => leastNoise(shown, name);
  return [
    {
      id: "all-height",
      title: "Height of the top",
      unit: first.run.unit("z"),
      noise: noise("z"),
      lines: lines(({ run }) => run.column("z")),
    },
    {
      id: "all-force",
      title: "Greatest leg force",
      note: "The greatest of the six, push positive.",
      unit: first.run.unit("f1"),
      noise: noise("f1"),
      lines: lines((study) => extremeForce(study, Math.max)),
    },
    {
      id: "all-pull",
      title: "Least leg force",
      note: "The least of the six; below zero a leg pulls.",
      unit: first.run.unit("f1"),
      noise: noise("f1"),
      lines: lines((study) => extremeForce(study, Math.min)),
    },
    {
      id: "all-condition",
      title: "Condition number of the leg Jacobian",
      logable: true,
      unit: "1",
      lines: lines(({ run }) => run.column("condition")),
    },
  ];
}

/** Curves of several studies together: what tells them apart. */
export function figuresOfAll(studies) {
  const shown = studies.filter((study) => study.run.rows);
  if (!shown.length) return [];
  const mixed = shown.some((study) => !study.isLike(shown[0]));
  const turned = shown.some((study) => study.unitOf("angle") !== shown[0].unitOf("angle"));
  const paper = shown.filter((study) => study.isPaper);
  const figures = [
    ...(paper.length > 1 ? [{ ...figure4(paper), wide: true }] : []),
    ...deviationsOfAll(shown),
    ...statesOfAll(shown),
  ];
  // where units differ, only the shapes can be compared, and the figure says so
  return mixed
    ? figures.map((figure) =>
        figure.unit === "1" || (!turned && figure.unit === shown[0].unitOf("angle"))
          ? figure
          : { ...figure, unit: "", note: joined(figure.note, "Each study in its own units.") },
      )
    : figures;
}
