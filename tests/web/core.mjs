// The core of the page in Node: whole runs with the bits of the command, live stepping with the bits of a run, settings that do
// what the study file would, and nothing that a page can do to it that stops it.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { readFileSync, statSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import test from "node:test";
import { inflateSync } from "node:zlib";
import { bytesOf, Core, doublesOf } from "../../web/src/core.js";
import { unpacked } from "../../web/src/packed.js";

const { CORE, FLAT, GOUGH, SCRATCH } = process.env;
const module = await WebAssembly.compile(readFileSync(CORE));

// ---- studies and their tables ----

const machine = `
units: dimensionless
platform: {base: {radius: 1, half_angle: 15}, top: {radius: 0.6, half_angle: 15}, height: 1.2}
load: {mass: 1.3, center_of_mass: [0.05, -0.03, 0.1], inertia: [0.08, 0.09, 0.15]}
`;
const held = "control: {stiffness: [30, 31, 32, 33, 34, 35], damping: 2}\n";
// looks at times that are whole multiples of a power of two, too
const sampled = "control: {stiffness: [30, 31, 32, 33, 34, 35], damping: 2, integral: 5, tracking_time: 0.5," +
  " sampling: {period: 0.03125, delay: 0.0078125, velocity: difference, cutoff: 6, resolution: 1e-5, noise: 1e-6}}\n" +
  "actuators: {kind: lag, time_constant: 0.02, max_force: 0.5}\n";
const pushed = 'disturbance: {leg_force: [0.01*t, 0, 0.02, 0, -0.01*t^2/(1 + t^2), "ramp(t, 2)/50"]}\n';
const moves = "motion: {moves: [{start: 0.5, duration: 2, heave: 0.1}, {start: 3, duration: 1.5, surge: 0.05}]}\n";
const polynomial = 'motion: {heave: 0.01*t*(2 - t/4)^3, sway: t^2/400 - 0.01, surge: "ramp(t, 3)/20"}\n';
const waves = "motion: {heave: 0.1*sin(t)*(1 - exp(-t/2)), roll: 4*sin(1.3*t), yaw: 5*cos(t), pitch: 3*tanh(t)}\n";
const noise = "disturbance: {noise: {leg_force: 0.02, moment: 0.01, interval: 0.2, seed: 9007199254740991}}\n";

// steps and rows at times that are whole multiples of a power of two: the same doubles in every way to them
const stepped = (method, duration = 6) =>
  `simulation: {duration: ${duration}, output_step: 0.0625, method: ${method}, step: 0.0078125}\n`;

let files = 0;
function write(text) {
  const file = join(SCRATCH, `study-${files++}.yaml`);
  writeFileSync(file, text);
  return file;
}

function flatOf(file) {
  return doublesOf(execFileSync(FLAT, [file], { maxBuffer: 1 << 28 }));
}

async function coreOf(text) {
  const core = await Core.load(module);
  core.begin(flatOf(write(text)));
  return core;
}

// The command's table: {names, rows}; a run that ends early is a table too.
function tableOf(file, ...settings) {
  const csv = join(SCRATCH, "table.csv");
  try {
    execFileSync(GOUGH, ["simulate", file, "-q", "-o", csv, ...settings.flatMap((s) => ["--set", s])], { stdio: "pipe" });
  } catch (error) {
    assert.equal(error.status, 1, String(error.stderr));
  }
  const lines = readFileSync(csv, "utf8").trimEnd().split("\n");
  return { names: lines[0].split(","), rows: lines.slice(1).map((line) => line.split(",").map(Number)) };
}

const angles = new Set(["roll", "pitch", "yaw", "eroll", "epitch", "eyaw"]);
const turns = new Set([...angles, "wx", "wy", "wz", "alx", "aly", "alz"]);
const degrees = (name, value) => (turns.has(name) ? value * (180 / Math.PI) : value);

