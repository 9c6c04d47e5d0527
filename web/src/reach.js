// Where the machine can be: all poses of six lengths as ghosts, the travel of each axis with what ends it, and the surface of the
// positions. The core finds them in the thread of reach_worker.js; this is the panel.
import core from "virtual:core";
import { LEGS } from "./color.js";
import { bytesOf, canRun, doublesOf } from "./core.js";
import { byId, element } from "./dom.js";
import { known, number, unit, unitAfter } from "./format.js";
import { poseOf } from "./pose.js";
import ReachWorker from "./reach_worker.js?worker&inline";
import { countWords, endWords, MIRRORED, sameSide, wayWords } from "./reach_words.js";
import { Slider } from "./sliders.js";

const COMPONENTS = ["surge", "sway", "heave", "roll", "pitch", "yaw"];
const FROM_RUN = ["x", "y", "z", "roll", "pitch", "yaw"];
/** Directions of the surface. */
const AZIMUTHS = 48;
const RINGS = 23;
/** What a bar shows beyond a travel, in parts of it. */
const BEYOND = 0.12;
/** Poses are known to this part of the base radius, angles to as many radians. */
const EXACT = 1e-10;
const NO_FORCES = LEGS.map(() => NaN);

export class Reach {
  constructor(page, study) {
    this.page = page;
    this.study = study;
    this.possible = Boolean(core && study.live && canRun());
    this.travel = [];
    this.surfaceShown = true;
  }

  /** A number of a component in the study's units; the core's are those of the run and radians. */
  own(component, value) {
    return value * this.study.factor(component < 3 ? "length" : "angle");
  }

  /** A number of a pose as text: 0 where it is below what is known of it. */
  said(component, value, digits) {
    const noise = EXACT * (component < 3 ? this.study.inside.radius : 1);
    return known(this.own(component, value), this.own(component, noise), digits);
  }

  unitOf(component) {
    return component < 3 ? this.study.unit("l1") : this.study.unitOf("angle");
  }

  // ---- start and stop ----

  start() {
    this.active = true;
    if (!this.worker) {
      this.build();
      this.worker = new ReachWorker();
      this.worker.addEventListener("message", ({ data }) => this.hear(data));
      this.worker.addEventListener("error", (event) => this.fail(event.message));
      this.worker.postMessage({
        kind: "begin",
        module: bytesOf(core),
        flat: doublesOf(bytesOf(this.study.live)),
        chosen: this.study.quantities.chosen,
      });
      this.fromRun();
      this.worker.postMessage({ kind: "travel" });
      if (this.page.scene.solid)
        this.worker.postMessage({ kind: "surface", azimuths: AZIMUTHS, rings: RINGS });
    }
    this.page.scene.machines[0].model.setPaths(null, null);
    this.show();
  }

  /** Leaves the scene; what was found is kept. */
  stop() {
    if (!this.active) return;
    this.active = false;
    const { model } = this.page.scene.machines[0];
    model.showPoses([]);
    model.showSurface(null);
    this.page.scene.toggle("load", this.page.switched.load);
  }

  /** Ends the thread, for another study takes its place. */
  end() {
    this.stop();
    this.worker?.terminate();
    this.worker = null;
  }

  // ---- the panel ----

  build() {
    this.sliders = LEGS.map(
      (_, leg) =>
        new Slider(
          {
            family: "reach",
            id: `l${leg + 1}`,
            label: `Leg ${leg + 1}`,
            unit: unit(this.study.unit("l1")),
            least: 0.6 * this.study.machine.home_length[leg],
            greatest: 1.6 * this.study.machine.home_length[leg],
            digits: 7,
            value: this.study.machine.home_length[leg],
          },
          () => this.ask("follow", { length: this.lengths }),
        ),
    );
    this.sliders.forEach(({ node }, leg) => node.style.setProperty("--accent", LEGS[leg]));
    this.count = element("p", { class: "help", "data-testid": "reach-count", role: "status" });
    this.way = element("p", { class: "help", "data-testid": "reach-way" });
    this.list = element("tbody", { "data-testid": "reach-poses" });
    this.bars = element("ol", { class: "travels", "data-testid": "reach-travel" });
    this.note = element("p", { class: "help", "data-testid": "reach-note" });
    const button = (testid, title, words, onclick) =>
      element("button", { class: "mini", type: "button", "data-testid": testid, title, onclick }, words);
    this.surfaceButton = button(
      "reach-surface",
      "the positions of the point that straight ways from home reach",
      "surface",
      () => this.toggleSurface(),
    );
    this.surfaceButton.setAttribute("aria-pressed", "true");
    this.place(button);
  }

