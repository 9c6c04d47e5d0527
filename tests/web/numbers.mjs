// Every number of the page against values that are computed here from the study file alone: the JSON that `gough report` writes,
// and what the page shows beside each label, with its unit, in SI and dimensionless. All numbers of the study differ, so that none
// can stand for another.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import test, { after } from "node:test";
import { inflateSync } from "node:zlib";
import { unpacked } from "../../web/src/packed.js";
import {
  byName,
  closeAll,
  example,
  factsOf,
  gough,
  open,
  pictureDrawn,
  read,
  report,
  scrubTo,
  study,
  table,
} from "./browser.mjs";

after(closeAll);

/** Pages are read here, not looked at: without the picture of the machine they open at once. */
const plain = { webgl: false };

// ---- the study ----

const SIX = [0, 1, 2, 3, 4, 5];
const NUMBERS = {
  base: [
    [0.49, 0.09, 0.011],
    [-0.19, 0.47, -0.013],
    [-0.33, 0.39, 0.017],
    [-0.31, -0.37, 0.019],
    [-0.21, -0.43, -0.023],
    [0.51, -0.11, 0.029],
  ],
  top: [
    [0.15, 0.26, 0.003],
    [0.12, 0.27, -0.005],
    [-0.28, 0.031, 0.007],
    [-0.29, -0.027, -0.002],
    [0.14, -0.25, 0.004],
    [0.17, -0.24, -0.006],
  ],
  height: 0.617,
  length: [0.432, 0.981],
  speed: 1.37,
  force: 913,
  mass: 23.9,
  center: [0.0131, -0.0172, 0.0813],
  inertia: [
    [0.713, 0.0121, -0.0233],
    [0.0121, 0.829, 0.0344],
    [-0.0233, 0.0344, 0.947],
  ],
  gravity: [0.211, -0.307, -9.71],
  about: [0.0219, 0.0412, 0.1057],
  stiffness: [60100, 61200, 62300, 63400, 64500, 65600],
  damping: [711, 722, 733, 744, 755, 766],
  duration: 2.2,
  outputStep: 0.02,
  tolerance: 3e-11,
};

const MOTION = 'heave: "0.031*sin(3*t)*ramp(t, 1)", surge: "0.023*sin(2*t)*ramp(t, 1)", yaw: "5*sin(4*t)*ramp(t, 1)"';

const text = (units) => `title: Numbers that differ, ${units}
units: ${units}
platform:
  base: {joints: ${JSON.stringify(NUMBERS.base)}}
  top: {joints: ${JSON.stringify(NUMBERS.top)}}
  height: ${NUMBERS.height}
  legs: {length: ${JSON.stringify(NUMBERS.length)}, max_speed: ${NUMBERS.speed}, max_force: ${NUMBERS.force}}
load: {mass: ${NUMBERS.mass}, center_of_mass: ${JSON.stringify(NUMBERS.center)}, inertia: ${JSON.stringify(NUMBERS.inertia)}}
gravity: ${JSON.stringify(NUMBERS.gravity)}
motion: {about: ${JSON.stringify(NUMBERS.about)}, ${MOTION}}
control: {feedforward: none, stiffness: ${JSON.stringify(NUMBERS.stiffness)}, damping: ${JSON.stringify(NUMBERS.damping)}}
simulation: {duration: ${NUMBERS.duration}, output_step: ${NUMBERS.outputStep}, tolerance: ${NUMBERS.tolerance}}
`;

const files = {
  si: study("numbers-si.yaml", text("si")),
  dimensionless: study("numbers-dimensionless.yaml", text("dimensionless")),
};

/** The JSON in a page. */
const dataOf = (file) =>
  JSON.parse(/<script type="application\/json" id="gough-data">(.*?)<\/script>/s.exec(readFileSync(file, "utf8"))[1]);

// ---- what follows from the study ----

const subtract = (a, b) => a.map((value, axis) => value - b[axis]);
const dot = (a, b) => a.reduce((sum, value, axis) => sum + value * b[axis], 0);
const cross = (a, b) => [
  a[1] * b[2] - a[2] * b[1],
  a[2] * b[0] - a[0] * b[2],
  a[0] * b[1] - a[1] * b[0],
];

