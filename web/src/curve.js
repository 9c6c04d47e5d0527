// One figure of curves: a card with heading, key with the values of the moment, and uPlot below. All figures share the range of
// time (zoom) and the cursor.
import uPlot from "uplot";
import { plain } from "./color.js";
import { element, themed } from "./dom.js";
import { known, labelRoom, number, powers, ticks, unit, unitAfter } from "./format.js";
import { download, fileName } from "./save.js";
import { printedSvg, svgOf } from "./svg.js";
import { lowerBound, thin } from "./thin.js";

/** The common range of time; null is all of it. */
export class Range {
  constructor(from, to) {
    this.whole = [from, to];
    this.shown = [from, to];
    this.listeners = new Set();
  }

  set(from, to) {
    this.shown = [Math.max(from, this.whole[0]), Math.min(to, this.whole[1])];
    for (const listener of this.listeners) listener();
  }

  reset() {
    this.set(...this.whole);
  }

  get zoomed() {
    return this.shown[0] > this.whole[0] || this.shown[1] < this.whole[1];
  }
}

/** The height of a plot in pixels. */
const HEIGHT = 210;

/** Powers of ten between two numbers, not more than eight. */
function decades(least, greatest) {
  const [low, high] = [
    Math.ceil(Math.log10(least) - 1e-9),
    Math.floor(Math.log10(greatest) + 1e-9),
  ];
  const step = Math.max(1, Math.ceil((high - low) / 7));
  const powersOfTen = [];
  for (let power = low; power <= high; power += step) powersOfTen.push(10 ** power);
  return powersOfTen;
}

export class Curve {
  /** @param spec {id, title, unit, note, noise, limits: [{value, beyond}],
   *  lines: [{label, name, color, t, y, leg, dash, width, off}]}: arrays of a line are as long as its t; `off` lines are shown
   *  on demand. @param range common Range; @param onSeek called with a time that the reader chooses, and @param onPoint
   *  with one that the pointer is at, or null; @param timeUnit of the abscissa. */
  constructor(spec, range, { events, onSeek, onPoint, timeUnit, study }) {
    // a table may lack a column that a run of another kind has
    this.spec = { ...spec, lines: spec.lines.filter((line) => line.y) };
    this.range = range;
    this.onSeek = onSeek;
    this.onPoint = onPoint;
    this.events = events.filter(({ figure }) => !figure || figure === spec.id);
    this.timeUnit = timeUnit;
    this.study = study;
    this.logarithmic = Boolean(spec.logarithmic);
    this.noise = spec.noise ?? 0;
    this.hidden = new Set(this.spec.lines.filter((line) => line.off));
    this.time = 0;
    this.pointed = null;
    this.visible = false;
    this.stale = true;
    this.build();
    range.listeners.add((this.onRange = () => this.refresh()));
  }

  build() {
    const { spec } = this;
    const unitWords = unit(spec.unit);
    this.plotHost = element("div", { class: "plot", role: "img", "aria-label": this.spoken() });
    this.buildKey();
    this.logButton = this.logarithmicButton();
    this.card = element(
      "figure",
      {
        class: `curve${spec.wide ? " wide" : ""}`,
        id: `curve-${spec.id}`,
        "data-testid": `curve-${spec.id}`,
      },
      element(
        "figcaption",
        {},
        element("h3", {}, spec.title),
        unitWords && element("span", { class: "unit" }, unitWords),
        element(
          "span",
          { class: "acts" },
          spec.logable && this.logButton,
          spec.limits?.length > 0 && this.limitsButton(),
          this.saveButton("PNG", () => this.savePng()),
          this.saveButton("SVG", () => this.saveSvg()),
        ),
      ),
      spec.note && element("p", { class: "note" }, spec.note),
      this.key,
      this.plotHost,
    );
    spec.lines.forEach((line) => this.mark(line));
  }

  /** Makes the key: a chip for each line, with the line's value at the cursor. */
  buildKey() {
    const { lines } = this.spec;
    this.values = lines.map((line) => this.valueBox(line));
    lines.forEach((line, index) => (line.chip = this.chip(line, this.values[index])));
    this.key = element(
      "div",
      { class: "key" },
      lines.map((line) => line.chip),
    );
  }

