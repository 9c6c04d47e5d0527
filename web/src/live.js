// The live run: what the reader sets and pulls goes to the thread in worker.js, and its rows come back as pictures.
import core from "virtual:core";
import { bytesOf, canRun, doublesOf } from "./core.js";
import { byId, element } from "./dom.js";
import { amount, causeWords, fixed, number, unit, unitAfter } from "./format.js";
import { Hand } from "./hand.js";
import { LiveRecord } from "./live_record.js";
import { presets } from "./presets.js";
import { placed, rotation } from "./pose.js";
import { Slider } from "./sliders.js";
import { holdsFrom } from "./stability.js";
import { Strips } from "./strips.js";
import LiveWorker from "./worker.js?worker&inline";

/** The strips show so many of the machine's units of time, √(R_b/g). */
const WINDOW = 24;
/** A top that is farther than this from its program, in base radii, has left. */
const REACH = 3;
/** Points of the trail behind the load. */
const TRAIL = 900;

const SPEEDS = { least: 0.1, greatest: 20 };

/** Name and direction (base axes) of each button that pushes. */
const DIRECTIONS = [
  ["+x", 1, 0, 0],
  ["−x", -1, 0, 0],
  ["+y", 0, 1, 0],
  ["−y", 0, -1, 0],
  ["up", 0, 0, 1],
  ["down", 0, 0, -1],
];

/** A warning where the six gains differ, since one slider sets them all. */
const unequalNote = (gains) =>
  gains.some((value) => value !== gains[0])
    ? "The study's six values differ; moving the slider makes them equal."
    : "";

/** Marks and help of the slider of stiffness: the value from which each mode holds at rest. */
function thresholdWords(study) {
  const thresholds = holdsFrom(study.stability);
  const holds = thresholds.map(({ mode, stiffness }) => `${mode} ${number(stiffness, 3)}`);
  return {
    marks: thresholds.map(({ mode, stiffness }) => ({
      value: stiffness,
      label: `${mode} holds from G = ${amount(stiffness, study.gainUnit(0))}`,
    })),
    help: [
      holds.length ? `At rest, holds from: ${holds.join(", ")}.` : "",
      unequalNote(study.control.stiffness),
    ]
      .join(" ")
      .trim(),
  };
}

export class Live {
  constructor(page, study) {
    this.page = page;
    this.study = study;
    // weight and unit of time are the core's, as step, gains and forces are that it is told; what is shown is the study's
    const { mass, gravity, radius } = study.inside;
    const pull = Math.hypot(...gravity) || 1;
    this.weight = mass * pull;
    this.timeUnit = Math.sqrt(radius / pull);
    this.possible = Boolean(core && study.live && canRun());
    this.reason =
      study.live === null
        ? "No live run for this study: its recorded motion is too long to be part of the page."
        : "No live run here: this browser has no WebAssembly, or the page was built without the core.";
    this.running = false;
    this.moved = {};
    this.trail = [];
  }

  // ---- start and stop ----

  start() {
    this.build();
    this.active = true;
    if (!this.worker) {
      this.worker = new LiveWorker();
      this.worker.addEventListener("message", ({ data }) => this.hear(data));
      this.worker.addEventListener("error", (event) => this.fail(event.message));
      this.tell("begin", {
        module: bytesOf(core),
        flat: doublesOf(bytesOf(this.study.live)),
        settings: {
          step: this.step(),
          reach: REACH * this.study.inside.radius,
          grain: this.strips.grain / this.study.factor("time"),
          chosen: this.study.quantities.chosen,
        },
      });
      // the study's own settings stand until the reader moves something
      this.tell("set", { settings: this.moved });
      this.tell("pace", { speed: this.speed.value, step: this.step() });
    }
    this.page.scene.machines[0].model.setPaths(null, null);
    this.hand = new Hand(
      this.page.scene,
      this.study,
      (force) => this.pushBy(force),
      () => !this.over && this.centre,
    );
    this.run(true);
  }

  stop() {
    if (!this.active) return;
    this.active = false;
    this.run(false);
    this.hand?.dispose();
    this.hand = null;
    this.worker.terminate();
    this.worker = null;
    this.row = null;
    this.over = null;
    this.trail = [];
    this.strips.clear();
  }

  /** A page that nobody sees does not run on. */
  hide(hidden) {
    if (!this.active || this.over) return;
    if (hidden) this.resume = this.running;
    if (hidden || this.resume) this.run(!hidden);
  }

  tell(kind, more = {}) {
    this.worker?.postMessage({ kind, ...more });
  }

  run(on) {
    this.running = on;
    this.tell("run", { on });
    if (this.playButton) {
      this.playButton.dataset.state = on ? "pause" : "play";
      this.playButton.setAttribute("aria-label", on ? "pause" : "play");
    }
  }

