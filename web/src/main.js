// The page: reads the data, shows the study chosen (or all), and drives scene, panel and curves by one clock.
import "uplot/dist/uPlot.min.css";
import "./style.css";
import "./drawing.css";
import "./access.css";
import "./beside.css";
import "./print.css";
import { forceGradient, studyColor } from "./color.js";
import { Curves } from "./curves.js";
import { unzlibSync } from "fflate";
import { readStudies } from "./data.js";
import { complete, WHY_NOT } from "./derived.js";
import { byId, calm, element } from "./dom.js";
import { eventsOf, glowing } from "./events.js";
import { amount, causeWords, fixed, number, unitAfter } from "./format.js";
import { bindKeys } from "./keys.js";
import { Link } from "./link.js";
import { Live } from "./live.js";
import { compareNumbers, showNumbers } from "./numbers.js";
import { Player } from "./player.js";
import { bindPrint } from "./print.js";
import { Reach } from "./reach.js";
import { ComparisonPanel, StudyPanel } from "./recorded.js";
import { DrawnScene } from "./drawn_scene.js";
import { download, fileName } from "./save.js";
import { Scene } from "./scene.js";
import { Transport } from "./transport.js";

const ALL = "all";
const MODES = ["recorded", "live", "reach"];
const FORCES = ["f1", "f2", "f3", "f4", "f5", "f6"];
class Page {
  constructor({ version, studies }) {
    this.version = version;
    this.studies = studies;
    this.mode = "recorded";
    this.switched = { ghost: true, paths: true, load: true, labels: true };
    this.openScene();
    this.buildHeader();
    this.buildSwitches();
    this.bindModes();
    this.link = new Link(this);
    this.section = new Curves(
      (time) => this.mode === "recorded" && this.player.seekRow(time),
      () => this.link.changed(),
    );
    this.choose(studies.length > 1 ? ALL : 0);
    bindKeys(this);
    bindPrint(this);
    this.link.bind();
    document.addEventListener("visibilitychange", () => this.live.hide(document.hidden));
    this.loop();
  }

  // ---- the scene, and what stands in its place where it cannot be ----

  openScene() {
    try {
      this.scene = new Scene(byId("view"));
    } catch {
      this.scene = new DrawnScene(byId("view"));
      byId("view").classList.add("without");
      byId("hint").after(
        element(
          "p",
          { class: "no-webgl", "data-testid": "no-webgl", role: "status" },
          "Drawn by lines: this browser does not provide WebGL.",
        ),
      );
    }
    byId("hint").textContent = this.turnHint;
    this.scene.controls.addEventListener("start", () => (byId("hint").textContent = ""));
    Object.entries({ tabindex: "0", role: "application", "aria-roledescription": "view of the machine" }).forEach(
      ([name, value]) => this.scene.canvas.setAttribute(name, value),
    );
  }

  /** How the view is turned, in words. */
  get turnHint() {
    return matchMedia("(pointer: coarse)").matches
      ? "two fingers turn and zoom"
      : "drag to turn · wheel to zoom";
  }

  // ---- what is chosen: a study, or all of them ----

  get shown() {
    return this.chosen === ALL ? this.studies : [this.studies[this.chosen]];
  }

  /** Whether one study is shown. */
  get alone() {
    return this.chosen !== ALL;
  }

  /** Whether studies of different units stand beside each other. */
  get mixed() {
    return this.shown.some((study) => !study.isLike(this.shown[0]));
  }

  choose(which) {
    this.chosen = which;
    this.live?.stop();
    this.reach?.end();
    const { shown } = this;
    const [first] = shown;
    const playing = this.player ? this.player.playing : !calm();
    const time = this.player?.time ?? 0;
    const duration = Math.max(
      ...shown.map((study) =>
        study.complete && shown.length === 1 ? study.lastTime : study.duration,
      ),
      0,
    );
    this.player = new Player(
      duration,
      Math.min(...shown.map((study) => study.simulation.output_step)),
      this.mixed ? 1 : first.factor("time"),
    );
    this.showHeader();
    this.showScene();
    this.events = which === ALL ? [] : eventsOf(first);
    this.panel =
      which === ALL
        ? new ComparisonPanel(this.studies, (index) => this.choose(index))
        : new StudyPanel(first, this.events, (event) => this.goTo(event));
    byId("recorded").replaceChildren(this.panel.node);
    this.transport = new Transport(
      byId("transport"),
      this.player,
      this.mixed ? "" : first.unit("t"),
      shown
        .filter((study) => !study.complete)
        .map((study) => ({
          time: study.end.time,
          label: `${study.label}: ${causeWords(study.end.status)}`,
        })),
      this.events,
    );
    this.live = new Live(this, first);
    this.reach = new Reach(this, first);
    byId("modes").hidden = which === ALL;
    this.setMode("recorded");
    this.player.listen(() => {
      this.moved = true;
      if (!this.player.playing) this.link.changed();
    });
    this.player.seek(Math.min(time, duration));
    if (playing) this.player.play();
    this.show();
    // the picture first, the curves as soon as it is there
    requestAnimationFrame(() => setTimeout(() => this.showCurves(which), 0));
  }

