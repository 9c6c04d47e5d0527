// The section of curves: the figures of what is shown, with one range of time, one cursor and tools for all of them.
import { LEGS } from "./color.js";
import { csv } from "./csv.js";
import { Curve, Range } from "./curve.js";
import { byId, element } from "./dom.js";
import { figuresOf, figuresOfAll } from "./figures.js";
import { download, fileName } from "./save.js";

/** A small button of the tools. */
const button = (words, title, action, attributes = {}) =>
  element(
    "button",
    { class: "mini", type: "button", title, onclick: action, ...attributes },
    words,
  );

export class Curves {
  /** @param onSeek called with a time that the reader chooses; @param onChange after a change of what is shown. */
  constructor(onSeek, onChange) {
    this.onSeek = onSeek;
    this.onChange = onChange;
    this.curves = [];
    // a figure is drawn when it comes near the window
    this.observer = new IntersectionObserver(
      (entries) =>
        entries.forEach(({ target, isIntersecting }) => target.curve.setVisible(isIntersecting)),
      { rootMargin: "200px" },
    );
    addEventListener("resize", () => this.curves.forEach((curve) => curve.resize()));
  }

  /** Shows the figures of a study, or those that compare several. */
  show(shown, time, events = []) {
    this.shown = shown;
    this.curves.forEach((curve) => curve.dispose());
    this.range = new Range(0, Math.max(...shown.map((study) => study.duration), 1e-9));
    const specs = shown.length === 1 ? figuresOf(shown[0]) : figuresOfAll(shown);
    const shared = {
      events,
      timeUnit: shown[0].unit("t"),
      study: shown.length === 1 ? shown[0].label : "comparison",
      onSeek: this.onSeek,
      onPoint: (pointed) => this.curves.forEach((curve) => curve.point(pointed)),
    };
    this.curves = specs.map((spec) => new Curve(spec, this.range, shared));
    byId("grid").replaceChildren(...this.curves.map((curve) => curve.card));
    this.observer.disconnect();
    this.curves.forEach((curve) => {
      curve.card.curve = curve;
      this.observer.observe(curve.card);
    });
    this.range.listeners.add(this.onChange);
    this.buildTools();
    this.setTime(time);
  }

  setTime(time) {
    for (const curve of this.curves) curve.setTime(time);
  }

  repaint() {
    for (const curve of this.curves) curve.rebuild();
  }

  buildTools() {
    byId("curve-tools").replaceChildren(
      ...(this.shown.length === 1 ? this.lineTools() : []),
      this.wholeRangeButton(),
      ...this.shown.map((study) => this.saveButtons(study)),
    );
  }

  /** The tools that show and hide lines of a single study. */
  lineTools() {
    this.planned = false;
    return [
      element(
        "span",
        { class: "group", role: "group", "aria-label": "Legs" },
        element("span", { class: "word" }, "legs"),
        ...[1, 2, 3, 4, 5, 6].map((leg) => this.legButton(leg)),
      ),
      this.programButton(),
    ];
  }

  /** The legs that are switched off, 1 … 6. */
  get hiddenLegs() {
    return [...byId("curve-tools").querySelectorAll(".leg-toggle")]
      .filter((node) => node.getAttribute("aria-pressed") === "false")
      .map((node) => Number(node.textContent));
  }

  /** Switches off these legs and no others. */
  hideLegs(hidden) {
    for (const node of byId("curve-tools").querySelectorAll(".leg-toggle"))
      if ((node.getAttribute("aria-pressed") === "true") === hidden.includes(Number(node.textContent)))
        node.click();
  }

  /** Shows or hides a leg in all figures; its program's lines are shown only while `planned` is set. */
  legButton(leg) {
    const toggle = () => {
      const visible = node.getAttribute("aria-pressed") !== "true";
      node.setAttribute("aria-pressed", String(visible));
      for (const curve of this.curves)
        curve.show(
          curve.spec.lines.filter(
            (line) => line.leg === leg && (!line.program || !visible || this.planned),
          ),
          visible,
        );
      this.onChange();
    };
    const node = button(String(leg), `leg ${leg} in all curves: show or hide`, toggle, {
      "aria-pressed": "true",
      "aria-label": `leg ${leg}`,
      "data-testid": `leg-${leg}`,
      class: "mini leg-toggle",
      style: { "--leg": LEGS[leg - 1] },
    });
    return node;
  }

  /** Shows or hides the program's lines in all figures. */
  programButton() {
    const toggle = () => {
      this.planned = !this.planned;
      node.setAttribute("aria-pressed", String(this.planned));
      for (const curve of this.curves)
        curve.show(
          curve.spec.lines.filter((line) => line.program),
          this.planned,
        );
    };
    const node = button("program", "the program's lines as well as the actual ones", toggle, {
      "aria-pressed": "false",
    });
    return node;
  }

  /** Shows the full range of time again; disabled while nothing is zoomed. */
  wholeRangeButton() {
    const node = button(
      "whole range",
      "the full range of time (double-click in a curve)",
      () => this.range.reset(),
      { "data-testid": "whole-range", disabled: true },
    );
    this.range.listeners.add(() => (node.disabled = !this.range.zoomed));
    return node;
  }

  saveButtons(study) {
    const several = this.shown.length > 1;
    const save = (table, kind) => () =>
      download(
        csv(table.names.map((name) => ({ name, values: table.column(name) }))),
        `${fileName(study.label)}-${kind}.csv`,
        "text/csv",
      );
    return element(
      "span",
      { class: "group" },
      several && element("span", { class: "word" }, study.label),
      element(
        "button",
        {
          class: "mini",
          type: "button",
          "data-testid": `save-run-${study.index}`,
          title: "the table of the run, with all rows and digits",
          onclick: save(study.run, "run"),
        },
        "run CSV",
      ),
      element(
        "button",
        {
          class: "mini",
          type: "button",
          "data-testid": `save-program-${study.index}`,
          title: "the table of the program",
          onclick: save(study.plan, "program"),
        },
        "program CSV",
      ),
    );
  }
}
