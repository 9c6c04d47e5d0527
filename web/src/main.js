// The page: reads the data, shows the study chosen (or all), and drives scene, panel and curves by one clock.
import "uplot/dist/uPlot.min.css";
import "./style.css";
import { forceGradient, studyColor } from "./color.js";
import { csv } from "./csv.js";
import { Curve, Range } from "./curve.js";
import { readStudies } from "./data.js";
import { byId, calm, element } from "./dom.js";
import { figuresOf, figuresOfAll } from "./figures.js";
import { causeWords, fixed, number, unitAfter } from "./format.js";
import { Live } from "./live.js";
import { compareNumbers, showNumbers } from "./numbers.js";
import { Player } from "./player.js";
import { ComparisonPanel, StudyPanel } from "./recorded.js";
import { download, fileName } from "./save.js";
import { Scene } from "./scene.js";
import { bindKeys, Transport } from "./transport.js";

const ALL = "all";
const FORCES = ["f1", "f2", "f3", "f4", "f5", "f6"];
/** Points of a path that is drawn: a longer run is thinned evenly. */
const PATH_POINTS = 4000;

/** The path of the centre of mass through a table, as x, y, z, …, and how many rows lie between its points. */
function pathOf(table, machine) {
  const stride = Math.max(1, Math.ceil(table.rows / PATH_POINTS));
  const points = [];
  const c = machine.center_of_mass;
  for (let row = 0; row < table.rows; row += stride) {
    const { position: p, rotation: r } = table.pose(table.t[row]);
    points.push(p[0] + r[0] * c[0] + r[1] * c[1] + r[2] * c[2], p[1] + r[3] * c[0] + r[4] * c[1] + r[5] * c[2], p[2] + r[6] * c[0] + r[7] * c[1] + r[8] * c[2]);
  }
  return { points, stride };
}

class Page {
  constructor({ version, studies }) {
    this.version = version;
    this.studies = studies;
    this.curves = [];
    this.mode = "recorded";
    this.switched = { ghost: true, paths: true, load: true, labels: true };
    this.openScene();
    this.buildHeader();
    this.buildSwitches();
    this.bindModes();
    this.observer = new IntersectionObserver((entries) => entries.forEach(({ target, isIntersecting }) => target.curve.setVisible(isIntersecting)), { rootMargin: "200px" });
    addEventListener("resize", () => this.curves.forEach((curve) => curve.resize()));
    this.choose(studies.length > 1 ? ALL : 0);
    this.bindKeys();
    document.addEventListener("visibilitychange", () => this.live.hide(document.hidden));
    this.loop();
  }

  // ---- the scene, and what stands in its place where it cannot be ----

  openScene() {
    try {
      this.scene = new Scene(byId("view"));
      byId("hint").textContent = "drag to turn · wheel to zoom";
      this.scene.controls.addEventListener("start", () => (byId("hint").textContent = ""));
    } catch (error) {
      this.scene = null;
      byId("view").prepend(element("div", { class: "no-webgl", "data-testid": "no-webgl", role: "status" },
        element("strong", {}, "No picture of the machine: this browser gives no WebGL."),
        element("span", {}, "Curves, numbers and the live run work without it. In most browsers hardware acceleration must be switched on.")));
      byId("view").classList.add("without");
    }
  }

  // ---- what is chosen: a study, or all of them ----

  get shown() {
    return this.chosen === ALL ? this.studies : [this.studies[this.chosen]];
  }

  /** Whether studies of different units stand beside each other. */
  get mixed() {
    return this.shown.some((study) => study.units !== this.shown[0].units);
  }

  choose(which) {
    this.chosen = which;
    this.live?.stop();
    const { shown } = this;
    const [first] = shown;
    const playing = this.player ? this.player.playing : !calm();
    const time = this.player?.time ?? 0;
    const duration = Math.max(...shown.map((study) => (study.complete && shown.length === 1 ? study.lastTime : study.duration)), 0);
    this.player = new Player(duration, Math.min(...shown.map((study) => study.simulation.output_step)));
    this.showHeader();
    this.showScene();
    this.panel = which === ALL ? new ComparisonPanel(this.studies, (index) => this.choose(index)) : new StudyPanel(first);
    byId("recorded").replaceChildren(this.panel.node);
    this.transport = new Transport(byId("transport"), this.player, this.mixed ? "" : first.unit("t"),
      shown.filter((study) => !study.complete).map((study) => ({ time: study.end.time, label: `${study.label}: ${causeWords(study.end.status)}` })));
    this.live = new Live(this, first);
    byId("modes").hidden = which === ALL;
    this.setMode("recorded");
    this.player.listen(() => (this.moved = true));
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
    byId("summary").textContent = all ? this.mixed ? "One clock; each machine in its own units, with its program as a ghost." : "One clock, one scale of colours; each machine with its program as a ghost." : this.sentence(first);
    byId("ending").replaceChildren(...this.shown.filter((study) => !study.complete).map((study) =>
      element("p", { class: "warning" },
        element("strong", {}, `${all ? `${study.label}: ` : ""}ended early at t = ${number(study.end.time, 6)}${unitAfter(study.unit("t"))}`),
        ` – ${study.end.message || causeWords(study.end.status)}`)));
  }