const legsAtHome = NUMBERS.top.map((top, leg) =>
  subtract([top[0], top[1], top[2] + NUMBERS.height], NUMBERS.base[leg]),
);
const homeLengths = legsAtHome.map((along) => Math.sqrt(dot(along, along)));
const center = [0, 1, 2].map((axis) => NUMBERS.base.reduce((sum, joint) => sum + joint[axis], 0) / 6);
/** The base radius of joints that are listed: their mean distance from their centre. */
const baseRadius =
  NUMBERS.base.reduce((sum, joint) => sum + Math.hypot(...subtract(joint, center)), 0) / 6;

/** Ratio of the singular values of the six rows (n, arm × n / reach), by Jacobi rotations of JᵀJ; the reach is the mean distance of
 *  the top joints from the top frame's origin. */
function homeCondition() {
  const reach = NUMBERS.top.reduce((sum, joint) => sum + Math.hypot(...joint), 0) / 6;
  const rows = legsAtHome.map((along, leg) => {
    const n = along.map((value) => value / homeLengths[leg]);
    return [...n, ...cross(NUMBERS.top[leg], n).map((value) => value / reach)];
  });
  const a = SIX.map((i) => SIX.map((j) => rows.reduce((sum, row) => sum + row[i] * row[j], 0)));
  for (let sweep = 0; sweep < 30; sweep++)
    for (let p = 0; p < 5; p++)
      for (let q = p + 1; q < 6; q++) {
        const angle = 0.5 * Math.atan2(2 * a[p][q], a[q][q] - a[p][p]);
        const [c, s] = [Math.cos(angle), Math.sin(angle)];
        for (const k of SIX) {
          const [x, y] = [a[k][p], a[k][q]];
          [a[k][p], a[k][q]] = [c * x - s * y, s * x + c * y];
        }
        for (const k of SIX) {
          const [x, y] = [a[p][k], a[q][k]];
          [a[p][k], a[q][k]] = [c * x - s * y, s * x + c * y];
        }
      }
  const values = SIX.map((k) => a[k][k]);
  return Math.sqrt(Math.max(...values) / Math.min(...values));
}

const near = (actual, wanted, tolerance, what) =>
  assert.ok(
    Math.abs(actual - wanted) <= tolerance * Math.max(Math.abs(wanted), 1e-300),
    `${what}: ${actual} for ${wanted}`,
  );

/** Units by the name of a column, written out by hand. */
const UNITS = {
  si: [
    [/^t$/, "s"],
    [/^([xyz]|e[xyz]|l\d)$/, "m"],
    [/^(e?(roll|pitch|yaw))$/, "degree"],
    [/^(v[xyz]|dl\d)$/, "m/s"],
    [/^w[xyz]$/, "degree/s"],
    [/^a[xyz]$/, "m/s2"],
    [/^al[xyz]$/, "degree/s2"],
    [/^f\d$/, "N"],
    [/^p\d$/, "W"],
    [/^(condition|drift)$/, "1"],
  ],
  dimensionless: [
    [/^(e?(roll|pitch|yaw)|w[xyz]|al[xyz])$/, "degree"],
    [/./, "1"],
  ],
};
const unitOf = (units, name) => UNITS[units].find(([pattern]) => pattern.test(name))[1];