// How far two numbers of a table are apart, angles in radians, for numbers above 1 relative to `size`.
const apart = (name, one, other, size) => Math.abs(one - other) / (turns.has(name) ? 180 / Math.PI : 1) / Math.max(1, size);

// Calls compare(name, ours, theirs) for each number of two tables of the same study.
function eachNumber(core, run, table, compare) {
  assert.equal(run.rows, table.rows.length);
  assert.ok(run.rows > 3);
  table.rows.forEach((row, r) =>
    row.forEach((value, c) => {
      const name = table.names[c];
      compare(name, degrees(name, run.data[r * core.columns.length + core.place[name]]), value, r);
    }),
  );
}

// ---- the module ----

test("imports nothing and stays below 460 kB", () => {
  assert.deepEqual(WebAssembly.Module.imports(module), []);
  assert.ok(statSync(CORE).size < 460e3, `${statSync(CORE).size} bytes`);
});

test("has the columns of the table", async () => {
  const core = await coreOf(machine + stepped("rk4", 1));
  const table = tableOf(write(machine + stepped("rk4", 1)));
  assert.deepEqual(core.columns.slice(0, table.names.length), table.names);
});

// ---- whole runs against the command ----

// In these no function of the mathematics library acts on the motion. Roll, pitch and yaw alone are read out through its arc
// tangent, which may differ in the last place; a deviation of angles is a difference of two.
for (const method of ["rk4", "dop853", "rattle4"]) {
  for (const [name, text] of Object.entries({
    "moves": moves + held + pushed,
    "polynomials": polynomial + held + pushed,
    "a start off the program, damped": held + "initial: {heave: 0.05, surge: 0.02, velocity: [0.1, 0, 0]}\n",
    "a sampled loop": moves + sampled + pushed,
    "a fall without feedback": "control: {feedforward: none}\ndisturbance: {force: [0.01, 0, 0]}\n",
    "a leg at its limit": moves + held + "disturbance: {force: [0, 0, t]}\n",
  })) {
    if (name === "a sampled loop" && method === "rattle4") continue; // which takes no lag
    test(`same bits as the command: ${name}, ${method}`, async () => {
      const limits =
        name === "a leg at its limit" ? machine.replace("height: 1.2", "height: 1.2, legs: {length: [1.2, 1.4]}") : machine;
      const file = write(limits + text + stepped(method));
      const core = await Core.load(module);
      core.begin(flatOf(file));
      const run = core.run();
      eachNumber(core, run, tableOf(file), (column, ours, theirs, row) => {
        if (angles.has(column)) {
          assert.ok(Math.abs(ours - theirs) <= 9e-16 * Math.max(1, Math.abs(theirs)), `${column} of row ${row}: ${ours} ${theirs}`);
        } else {
          assert.ok(Object.is(ours, theirs), `${column} of row ${row}: ${ours} ${theirs}`);
        }
      });
      const ends = { "a fall without feedback": "singular", "a leg at its limit": "leg_long" };
      assert.equal(run.cause, ends[name] ?? "done", core.message);
      assert.equal(core.message === "", run.cause === "done");
    });
  }
}

// a record that passes a pitch of 90 degrees at 2 degrees, Rx(2 degrees) Ry(θ), where it is interpolated about turned axes
const steep = ["t,roll,pitch,yaw"];
for (let i = 0; i <= 24; i++) {
  const angle = (50 * Math.PI * (1 - Math.cos((Math.PI * i) / 24))) / 180, tilt = (2 * Math.PI) / 180;
  const [c, s, C, S] = [Math.cos(angle), Math.sin(angle), Math.cos(tilt), Math.sin(tilt)];
  const triple = [Math.atan2(S, C * c), Math.asin(C * s), Math.atan2(S * s, c)];
  steep.push([i / 4, ...triple.map((radians) => (radians * 180) / Math.PI)].join(","));
}
writeFileSync(join(SCRATCH, "steep.csv"), steep.join("\n") + "\n");

