// The scene where there is no WebGL: the machines drawn by lines (drawing.js), turned as the other one is.
import { arrange, extent, riseOf } from "./arrange.js";
import { drawing, element, fillWith, themed } from "./dom.js";
import { groundNodes, machinesDrawn, triad } from "./drawing.js";
import { Eye } from "./eye.js";

/** Styles of a drawing that a saved picture must have with it. */
const DRAWN = ["fill", "stroke", "stroke-width", "stroke-dasharray", "stroke-linecap", "opacity", "fill-opacity"];

export class DrawnScene {
  /** @param host element that the scene fills. */
  constructor(host) {
    this.host = host;
    this.canvas = drawing("svg", { class: "drawn", "data-testid": "scene-canvas" });
    this.labels = element("div", { class: "labels", "aria-hidden": "true" });
    host.prepend(this.canvas, this.labels);
    this.eye = new Eye(this.canvas, () => this.invalidate());
    this.camera = this.eye.camera;
    this.controls = this.eye.controls;
    this.machines = [];
    this.moments = [];
    this.shown = { ghost: true, paths: true, load: true, labels: true };
    new ResizeObserver(() => this.resize()).observe(host);
  }

  /** Shows machines side by side, as Scene.show() does. */
  show(entries, mixed = false) {
    this.entries = entries;
    this.room = arrange(entries, mixed, Eye.direction("first"));
    this.machines = entries.map((entry) => ({ entry, model: new DrawnMachine(this, entry) }));
    this.moments = [];
    this.labels.replaceChildren(
      ...(entries.length > 1 ? entries : []).map(({ name, accent }) =>
        element("span", { class: "study-mark", style: { "--study": accent } }, name),
      ),
    );
    this.fit();
  }

  /** Takes the colours of the theme in force: the style sheet does. */
  paint() {
    this.invalidate();
  }

  resetView() {
    this.fit();
    this.eye.look("first");
  }

  /** The same for another picture or other machines: the reader's view of them stays. */
  fit() {
    this.eye.fit(extent(this.entries, this.room));
  }

  /** Moves the machines: [{pose, forces, plan, points}] in order. */
  move(moments) {
    this.moments = moments;
    this.eye.follow(riseOf(this.entries, this.room, moments));
    this.invalidate();
  }

  toggle(part, visible) {
    this.shown[part] = visible;
    this.invalidate();
  }

  resize() {
    const { clientWidth: width, clientHeight: height } = this.host;
    if (!width || !height) return;
    if (this.eye.proportion(width, height) && this.machines.length) this.fit();
    this.invalidate();
  }

  invalidate() {
    this.dirty = true;
  }

  /** Draws if something changed. @return whether it did. */
  draw() {
    const { clientWidth: width, clientHeight: height } = this.host;
    if (!this.dirty || !this.moments.length || !width) return false;
    this.dirty = false;
    this.canvas.setAttribute("viewBox", `0 0 ${width} ${height}`);
    const projection = this.eye.projection(width, height);
    const { size, low, places } = this.room;
    this.canvas.replaceChildren();
    fillWith(this.canvas, [
      groundNodes(projection, { size, low, count: places.length }),
      machinesDrawn(projection, this.room, this.machines.map(({ model }) => model), this.moments, this.shown),
      triad(projection, [width - 50, height - 42], 26),
    ]);
    this.placeNames(projection);
    return true;
  }

  placeNames(projection) {
    const { size, low, places } = this.room;
    const spots = places.map(({ shift }) => projection.place([shift[0], shift[1], low - 0.42 * size]));
    if (spots.length > 1 && spots.every(Boolean))
      this.labels.style.setProperty("--room", `${Math.max(18, 0.94 * Math.abs(spots[1][0] - spots[0][0])).toFixed(0)}px`);
    [...this.labels.children].forEach((mark, index) => {
      const [x, y] = spots[index] ?? [-999, -999];
      mark.style.transform = `translate(-50%, -50%) translate(${x.toFixed(1)}px, ${y.toFixed(1)}px)`;
    });
  }

  /** The point of the top or the load under the pointer, or null: in base axes, in the plane through the top that faces the
   *  reader. */
  pick(event) {
    const hit = document.elementFromPoint(event.clientX, event.clientY);
    if (!hit?.closest?.(".top-plate, .load, .centre-disc, .centre-quarters") || !this.moments.length) return null;
    return this.eye.facing(event, this.camera.position.clone().set(...this.moments[0].pose.position));
  }

  /** The picture as a PNG blob, on the theme's ground. */
  async picture() {
    const { clientWidth: width, clientHeight: height } = this.host;
    const copy = this.canvas.cloneNode(true);
    copy.setAttribute("width", width);
    copy.setAttribute("height", height);
    const [from, to] = [this.canvas, copy].map((root) => [...root.querySelectorAll("*")]);
    from.forEach((node, index) => {
      const style = getComputedStyle(node);
      for (const name of DRAWN) to[index].style.setProperty(name, style.getPropertyValue(name));
    });
    const image = new Image();
    image.src = `data:image/svg+xml;charset=utf-8,${encodeURIComponent(new XMLSerializer().serializeToString(copy))}`;
    await image.decode();
    const sheet = element("canvas", { width: 2 * width, height: 2 * height });
    const context = sheet.getContext("2d");
    context.fillStyle = themed("--scene-back");
    context.fillRect(0, 0, sheet.width, sheet.height);
    context.drawImage(image, 0, 0, sheet.width, sheet.height);
    return new Promise((resolve) => sheet.toBlob(resolve, "image/png"));
  }
}

/** What the live run and the part Reach ask of a machine of the scene. */
class DrawnMachine {
  constructor(scene, entry) {
    this.scene = scene;
    this.entry = { ...entry };
    this.poses = [];
  }

  setPaths(run, plan) {
    Object.assign(this.entry, { run, plan });
    this.scene.invalidate();
  }

  showTrail(points) {
    this.entry.run = points;
  }

  showPoses(poses) {
    this.poses = poses;
    this.scene.invalidate();
  }

  /** The surface needs WebGL. */
  showSurface() {}
}
