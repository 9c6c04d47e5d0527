// The numbers: how the run ended, peaks of each leg, the machine, stability, the study's text, the version.
import { multiplierCircle } from "./circle.js";
import { LEGS } from "./color.js";
import { element } from "./dom.js";
import { amount, causeWords, known, number, unit, unitAfter } from "./format.js";
import { modesAtRest, multipliersBySize, thresholdsOf, verdictOf } from "./stability.js";

/** A table with headings; cells are text or nodes. */
function table(caption, headings, rows, attributes = {}) {
  return element(
    "div",
    { class: "scroll", tabindex: "0", role: "region", "aria-label": caption },
    element(
      "table",
      attributes,
      element("caption", {}, caption),
      element(
        "thead",
        {},
        element(
          "tr",
          {},
          headings.map((heading) => element("th", { scope: "col" }, heading)),
        ),
      ),
      element(
        "tbody",
        {},
        rows.map((row) =>
          element(
            "tr",
            {},
            row.map((cell, column) =>
              column ? element("td", {}, cell) : element("th", { scope: "row" }, cell),
            ),
          ),
        ),
      ),
    ),
  );
}

const legName = (leg) =>
  element("span", { class: "leg-name", style: { "--leg": LEGS[leg] } }, String(leg + 1));
const withUnit = (words, unitText) => (unit(unitText) ? `${words} [${unit(unitText)}]` : words);
const list = (values, digits = 5) => values.map((value) => number(value, digits)).join(", ");

const factList = (pairs) =>
  element(
    "dl",
    { class: "fact-list" },
    pairs
      .filter(Boolean)
      .map(([term, ...values]) => [element("dt", {}, term), element("dd", {}, ...values)]),
  );

const facts = (title, pairs, testid) =>
  element(
    "section",
    { class: "facts", "data-testid": testid },
    element("h3", {}, title),
    factList(pairs),
  );

/** Errors of a run at their largest, over all of it and at the loop's own frequencies, are this many times those at a moment. */
const PEAK_NOISE = 10;

/** Peaks of the six legs, of a summary as the command prints it. @param program whether they are the program's. */
function legTable(study, summary, caption, testid, program) {
  const units = (name) => study.unit(name);
  const noise = (name) => PEAK_NOISE * study.noise(name, program);
  const energy = study.unitOf("energy");
  const peak = ([least, greatest]) => Math.max(Math.abs(least), Math.abs(greatest));
  const limited = summary.legs.some(
    (leg) => leg.stroke_used !== null && leg.stroke_used !== undefined,
  );
  const headings = [
    "leg",
    withUnit("length, least", units("l1")),
    "greatest",
    withUnit("peak rate", units("dl1")),
    withUnit("force, least", units("f1")),
    "greatest",
    "peak",
    "RMS",
    withUnit("power, least", units("p1")),
    "greatest",
    withUnit("energy", energy),
    "swing, base [°]",
    "top",
    limited && "stroke used [%]",
  ].filter(Boolean);
  const stroke = limited ? study.machine.limits.length[1] - study.machine.limits.length[0] : NaN;
  const rows = summary.legs.map((leg, index) => [
    legName(index),
    ...[
      [leg.length[0], "l1"],
      [leg.length[1], "l1"],
      [leg.speed, "dl1"],
      [leg.force[0], "f1"],
      [leg.force[1], "f1"],
      [peak(leg.force), "f1"],
      [leg.rms_force, "f1"],
      [leg.power[0], "p1"],
      [leg.power[1], "p1"],
      [leg.energy, "energy"],
      [leg.swing?.base, "roll"],
      [leg.swing?.top, "roll"],
    ].map(([value, name]) => known(value, noise(name))),
    ...(limited ? [known(100 * leg.stroke_used, (100 * noise("l1")) / stroke, 3)] : []),
  ]);
  return table(caption, headings, rows, { class: "legs", "data-testid": testid });
}