test("a steep record is interpolated about turned axes", () => {
  const file = write(machine + "motion: {samples: steep.csv}\n" + held + stepped("dop853", 5));
  const check = JSON.parse(execFileSync(GOUGH, ["check", file, "--json", "-q"], { stdio: "pipe" }));
  assert.equal(check.program.record.turned, true);
});

// Here sine, exponential and the like, of two libraries; angles in radians, relative to what is above 1 in the column.
for (const [name, text] of Object.entries({
  "waves, rk4": waves + held + stepped("rk4"),
  "waves, dop853": waves + held + stepped("dop853"),
  "waves larger and faster": waves.replace("}", ", amplitude: 0.7, frequency: 1.3}") + held + stepped("dop853"),
  "noise": noise + held + stepped("dop853"),
  "recorded about turned axes": "motion: {samples: steep.csv}\n" + held + stepped("dop853", 5),
  "adaptive": waves + held + "simulation: {duration: 6, output_step: 0.1, tolerance: 1e-10}\n",
})) {
  test(`within 1e-12 of the command: ${name}`, async () => {
    const file = write(machine + text);
    const core = await Core.load(module);
    core.begin(flatOf(file));
    const run = core.run();
    const table = tableOf(file);
    const size = table.names.map((_, c) => Math.max(...table.rows.map((row) => Math.abs(row[c]))));
    let worst = 0;
    eachNumber(core, run, table, (column, ours, theirs, row) => {
      const error = apart(column, ours, theirs, size[table.names.indexOf(column)]);
      assert.ok(error <= 1e-12, `${column} of row ${row}: ${ours} ${theirs}`);
      worst = Math.max(worst, error);
    });
    assert.equal(run.cause, "done");
    console.log(`${name}: greatest difference ${worst.toExponential(1)}`);
  });
}

// ---- live stepping against a run ----

function assertSameRow(core, run, r) {
  const row = core.row();
  for (let c = 0; c < row.length; c++) {
    const whole = run.data[r * row.length + c];
    assert.ok(Object.is(row[c], whole), `${core.columns[c]} of row ${r}: ${row[c]} ${whole}`);
  }
}

for (const [method, loop, text] of [["rk4", "continuous", held], ["dop853", "continuous", held], ["rk4", "sampled", sampled],
  ["dop853", "sampled", sampled]]) {
  test(`stepping live has the bits of a run, ${method}, ${loop}`, async () => {
    const core = await coreOf(machine + waves + text + pushed + stepped(method));
    const run = core.run();
    for (let r = 0; r < run.rows; r++) {
      assertSameRow(core, run, r);
      assert.equal(core.advance(0.0625, 0.0078125), "done");
    }
  });
}

test("durations that are no whole steps lose no time", async () => {
  const core = await coreOf(machine + waves + held + stepped("rk4"));
  const run = core.run();
  let asked = 0, met = 0;
  while (met < 20) {
    core.advance(0.0101, 0.0078125);
    asked += 0.0101;
    const t = core.row()[core.place.t];
    assert.ok(t <= asked + 1e-9 && t > asked - 0.0078126, `${t} ${asked}`);
    if (t % 0.0625 !== 0) continue;
    // drift is that since the row before, which here is another
    const row = core.row(), r = t / 0.0625;
    for (const name of ["x", "z", "yaw", "vx", "f1", "f6", "ez"]) {
      assert.ok(Object.is(row[core.place[name]], run.data[r * row.length + core.place[name]]), `${name} at ${t}`);
    }
    met++;
  }
});