  showHeader() {
    const [first] = this.shown;
    const all = this.chosen === ALL;
    byId("title").textContent = all ? `${this.studies.length} studies side by side` : first.label;
    document.title = `${all ? `${this.studies.length} studies` : first.label} – gough`;
    document.querySelectorAll("#studies [role=tab]").forEach((tab) => {
      const selected = tab.dataset.which === String(this.chosen);
      tab.setAttribute("aria-selected", String(selected));
      tab.tabIndex = selected ? 0 : -1;
    });
    byId("summary").textContent = all
      ? this.mixed
        ? "One clock; each machine in its own units, with its program as a ghost."
        : "One clock, one scale of colours; each machine with its program as a ghost."
      : this.sentence(first);
    byId("ending").replaceChildren(
      ...this.shown
        .filter((study) => !study.complete)
        .map((study) =>
          element(
            "p",
            { class: "warning" },
            element(
              "strong",
              {},
              `${all ? `${study.label}: ` : ""}ended early at t = ${number(study.end.time, 6)}${unitAfter(study.unit("t"))}`,
            ),
            ` – ${study.end.message || causeWords(study.end.status)}`,
          ),
        ),
    );
  }

  /** The study in a line: its size, how it is held, and how well. */
  sentence(study) {
    const { control, machine, simulate } = study;
    const [stiffness, damping] = [Math.max(...control.stiffness), Math.max(...control.damping)];
    const exceptFor = machine.ignored ? ` except for ${machine.ignored}` : "";
    const off = simulate?.deviation?.position;
    const near = study.isNoise(off, "ex");
    const parts = [
      `${study.unitsSentence} · base radius ${amount(machine.base_radius, study.unit("l1"))} · `,
      study.openLoop ? "open loop" : `feedback G = ${amount(stiffness, study.gainUnit(0))}`,
      damping > 0 ? `, D = ${amount(damping, study.gainUnit(1))}` : "",
      control.sampling ? `, sampled every ${amount(control.sampling.period, study.unitOf("time"))}` : "",
      control.feedforward ? `, program forces fed forward${exceptFor}` : ", no program forces",
      near ? ", on its program to the accuracy of the run" : "",
      off > 0 && !near
        ? `, at most ${study.say(off, "ex", 3)}${unitAfter(study.unit("ex"))} off its program`
        : "",
    ];
    return parts.join("");
  }

  /** The greatest force of all studies that are shown. */
  get peak() {
    return Math.max(...this.shown.map((study) => study.peakForce));
  }

  /** What a leg's colour tells, and the ends of its scale. */
  get scale() {
    const { peak, shown } = this;
    const whose = shown.some(({ machine }) => machine.legs_take_force)
      ? "force of a drive"
      : "force in a leg";
    return {
      whose: this.mixed ? `${whose}, of each study's greatest` : whose,
      forceUnit: this.mixed ? "" : unitAfter(shown[0].unit("f1")),
      ends: this.mixed
        ? ["greatest pull", "greatest push"]
        : [`pull ${number(-peak, 3)}`, `push ${number(peak, 3)}`],
    };
  }

  /** The colours of the recorded run in words. */
  legendWords() {
    const { whose, forceUnit, ends } = this.scale;
    return `Colour of a leg (${whose}): blue is ${ends[0]}${forceUnit}, pale no force, orange ${ends[1]}${forceUnit}.`;
  }

  /** What the colours of the scene mean. */
  showLegend() {
    if (this.mode === "reach") {
      byId("legend").replaceChildren(...this.reach.legend());
      byId("legend").setAttribute("aria-label", byId("legend").textContent);
      return;
    }
    const { whose, forceUnit, ends } = this.scale;
    byId("legend").replaceChildren(
      element("span", { class: "legend-title" }, `${whose}${forceUnit && ` [${forceUnit.trim()}]`}`),
      element("i", { class: "legend-bar", style: { background: forceGradient } }),
      element(
        "span",
        { class: "legend-ends" },
        element("b", {}, ends[0]),
        element("b", {}, "0"),
        element("b", {}, ends[1]),
      ),
    );
    byId("legend").setAttribute("aria-label", this.legendWords());
  }