  toggle() {
    if (this.over) this.restart();
    else this.run(!this.running);
  }

  restart() {
    this.over = null;
    this.trail = [];
    this.strips.clear();
    byId("fallen").hidden = true;
    this.tell("restart");
    this.run(true);
  }

  /** Fixed step: a hundredth of the unit of time, less where the gains make the fastest mode faster: ω h and λ h stay below 1,
   *  with ω² ≤ 6 G (1/m + r²/J) and λ ≤ 6 D (1/m + r²/J). */
  step() {
    const { mass, centre, top, inertia } = this.study.inside;
    const arm = Math.max(
      ...top.map((joint) => Math.hypot(...joint.map((value, axis) => value - centre[axis]))),
    );
    const least = Math.min(...[0, 1, 2].map((axis) => inertia[axis][axis]));
    const mobility = 6 * (1 / mass + (arm * arm) / least);
    const { stiffness, damping } = this.sliders;
    return Math.min(
      0.01 * this.timeUnit,
      1 / Math.sqrt((stiffness.value / this.study.factor("stiffness")) * mobility || 1e-300),
      1 / ((damping.value / this.study.factor("damping")) * mobility || 1e-300),
    );
  }

  /** A setting that the reader has moved: stiffness, damping, period, delay, disturbance, amplitude, frequency or feedforward. */
  change(name, value) {
    const kind = { stiffness: "stiffness", damping: "damping", period: "time", delay: "time" }[name];
    const told = kind ? value / this.study.factor(kind) : value;
    this.moved[name] = told;
    this.page.link.changed();
    this.tell("set", { settings: { [name]: told } });
    this.tell("pace", { step: this.step() });
  }

  // ---- the panel ----

  build() {
    if (this.built) return;
    this.buildControls();
    this.buildReadings();
    this.built = element(
      "div",
      { class: "live-panel" },
      this.head(),
      this.settings(),
      element("h3", {}, "Your hand"),
      element(
        "p",
        { class: "help" },
        "Take the platform or the load and pull; or hold a button:",
      ),
      element("div", { class: "pad" }, this.pushButtons()),
      element("h3", {}, "Pace"),
      this.speed.node,
      this.readings(),
    );
    byId("live").replaceChildren(this.built);
    this.strips = new Strips(
      byId("strips"),
      this.study,
      WINDOW * this.timeUnit * this.study.factor("time"),
    );
  }

  /** Makes all controls that the reader can set. */
  buildControls() {
    this.sliders = {
      ...this.gainSliders(),
      ...this.samplingSliders(),
      ...this.multiplierSliders(),
    };
    this.feedforward = element("input", {
      type: "checkbox",
      id: "live-feedforward",
      "data-testid": "live-feedforward",
      checked: this.study.control.feedforward,
      onchange: () => this.change("feedforward", this.feedforward.checked),
    });
    this.speed = new Slider(
      {
        id: "speed",
        label: "Speed",
        unit: this.study.dimensionless ? "units of time per second" : "× real time",
        ...SPEEDS,
        logarithmic: true,
        value: 1,
      },
      (value) => this.tell("pace", { speed: value }),
    );
    this.playButton = element("button", {
      class: "play",
      type: "button",
      "data-testid": "live-play",
      title: "play or pause (space)",
      onclick: () => this.toggle(),
    });
  }

  /** A slider for the setting with the name `spec.id`. */
  slider(spec) {
    return new Slider(spec, (value) => this.change(spec.id, value));
  }

  /** Sliders of stiffness and damping. Their ranges lie around the machine's own units: m g/R_b for stiffness, and
   *  m g/R_b · √(R_b/g) for damping. */
  gainSliders() {
    const { study } = this;
    const stiff = (this.weight / study.inside.radius) * study.factor("stiffness");
    const damped = (this.weight / study.inside.radius) * this.timeUnit * study.factor("damping");
    const power = (value) => 10 ** Math.round(Math.log10(value));
    const { stiffness, damping } = study.control;
    return {
      stiffness: this.slider({
        id: "stiffness",
        label: "Stiffness G",
        unit: unit(study.gainUnit(0)),
        least: power(stiff) / 100,
        greatest: power(stiff) * 1000,
        logarithmic: true,
        value: Math.max(...stiffness),
        ...thresholdWords(study),
      }),
      damping: this.slider({
        id: "damping",
        label: "Damping D",
        unit: unit(study.gainUnit(1)),
        least: power(damped) / 100,
        greatest: power(damped) * 100,
        logarithmic: true,
        value: Math.max(...damping),
        help: unequalNote(damping),
      }),
    };
  }