  /** Where the key shows a line's value. */
  valueBox(line) {
    return element("output", {
      class: "value",
      "data-testid": `value-${this.spec.id}-${line.name ?? line.label}`,
    });
  }

  /** The button of the key that shows or hides a line. */
  chip(line, value) {
    return element(
      "button",
      {
        class: line.program ? "chip plan" : "chip",
        type: "button",
        "aria-pressed": "true",
        title: `${line.long ?? line.label}: show or hide`,
        style: { "--mark": line.color },
        onclick: () => this.show([line], this.hidden.has(line)),
      },
      element("i", { class: line.dash ? "swatch dashed" : "swatch" }),
      element("span", {}, line.label),
      value,
    );
  }

  logarithmicButton() {
    return element(
      "button",
      {
        class: "mini",
        type: "button",
        "aria-pressed": String(this.logarithmic),
        title: "magnitudes on a logarithmic axis",
        onclick: () => this.setLogarithmic(!this.logarithmic),
      },
      "log",
    );
  }

  saveButton(kind, action) {
    return element(
      "button",
      {
        class: "mini",
        type: "button",
        title: `save this figure as ${kind}`,
        "data-testid": `save-${kind.toLowerCase()}-${this.spec.id}`,
        onclick: action,
      },
      kind,
    );
  }

  limitsButton() {
    const words = this.spec.limits
      .map(({ value }) => `${number(value)}${unitAfter(this.spec.unit)}`)
      .join(" and ");
    const button = element(
      "button",
      {
        class: "mini",
        type: "button",
        "aria-pressed": "false",
        title: `the limits, ${words}, within the picture`,
        "data-testid": `limits-${this.spec.id}`,
      },
      "limits",
    );
    button.addEventListener("click", () => {
      this.allLimits = !this.allLimits;
      button.setAttribute("aria-pressed", String(this.allLimits));
      this.refresh();
    });
    return button;
  }

  /** For a screen reader: what is drawn, between what. */
  spoken() {
    const { lines, title, unit: unitText } = this.spec;
    const parts = lines.slice(0, 8).map((line) => {
      let least = Infinity;
      let greatest = -Infinity;
      for (const value of line.y) {
        if (value < least) least = value;
        if (value > greatest) greatest = value;
      }
      return `${line.label} from ${known(least, this.noise, 3)} to ${known(greatest, this.noise, 3)}`;
    });
    return `${title} against time${unit(unitText) ? ` in ${unit(unitText)}` : ""}: ${parts.join("; ")}`;
  }

  mark(line) {
    line.chip.setAttribute("aria-pressed", String(!this.hidden.has(line)));
  }

  /** Shows or hides lines. */
  show(lines, visible) {
    for (const line of lines) {
      if (visible) this.hidden.delete(line);
      else this.hidden.add(line);
      this.mark(line);
    }
    this.refresh();
  }

  setLogarithmic(logarithmic) {
    this.logarithmic = logarithmic;
    this.logButton.setAttribute("aria-pressed", String(logarithmic));
    this.rebuild();
  }

  get shownLines() {
    return this.spec.lines.filter((line) => !this.hidden.has(line));
  }

  /** Whether the axis is drawn as a logarithmic one: not where there is nothing but noise, which lies at zero. */
  get byDecades() {
    this.signal ??= this.spec.lines.some((line) =>
      line.y.some((value) => Math.abs(value) > this.noise),
    );
    return this.logarithmic && this.signal;
  }

