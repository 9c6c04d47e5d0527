// The last stretch of a live run as it goes: how far the top is from its program, and the leg forces.
import uPlot from "uplot";
import { LEGS, plain, studyColor } from "./color.js";
import { element, themed } from "./dom.js";
import { labelRoom, ticks, unit } from "./format.js";

/** An axis is at least so many times as wide as the error of the run: errors lie on a straight line. */
const LEAST_WIDTH = 100;

/** Points that a strip holds at most. */
const POINTS = 1600;
/** Height of a strip in pixels, and the least time between two drawings in milliseconds. */
const STRIP = 175;
const PAUSE = 40;
/** What a strip says where all its numbers lie within the errors of the run. */
const NARROW = "the scale is no finer than the accuracy of the run";

/** The range of an ordinate, and whether it is as narrow as the accuracy of the run allows. */
function rangeOf(least, greatest, noise) {
  const floor = LEAST_WIDTH * noise;
  if (least === null) return { range: [0, floor || 1], narrow: false };
  if (greatest - least > floor)
    return { range: uPlot.rangeNum(least, greatest, 0.1, true), narrow: false };
  const half = Math.max(floor, 1e-9 * Math.max(Math.abs(least), Math.abs(greatest)), 1e-300) / 2;
  const middle = (least + greatest) / 2;
  return {
    range: least >= 0 && middle < half ? [0, 2 * half] : [middle - half, middle + half],
    narrow: true,
  };
}

/** How a strip is drawn: the last `window` of time, in a given width. */
function optionsOf(series, window, width, noise) {
  const axis = {
    stroke: themed("--muted"),
    grid: { stroke: themed("--rule"), width: 1 },
    ticks: { show: false },
    font: "11px system-ui, sans-serif",
  };
  return {
    width,
    height: STRIP,
    pxAlign: false,
    legend: { show: false },
    cursor: { show: false },
    padding: [8, 10, 0, 0],
    scales: {
      x: {
        time: false,
        range: (_, least, greatest) =>
          least === null ? [0, 1] : [Math.max(0, greatest - window), Math.max(greatest, window)],
      },
      y: { range: (_, least, greatest) => rangeOf(least, greatest, noise).range },
    },
    axes: [
      { ...axis, size: 26, values: (_, values) => ticks(values) },
      {
        ...axis,
        size: (_, labels) => labelRoom(labels, 58),
        values: (_, values) => ticks(values),
      },
    ],
    series: [
      {},
      ...series.map(({ color }) => ({
        stroke: plain(color),
        width: 1.5,
        points: { show: false },
      })),
    ],
  };
}

export class Strips {
  /** @param host element; @param study for its units; @param window length of time shown. */
  constructor(host, study, window) {
    Object.assign(this, { host, study, window });
    this.clear();
    this.build();
  }

  clear() {
    this.samples = {
      t: [],
      off: [],
      drives: LEGS.map(() => []),
      legs: LEGS.map(() => []),
    };
  }

  /** Time between samples that is fine enough for the drawing. */
  get grain() {
    return (2 * this.window) / POINTS;
  }

  build() {
    const { host, study } = this;
    this.strips?.forEach(({ plot }) => plot.destroy());
    const strip = (title, column, series, id, ...tools) => {
      const unitText = study.unit(column);
      const noise = study.noise(column);
      const said = element("span", { class: "unit", hidden: true }, NARROW);
      const box = element("div", { class: "plot" });
      host.append(
        element(
          "figure",
          { class: "curve strip", "data-testid": id },
          element(
            "figcaption",
            {},
            element("h3", {}, title),
            unit(unitText) && element("span", { class: "unit" }, unit(unitText)),
            said,
            ...tools,
          ),
          box,
        ),
      );
      const options = optionsOf(series, this.window, box.clientWidth || 400, noise);
      const plot = new uPlot(options, [[], ...series.map(() => [])], box);
      return { plot, box, series, noise, said };
    };
    host.replaceChildren();
    this.strips = [
      strip(
        "Off the program",
        "ex",
        [{ color: studyColor(0), of: () => this.samples.off }],
        "strip-deviation",
      ),
      strip(
        this.names[this.shown ?? "drives"],
        "f1",
        LEGS.map((color, leg) => ({ color, of: () => this.samples[this.shown ?? "drives"][leg] })),
        "strip-forces",
        study.machine.legs_take_force && this.switch(),
      ),
    ];
  }

  /** What the forces are called: without friction, drives and legs have the same. */
  get names() {
    return this.study.machine.legs_take_force
      ? { drives: "Drive forces", legs: "Leg forces" }
      : { drives: "Leg forces" };
  }

  /** A button that changes between the forces of the drives and those in the legs. */
  switch() {
    const other = { drives: "legs", legs: "drives" };
    const change = () => {
      this.shown = other[this.shown ?? "drives"];
      this.build();
      this.drawn = 0;
      this.draw();
    };
    return element(
      "button",
      {
        class: "mini",
        type: "button",
        "data-testid": "strip-switch",
        title: "friction is what drive forces and leg forces differ by",
        onclick: change,
      },
      `show ${this.names[other[this.shown ?? "drives"]].toLowerCase()}`,
    );
  }

  /** Takes a sample: t, distance from the program, six forces of the drives and six in the legs. */
  take([t, off, ...forces]) {
    // a run that began again
    if (t < this.samples.t[this.samples.t.length - 1]) this.clear();
    const { samples } = this;
    samples.t.push(t);
    samples.off.push(off);
    LEGS.forEach((_, leg) => {
      samples.drives[leg].push(forces[leg]);
      samples.legs[leg].push(forces[LEGS.length + leg]);
    });
    while (samples.t.length > POINTS || samples.t[0] < t - this.window) {
      samples.t.shift();
      samples.off.shift();
      [...samples.drives, ...samples.legs].forEach((values) => values.shift());
    }
  }

  draw() {
    const now = performance.now();
    if (now - (this.drawn ?? 0) < PAUSE) return;
    this.drawn = now;
    for (const { plot, box, series, noise, said } of this.strips) {
      if (box.clientWidth && plot.width !== box.clientWidth)
        plot.setSize({ width: box.clientWidth, height: STRIP });
      const lines = series.map(({ of }) => of());
      plot.setData([this.samples.t, ...lines]);
      const values = lines.flat();
      const least = values.length ? Math.min(...values) : null;
      said.hidden = !rangeOf(least, Math.max(...values), noise).narrow;
    }
  }
}