test("settings set to what they are, or to no number, change no bit at any time", async () => {
  const core = await coreOf(machine + waves + "control: {stiffness: 30, damping: 2}\n" + stepped("dop853"));
  const run = core.run();
  for (let r = 0; r < run.rows; r++) {
    core.set({ stiffness: 30, damping: 2, feedforward: true, disturbance: 1, amplitude: 1, frequency: 1 });
    for (const none of [NaN, Infinity, -Infinity]) {
      core.set({ stiffness: none, damping: none, disturbance: none, amplitude: none, frequency: none });
      core.push(none, 0, 0);
    }
    core.push(0, 0, 0);
    assertSameRow(core, run, r);
    core.advance(0.0625, 0.0078125);
  }
  core.restart();
  assertSameRow(core, run, 0);
});

test("ends where a run ends, in its words, and rests there until it is begun again", async () => {
  const core = await coreOf(machine + "control: {feedforward: none}\ndisturbance: {force: [0.01, 0, 0]}\n" + stepped("dop853"));
  const run = core.run();
  const sentence = core.message;
  assert.equal(run.cause, "singular");
  core.restart();
  assert.equal(core.message, "");
  assert.equal(core.advance(6, 0.0078125), "singular");
  assert.equal(core.message, sentence);
  const t = core.row()[core.place.t];
  assert.ok(sentence.includes(`t = ${t.toPrecision(9).replace(/0+$/, "")}:`), `${sentence} ${t}`);
  assert.equal(core.advance(1, 0.01), "singular");
  core.set({ stiffness: 50 });
  assert.equal(core.row()[core.place.t], t);
  core.restart();
  core.set({ feedforward: true, stiffness: 50, damping: 5 });
  assert.equal(core.advance(50, 0.01), "done");
});

for (const [cause, limits, text] of [
  ["leg_long", "legs: {length: [1.2, 1.4]}", "disturbance: {force: [0, 0, t]}"],
  ["leg_short", "legs: {length: [1.2, 1.4]}", "disturbance: {force: [0, 0, -t]}"],
  ["leg_speed", "legs: {max_speed: 0.02}", "disturbance: {force: [0, 0, t^2/4]}"],
  ["leg_force", "legs: {max_force: 0.5}", "disturbance: {force: [0, 0, t]}"],
  ["leg_force", "legs: {force: [0.1, 9]}", "disturbance: {force: [0, 0, t/4]}"],
  ["leg_acceleration", "legs: {max_acceleration: 0.01}", "disturbance: {force: [0, 0, t^4/40]}"],
  ["base_swing", "joints: {base_swing: 1}", "disturbance: {force: [t/4, 0, 0]}"],
  ["top_swing", "joints: {top_swing: 1}", "disturbance: {force: [t/4, 0, 0]}"],
  ["platform_pose", "limits: {yaw: 2}", "disturbance: {moment: [0, 0, t/8]}"],
  ["platform_speed", "limits: {speed: {heave: 0.02}}", "disturbance: {force: [0, 0, t^2/4]}"],
  ["platform_acceleration", "limits: {acceleration: {heave: 0.01}}", "disturbance: {force: [0, 0, t^4/40]}"],
  ["not_finite", "", "motion: {heave: 0.01*log(2 - t)}"],
  ["not_finite", "", "disturbance: {force: [1/(t - 1), 0, 0]}"],
]) {
  test(`ends as a run does: ${cause}, ${text.slice(0, 6)}`, async () => {
    const limited = machine.replace("height: 1.2", `height: 1.2, ${limits}`);
    const core = await coreOf(limited + held + `${text}\n` + stepped("dop853", 20));
    const run = core.run(), sentence = core.message;
    assert.equal(run.cause, cause);
    core.restart();
    assert.equal(core.advance(20, 0.0078125), cause);
    assert.equal(core.message, sentence);
    assert.ok(core.row()[core.place.t] > 0.5);
  });
}

test("names the leg that ends it", async () => {
  const core = await coreOf(machine.replace("height: 1.2", "height: 1.2, legs: {length: [1.2, 1.4]}") + held +
    "disturbance: {leg_force: [0, 0, 0, 3*t, 0, 0]}\n" + stepped("dop853"));
  assert.equal(core.advance(20, 0.01), "leg_long");
  assert.equal(core.leg, 4);
});