  /** Puts the parts of the panel where they belong. */
  place(button) {
    byId("reach").replaceChildren(
      element(
        "div",
        { class: "live-panel" },
        element(
          "div",
          { class: "live-head" },
          button("reach-home", "lengths and pose of home", "home", () => this.toHome()),
          button("reach-run", "the pose of the recorded run at its time", "from the run", () =>
            this.fromRun(),
          ),
          this.page.scene.solid && this.surfaceButton,
        ),
        element("h3", {}, "Leg lengths"),
        this.sliders.map(({ node }) => node),
        this.way,
        this.count,
        this.note,
      ),
    );
    byId("travels").replaceChildren(
      element(
        "section",
        {},
        element("h3", {}, "Poses of these lengths"),
        element("div", { class: "scroll poses-scroll" }, this.table()),
      ),
      element("section", {}, element("h3", {}, "Travel of each axis, the others at home"), this.bars),
    );
  }

  table() {
    const head = COMPONENTS.map((name, component) =>
      element("th", { scope: "col" }, name, element("span", { class: "unit" }, unit(this.unitOf(component)))),
    );
    return element(
      "table",
      { class: "poses" },
      element("thead", {}, element("tr", {}, element("th", { scope: "col" }, "pose"), head)),
      this.list,
    );
  }

  /** The lengths of the sliders, in the core's units. */
  get lengths() {
    return this.sliders.map(({ value }) => value / this.study.factor("length"));
  }

  // ---- questions: one at a time, of those that wait the latest ----

  ask(kind, more) {
    const order = { kind, ...more };
    if (this.busy) this.waiting = order;
    else this.send(order);
  }

  send(order) {
    this.busy = true;
    this.worker.postMessage(order);
  }

  toHome() {
    this.ask("place", { pose: [0, 0, this.study.machine.height / this.study.factor("length"), 0, 0, 0] });
  }

  /** The recorded pose at the page's time, or home where nothing is recorded. */
  fromRun() {
    const { run, lastTime } = this.study;
    if (!run.rows) return this.toHome();
    const time = Math.min(this.page.player.time, lastTime);
    const pose = FROM_RUN.map(
      (name, place) => run.value(name, time) / this.study.factor(place < 3 ? "length" : "angle"),
    );
    return this.ask("place", { pose });
  }

  // ---- answers ----

  hear(data) {
    const hearers = {
      ready: ({ known }) => this.know(known),
      poses: (answer) => this.take(answer),
      travel: ({ component, travel }) => {
        this.travel[component] = travel;
        this.drawBars();
      },
      surface: (surface) => {
        this.surface = surface;
        this.show();
        document.documentElement.dataset.surface = "true";
      },
      failed: ({ message }) => this.fail(message),
    };
    hearers[data.kind](data);
  }

  fail(message) {
    this.busy = false;
    this.note.textContent = message || "The thread of the searches could not be started.";
  }

  know(known) {
    this.known = known;
    this.note.textContent = known.refused;
    const factor = this.study.factor("length");
    this.sliders.forEach((slider, leg) => {
      const [least, greatest] = known.lengths[leg];
      if (least > 0) slider.spec.least = least * factor;
      if (Number.isFinite(greatest)) slider.spec.greatest = greatest * factor;
    });
  }

  take(answer) {
    this.busy = false;
    this.answer = answer;
    if (!this.waiting && answer.because !== "follow")
      this.sliders.forEach((slider, leg) => slider.set(answer.length[leg] * this.study.factor("length")));
    this.count.textContent = countWords(answer.found);
    this.way.textContent = wayWords(answer);
    this.way.classList.toggle("state", Boolean(answer.followed.refused));
    this.listPoses();
    this.drawBars();
    this.show();
    if (this.waiting) {
      const order = this.waiting;
      this.waiting = null;
      this.send(order);
    }
  }