for (const units of ["si", "dimensionless"]) {
  test(`the page's data are the numbers of the study, ${units}`, () => {
    const [one] = dataOf(report(files[units])).studies;
    const { machine, control, simulation, motion } = one;
    assert.equal(one.units, units);
    assert.deepEqual(machine.base, NUMBERS.base);
    assert.deepEqual(machine.top, NUMBERS.top);
    assert.equal(machine.height, NUMBERS.height);
    assert.equal(machine.mass, NUMBERS.mass);
    assert.deepEqual(machine.center_of_mass, NUMBERS.center);
    assert.deepEqual(machine.inertia, NUMBERS.inertia);
    assert.deepEqual(machine.gravity, NUMBERS.gravity);
    assert.deepEqual(machine.limits, { length: NUMBERS.length, speed: NUMBERS.speed, force: NUMBERS.force });
    assert.deepEqual(motion.about, NUMBERS.about);
    assert.deepEqual(control.stiffness, NUMBERS.stiffness);
    assert.deepEqual(control.damping, NUMBERS.damping);
    assert.equal(control.feedforward, false);
    assert.equal(simulation.duration, NUMBERS.duration);
    assert.equal(simulation.output_step, NUMBERS.outputStep);
    assert.equal(simulation.tolerance, NUMBERS.tolerance);
    assert.equal(simulation.method, "dop853");
    SIX.forEach((leg) => near(machine.home_length[leg], homeLengths[leg], 1e-14, `home length ${leg}`));
    near(machine.base_radius, baseRadius, 1e-14, "base radius");
    near(machine.home_condition, homeCondition(), 1e-9, "condition at home");
    assert.equal(one.end.status, "done");
    near(one.end.time, NUMBERS.duration, 1e-12, "end");
  });

  test(`columns have their units and their numbers, ${units}`, () => {
    const [one] = dataOf(report(files[units])).studies;
    for (const [verb, columns] of [
      ["simulate", one.columns],
      ["forces", one.program],
    ]) {
      const { names, rows } = table(verb, files[units]);
      assert.ok(columns.length >= 19, verb);
      for (const column of columns) {
        const { name, unit } = column;
        assert.equal(unit, unitOf(units, name), `${verb} ${name}`);
        const values = unpacked(column, inflateSync);
        assert.equal(values.length, rows.length);
        values.forEach((value, row) => assert.equal(value, rows[row][names.indexOf(name)], name));
      }
    }
  });
}

// ---- what the page shows ----

/** All numbers in a text, in order. */
const numbersIn = (words) =>
  (words.replaceAll("·10", "·10").match(/[−-]?\d[\d.]*(·10[⁻⁰¹²³⁴⁵⁶⁷⁸⁹]+)?/g) ?? []).map(read);

/** A fact has these numbers, to the digits it shows, and ends in this unit. */
function expectFact(facts, term, wanted, unit, digits = 5) {
  assert.ok(term in facts, `no ${term} in ${Object.keys(facts)}`);
  const found = numbersIn(facts[term].replace(/[a-z]²/g, ""));
  assert.equal(found.length, wanted.length, `${term}: ${facts[term]}`);
  wanted.forEach((value, index) => near(found[index], value, 0.51 * 10 ** (1 - digits), `${term}: ${facts[term]}`));
  const after = facts[term].replace(/^.*[\d⁰¹²³⁴⁵⁶⁷⁸⁹]/s, "").replace(/^(m²|s²)?/, "");
  const tail = facts[term].endsWith(unit ? ` ${unit}` : "");
  assert.ok(unit ? tail : after === "", `${term}: ${facts[term]} is not in '${unit}'`);
}

const CURVES = {
  forces: ["N", "f1"],
  lengths: ["m", "l1"],
  rates: ["m/s", "dl1"],
  power: ["W", "p1"],
  position: ["m", "x"],
  orientation: ["°", "roll"],
  deviation: ["m", "ex"],
  "deviation-angle": ["°", "eroll"],
  energy: ["J", null],
  work: ["J", null],
  drift: ["", null],
  condition: ["", null],
};

/** In a row the program's forces are those of the command: as numbers of the curve's dashed lines, and as marks on the bars, where
 *  forces of run and program have one scale and one zero. */
async function expectProgram(page, file, row) {
  await page.getByRole("button", { name: "program", exact: true }).click();
  await byName(page, "curve-forces").scrollIntoViewIfNeeded();
  await pictureDrawn(page);
  const [run, program] = ["simulate", "forces"].map((verb) => table(verb, file));
  const at = ({ names, rows }, name) => rows[row][names.indexOf(name)];
  const places = await page.locator(".bars li").evaluateAll((lines) =>
    lines.map((line) => {
      const [bar, plan] = [line.querySelector(".bar"), line.querySelector(".plan")].map(({ style }) =>
        [style.left, style.width].map((text) => parseFloat(text) || 0),
      );
      const [red, , blue] = line.querySelector(".bar").style.background.match(/\d+/g).map(Number);
      return { from: bar[0] - 50, to: bar[0] + bar[1] - 50, plan: plan[0] - 50, warmth: red - blue };
    }),
  );
  const scale = places[0].plan / at(program, "f1");
  assert.ok(scale > 0);
  places.forEach(({ from, to, plan, warmth }, leg) => {
    const [force, wanted] = [at(run, `f${leg + 1}`), at(program, `f${leg + 1}`)];
    near(plan, scale * wanted, 1e-4, `mark of leg ${leg + 1}`);
    near(force > 0 ? to : from, scale * force, 1e-4, `bar of leg ${leg + 1}`);
    assert.ok(warmth * force > 0, `push is warm, pull is cold: leg ${leg + 1}`);
  });
  for (const leg of [1, 2, 3, 4, 5, 6]) {
    const shown = await byName(page, `value-forces-program-f${leg}`).textContent();
    near(read(shown), at(program, `f${leg}`), 1e-4, `program's force of leg ${leg}`);
  }
}