function endFacts(study) {
  const { end, simulate, simulation } = study;
  const time = unitAfter(study.unit("t"));
  return facts(
    "The run",
    [
      [
        "end",
        study.complete
          ? `the whole duration, t = ${number(end.time, 6)}${time}`
          : `${causeWords(end.status)} at t = ${number(end.time, 9)}${time}`,
      ],
      !study.complete && ["why", end.message],
      simulate?.deviation && [
        "greatest deviation",
        `${study.within(simulate.deviation.position, "ex")}${unitAfter(study.unit("ex"))} from the program, `,
        `${study.within(simulate.deviation.angle, "eroll")}${unitAfter(study.unitOf("angle"))} of angle`,
      ],
      simulate && ["drift of the constraints", `at most ${number(simulate.drift, 3)}`],
      simulate && ["condition", `at most ${number(simulate.condition, 5)}`],
      ["rows", `${study.run.rows}, one each ${number(simulation.output_step, 6)}${time}`],
      ["method", simulation.method],
      [
        "feed-forward",
        study.control.feedforward ? `the program's forces${exceptFor(study.machine.ignored)}` : "none",
      ],
      ["stiffness G", same(study.control.stiffness), unitAfter(study.gainUnit(0))],
      ["damping D", same(study.control.damping), unitAfter(study.gainUnit(1))],
    ],
    "end-facts",
  );
}

const exceptFor = (ignored) => (ignored ? ` except for ${ignored}` : "");

const sum = (values) => values.reduce((total, value) => total + value, 0);

const same = (six) => (six.every((value) => value === six[0]) ? number(six[0], 6) : list(six));

/** "0.25 to 0.4", "±80", "none"; one number for a limit of one side. */
function rangeText(limit) {
  if (!Array.isArray(limit)) return limit === null ? "none" : number(limit, 6);
  const [low, high] = limit;
  if (low === null || high === null) return "none";
  return low === -high ? `±${number(high, 6)}` : `${number(low, 6)} to ${number(high, 6)}`;
}

const isGiven = (limit) => (Array.isArray(limit) ? limit[1] !== null : limit !== null);

/** Limits of the legs besides those that all legs share, and limits of the platform: [name, text]. */
function limitFacts(study) {
  const { machine } = study;
  const { legs, platform } = machine.all_limits;
  const { length, speed, force } = machine.limits;
  const names = ["surge", "sway", "heave", "roll", "pitch", "yaw"];
  const of = (name, six, column) => {
    if (!six.some(isGiven)) return null;
    const texts = six.map(rangeText);
    const text = texts.every((one) => one === texts[0]) ? texts[0] : texts.join(", ");
    return [name, text, unitAfter(study.unit(column))];
  };
  const components = (six, what, columns) =>
    six.map((pair, c) =>
      isGiven(pair)
        ? [`${names[c]}${what}`, rangeText(pair), unitAfter(study.unit(columns[c < 3 ? 0 : 1]))]
        : null,
    );
  return [
    !length?.[1] && of("length limits", legs.length, "l1"),
    !speed && of("greatest speed", legs.speed, "dl1"),
    !force && of("force limits", legs.force, "f1"),
    of("greatest acceleration of a leg", legs.acceleration, "ax"),
    of("swing at the base", legs.base_swing, "roll"),
    of("swing at the top", legs.top_swing, "roll"),
    ...components(platform.pose, "", ["x", "roll"]),
    ...components(platform.speed, " velocity", ["vx", "wx"]),
    ...components(platform.acceleration, " acceleration", ["ax", "alx"]),
  ].filter(Boolean);
}