  /** Sliders of when the controller looks and when its commands act; a period of 0 is a continuous one. */
  samplingSliders() {
    const { study } = this;
    const time = this.timeUnit * study.factor("time");
    const power = 10 ** Math.round(Math.log10(time));
    const { period = 0, delay = 0 } = study.control.sampling ?? {};
    const range = { unit: unit(study.unitOf("time")), logarithmic: true };
    return {
      period: this.slider({
        id: "period",
        label: "Sampling period",
        ...range,
        least: power / 10000,
        greatest: power,
        value: period ?? 0,
        help: "0: a continuous controller",
      }),
      delay: this.slider({
        id: "delay",
        label: "Delay of commands",
        ...range,
        least: power / 10000,
        greatest: power,
        value: delay ?? 0,
        help: "from a sample until its command acts; a continuous controller has none",
      }),
    };
  }

  /** Sliders of the factors by which the study's disturbance and program are multiplied. */
  multiplierSliders() {
    return {
      disturbance: this.slider({
        id: "disturbance",
        label: "Disturbance",
        unit: "× the study's",
        least: 0.1,
        greatest: 1000,
        logarithmic: true,
        value: 1,
      }),
      amplitude: this.slider({
        id: "amplitude",
        label: "Amplitude",
        unit: "× the program",
        least: 0,
        greatest: 2,
        value: 1,
      }),
      frequency: this.slider({
        id: "frequency",
        label: "Frequency",
        unit: "× the program",
        least: 0,
        greatest: 3,
        value: 1,
      }),
    };
  }

  /** Makes the outputs that each picture updates: the clock, the distance from the program and the pace. */
  buildReadings() {
    this.record = new LiveRecord(this.study);
    this.clock = element("output", {
      class: "span",
      "data-testid": "live-time",
      "aria-label": "time of the live run",
    });
    this.off = element("output", { "data-testid": "live-deviation" });
    this.pace = element("output", {
      "data-testid": "live-pace",
      title: "how much faster than real time the core runs on this computer",
    });
  }

  /** The head of the panel: play, restart and clock. */
  head() {
    return element(
      "div",
      { class: "live-head" },
      this.playButton,
      element(
        "button",
        {
          class: "mini",
          type: "button",
          "data-testid": "live-restart",
          title: "from t = 0 again (home)",
          onclick: () => this.restart(),
        },
        "restart",
      ),
      this.record.button,
      this.clock,
    );
  }

  /** The sliders with their headings, and the box of the feed-forward. */
  settings() {
    const { stiffness, damping, period, delay, amplitude, frequency, disturbance } = this.sliders;
    return [
      element("h3", {}, "Feedback"),
      element("div", { class: "pad presets" }, presets(this.study, this.sliders)),
      stiffness.node,
      damping.node,
      period.node,
      delay.node,
      element("label", { class: "check" }, this.feedforward, "feed the program's forces forward"),
      element("h3", {}, "Program and disturbance"),
      amplitude.node,
      frequency.node,
      disturbance.node,
    ];
  }

  /** A button for each direction: while held, it pushes with a fifth of the load's weight. */
  pushButtons() {
    const force = 0.2 * this.weight * this.study.factor("force");
    return DIRECTIONS.map(([word, ...direction]) => {
      const set = (on) => () => this.pushBy(on ? direction.map((part) => part * force) : [0, 0, 0]);
      return element(
        "button",
        {
          class: "mini",
          type: "button",
          "aria-label": `push ${word}`,
          title: `push while held, with ${amount(force, this.study.unit("f1"), 3)}`,
          onpointerdown: set(true),
          onpointerup: set(false),
          onpointerleave: set(false),
          onblur: set(false),
          onkeydown: (event) =>
            (event.key === " " || event.key === "Enter") && (event.preventDefault(), set(true)()),
          onkeyup: set(false),
        },
        word,
      );
    });
  }

  /** The list of readings at the foot of the panel. */
  readings() {
    return element(
      "dl",
      { class: "live-facts" },
      element("dt", {}, "off program"),
      element("dd", {}, this.off),
      element("dt", {}, "the core's pace"),
      element("dd", {}, this.pace),
    );
  }

  repaint() {
    if (this.active) this.strips.build();
  }

  // ---- what the thread says ----

  hear(data) {
    if (!this.active) return;
    if (data.kind === "ready")
      this.place = Object.fromEntries(data.columns.map((name, index) => [name, index]));
    else if (data.kind === "failed") this.fail(data.message);
    else if (data.kind === "row") {
      data.samples.forEach((sample) => this.strips.take(this.ownSample(sample)));
      this.record.take(this.place, data.row);
      this.row = this.ownRow(data.row);
      this.program = data.program.map((value, index) =>
        index < 3 ? value * this.study.factor("length") : value,
      );
      this.ratio = data.ratio;
      this.fresh = true;
      if (data.over && !this.over) this.fall(data.over);
    }
  }