// ---- settings against study files ----

// greatest difference of what a live run with settings and the command with keys have in common at the end
async function assertSameEnd(text, settings, ...keys) {
  const core = await coreOf(text);
  const rows = tableOf(write(text), ...keys);
  const last = rows.rows.at(-1);
  if (settings.push) core.push(...settings.push);
  core.set(settings.set ?? {});
  assert.equal(core.advance(last[0], 0.0078125), "done", core.message);
  const row = core.row();
  rows.names.forEach((name, c) => {
    if (name === "drift" || /^u\d/.test(name)) return; // a live run of a continuous study has no commands
    const ours = degrees(name, row[core.place[name]]);
    assert.ok(apart(name, ours, last[c], Math.abs(last[c])) <= 1e-12, `${name}: ${ours} ${last[c]}`);
  });
}

const all = machine + waves + pushed + held + stepped("dop853");
test("sets gains as the study does", () =>
  assertSameEnd(all, { set: { stiffness: 20, damping: 0.5 } }, "control.stiffness=20", "control.damping=0.5"));
test("sets period and delay of the samples as the study does", () =>
  assertSameEnd(all, { set: { delay: 0, period: 0.0390625 } }, "control.sampling.period=0.0390625")); // of which 6 is no multiple
test("a delay holds commands back as the study does", () =>
  assertSameEnd(all.replace("damping: 2", "damping: 2, sampling: {period: 0.03125}"), { set: { delay: 0.0234375 } },
    "control.sampling.delay=0.0234375"));
test("sets period and delay where drives lag and saturate", () =>
  assertSameEnd(
    all.replace("damping: 2", "damping: 2, sampling: {period: 0.03125}") +
      "actuators: {kind: lag, time_constant: 0.02, max_force: 0.6}\n",
    { set: { period: 0.015625, delay: 0.0078125 } }, "control.sampling.period=0.015625", "control.sampling.delay=0.0078125"));
test("an edge of the window is one live: too long a period shakes the platform off, a shorter one takes it back", async () => {
  const core = await coreOf(machine + "control: {stiffness: 20, damping: 2}\n" + stepped("dop853"));
  core.push(0.01, 0, 0);
  core.advance(1, 0.0078125);
  core.set({ period: 0.02, delay: 0.02 });
  assert.equal(core.advance(20, 0.0078125), "done");
  const rate = () => Math.hypot(...["vx", "vy", "wx", "wy"].map((name) => core.row()[core.place[name]]));
  assert.ok(rate() < 1e-3, `${rate()}`);
  core.set({ period: 0.3, delay: 0.3 });
  assert.notEqual(core.advance(50, 0.0078125), "done");
  core.set({ period: 0 });
  core.restart();
  assert.equal(core.advance(50, 0.0078125), "done");
});
test("sets the feed-forward as the study does", () =>
  assertSameEnd(all, { set: { feedforward: false } }, "control.feedforward=none"));
test("sets the amplitude as the study does", () => assertSameEnd(all, { set: { amplitude: 0.4 } }, "motion.amplitude=0.4"));
test("sets the frequency as the study does", () => assertSameEnd(all, { set: { frequency: 1.7 } }, "motion.frequency=1.7"));
test("pushes as a constant force does", () =>
  assertSameEnd(all, { push: [0.1, -0.2, 0.05] }, "disturbance.force=[0.1, -0.2, 0.05]"));
test("pushes as hard, however the disturbances are scaled", () =>
  assertSameEnd(machine + waves + held + stepped("dop853"), { set: { disturbance: 3 }, push: [0.1, -0.2, 0.05] },
    "disturbance.force=[0.1, -0.2, 0.05]"));