  /** What is drawn: thinned lines over one abscissa. */
  data() {
    const [from, to] = this.range.shown;
    const buckets = Math.max(200, Math.round(this.plotHost.clientWidth || 600));
    const lines = this.shownLines;
    const tables = [];
    const order = [];
    for (const t of new Set(lines.map((line) => line.t))) {
      const group = lines.filter((line) => line.t === t);
      const thinned = thin(
        t,
        group.map((line) => line.y),
        from,
        to,
        buckets,
      );
      if (this.byDecades)
        thinned.lines = thinned.lines.map((y) =>
          y.map((value) => (value === null || value === 0 ? null : Math.abs(value))),
        );
      tables.push([thinned.x, ...thinned.lines]);
      order.push(...group);
    }
    if (!tables.length) return { order: [], data: [[from, to]] };
    return { order, data: tables.length === 1 ? tables[0] : uPlot.join(tables) };
  }

  /** Range of the ordinate: of the data, with the limits where they are not far off. */
  ordinate(least, greatest) {
    if (least === null || greatest === null) return this.byDecades ? [0.1, 1] : [0, 1];
    if (this.byDecades)
      return [
        10 ** Math.floor(Math.log10(least) - 1e-9),
        10 ** Math.ceil(Math.log10(greatest) + 1e-9),
      ];
    let [low, high] = [least, greatest];
    const size = Math.max(Math.abs(low), Math.abs(high));
    // limits not far from the data are within the picture; those that would crush it come at the reader's wish
    const limits = (this.spec.limits ?? []).map(({ value }) => value);
    const [lowest, highest] = [Math.min(low, ...limits), Math.max(high, ...limits)];
    if (this.allLimits || highest - lowest < 5 * (high - low)) [low, high] = [lowest, highest];
    // noise is not blown up: a constant stands in the middle of a tenth of itself, noise about zero on a line at zero
    const floor = Math.max(100 * this.noise, 1e-9 * size);
    if (high - low > floor) return [low - 0.06 * (high - low), high + 0.06 * (high - low)];
    const middle = size < floor ? 0 : (low + high) / 2;
    const half = Math.max(0.5 * (high - low) + 0.05 * size, 0.5 * floor) || 1;
    return [middle - half, middle + half];
  }

  /** What uPlot draws of these lines, and how. */
  options(order) {
    return {
      width: this.plotHost.clientWidth || 400,
      height: HEIGHT,
      pxAlign: false,
      legend: { show: false },
      padding: [8, 12, 0, 0],
      cursor: this.pointing(),
      scales: {
        x: { time: false, range: () => this.range.shown },
        y: {
          distr: this.byDecades ? 3 : 1,
          range: (_, least, greatest) => this.ordinate(least, greatest),
        },
      },
      axes: this.axes(),
      series: [
        {},
        ...order.map((line) => ({
          stroke: plain(line.color),
          width: line.width ?? 1.5,
          dash: line.dash,
          spanGaps: false,
          points: { show: false },
        })),
      ],
      hooks: {
        setSelect: [(plot) => this.select(plot)],
        drawAxes: [(plot) => this.drawLimits(plot), (plot) => this.drawEvents(plot)],
        // uPlot knows its scales only when it draws, a moment after it was asked to
        draw: [() => this.placeCursor()],
      },
    };
  }

  /** How the plot answers the pointer: dragging selects a range of time, a double click shows all of it. uPlot draws no cursor:
   *  placeCursor() does. */
  pointing() {
    return {
      x: false,
      y: false,
      points: { show: false },
      drag: { x: true, y: false, setScale: false },
      bind: {
        dblclick: () => () => {
          this.range.reset();
          return null;
        },
      },
    };
  }

  /** The axis of time, and the axis of the values: linear, or by powers of ten. */
  axes() {
    const axis = {
      stroke: themed("--muted"),
      grid: { stroke: themed("--rule"), width: 1 },
      ticks: { show: false },
      font: "11px system-ui, sans-serif",
    };
    return [
      { ...axis, size: 30, values: (_, values) => ticks(values) },
      this.byDecades
        ? {
            ...axis,
            size: 58,
            splits: (_, __, least, greatest) => decades(least, greatest),
            filter: (_, splits) => splits,
            values: (_, values) => powers(values),
          }
        : {
            ...axis,
            size: (_, labels) => labelRoom(labels, 58),
            values: (_, values) => ticks(values),
          },
    ];
  }