  sentence(study) {
    const { control, machine, simulate } = study;
    const gain = Math.max(...control.stiffness);
    const law = study.openLoop ? "open loop" : `feedback G = ${number(gain, 4)}${Math.max(...control.damping) > 0 ? `, D = ${number(Math.max(...control.damping), 4)}` : ""}`;
    const off = simulate?.deviation ? `, at most ${number(simulate.deviation.position, 3)}${unitAfter(study.unit("ex"))} off its program` : "";
    return `${study.units === "si" ? "SI units" : "Dimensionless"} · base radius ${number(machine.base_radius, 4)}${unitAfter(study.unit("l1"))} · ${law}, ${control.feedforward ? "program forces fed forward" : "no program forces"}${off}`;
  }

  showScene() {
    const { shown } = this;
    const peak = Math.max(...shown.map((study) => study.peakForce));
    this.paths = shown.map((study) => pathOf(study.run, study.machine));
    const forceUnit = unitAfter(shown[0].unit("f1")).trim();
    const ends = this.mixed ? ["greatest pull", "greatest push"] : [`pull ${number(-peak, 3)}`, `push ${number(peak, 3)}`];
    byId("legend").replaceChildren(
      element("span", { class: "legend-title" }, `force in a leg${this.mixed ? ", of each study's greatest" : forceUnit && ` [${forceUnit}]`}`),
      element("i", { class: "legend-bar", style: { background: forceGradient } }),
      element("span", { class: "legend-ends" }, element("b", {}, ends[0]), element("b", {}, "0"), element("b", {}, ends[1])));
    byId("legend").setAttribute("aria-label", `Colour of a leg: blue is ${ends[0]}, pale no force, orange ${ends[1]}`);
    if (!this.scene) return;
    this.scene.show(shown.map((study, index) => ({
      machine: study.machine, peak: this.mixed ? study.peakForce : peak, accent: shown.length > 1 ? studyColor(study.index) : null, name: study.label,
      run: this.paths[index].points, plan: pathOf(study.plan, study.machine).points,
    })), this.mixed);
    for (const [part, visible] of Object.entries(this.switched)) this.scene.toggle(part, visible);
    this.scene.canvas.setAttribute("aria-label", `The machine in three dimensions: ${shown.map((study) => study.label).join("; ")}`);
  }

  // ---- header, switches, modes, keys ----

  buildHeader() {
    const tabs = this.studies.length > 1 ? [ALL, ...this.studies.keys()] : [];
    byId("studies").replaceChildren(...tabs.map((which) => element("button", {
      type: "button", role: "tab", "data-which": String(which), "data-testid": `tab-${which}`, style: which === ALL ? undefined : { "--study": studyColor(which) }, onclick: () => this.choose(which),
    }, which === ALL ? "All" : this.studies[which].label)));
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
    byId("footer").replaceChildren(element("span", { "data-testid": "version" }, `gough ${this.version}`), " · one file, no network; the data are inside");
  }

  changeTheme() {
    const root = document.documentElement;
    const dark = root.dataset.theme ? root.dataset.theme === "dark" : matchMedia("(prefers-color-scheme: dark)").matches;
    root.dataset.theme = dark ? "light" : "dark";
    this.repaint();
  }

  repaint() {
    this.scene?.paint();
    this.curves.forEach((curve) => curve.rebuild());
    this.live?.repaint();
  }

  buildSwitches() {
    const words = { ghost: ["ghost", "the program beside the actual motion (g)"], paths: ["path", "path of the centre of mass (p)"], load: ["load", "ellipsoid of the load's mass and inertia"], labels: ["numbers", "numbers of the legs"] };
    byId("switches").replaceChildren(
      ...Object.entries(words).map(([part, [word, title]]) => element("button", { class: "mini", type: "button", "aria-pressed": "true", title, "data-part": part, onclick: () => this.switchPart(part) }, word)),
      element("button", { class: "mini", type: "button", title: "reset the view (r)", "data-testid": "reset-view", onclick: () => this.scene?.resetView() }, "reset view"),
      element("button", { class: "mini", type: "button", title: "save the picture as PNG", "data-testid": "save-scene", onclick: () => this.savePicture() }, "PNG"),
    );
    if (!this.scene) byId("switches").hidden = true;
  }