test("scales what the study scales already", () =>
  assertSameEnd(all.replace("motion: {", "motion: {amplitude: 0.5, frequency: 2, "), { set: { amplitude: 0.5, frequency: 0.75 } },
    "motion.amplitude=0.25", "motion.frequency=1.5"));
test("scales all disturbances", () =>
  assertSameEnd(machine + moves + held +
    "disturbance: {leg_force: 0.1*t, vertical_force: 0.2, force: [0.1, 0, 0], moment: [0, 0.02*t, 0]," +
    " noise: {leg_force: 0.02, interval: 0.3}}\n" + stepped("dop853"), { set: { disturbance: 0.5 } },
    "disturbance.leg_force=0.05*t", "disturbance.vertical_force=0.1", "disturbance.force=[0.05, 0, 0]",
    "disturbance.moment=[0, 0.01*t, 0]", "disturbance.noise.leg_force=0.01"));

test("feedback below its threshold loses the platform, above it holds", async () => {
  const core = await coreOf(machine + waves + stepped("dop853"));
  for (const [stiffness, holds] of [[0.05, false], [50, true]]) {
    core.restart();
    core.set({ stiffness, damping: 0.1 });
    core.push(0.001, 0.001, 0);
    const cause = core.advance(100, 0.01);
    const row = core.row();
    const away = Math.hypot(row[core.place.ex], row[core.place.ey], row[core.place.ez]);
    assert.equal(cause === "done" && away < 0.01, holds, `G = ${stiffness}: ${cause}, ${away}`);
  }
});

// The program's position and speed, by differences, while size and speed of it are changed on the way.
test("an amplitude is reached after the machine's unit of time, half of the way after half of it", async () => {
  const core = await coreOf(machine + "motion: {surge: 0.05*cos(2*t)}\n" + held + stepped("dop853"));
  core.advance(1, 1 / 128);
  core.set({ amplitude: 0.5 });
  for (const [t, factor] of [[1.5, 0.75], [2, 0.5], [2.5, 0.5]]) {
    core.advance(0.5, 1 / 128);
    assert.equal(core.row()[core.place.t], t);
    const [x] = core.program();
    assert.ok(Math.abs(x - factor * 0.05 * Math.cos(2 * t)) < 1e-14, `t = ${t}: ${x}`);
  }
});
test("a program does not go backwards: with a frequency below 0 it stands", async () => {
  const core = await coreOf(machine + "motion: {surge: 0.05*cos(2*t)}\n" + held + stepped("dop853"));
  core.advance(1, 1 / 128);
  core.set({ frequency: -1 });
  core.advance(1, 1 / 128);
  const stands = core.program();
  core.advance(1, 1 / 128);
  assert.deepEqual(core.program(), stands);
});
test("the program stays smooth while its amplitude and frequency change", async () => {
  const core = await coreOf(machine + "motion: {heave: 0.1*sin(3*t), surge: 0.05*cos(2*t)}\n" + held + stepped("dop853"));
  const step = 1 / 1024;
  let before, speed, accelerated = 0;
  for (let i = 0; i < 8600; i++) {
    if (i === 1000) core.set({ frequency: 2 });
    if (i === 2500) core.set({ amplitude: 0.3 });
    if (i === 3500) core.set({ amplitude: 1.2, frequency: 0.25 });
    if (i === 4500) core.set({ frequency: 1 });
    if (i === 4700) core.set({ frequency: 1 }); // the same on its way is no change
    if (i === 5600) core.set({ amplitude: 1 });
    // as given again, but for the phase
    if (i === 7000) for (const factor of [2, 1]) core.set({ amplitude: factor, frequency: factor });
    if (i === 7500) core.set({ frequency: 0 });
    assert.equal(core.advance(step, step), "done", core.message);
    const z = core.program()[2];
    if (before !== undefined) {
      const now = (z - before) / step;
      if (speed !== undefined) accelerated = Math.max(accelerated, Math.abs(now - speed) / step);
      speed = now;
    }
    before = z;
  }
  // 0.1·3²·2² = 3.6 and what the passages add; a jump in speed of 0.01 would be 10
  assert.ok(accelerated > 1 && accelerated < 6, `${accelerated}`);
  assert.ok(Math.abs(speed) < 0.4);
  const rest = core.program();
  core.advance(2, 0.01);
  const later = core.program();
  core.advance(2, 0.01);
  assert.deepEqual(core.program(), later); // frequency 0: it stands
  assert.ok(Math.hypot(...rest.map((x, i) => x - later[i])) < 0.2);
});