function machineFacts(study) {
  const { machine } = study;
  const metre = unitAfter(study.unit("l1"));
  const { length, speed, force } = machine.limits ?? {};
  return facts(
    "The machine",
    [
      ["height at home", `${number(machine.height, 6)}${metre}`],
      ["base radius", `${number(machine.base_radius, 6)}${metre}`],
      ["leg length at home", same(machine.home_length), metre],
      ["condition at home", number(machine.home_condition, 6)],
      [
        "load",
        `mass ${number(machine.mass, 6)}${unitAfter(study.unitOf("mass"))}, `,
        `centre of mass ${list(machine.center_of_mass)}${metre}`,
      ],
      [
        "inertia about it",
        element("span", { class: "matrix" }, machine.inertia.map((row) => list(row)).join("\n")),
        unitAfter(study.unitOf("inertia")),
      ],
      machine.legs_have_mass && [
        "mass of the legs",
        number(sum(machine.cylinder.mass) + sum(machine.piston.mass), 6),
        unitAfter(study.unitOf("mass")),
      ],
      machine.externals > 0 && ["external loads", `${machine.externals}; see the study file`],
      ["gravity", list(machine.gravity, 6), unitAfter(study.unitOf("acceleration"))],
      length &&
        (length[0] || length[1]) && [
          "length limits",
          `${number(length[0], 6)} to ${number(length[1], 6)}${metre}`,
        ],
      speed && ["greatest speed", `${number(speed, 6)}${unitAfter(study.unit("dl1"))}`],
      force && ["greatest force", `${number(force, 6)}${unitAfter(study.unit("f1"))}`],
      ...limitFacts(study),
      !machine.legs_have_mass && [
        "legs",
        "massless in this model: add the forces of their own weight and inertia",
      ],
    ],
    "machine-facts",
  );
}

function jointTable(study) {
  const { machine } = study;
  const metre = study.unit("l1");
  return table(
    "Joints",
    ["leg", withUnit("base x", metre), "y", "z", withUnit("top x, top frame", metre), "y", "z"],
    machine.base.map((base, leg) => [
      legName(leg),
      ...[...base, ...machine.top[leg]].map((value) => number(value, 6)),
    ]),
    { class: "joints" },
  );
}

/** What the eigenvalues and multipliers say, in a list of facts. */
function stabilityFacts(study) {
  const { stability } = study;
  const time = unitAfter(study.unit("t"));
  const periodic = stability.multipliers?.length > 0;
  const about = periodic ? "about the program" : "at rest";
  const verdict = {
    stays: `No mode grows ${about} under this feedback.`,
    drifts: `No mode grows ${about} under this feedback, but a velocity in ${stability.drifts?.join(", ")} \
stays for ever: the top drifts away.`,
    grows: `Some mode grows ${about} under this feedback.`,
  }[verdictOf(stability)];
  return factList([
    ["verdict", element("strong", { class: stability.stable ? "good" : "bad" }, verdict)],
    present(stability.growth_rate) && [
      "greatest growth rate at rest",
      `${number(stability.growth_rate, 5)}${time ? " 1/s" : ""}`,
    ],
    periodic && ["period of the program", amount(stability.period, study.unit("t"), 8)],
    periodic && ["growth each period", `× ${number(stability.growth_per_period, 5)}`],
    !periodic && [
      "Floquet multipliers",
      `none: ${study.stability_message || "the program has no period"}`,
    ],
  ]);
}

/** A picture and a table of the multipliers, or an empty list without multipliers. */
function multiplierViews(stability) {
  const multipliers = multipliersBySize(stability);
  if (!multipliers.length) return [];
  return [
    element(
      "figure",
      { class: "circle" },
      multiplierCircle(stability.multipliers),
      element(
        "figcaption",
        {},
        "Floquet multipliers and the unit circle, with a logarithmic scale outside it. ◆ grows, ● does not.",
      ),
    ),
    table(
      "Floquet multipliers, by size",
      ["mode", "|μ|"],
      multipliers.map(({ mode, size }) => [mode, number(size, 6)]),
      { "data-testid": "multipliers" },
    ),
  ];
}