  switchPart(part) {
    this.switched[part] = !this.switched[part];
    byId("switches").querySelector(`[data-part="${part}"]`).setAttribute("aria-pressed", String(this.switched[part]));
    this.scene?.toggle(part, this.switched[part]);
  }

  async savePicture() {
    if (this.scene) download(await this.scene.picture(), `${fileName(this.shown[0].label)}-machine.png`);
  }

  bindModes() {
    for (const mode of ["recorded", "live"]) byId(`mode-${mode}`).addEventListener("click", () => this.setMode(mode));
    byId("modes").addEventListener("keydown", (event) => {
      if (event.key !== "ArrowLeft" && event.key !== "ArrowRight") return;
      this.setMode(this.mode === "live" ? "recorded" : "live");
      byId(`mode-${this.mode}`).focus();
    });
  }

  setMode(mode) {
    const live = mode === "live" && this.live.possible;
    this.mode = live ? "live" : "recorded";
    for (const name of ["recorded", "live"]) {
      byId(name).hidden = name !== this.mode;
      byId(`mode-${name}`).setAttribute("aria-selected", String(name === this.mode));
      byId(`mode-${name}`).tabIndex = name === this.mode ? 0 : -1;
    }
    byId("mode-live").disabled = !this.live.possible;
    byId("mode-live").title = this.live.possible ? "the simulation runs here, under your hands" : this.live.reason;
    byId("stage").classList.toggle("live", live);
    byId("stage").classList.toggle("many", this.chosen === ALL);
    if (live && this.scene) byId("hint").textContent = "take the load and pull";
    byId("transport").hidden = live;
    byId("strips").hidden = !live;
    if (live) {
      this.player.pause();
      this.live.start();
    } else {
      this.live.stop();
      byId("fallen").hidden = true;
      if (this.scene) this.showScenePaths();
      this.moved = true;
    }
    this.scene?.resize();
  }

  showScenePaths() {
    this.scene.machines.forEach(({ model, entry }) => model.setPaths(entry.run, entry.plan));
    this.scene.resetView();
  }

  bindKeys() {
    const recorded = (action) => (event) => this.mode === "recorded" && action(event);
    const actions = [
      { keys: [" "], say: "space", does: "play or pause", run: () => (this.mode === "live" ? this.live.toggle() : this.player.toggle()) },
      { keys: ["ArrowRight"], say: "→", does: "a row on (with shift: ten)", run: recorded((event) => this.player.stepRows(event.shiftKey ? 10 : 1)) },
      { keys: ["ArrowLeft"], say: "←", does: "a row back (with shift: ten)", run: recorded((event) => this.player.stepRows(event.shiftKey ? -10 : -1)) },
      { keys: ["Home"], say: "home", does: "to the start; live: start again", run: () => (this.mode === "live" ? this.live.restart() : this.player.seek(0)) },
      { keys: ["End"], say: "end", does: "to the end", run: recorded(() => this.player.seek(this.player.duration)) },
      { keys: ["]", "+"], say: "]", does: "faster", run: recorded(() => this.transport.faster(1)) },
      { keys: ["[", "-"], say: "[", does: "slower", run: recorded(() => this.transport.faster(-1)) },
      { keys: ["r"], say: "r", does: "reset the view", run: () => this.scene?.resetView() },
      { keys: ["g"], say: "g", does: "the program's ghost", run: () => this.switchPart("ghost") },
      { keys: ["p"], say: "p", does: "the path", run: () => this.switchPart("paths") },
      { keys: ["l"], say: "l", does: "live or recorded", run: () => this.chosen !== ALL && this.setMode(this.mode === "live" ? "recorded" : "live") },
      { keys: ["?"], say: "?", does: "these keys", run: () => byId("keys").showModal() },
    ];
    byId("keys").replaceChildren(
      element("h2", {}, "Keys"), element("dl", {}, actions.map(({ say, does }) => [element("dt", {}, element("kbd", {}, say)), element("dd", {}, does)])),
      element("p", { class: "note" }, "Mouse: drag to turn, wheel to zoom, right button to shift. In a curve: point to see that moment, drag to zoom, double-click for all of it. Live: take the load and pull."),
      element("form", { method: "dialog" }, element("button", { class: "mini" }, "close")));
    byId("keys-open").addEventListener("click", () => byId("keys").showModal());
    bindKeys(actions);
  }

  // ---- curves and numbers ----