// ---- what a page may do to it ----

// reproducible numbers in [0, 1)
function dice(seed) {
  let state = seed >>> 0;
  return () => {
    state = (state + 0x6d2b79f5) | 0;
    let z = Math.imul(state ^ (state >>> 15), 1 | state);
    z = (z + Math.imul(z ^ (z >>> 7), 61 | z)) ^ z;
    return ((z ^ (z >>> 14)) >>> 0) / 4294967296;
  };
}

const causes = [
  "done", "leg_short", "leg_long", "leg_speed", "leg_force", "leg_no_length",
  "singular", "not_finite", "no_convergence", "stopped", "invalid",
  "leg_acceleration", "base_swing", "top_swing", "platform_pose", "platform_speed", "platform_acceleration",
];
const nasty = [0, -1, 1e300, -1e300, 1e-300, NaN, Infinity, -Infinity, 5e-324, 1e9, 0.5, 2];

test("random pushes and settings never stop it, and what goes on is finite", async () => {
  const random = dice(5);
  const any = (size) => (random() < 0.1 ? nasty[Math.floor(random() * nasty.length)] : size * (2 * random() - 1));
  const seen = new Set();
  const core = await coreOf(all.replace("leg_force", "noise: {force: 0.01, interval: 0.2}, leg_force"));
  for (let game = 0; game < 150; game++) {
    core.restart();
    core.set({ stiffness: 30, damping: 2, feedforward: true, disturbance: 1, amplitude: 1, frequency: 1 });
    for (let i = 0; i < 30; i++) {
      const names = ["stiffness", "damping", "feedforward", "disturbance", "amplitude", "frequency"];
      if (random() < 0.5) core.push(any(1), any(1), any(1));
      if (random() < 0.3) core.set({ [names[Math.floor(random() * names.length)]]: any(3) });
      const cause = core.advance(random() < 0.1 ? any(1) : 0.1 * random(), random() < 0.1 ? any(0.1) : 0.01);
      assert.ok(causes.includes(cause), cause);
      seen.add(cause);
      const row = core.row();
      if (cause === "done") assert.ok(row.subarray(0, core.place.drift).every(Number.isFinite), `game ${game}, ${i}: ${row}`);
      if (cause !== "done" && cause !== "invalid") assert.ok(core.message.length > 10);
      core.program();
    }
  }
  assert.ok(seen.size >= 4, [...seen].join(" ")); // done, invalid and more than one way to end
});

test("damaged studies are refused with a sentence or run", async () => {
  const random = dice(6);
  const flat = flatOf(write(all));
  const core = await Core.load(module);
  let begun = 0, refused = 0;
  for (let i = 0; i < 2000; i++) {
    const damaged = flat.slice(0, random() < 0.1 ? Math.floor(random() * flat.length) : flat.length);
    for (let k = 0; k < 1 + 3 * random(); k++) {
      damaged[Math.floor(random() * damaged.length)] =
        random() < 0.5 ? nasty[Math.floor(random() * nasty.length)] : Math.floor(30 * random());
    }
    try {
      core.begin(damaged);
      begun++;
      core.push(0.1, 0, 0);
      assert.ok(causes.includes(core.advance(0.1, 0.01)));
      core.row();
    } catch (error) {
      assert.ok(error.constructor === Error && error.message.length > 10, `${error.stack}`);
      refused++;
    }
  }
  assert.ok(begun > 50 && refused > 50, `${begun} ${refused}`);
});