  showScene() {
    const { peak, shown } = this;
    this.paths = shown.map((study) => study.run.path(study.machine.center_of_mass));
    this.entries = shown.map((study, index) => ({
      machine: study.machine,
      peak: this.mixed ? study.peakForce : peak,
      accent: shown.length > 1 ? studyColor(study.index) : null,
      name: study.label,
      run: this.paths[index].points,
      plan: study.plan.path(study.machine.center_of_mass).points,
    }));
    this.scene.show(this.entries, this.mixed);
    for (const [part, visible] of Object.entries(this.switched)) this.scene.toggle(part, visible);
    this.scene.canvas.setAttribute(
      "aria-label",
      `The machine in three dimensions: ${shown.map((study) => study.label).join("; ")}. Arrow keys turn the view, \
+ and − zoom, 1 to 5 are standard views.`,
    );
  }

  // ---- header, switches, modes, keys ----

  buildHeader() {
    const tabs = this.studies.length > 1 ? [ALL, ...this.studies.keys()] : [];
    byId("studies").replaceChildren(
      ...tabs.map((which) =>
        element(
          "button",
          {
            type: "button",
            role: "tab",
            "data-which": String(which),
            "data-testid": `tab-${which}`,
            style: which === ALL ? undefined : { "--study": studyColor(which) },
            onclick: () => this.choose(which),
          },
          which === ALL ? "All" : this.studies[which].label,
        ),
      ),
    );
    byId("studies").hidden = tabs.length === 0;
    byId("studies").addEventListener("keydown", (event) => {
      const step = { ArrowRight: 1, ArrowLeft: -1 }[event.key];
      if (!step) return;
      const next = tabs[(tabs.indexOf(this.chosen) + step + tabs.length) % tabs.length];
      this.choose(next);
      byId("studies").querySelector(`[data-which="${next}"]`).focus();
    });
    byId("theme").addEventListener("click", () => this.changeTheme());
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => this.repaint());
    byId("footer").replaceChildren(
      element("span", { "data-testid": "version" }, `gough ${this.version}`),
      " · one file that needs no network; drawn with three.js and uPlot",
    );
  }

  changeTheme() {
    const root = document.documentElement;
    const dark = root.dataset.theme
      ? root.dataset.theme === "dark"
      : matchMedia("(prefers-color-scheme: dark)").matches;
    root.dataset.theme = dark ? "light" : "dark";
    this.repaint();
  }

  repaint() {
    this.scene.paint();
    this.section.repaint();
    this.live?.repaint();
    this.reach?.repaint();
  }

  buildSwitches() {
    const words = {
      ghost: ["ghost", "the program beside the actual motion (g)"],
      paths: ["path", "path of the centre of mass (p)"],
      load: ["load", "ellipsoid of the load's mass and inertia"],
      labels: ["numbers", "numbers of the legs"],
    };
    byId("switches").replaceChildren(
      ...Object.entries(words).map(([part, [word, title]]) =>
        element(
          "button",
          {
            class: "mini",
            type: "button",
            "aria-pressed": "true",
            title,
            "data-part": part,
            onclick: () => this.switchPart(part),
          },
          word,
        ),
      ),
      element(
        "button",
        {
          class: "mini",
          type: "button",
          title: "reset the view (r)",
          "data-testid": "reset-view",
          onclick: () => this.scene.resetView(),
        },
        "reset view",
      ),
      element(
        "button",
        {
          class: "mini",
          type: "button",
          title: "save the picture as PNG",
          "data-testid": "save-scene",
          onclick: () => this.savePicture(),
        },
        "PNG",
      ),
    );
  }

  switchPart(part) {
    this.switched[part] = !this.switched[part];
    byId("switches")
      .querySelector(`[data-part="${part}"]`)
      .setAttribute("aria-pressed", String(this.switched[part]));
    this.scene.toggle(part, this.switched[part]);
    this.link.changed();
  }

  async savePicture() {
    download(await this.scene.picture(), `${fileName(this.shown[0].label)}-machine.png`);
  }

  bindModes() {
    for (const mode of MODES)
      byId(`mode-${mode}`).addEventListener("click", () => this.setMode(mode));
    byId("modes").addEventListener("keydown", (event) => {
      const step = { ArrowRight: 1, ArrowLeft: -1 }[event.key];
      if (!step) return;
      const place = MODES.indexOf(this.mode) + step + MODES.length;
      this.setMode(MODES[place % MODES.length]);
      byId(`mode-${this.mode}`).focus();
    });
  }

  setMode(mode) {
    const live = mode === "live" && this.live.possible;
    const reach = mode === "reach" && this.reach.possible && this.alone;
    this.mode = live ? "live" : reach ? "reach" : "recorded";
    for (const name of MODES) {
      byId(name).hidden = name !== this.mode;
      byId(`mode-${name}`).setAttribute("aria-selected", String(name === this.mode));
      byId(`mode-${name}`).tabIndex = name === this.mode ? 0 : -1;
    }
    document.querySelector("main").dataset.mode = this.mode;
    byId("mode-live").disabled = !this.live.possible;
    byId("mode-live").title = "the simulation runs in this page";
    byId("mode-reach").disabled = !this.reach.possible;
    byId("mode-reach").title = "all poses of six leg lengths, travel of each axis, surface of the positions";
    byId("no-live").textContent = this.live.possible || !this.alone ? "" : this.live.reason;
    byId("stage").classList.toggle("live", live);
    byId("stage").classList.toggle("many", this.chosen === ALL);
    byId("hint").textContent = live ? "take the load and pull" : this.turnHint;
    byId("transport").hidden = live || reach;
    byId("strips").hidden = !live;
    byId("travels").hidden = !reach;
    byId("stage").classList.toggle("reach", reach);
    if (!live) this.live.stop();
    if (!reach) this.reach.stop();
    if (live) {
      this.player.pause();
      this.live.start();
    } else if (reach) {
      this.player.pause();
      byId("fallen").hidden = true;
      this.reach.start();
    } else {
      byId("fallen").hidden = true;
      this.showScenePaths();
      this.moved = true;
    }
    this.showLegend();
    this.scene.resize();
    this.link.changed();
  }

  showScenePaths() {
    this.scene.machines.forEach(({ model, entry }) => model.setPaths(entry.run, entry.plan));
    this.scene.fit();
  }

  // ---- curves and numbers ----

  showCurves(which) {
    if (which !== this.chosen) return;
    this.section.show(this.shown, this.player.time, this.events);
    if (this.alone) showNumbers(byId("figures"), this.shown[0]);
    else compareNumbers(byId("figures"), this.shown);
    this.link.applyCurves();
    document.documentElement.dataset.ready = "true";
  }

  // ---- time ----

  /** Goes to an event's own time, which may lie between rows. */
  goTo({ time }) {
    if (this.mode !== "recorded") return;
    this.player.pause();
    this.player.seek(time);
  }

  /** Scene, panel and cursors at the clock's time. */
  show() {
    this.moved = false;
    const { time } = this.player;
    byId("clock").textContent = `t = ${fixed(time, this.transport.decimals)}${this.transport.unit}`;
    this.panel.show(time);
    this.section.setTime(time);
    this.scene.move(this.momentsAt(time));
  }

  /** Pose, forces, program and how much of the path is drawn of each study at a time. */
  momentsAt(time) {
    return this.shown.map((study, index) => {
      const at = Math.min(time, study.lastTime);
      return {
        pose: study.run.rows ? study.run.pose(at) : study.home,
        forces: FORCES.map((name) => (study.isOver(time) ? NaN : study.run.value(name, at))),
        plan: study.plan.rows ? study.plan.pose(time) : null,
        glow: glowing(this.events, time, 0.5 * study.run.step),
        points: study.run.rows
          ? Math.floor(study.run.at(at).row / this.paths[index].stride) + 1
          : 0,
      };
    });
  }

  loop() {
    let before = performance.now();
    const frame = (now) => {
      const seconds = Math.max(0, Math.min((now - before) / 1000, 0.25));
      before = now;
      if (this.mode === "recorded") {
        this.player.advance(seconds);
        if (this.moved) this.show();
      } else if (this.mode === "live") this.live.frame();
      if (this.scene.draw(seconds) && !document.documentElement.dataset.firstPicture)
        document.documentElement.dataset.firstPicture = performance.now().toFixed(0);
      requestAnimationFrame(frame);
    };
    requestAnimationFrame(frame);
  }
}

/** Opens the page of these studies; columns that the file does not have are computed first. */
async function begin(data) {
  if (!data?.studies.length) {
    byId("title").textContent = "This is the empty template: gough report fills it.";
    return;
  }
  const thin = data.studies.filter((study) => study.at_rest);
  if (thin.length && !(await complete(thin))) {
    byId("title").textContent = WHY_NOT;
    return;
  }
  window.goughPage = new Page(data);
}

begin(readStudies(unzlibSync));