  showCurves(which) {
    if (which !== this.chosen) return;
    const { shown } = this;
    this.curves.forEach((curve) => curve.dispose());
    this.range = new Range(0, Math.max(...shown.map((study) => study.duration), 1e-9));
    const specs = which === ALL ? figuresOfAll(shown) : figuresOf(shown[0]);
    const shared = {
      timeUnit: shown[0].unit("t"), study: which === ALL ? "comparison" : shown[0].label,
      onSeek: (time, clicked) => {
        if (this.mode === "live" || (this.player.playing && !clicked)) return;
        this.player.seekRow(time);
      },
    };
    this.curves = specs.map((spec) => new Curve(spec, this.range, shared));
    byId("grid").replaceChildren(...this.curves.map((curve) => curve.card));
    this.observer.disconnect();
    this.curves.forEach((curve) => {
      curve.card.curve = curve;
      this.observer.observe(curve.card);
    });
    this.buildCurveTools(which);
    if (which === ALL) compareNumbers(byId("figures"), shown);
    else showNumbers(byId("figures"), shown[0]);
    this.curves.forEach((curve) => curve.setTime(this.player.time));
    document.documentElement.dataset.ready = "true";
  }

  buildCurveTools(which) {
    const tools = [];
    const button = (words, title, action, attributes = {}) => element("button", { class: "mini", type: "button", title, onclick: action, ...attributes }, words);
    if (which !== ALL) {
      const legs = [1, 2, 3, 4, 5, 6].map((leg) => {
        const node = button(String(leg), `leg ${leg} in all curves: show or hide`, () => {
          const visible = node.getAttribute("aria-pressed") !== "true";
          node.setAttribute("aria-pressed", String(visible));
          for (const curve of this.curves) curve.show(curve.spec.lines.filter((line) => line.leg === leg && (!line.program || !visible || this.planned)), visible);
        }, { "aria-pressed": "true", "data-testid": `leg-${leg}`, class: "mini leg-toggle", style: { "--leg": `var(--leg-${leg})` } });
        return node;
      });
      const plan = button("program", "the program's lines beside the actual ones", () => {
        this.planned = !this.planned;
        plan.setAttribute("aria-pressed", String(this.planned));
        for (const curve of this.curves) curve.show(curve.spec.lines.filter((line) => line.program), this.planned);
      }, { "aria-pressed": "false" });
      this.planned = false;
      tools.push(element("span", { class: "group", role: "group", "aria-label": "Legs" }, element("span", { class: "word" }, "legs"), ...legs), plan);
    }
    const all = button("whole range", "the whole range of time (double-click in a curve)", () => this.range.reset(), { "data-testid": "whole-range", disabled: true });
    this.range.listeners.add(() => (all.disabled = !this.range.zoomed));
    tools.push(all);
    for (const study of this.shown) tools.push(this.saveButtons(study));
    byId("curve-tools").replaceChildren(...tools);
  }

  saveButtons(study) {
    const several = this.shown.length > 1;
    const save = (table, kind) => () => download(csv(table.names.map((name) => ({ name, values: table.column(name) }))), `${fileName(study.label)}-${kind}.csv`, "text/csv");
    return element(
      "span", { class: "group" },
      several && element("span", { class: "word" }, study.label),
      element("button", { class: "mini", type: "button", "data-testid": `save-run-${study.index}`, title: "the table of the run, all rows, all digits", onclick: save(study.run, "run") }, "run CSV"),
      element("button", { class: "mini", type: "button", "data-testid": `save-program-${study.index}`, title: "the table of the program", onclick: save(study.plan, "program") }, "program CSV"));
  }

  // ---- time ----

  /** Scene, panel and cursors at the clock's time. */
  show() {
    this.moved = false;
    const { time } = this.player;
    byId("clock").textContent = `t = ${fixed(time, this.transport.decimals)}${this.transport.unit}`;
    this.panel.show(time);
    for (const curve of this.curves) curve.setTime(time);
    this.scene?.move(this.shown.map((study, index) => {
      const at = Math.min(time, study.lastTime);
      return {
        pose: study.run.rows ? study.run.pose(at) : null, forces: FORCES.map((name) => study.run.value(name, at)),
        plan: study.plan.rows ? study.plan.pose(time) : null,
        points: study.run.rows ? Math.floor(study.run.at(at).row / this.paths[index].stride) + 1 : 0,
      };
    }));
  }

  loop() {
    let before = performance.now();
    const frame = (now) => {
      const seconds = Math.min((now - before) / 1000, 0.25);
      before = now;
      if (this.mode === "recorded") {
        this.player.advance(seconds);
        if (this.moved) this.show();
      } else this.live.frame();
      if (this.scene?.draw() && !document.documentElement.dataset.firstPicture) document.documentElement.dataset.firstPicture = performance.now().toFixed(0);
      requestAnimationFrame(frame);
    };
    requestAnimationFrame(frame);
  }
}

const data = readStudies();
if (data?.studies.length) window.goughPage = new Page(data);
else byId("title").textContent = "This is the empty template: gough report fills it.";