  select(plot) {
    const { left, width } = plot.select;
    plot.setSelect({ left: 0, width: 0, top: 0, height: 0 }, false);
    if (width > 4) this.range.set(plot.posToVal(left, "x"), plot.posToVal(left + width, "x"));
  }

  drawLimits(plot) {
    const { ctx, bbox } = plot;
    ctx.save();
    ctx.strokeStyle = themed("--limit");
    ctx.fillStyle = themed("--limit");
    ctx.lineWidth = devicePixelRatio;
    for (const { value, beyond } of this.spec.limits ?? []) {
      if (this.logarithmic && !(value > 0)) continue;
      const y = Math.round(plot.valToPos(value, "y", true)) + 0.5;
      ctx.setLineDash([4 * devicePixelRatio, 4 * devicePixelRatio]);
      ctx.beginPath();
      ctx.moveTo(bbox.left, y);
      ctx.lineTo(bbox.left + bbox.width, y);
      ctx.stroke();
      ctx.globalAlpha = 0.09;
      if (beyond > 0) ctx.fillRect(bbox.left, bbox.top, bbox.width, Math.max(0, y - bbox.top));
      else ctx.fillRect(bbox.left, y, bbox.width, Math.max(0, bbox.top + bbox.height - y));
      ctx.globalAlpha = 1;
    }
    ctx.restore();
  }

  /** A triangle at the upper edge for each event of this figure. */
  drawEvents(plot) {
    const { ctx, bbox } = plot;
    const [from, to] = this.range.shown;
    const size = 5 * devicePixelRatio;
    ctx.save();
    for (const { time, kind } of this.events) {
      if (time < from || time > to) continue;
      const x = plot.valToPos(time, "x", true);
      ctx.fillStyle = themed(kind === "limit" ? "--limit" : "--muted");
      ctx.beginPath();
      ctx.moveTo(x - size, bbox.top - size);
      ctx.lineTo(x + size, bbox.top - size);
      ctx.lineTo(x, bbox.top + size);
      ctx.fill();
    }
    ctx.restore();
  }

  /** Draws anew, at once if it can be seen, else when it is scrolled to. */
  refresh() {
    this.stale = true;
    if (this.visible) this.draw();
  }

  rebuild() {
    this.plot?.destroy();
    this.plot = null;
    this.refresh();
  }

  setVisible(visible) {
    this.visible = visible;
    if (visible && this.stale) this.draw();
    if (visible) this.setTime(this.time);
  }

  draw() {
    this.stale = false;
    const { order, data } = this.data();
    const signature = order.map((line) => this.spec.lines.indexOf(line)).join();
    if (!this.plot || signature !== this.signature) {
      this.plot?.destroy();
      this.signature = signature;
      this.plot = new uPlot(this.options(order), data, this.plotHost);
      this.cursor = element("div", { class: "cursor", "data-testid": `cursor-${this.spec.id}` });
      this.pointer = element("div", { class: "cursor pointer", "data-testid": `pointer-${this.spec.id}` });
      this.plot.over.append(this.pointer, this.cursor);
      this.listen(this.plot.over);
    } else this.plot.setData(data);
    this.setTime(this.time);
  }

  /** Pointing shows the numbers of that time in all figures; a click, or a finger that is drawn along, goes to it. */
  listen(over) {
    const at = (event) =>
      this.plot.posToVal(event.clientX - over.getBoundingClientRect().left, "x");
    let pressed = null;
    over.addEventListener("pointerdown", (event) => (pressed = event.clientX));
    over.addEventListener("pointermove", (event) => {
      if (event.pointerType === "touch") this.onSeek(at(event));
      else if (event.buttons === 0) this.onPoint(at(event));
    });
    over.addEventListener("pointerleave", () => this.onPoint(null));
    over.addEventListener("pointerup", (event) => {
      if (pressed !== null && Math.abs(event.clientX - pressed) < 4) this.onSeek(at(event));
      pressed = null;
    });
  }

  resize() {
    if (!this.plot || !this.plotHost.clientWidth || this.plot.width === this.plotHost.clientWidth)
      return;
    this.plot.setSize({ width: this.plotHost.clientWidth, height: HEIGHT });
    this.refresh();
  }