for (const units of ["si", "dimensionless"]) {
  const si = units === "si";
  const only = (unit) => (si ? unit : "");

  test(`beside each label stands its number with its unit, ${units}`, async () => {
    const page = await open(report(files[units]), plain);
    const machine = await factsOf(page, "machine-facts");
    expectFact(machine, "height at home", [NUMBERS.height], only("m"));
    expectFact(machine, "base radius", [baseRadius], only("m"));
    expectFact(machine, "leg length at home", homeLengths, only("m"));
    expectFact(machine, "condition at home", [homeCondition()], "");
    expectFact(machine, "load", [NUMBERS.mass, ...NUMBERS.center], only("m"));
    if (si) assert.match(machine.load, / kg, /);
    expectFact(machine, "inertia about it", NUMBERS.inertia.flat(), only("kg m²"));
    expectFact(machine, "gravity", NUMBERS.gravity, only("m/s²"));
    expectFact(machine, "length limits", NUMBERS.length, only("m"));
    expectFact(machine, "greatest speed", [NUMBERS.speed], only("m/s"));
    expectFact(machine, "greatest force", [NUMBERS.force], only("N"));
    const run = await factsOf(page, "end-facts");
    expectFact(run, "end", [NUMBERS.duration], only("s"));
    expectFact(run, "rows", [111, NUMBERS.outputStep], only("s"));
    expectFact(run, "stiffness G", NUMBERS.stiffness, only("N/m"));
    expectFact(run, "damping D", NUMBERS.damping, only("N s/m"));
    assert.equal(run["feed-forward"], "none");
    assert.equal(run.method, "dop853");
    const joints = await page.locator("table.joints tbody tr").evaluateAll((lines) =>
      lines.map((line) => [...line.querySelectorAll("td")].map((cell) => cell.textContent)),
    );
    joints.forEach((cells, leg) =>
      [...NUMBERS.base[leg], ...NUMBERS.top[leg]].forEach((value, k) =>
        near(read(cells[k]), value, 1e-5, `joint ${leg + 1}, ${k}`),
      ),
    );
    assert.equal(joints.length, 6);

    // greatest deviation: from the table
    const { names, rows } = table("simulate", files[units]);
    const column = (name) => rows.map((row) => row[names.indexOf(name)]);
    // what the summary has of the motion between rows is in a table with twenty times the rows
    const fine = table("simulate", files[units], "--set", `simulation.output_step=${NUMBERS.outputStep / 20}`);
    const motion = (name) => fine.rows.map((row) => row[fine.names.indexOf(name)]);
    const size = (parts) => {
      const columns = parts.map(motion);
      return Math.max(...columns[0].map((_, row) => Math.hypot(...columns.map((part) => part[row]))));
    };
    const [off, angle] = [size(["ex", "ey", "ez"]), size(["eroll", "epitch", "eyaw"])];
    const shown = run["greatest deviation"].split(",");
    near(read(shown[0]), off, 1e-4, run["greatest deviation"]);
    assert.ok(!si || / m from/.test(shown[0]), shown[0]);
    // rotation angle and the size of three small angles are equal to second order
    near(read(shown[1]), angle, 2e-2, run["greatest deviation"]);
    assert.match(shown[1], / ° /);

    // curves: unit by its heading, values of a row by their keys
    await scrubTo(page, 77);
    for (const [id, [unit]] of Object.entries(CURVES)) {
      const card = byName(page, `curve-${id}`);
      await card.scrollIntoViewIfNeeded();
      const wanted = si || unit === "°" ? unit : "";
      const said = await card.locator("figcaption > .unit").allTextContents();
      assert.deepEqual(said, wanted ? [wanted] : [], id);
    }
    for (const id of ["forces", "lengths", "rates", "power"])
      for (const leg of [1, 2, 3, 4, 5, 6]) {
        const name = `${CURVES[id][1].slice(0, -1)}${leg}`;
        await byName(page, `curve-${id}`).scrollIntoViewIfNeeded();
        await pictureDrawn(page);
        near(read(await byName(page, `value-${id}-${name}`).textContent()), column(name)[77], 1e-4, name);
      }
    for (const name of ["x", "y", "z"]) {
      near(read(await byName(page, `pose-${name}`).textContent()), column(name)[77], 1e-2, name);
      await byName(page, "curve-position").scrollIntoViewIfNeeded();
      await pictureDrawn(page);
      const place = column(name)[77] - (name === "z" ? NUMBERS.height : 0);
      assert.ok(Math.abs(read(await byName(page, `value-position-${name}`).textContent()) - place) <= 1e-4, name);
    }
    await expectProgram(page, files[units], 77);
    for (const [id, limits] of [
      ["forces", [NUMBERS.force, -NUMBERS.force]],
      ["rates", [NUMBERS.speed, -NUMBERS.speed]],
      ["lengths", NUMBERS.length],
    ]) {
      const words = await byName(page, `limits-${id}`).getAttribute("title");
      assert.deepEqual(numbersIn(words), limits, words);
    }
    assert.deepEqual(
      (await page.locator("table.pose th[scope=row]").allTextContents()).map((words) =>
        words.replace(/^(roll|pitch|yaw|x|y|z)/, ""),
      ),
      si ? ["m", "m", "m", "°", "°", "°"] : ["", "", "", "°", "°", "°"],
    );
    const heads = await byName(page, "legs-run").locator("thead th").allTextContents();
    const brackets = heads.map((words) => /\[(.*)\]/.exec(words)?.[1] ?? "").filter(Boolean);
    assert.deepEqual(brackets, si ? ["m", "m/s", "N", "W", "J", "°", "%"] : ["°", "%"]);
    const cells = await byName(page, "legs-run").locator("tbody tr").evaluateAll((lines) =>
      lines.map((line) => [...line.querySelectorAll("td")].map((cell) => cell.textContent)),
    );
    const { legs } = JSON.parse(gough("simulate", files[units], "--json", "-q"));
    const glance = await page.locator(".glance dd").allTextContents();
    const ends = (name) => [Math.min, Math.max].map((pick) => pick(...legs.flatMap((leg) => leg[name])));
    for (const [k, name] of [[2, "force"], [3, "length"]])
      numbersIn(glance[k]).forEach((value, end) => near(value, ends(name)[end], 1e-3, glance[k]));
    SIX.forEach((leg) => {
      const found = cells[leg].map(read);
      near(found[7], legs[leg].power[0], 1e-4, "least power");
      near(found[10], legs[leg].swing.base, 1e-4, "swing of the base");
      near(found[11], legs[leg].swing.top, 1e-4, "swing of the top");
      const [l, f, p, dl] = ["l", "f", "p", "dl"].map((name) => motion(`${name}${leg + 1}`));
      const peaks = [Math.min(...l), Math.max(...l), Math.max(...dl.map(Math.abs)), Math.min(...f), Math.max(...f)];
      peaks.forEach((value, k) => near(found[k], value, 1e-3, `${heads[k + 1]} of leg ${leg + 1}`));
      near(found[6], Math.sqrt(f.reduce((sum, value) => sum + value * value, 0) / f.length), 1e-3, "RMS");
      near(found[8], Math.max(...p), 1e-4, "power");
      const energy = p.reduce((sum, value, row) => sum + (row ? 0.5 * (NUMBERS.outputStep / 20) * (value + p[row - 1]) : 0), 0);
      assert.ok(Math.abs(found[9] - energy) <= 1e-4 * Math.max(...p.map(Math.abs)), `energy ${found[9]} for ${energy}`);
      const stroke = (100 * (peaks[1] - peaks[0])) / (NUMBERS.length[1] - NUMBERS.length[0]);
      near(found[12], stroke, 5e-3, "stroke used"); // of three digits
    });
    assert.deepEqual(page.said, []);
    await page.close();
  });
}