  listPoses() {
    const { found, length } = this.answer;
    this.list.replaceChildren(
      ...found.poses.map((pose, index) =>
        element(
          "tr",
          { class: pose.present ? "present" : undefined },
          element(
            "th",
            { scope: "row" },
            element(
              "button",
              {
                class: "mini",
                type: "button",
                "aria-pressed": String(pose.present),
                title: "the machine stands in this pose",
                onclick: () => this.ask("take", { index, length }),
              },
              element("i", { class: sameSide(pose, this.known) ? "side" : "side other" }),
              String(index + 1),
            ),
          ),
          pose.components.map((value, component) =>
            element("td", {}, this.said(component, value, 3)),
          ),
        ),
      ),
    );
  }

  drawBars() {
    const present = this.answer?.present.components;
    this.bars.replaceChildren(
      ...this.travel.map((travel, component) => {
        const [least, greatest] = travel.ends;
        const span = greatest - least || 1;
        const share = (value) => {
          const part = (value - least + BEYOND * span) / (span * (1 + 2 * BEYOND));
          return `${(100 * Math.min(Math.max(part, 0), 1)).toFixed(2)}%`;
        };
        const [low, high] = travel.bindings;
        const colour = ({ limit, which }) =>
          endWords({ limit, which }).leg ? LEGS[which] : "var(--grey)";
        const words = (end) =>
          `${number(this.own(component, travel.ends[end]), 4)}${unitAfter(this.unitOf(component))}`;
        return element(
          "li",
          { "data-testid": `travel-${COMPONENTS[component]}` },
          element("b", {}, COMPONENTS[component]),
          element("span", {}, words(0)),
          element("span", {}, words(1)),
          element(
            "div",
            {
              class: "travel-rail",
              style: {
                "--from": share(least),
                "--to": share(greatest),
                "--home": share(0),
                "--low": colour(low),
                "--high": colour(high),
              },
            },
            element("i", { class: "travel-bar" }),
            element("i", { class: "travel-home", title: "home" }),
            present &&
              element("i", {
                class: "travel-now",
                title: `now ${this.said(component, present[component], 4)}${unitAfter(this.unitOf(component))}`,
                style: { left: share(present[component]) },
              }),
          ),
          element("small", {}, endWords(low).text),
          element("small", {}, endWords(high).text),
        );
      }),
    );
  }

  // ---- the scene ----

  toggleSurface() {
    this.surfaceShown = !this.surfaceShown;
    this.surfaceButton.setAttribute("aria-pressed", String(this.surfaceShown));
    this.show();
  }

  /** A pose of the core in the study's units. */
  placedPose({ position, rotation }) {
    return { position: position.map((value) => this.own(0, value)), rotation };
  }

  show() {
    const { scene } = this.page;
    if (!this.active) return;
    byId("clock").textContent = "";
    const { model } = scene.machines[0];
    // the load's ellipsoid would cover the ghosts
    scene.toggle("load", false);
    if (this.answer) {
      const { found, present } = this.answer;
      model.showPoses(
        found.poses
          .filter((pose) => !pose.present)
          .map((pose) => ({ ...this.placedPose(pose), other: !sameSide(pose, this.known) })),
      );
      scene.move([{ pose: this.placedPose(present), forces: NO_FORCES, plan: null }]);
    } else {
      const { height } = this.study.machine;
      scene.move([{ pose: poseOf([0, 0, height, 0, 0, 0], 1), forces: NO_FORCES, plan: null }]);
    }
    const { surface, known } = this;
    model.showSurface(
      surface && this.surfaceShown
        ? { ...surface, point: known.point.map((value) => this.own(0, value)), scale: this.own(0, 1) }
        : null,
    );
    scene.paint();
  }

  /** What the colours of the scene mean here. */
  legend() {
    const sides = [
      ["side", "other poses, sign of the determinant as at home"],
      ["side other", MIRRORED],
    ];
    const lines = [
      ...sides.map(([name, words]) => element("span", { class: "legend-line" }, element("i", { class: name }), words)),
      this.page.scene.solid && element(
        "span",
        { class: "legend-line" },
        "surface: where straight ways of the moved point end, in the colour of the leg that ends them",
      ),
    ];
    return lines.filter(Boolean);
  }

  repaint() {
    this.show();
  }
}