  /** Moves the cursor, and shows the values there: those of the row at or before the time. */
  setTime(time) {
    this.time = time;
    if (!this.visible || !this.plot) return;
    this.placeCursor();
    if (this.pointed === null) this.showValues(time);
  }

  /** Shows the values of a time that the pointer is at; with null those of the cursor again. */
  point(time) {
    this.pointed = time;
    if (!this.visible || !this.plot) return;
    this.placeCursor();
    this.showValues(time ?? this.time);
  }

  showValues(time) {
    this.spec.lines.forEach((line, index) => {
      const row = lowerBound(line.t, time + 1e-9 * Math.max(1, time)) - 1;
      const text =
        row >= 0 && time <= line.t[line.t.length - 1] * (1 + 1e-9) + 1e-9
          ? known(line.y[row], this.noise)
          : "–";
      if (this.values[index].textContent !== text) this.values[index].textContent = text;
    });
  }

  placeCursor() {
    if (!this.cursor) return;
    const [from, to] = this.range.shown;
    for (const [line, time] of [
      [this.cursor, this.time],
      [this.pointer, this.pointed ?? NaN],
    ]) {
      const within = time >= from && time <= to;
      if (within) line.style.transform = `translateX(${this.plot.valToPos(time, "x").toFixed(1)}px)`;
      line.style.visibility = within ? "visible" : "hidden";
    }
  }

  get name() {
    return `${fileName(this.study)}-${this.spec.id}`;
  }

  saveSvg() {
    const { order, data } = this.data();
    download(svgOf(this.figure(order, data)), `${this.name}.svg`, "image/svg+xml");
  }

  /** Least and greatest value of what is drawn, within the range of time; null without a value. */
  extremes([x, ...lines]) {
    const [from, to] = this.range.shown;
    let [least, greatest] = [null, null];
    for (const y of lines)
      y.forEach((value, index) => {
        if (!Number.isFinite(value) || x[index] < from || x[index] > to) return;
        least = least === null ? value : Math.min(least, value);
        greatest = greatest === null ? value : Math.max(greatest, value);
      });
    return [least, greatest];
  }

  figure(order, data) {
    const { spec, timeUnit } = this;
    return {
      title: `${spec.title} · ${this.study}`,
      ordinate: unit(spec.unit) ? `${spec.title} [${unit(spec.unit)}]` : spec.title,
      abscissa: unit(timeUnit) ? `t [${unit(timeUnit)}]` : "t",
      x: data[0],
      xRange: this.range.shown,
      yRange: this.ordinate(...this.extremes(data)),
      logarithmic: this.byDecades,
      limits: spec.limits,
      lines: order.map((line, index) => ({
        ...line,
        color: plain(line.color),
        y: data[index + 1],
      })),
    };
  }

  /** The figure for paper, in the place of the plot. */
  print() {
    const { order, data } = this.data();
    const figure = this.figure(order, data);
    // the ordinate has the unit; the heading above has the name
    const ordinate = unit(this.spec.unit) ? `[${unit(this.spec.unit)}]` : "";
    const lines = figure.lines.map((line, index) => ({ ...line, color: order[index].color }));
    this.printed = printedSvg({ ...figure, ordinate, lines }, this.spec.id, this.spec.wide);
    this.card.append(this.printed);
  }

  unprint() {
    this.printed?.remove();
  }

  /** The same drawing as the SVG, at twice its size. */
  savePng() {
    const { order, data } = this.data();
    const image = new Image();
    image.onload = () => {
      const sheet = element("canvas", { width: 1760, height: 880 });
      sheet.getContext("2d").drawImage(image, 0, 0, 1760, 880);
      sheet.toBlob((blob) => download(blob, `${this.name}.png`));
    };
    image.src = `data:image/svg+xml;charset=utf-8,${encodeURIComponent(svgOf(this.figure(order, data)))}`;
  }

  dispose() {
    this.range.listeners.delete(this.onRange);
    this.plot?.destroy();
  }
}