test("studies in different units: each number has its own unit", async () => {
  const page = await open(report(files.si, files.dimensionless), plain);
  const heads = await byName(page, "comparison").locator("thead th").allTextContents();
  for (const words of heads) assert.ok(!/\[(m|N|s)/.test(words), words);
  const [si, bare] = await byName(page, "comparison").locator("tbody tr").evaluateAll((lines) =>
    lines.map((line) => [...line.querySelectorAll("td")].map((cell) => cell.textContent)),
  );
  assert.match(si[2], / N\/m$/);
  assert.match(si[3], / N s\/m$/);
  assert.match(si[4], / m$/);
  assert.match(si[6], / N$/);
  for (const cell of [bare[2], bare[3], bare[4], bare[6]]) assert.match(cell, /[\d⁰¹²³⁴⁵⁶⁷⁸⁹]$/);
  await page.close();
});

// ---- axes, colours, the end of a run, noise ----

const still = () =>
  study("still.yaml", readFileSync(example("own-machine"), "utf8").replace(/^motion:\n( .*\n)+/m, ""));

/** What a curve writes at its axes when it is drawn: {text, left, value}, the value being that of the ordinate at its place. */
const writtenBy = async (page, id) => {
  await byName(page, `curve-${id}`).scrollIntoViewIfNeeded();
  await pictureDrawn(page);
  return page.evaluate(async (name) => {
    const curve = window.goughPage.section.curves.find(({ spec }) => spec.id === name);
    const written = [];
    const { fillText } = CanvasRenderingContext2D.prototype;
    CanvasRenderingContext2D.prototype.fillText = function (text, x, y) {
      const width = this.measureText(text).width;
      const start = { right: x - width, center: x - width / 2 }[this.textAlign] ?? x;
      const transform = this.getTransform();
      written.push({ text, align: this.textAlign, left: start + transform.e, y });
      fillText.call(this, text, x, y);
    };
    curve.rebuild();
    await new Promise((done) => setTimeout(done, 50));
    CanvasRenderingContext2D.prototype.fillText = fillText;
    const { plot } = curve;
    return written
      .filter(({ text, align }) => text && align === "right")
      .map(({ text, left, y }) => ({
        text,
        left,
        value: plot.posToVal((y - plot.bbox.top) / devicePixelRatio, "y"),
        span: plot.scales.y.max - plot.scales.y.min,
        logarithmic: plot.scales.y.distr === 3,
      }));
  }, id);
};

test("numbers at axes are whole, and are those of their places", async () => {
  const offset = study("offset.yaml", text("si").replace(MOTION, 'heave: "3e-6*sin(3*t)*ramp(t, 1)"'));
  for (const file of [files.si, files.dimensionless, still(), offset]) {
    const page = await open(report(file), plain);
    for (const id of Object.keys(CURVES)) {
      const written = await writtenBy(page, id);
      assert.ok(written.length >= 2, `${id}: ${written.length} numbers`);
      const texts = written.map(({ text }) => text);
      assert.equal(new Set(texts).size, texts.length, `${id}: ${texts}`);
      for (const { text, left, value, span, logarithmic } of written) {
        assert.ok(left >= 0, `${id}: ${text} is cut by ${-left} pixels`);
        const tolerance = logarithmic ? 0.02 * value : 0.005 * span;
        assert.ok(Math.abs(read(text) - value) <= tolerance, `${id}: ${text} at ${value}`);
      }
    }
    assert.deepEqual(page.said, []);
    await page.close();
  }
});

test("the noise of a machine at rest reads as nothing", async () => {
  const page = await open(report(still()), plain);
  await scrubTo(page, 321);
  for (const name of ["x", "y", "z", "roll", "pitch", "yaw"])
    assert.equal(await byName(page, `off-${name}`).textContent(), "0", name);
  for (const [id, names] of [
    ["deviation", ["ex", "ey", "ez"]],
    ["deviation-angle", ["eroll", "epitch", "eyaw"]],
    ["rates", ["dl1", "dl6"]],
    ["power", ["p1", "p6"]],
  ]) {
    await writtenBy(page, id);
    for (const name of names)
      assert.equal(await byName(page, `value-${id}-${name}`).textContent(), "0", name);
    const { range, noise } = await page.evaluate((wanted) => {
      const curve = window.goughPage.section.curves.find(({ spec }) => spec.id === wanted);
      const { min, max } = curve.plot.scales.y;
      return { range: max - min, noise: curve.noise };
    }, id);
    assert.ok(noise > 0 && range >= 99 * noise, `${id}: ${range}`);
  }
  for (const [name, still] of [
    ["legs-run", [2, 7, 8, 9, 10, 11, 12]],
    ["legs-program", [2, 7, 8, 9, 10, 11, 12]],
  ]) {
    const lines = await byName(page, name).locator("tbody tr").evaluateAll((rows) =>
      rows.map((row) => [...row.querySelectorAll("td")].map((cell) => cell.textContent)),
    );
    assert.equal(lines.length, 6);
    // rate, power, energy, swing and stroke
    for (const cells of lines) assert.deepEqual(still.map((k) => cells[k]), still.map(() => "0"), name);
  }
  // and a force that is there is not lost: six times the force of a leg hold the weight
  near(read(await byName(page, "force-1").textContent()), 11.400042, 1e-4, "force");
  await page.close();
});

test("after the end of a run its numbers do not stand as current, and the clock never goes below 0", async () => {
  const page = await open(report(example("own-machine"), "--set", "platform.legs.max_force=15"), plain);
  const [end, step] = await page.evaluate(() => {
    const [one] = window.goughPage.studies;
    return [one.end.time, one.simulation.output_step];
  });
  assert.ok(end > 1 && end < 7, `${end}`);
  const cells = [
    ...["x", "y", "z", "roll", "pitch", "yaw"].flatMap((name) => [`pose-${name}`, `off-${name}`]),
    ...[1, 2, 3, 4, 5, 6].flatMap((leg) => [`force-${leg}`, `value-forces-f${leg}`]),
  ];
  await scrubTo(page, Math.floor(end / step));
  assert.ok(await byName(page, "over").isHidden());
  for (const name of cells) assert.notEqual(await byName(page, name).textContent(), "–", name);
  await scrubTo(page, Math.ceil(end / step) + 10);
  assert.match(await byName(page, "over").textContent(), /ended at t = [\d.]+ s/);
  assert.ok(await byName(page, "over").isVisible());
  for (const name of cells) assert.equal(await byName(page, name).textContent(), "–", name);
  const clock = await page.evaluate(() => {
    const { player } = window.goughPage;
    player.seek(0);
    player.play();
    player.advance(-0.3);
    window.goughPage.show();
    return document.getElementById("clock").textContent;
  });
  assert.equal(clock, "t = 0.00 s");
  await page.close();
});

test("legs and axes have the same colours in the page and in figures", async () => {
  const page = await open(report(example("all-six")), plain);
  const chips = (id) =>
    byName(page, `curve-${id}`)
      .locator(".chip:not(.plan)")
      .evaluateAll((nodes) => {
        const style = getComputedStyle(document.documentElement);
        return nodes.map((node) =>
          style.getPropertyValue(/--\w+/.exec(node.style.getPropertyValue("--mark"))[0]).trim(),
        );
      });
  const run = join(process.env.SCRATCH, "all-six.csv");
  gough("simulate", example("all-six"), "-q", "-o", run);
  const drawn = (figure) => {
    const picture = join(process.env.SCRATCH, `${figure}.svg`);
    gough("plot", run, "-q", "--figure", figure, "-o", picture);
    const stroke = /<path stroke='rgb\( *(\d+), *(\d+), *(\d+)\)'[^>]*d='M[^']{2000}/g;
    return [...readFileSync(picture, "utf8").matchAll(stroke)]
      .map(([, ...parts]) => `#${parts.map((part) => Number(part).toString(16).padStart(2, "0")).join("")}`)
      .filter((colour) => colour !== "#c9c9c9");
  };
  const legs = await chips("forces");
  assert.equal(new Set(legs).size, 6);
  assert.deepEqual(drawn("forces"), legs);
  assert.deepEqual(drawn("lengths"), legs);
  const axes = await chips("position");
  assert.equal(new Set(axes).size, 3);
  assert.deepEqual(await chips("orientation"), axes);
  assert.deepEqual(drawn("deviation").slice(0, 3), axes);
  assert.deepEqual(drawn("motion"), axes.flatMap((colour) => [colour, colour]));
  await page.close();
});