function stabilitySection(study) {
  const { stability } = study;
  const section = element(
    "section",
    { class: "stability", "data-testid": "stability" },
    element("h3", {}, "Stability"),
  );
  if (!stability) {
    section.append(
      element("p", { class: "note" }, study.stability_message || "Not computed for this study."),
    );
    return section;
  }
  const unitText = unitAfter(study.gainUnit(0)).trim();
  const rate = unit(study.unitOf("rate")) ? ` [${unit(study.unitOf("rate"))}]` : "";
  const thresholds = thresholdsOf(stability);
  section.append(
    stabilityFacts(study),
    element(
      "div",
      { class: "beside" },
      ...multiplierViews(stability),
      thresholds.length > 0 &&
        table(
          "Least stiffness that holds at rest",
          ["mode", `G${unitText ? ` [${unitText}]` : ""}`],
          thresholds.map(({ mode, stiffness }) => [mode, number(stiffness, 6)]),
          { "data-testid": "thresholds" },
        ),
      table(
        "Modes at rest under this feedback",
        ["mode", `growth rate${rate}`, `angular frequency${rate}`],
        modesAtRest(stability).map(({ mode, rate: growth, frequency }) => [
          mode,
          number(growth, 5),
          number(frequency, 5),
        ]),
      ),
    ),
  );
  return section;
}

const present = (value) => value !== null && value !== undefined;

/** Where a line's comment begins: a # at the start or after a space, outside quotes; the line's length if it has no comment. */
function commentStart(line) {
  let quote = "";
  for (let index = 0; index < line.length; index++) {
    const character = line[index];
    if (quote) quote = character === quote ? "" : quote;
    else if (character === '"' || character === "'") quote = character;
    else if (character === "#" && (index === 0 || /\s/.test(line[index - 1]))) return index;
  }
  return line.length;
}

/** The study's file, comments set back. */
function studyText(study) {
  const code = element("code", {});
  const lines = study.text.split("\n");
  for (const line of lines) {
    const start = commentStart(line);
    code.append(
      line.slice(0, start),
      element("span", { class: "comment" }, line.slice(start)),
      "\n",
    );
  }
  return element(
    "details",
    { class: "study-text", open: lines.length < 60 },
    element("summary", {}, `The study file: ${study.name}`),
    element("pre", { "data-testid": "study-text", tabindex: "0" }, code),
  );
}

/** All numbers of a study into a host. */
export function showNumbers(host, study) {
  host.replaceChildren(
    element("div", { class: "columns" }, endFacts(study), machineFacts(study)),
    stabilitySection(study),
    study.simulate?.legs && study.run.rows
      ? legTable(study, study.simulate, "The legs in the run", "legs-run", false)
      : "",
    study.forces?.legs && study.plan.rows
      ? legTable(study, study.forces, "The legs along the program", "legs-program", true)
      : "",
    jointTable(study),
    studyText(study),
  );
}

/** A table that compares studies, a row each. */
export function compareNumbers(host, studies) {
  const [first] = studies;
  // where studies are in different units, each number has its own
  const mixed = studies.some((study) => !study.isLike(first));
  const heading = (words, unitText) => (mixed ? words : withUnit(words, unitText));
  const own = (study, text, unitText) => (mixed ? `${text}${unitAfter(unitText)}` : text);
  const rows = studies.map((study) => [
    study.label,
    study.complete
      ? "complete"
      : `${causeWords(study.end.status)}, t = ${number(study.end.time, 6)}${unitAfter(study.unit("t"))}`,
    study.control.feedforward ? "yes" : "no",
    own(study, same(study.control.stiffness), study.gainUnit(0)),
    own(study, same(study.control.damping), study.gainUnit(1)),
    own(study, study.within(study.simulate?.deviation?.position, "ex", 4), study.unit("ex")),
    study.within(study.simulate?.deviation?.angle, "eroll", 4),
    own(
      study,
      study.say(Math.max(...(study.simulate?.legs ?? []).map((leg) => leg.force[1])), "f1", 4),
      study.unit("f1"),
    ),
    number(study.simulate?.condition, 4),
  ]);
  host.replaceChildren(
    table(
      "The studies beside each other",
      [
        "study",
        "end",
        "feed-forward",
        heading("G", first.gainUnit(0)),
        heading("D", first.gainUnit(1)),
        heading("greatest deviation", first.unit("ex")),
        "of angle [°]",
        heading("greatest force", first.unit("f1")),
        "condition",
      ],
      rows,
      { "data-testid": "comparison" },
    ),
  );
}