test("before a study there is nothing, and nothing happens", async () => {
  const core = await Core.load(module);
  core.restart();
  core.push(1, 2, 3);
  core.set({ stiffness: 3, amplitude: 2, frequency: 2 });
  assert.equal(core.advance(1, 0.1), "invalid");
  assert.equal(core.run().rows, 0);
  assert.throws(() => core.derived(new Float64Array(12)), Error);
  assert.throws(() => core.derived(new Float64Array(0)), Error);
  assert.throws(() => core.set({ nonsense: 1 }), /no setting nonsense/);
  assert.throws(() => core.begin(new Float64Array(0)), Error);
  core.begin(flatOf(write(all)));
  assert.equal(core.advance(1, 0.01), "done");
  assert.equal(core.advance(1e9, 1e6), "invalid"); // beyond a million durations
  assert.equal(core.advance(1001, 0.01), "invalid"); // more steps than one call takes
  assert.equal(core.row()[core.place.t], 1);
});

test("takes recorded motion of any length, again and again, in the same memory", async () => {
  const rows = ["t,heave,yaw"];
  for (let i = 0; i <= 60000; i++) rows.push(`${i / 100},${0.05 * Math.sin(i / 100)},${3 * Math.cos(i / 150)}`);
  writeFileSync(join(SCRATCH, "recorded.csv"), rows.join("\n") + "\n");
  const file = write(machine + "motion: {samples: recorded.csv}\n" + held + stepped("dop853"));
  const flat = flatOf(file);
  assert.ok(flat.length > 7 * 60001);
  const core = await Core.load(module);
  core.begin(flat);
  const run = core.run();
  for (let i = 0; i < 20; i++) core.begin(flat);
  const memory = core.calls.memory.buffer.byteLength;
  for (let i = 0; i < 20; i++) core.begin(flat);
  assert.equal(core.calls.memory.buffer.byteLength, memory);
  assert.equal(core.advance(0.0625, 0.0078125), "done");
  assertSameRow(core, run, 1);
  assert.equal(core.advance(595, 0.01), "done");
  // past its end the record holds its last row
  assert.equal(core.advance(20, 0.01), "done");
  assert.ok(Math.abs(core.program()[2] - (1.2 + 0.05 * Math.sin(600))) < 1e-12);
});

test("the page of a study carries the model and its table, to the bit", async () => {
  const file = write(all), page = join(SCRATCH, "page.html");
  execFileSync(GOUGH, ["report", file, "-q", "-o", page], { stdio: "pipe" });
  const [, json] = readFileSync(page, "utf8").match(/<script type="application\/json" id="gough-data">(.*?)<\/script>/s);
  const [study] = JSON.parse(json).studies;
  const flat = doublesOf(bytesOf(study.live));
  assert.deepEqual(flat, flatOf(file));
  const core = await Core.load(module);
  core.begin(flat);
  const table = tableOf(file);
  for (const column of study.columns) {
    const c = table.names.indexOf(column.name);
    assert.deepEqual(Array.from(unpacked(column, inflateSync)), table.rows.map((row) => row[c]));
  }
});

test("base64 comes back as bytes", () => {
  const bytes = Uint8Array.from({ length: 256 }, (_, i) => i);
  assert.deepEqual(bytesOf(Buffer.from(bytes).toString("base64")), bytes);
});

test("steps faster than real time at a millisecond", async () => {
  const core = await coreOf(all);
  core.advance(5, 0.001);
  const begin = performance.now();
  for (let i = 0; i < 10; i++) assert.equal(core.advance(1, 0.001), "done");
  const seconds = (performance.now() - begin) / 1000;
  console.log(`${Math.round(1e4 / seconds)} steps of dop853 a second`);
  assert.ok(seconds < 5, `${seconds} s for 10 s of motion`);
});
