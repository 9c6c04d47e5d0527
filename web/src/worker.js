// The live run's own thread: the C core goes on at the pace asked for, and hands over a row for each picture. The page never waits
// for it.
import { Core, inflated } from "./core.js";

/** Pictures in a second, and how much of each the core may take: the rest of a second belongs to the processor's other work. */
const RATE = 60;
const SHARE = 0.8;
/** A page that slept does not make up for it: at most so many seconds are caught up. */
const CATCH_UP = 0.1;

let core;
let clock;
let speed = 1;
let step = 0.01;
let reach = Infinity;
let before = 0;
let owed = 0;
let over = null;
/** Samples for the strips since the last picture, and the time between two of them. */
let samples = [];
let grain = Infinity;
let sampled = -Infinity;
/** Simulated and real time since the last word on the pace. */
let pace = { simulated: 0, busy: 0 };

/** How far the top is from its program. */
function deviation(row) {
  const { ex, ey, ez } = core.place;
  return Math.hypot(row[ex], row[ey], row[ez]);
}

/** Keeps a sample for the strips, if it is time for one: forces of the drives, then those in the legs, if they are known. */
function sample(row) {
  const { t, f1, h1 } = core.place;
  if (row[t] < sampled + grain && row[t] >= sampled) return;
  sampled = row[t];
  samples.push([
    row[t],
    deviation(row),
    ...row.subarray(f1, f1 + 6),
    ...row.subarray(h1, h1 + 6),
  ]);
}

function report() {
  const row = core.row();
  sample(row);
  if (!over && deviation(row) > reach) over = { cause: "left", message: "", leg: 0 };
  const ratio = pace.busy > 0 ? pace.simulated / pace.busy : 0;
  postMessage({ kind: "row", row, program: core.program(), over, ratio, samples });
  samples = [];
}

function tick() {
  const now = performance.now();
  owed += Math.min((now - before) / 1000, CATCH_UP) * speed;
  before = now;
  if (over) return;
  const until = now + (1000 * SHARE) / RATE;
  let moved = false;
  while (owed > 0 && performance.now() < until) {
    // a few steps at a time, so that the clock is looked at often enough
    const piece = Math.min(owed, 8 * step);
    const begun = performance.now();
    const cause = core.advance(piece, step);
    pace.busy += (performance.now() - begun) / 1000;
    pace.simulated += piece;
    owed -= piece;
    moved = true;
    if (cause !== "done") {
      over = { cause, message: core.message, leg: core.leg };
      break;
    }
    sample(core.row());
  }
  // what could not be done in time is not owed: the run is slower then, not late
  owed = 0;
  if (pace.busy > 2) pace = { simulated: pace.simulated / 2, busy: pace.busy / 2 };
  if (moved) report();
}

function run(on) {
  clearInterval(clock);
  clock = undefined;
  if (!on) return;
  before = performance.now();
  clock = setInterval(tick, 1000 / RATE);
}

const orders = {
  async begin({ module, flat, settings }) {
    core = await Core.load(await inflated(module));
    core.begin(flat, settings.chosen);
    ({ step, reach, grain } = settings);
    postMessage({ kind: "ready", columns: core.columns });
    report();
  },
  set({ settings }) {
    core.set(settings);
  },
  pace(settings) {
    speed = settings.speed ?? speed;
    step = settings.step ?? step;
  },
  push({ force }) {
    core.push(...force);
  },
  restart() {
    core.restart();
    over = null;
    owed = 0;
    samples = [];
    report();
  },
  run({ on }) {
    run(on);
  },
};

// one order after the other: what comes while the core is still being loaded waits
let orderly = Promise.resolve();
addEventListener("message", ({ data }) => {
  orderly = orderly
    .then(() => orders[data.kind](data))
    .catch((error) => {
      run(false);
      postMessage({ kind: "failed", message: error.message });
    });
});