  /** A row in the study's units but for its angles, which stay radians; of the columns that are shown. */
  ownRow(row) {
    const own = Float64Array.from(row);
    for (const [name, place] of Object.entries(this.place ?? {})) {
      if (name === "t") own[place] *= this.study.factor("time");
      else if (/^(x|y|z|ex|ey|ez)$/.test(name)) own[place] *= this.study.factor("length");
      else if (/^f\d$/.test(name)) own[place] *= this.study.factor("force");
    }
    return own;
  }

  /** Time, distance from the program and six forces in the study's units. */
  ownSample([t, off, ...forces]) {
    const { study } = this;
    return [
      t * study.factor("time"),
      off * study.factor("length"),
      ...forces.map((force) => force * study.factor("force")),
    ];
  }

  fail(message) {
    this.run(false);
    this.tellFallen("The live run stopped.", message || "Its thread could not be started.", false);
  }

  fall(over) {
    this.over = over;
    this.run(false);
    this.hand?.letGo();
    const time = `t = ${number(this.row[this.place.t], 5)}${unitAfter(this.study.unit("t"))}`;
    const stiffness = this.sliders.stiffness.value;
    const weakest = holdsFrom(this.study.stability)
      .filter((threshold) => threshold.stiffness > stiffness)
      .map(({ mode }) => mode);
    const because = weakest.length
      ? `G = ${amount(stiffness, this.study.gainUnit(0))} is below the threshold at rest of ${weakest.join(", ")}.`
      : "";
    if (over.cause === "left")
      this.tellFallen(
        `The platform has left its program at ${time}.`,
        because || `It is more than ${REACH} base radii away.`,
        true,
      );
    else
      this.tellFallen(
        `It ends at ${time}: ${causeWords(over.cause)}.`,
        [over.message && `${over.message[0].toUpperCase()}${over.message.slice(1)}.`, because]
          .filter(Boolean)
          .join(" "),
        true,
      );
  }

  tellFallen(headline, reason, again) {
    byId("fallen").replaceChildren(
      element("strong", {}, headline),
      element("span", {}, reason),
      again &&
        element(
          "button",
          {
            class: "mini strong",
            type: "button",
            "data-testid": "fallen-restart",
            onclick: () => this.restart(),
          },
          "start again",
        ),
    );
    byId("fallen").hidden = false;
  }

  // ---- pictures ----

  /** Called for each picture. */
  frame() {
    if (!this.active || !this.row || !this.place) return;
    this.hand?.pull(this.centre ?? [0, 0, 0]);
    if (!this.fresh) return;
    this.fresh = false;
    const at = (name) => this.row[this.place[name]];
    const order = this.study.motion?.order;
    const pose = {
      position: [at("x"), at("y"), at("z")],
      rotation: rotation(at("roll"), at("pitch"), at("yaw"), order),
    };
    const [x, y, z, roll, pitch, yaw] = this.program;
    const forces = [1, 2, 3, 4, 5, 6].map((leg) => at(`f${leg}`));
    this.centre = placed(pose, this.study.machine.center_of_mass);
    this.leaveTrail();
    const { scene } = this.page;
    scene.machines[0].model.showTrail(this.trail);
    const plan = { position: [x, y, z], rotation: rotation(roll, pitch, yaw, order) };
    scene.move([{ pose, forces, plan }]);
    const time = `t = ${fixed(at("t"), 2)}${unitAfter(this.study.unit("t"))}`;
    byId("clock").textContent = time;
    this.clock.textContent = time;
    const [off, angle] = [
      Math.hypot(at("ex"), at("ey"), at("ez")),
      this.study.factor("angle") * Math.hypot(at("eroll"), at("epitch"), at("eyaw")),
    ];
    const { study } = this;
    this.off.textContent = [
      study.within(off, "ex", 3) + unitAfter(study.unit("ex")),
      study.within(angle, "eroll", 3) + unitAfter(study.unitOf("angle")),
    ].join(", ");
    this.pace.textContent =
      this.ratio > 0
        ? `${number(this.ratio, 2)}${this.study.dimensionless ? " units of time per second" : "× real time"}`
        : "–";
    this.strips.draw();
  }

  /** Goes on with the path behind the centre of mass. */
  leaveTrail() {
    this.trail.push(...this.centre);
    if (this.trail.length > 3 * TRAIL) this.trail.splice(0, this.trail.length - 3 * TRAIL);
  }

  /** Pushes the load at its centre of mass, base axes, until the next push. */
  pushBy(force) {
    this.tell("push", { force: force.map((part) => part / this.study.factor("force")) });
  }
}
