// The 3D scene: machines on a ground, z up, with light and shadow. It is drawn only when something changed.
import {
  AmbientLight,
  BufferAttribute,
  BufferGeometry,
  CircleGeometry,
  Color,
  DirectionalLight,
  Group,
  HemisphereLight,
  LineBasicMaterial,
  LineSegments,
  Mesh,
  PCFShadowMap,
  Scene as Stage,
  ShadowMaterial,
  Vector3,
  WebGLRenderer,
} from "three";
import { arrange, extent, halfRow, riseOf } from "./arrange.js";
import { LEGS } from "./color.js";
import { element, themed } from "./dom.js";
import { Eye } from "./eye.js";
import { Machine } from "./machine.js";

/** A picture that takes longer is slow; nothing but slow ones for so long is too much. Seconds. */
const SLOW = 0.045;
const PATIENCE = 2.5;

/** Lines on the ground that fade out, within `reach` of the origin. */
function groundLines(size, reach) {
  const positions = [];
  const colors = [];
  const pieces = 24;
  for (let k = -reach; k <= reach; k++) {
    for (let piece = -pieces; piece < pieces; piece++) {
      for (const along of [0, 1]) {
        for (const end of [piece, piece + 1]) {
          const point = [k * size, (end / pieces) * reach * size];
          if (along) point.reverse();
          positions.push(...point, 0);
          const share = Math.max(0, 1 - Math.hypot(...point) / (reach * size));
          colors.push(1, 1, 1, share * share);
        }
      }
    }
  }
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new BufferAttribute(new Float32Array(positions), 3));
  geometry.setAttribute("color", new BufferAttribute(new Float32Array(colors), 4));
  return new LineSegments(
    geometry,
    new LineBasicMaterial({ vertexColors: true, transparent: true, depthWrite: false }),
  );
}

export class Scene {
  /** @param host element that the scene fills. Throws where there is no WebGL. */
  constructor(host) {
    this.host = host;
    this.solid = true;
    if (!document.createElement("canvas").getContext("webgl2")) throw new Error("no WebGL");
    this.renderer = new WebGLRenderer({ antialias: true, alpha: true });
    // asking a program whether it was linked waits until it is
    this.renderer.debug.checkShaderErrors = false;
    this.renderer.shadowMap.enabled = true;
    this.renderer.shadowMap.type = PCFShadowMap;
    this.canvas = this.renderer.domElement;
    this.canvas.dataset.testid = "scene-canvas";
    this.labels = element("div", { class: "labels", "aria-hidden": "true" });
    host.prepend(this.canvas, this.labels);
    this.stage = new Stage();
    this.eye = new Eye(this.canvas, () => this.invalidate());
    this.camera = this.eye.camera;
    this.controls = this.eye.controls;
    this.machines = [];
    this.dirty = true;
    this.slow = 0;
    this.fineness = 1;
    this.light();
    this.observer = new ResizeObserver(() => this.resize());
    this.observer.observe(host);
  }

  light() {
    this.sun = new DirectionalLight(0xffffff, 2.2);
    this.sun.castShadow = true;
    this.sun.shadow.mapSize.set(1024, 1024);
    this.sun.shadow.radius = 5;
    this.fill = new DirectionalLight(0xdfe9ff, 0.7);
    this.sky = new HemisphereLight(0xffffff, 0xb9b4a6, 1.35);
    this.stage.add(
      this.sun,
      this.sun.target,
      this.fill,
      this.sky,
      new AmbientLight(0xffffff, 0.25),
    );
  }

  /** Shows machines side by side: [{machine, peak, accent, name, run, plan}], run and plan being paths. `mixed` machines have no
   *  unit of length in common: each is drawn with the same base radius. */
  show(entries, mixed = false) {
    for (const { model } of this.machines) {
      this.stage.remove(model.group);
      model.dispose();
    }
    this.entries = entries;
    this.room = arrange(entries, mixed, Eye.direction("first"));
    this.size = this.room.size;
    this.low = this.room.low;
    this.machines = entries.map((entry, index) => {
      const { scale, shift } = this.room.places[index];
      const model = new Machine(entry.machine, entry.peak, entry.accent);
      model.group.scale.setScalar(scale);
      model.group.position.set(...shift);
      model.setPaths(entry.run, entry.plan);
      this.stage.add(model.group);
      return { model, entry, scale };
    });
    this.buildGround();
    this.buildLabels(entries.length > 1);
    this.paint();
    this.fit();
  }

  buildGround() {
    if (this.ground) this.stage.remove(this.ground);
    this.lines = groundLines(0.5 * this.size, 6 + 3 * this.machines.length);
    this.shade = new Mesh(
      new CircleGeometry(20 * this.size, 48),
      new ShadowMaterial({ opacity: 0.22 }),
    );
    this.shade.receiveShadow = true;
    this.ground = new Group();
    this.ground.add(this.lines, this.shade);
    this.ground.position.z = this.low;
    this.stage.add(this.ground);
    const s = this.size;
    const reach = (1.8 + halfRow(this.machines.length)) * s;
    this.sun.position.set(1.6 * s, -1.2 * s, 5.2 * s);
    this.fill.position.set(-3 * s, 2 * s, 2 * s);
    const { camera } = this.sun.shadow;
    Object.assign(camera, {
      left: -reach,
      right: reach,
      top: reach,
      bottom: -reach,
      near: 0.5 * s,
      far: 14 * s,
    });
    camera.updateProjectionMatrix();
    this.sun.shadow.normalBias = 0.01 * s;
  }

  buildLabels(named) {
    this.labels.replaceChildren();
    this.marks = [];
    for (const { model, entry, scale } of this.machines) {
      if (!named)
        entry.machine.base.forEach((joint, leg) => {
          const mark = element(
            "span",
            { class: "leg-mark", style: { "--leg": LEGS[leg] } },
            String(leg + 1),
          );
          const outwards = 1 + (0.2 * this.size) / (Math.hypot(joint[0], joint[1]) || 1);
          this.marks.push({
            mark,
            model,
            point: new Vector3(
              joint[0] * outwards,
              joint[1] * outwards,
              joint[2] - 0.08 * this.size,
            ),
          });
          this.labels.append(mark);
        });
      if (!named) continue;
      const mark = element(
        "span",
        { class: "study-mark", style: { "--study": entry.accent } },
        entry.name,
      );
      this.marks.push({
        mark,
        model,
        point: new Vector3(0, 0, (this.low - 0.42 * this.size) / scale),
      });
      this.labels.append(mark);
    }
  }

  /** Takes the colours of the theme in force. */
  paint() {
    const theme = Object.fromEntries(
      ["base", "top", "piston", "load", "edge", "plan", "ghost", "side", "other"].map((name) => [
        name,
        themed(`--scene-${name}`),
      ]),
    );
    for (const { model } of this.machines) model.paint(theme);
    if (this.lines) {
      this.lines.material.color = new Color(themed("--scene-grid"));
      this.shade.material.opacity = Number(themed("--scene-shadow"));
    }
    this.invalidate();
  }

  /** The view that all machines at home fill. */
  resetView() {
    this.fit();
    this.eye.look("first");
  }

  /** The same for another picture or other machines: the reader's view of them stays. */
  fit() {
    this.eye.fit(extent(this.entries, this.room));
  }

  /** Moves the machines: [{pose, forces, plan, points}] in order; keeps what has left the view's first frame within it. */
  move(moments) {
    moments.forEach(({ pose, forces, plan, points, glow }, index) => {
      const { model } = this.machines[index];
      model.move(pose, forces, glow);
      model.moveGhost(plan);
      if (points !== undefined) model.showPath(points);
    });
    this.eye.follow(riseOf(this.entries, this.room, moments));
    this.invalidate();
  }

  /** Shows or hides "ghost", "paths", "load", "labels". */
  toggle(part, visible) {
    for (const { model } of this.machines) {
      if (part === "ghost") {
        model.ghostHidden = !visible;
        model.ghost.visible = visible;
      }
      if (part === "paths") model.paths.visible = visible;
      if (part === "load") model.load.visible = model.centre.visible = visible;
    }
    if (part === "labels") this.labels.hidden = !visible;
    this.invalidate();
  }

  resize() {
    const { clientWidth: width, clientHeight: height } = this.host;
    if (!width || !height) return;
    this.renderer.setPixelRatio(this.fineness * Math.min(devicePixelRatio, 2));
    this.renderer.setSize(width, height, false);
    if (this.eye.proportion(width, height) && this.machines.length) this.fit();
    this.invalidate();
  }

  invalidate() {
    this.dirty = true;
  }

  /** Draws if something changed. @param seconds since the picture before. @return whether it did. */
  draw(seconds) {
    if (!this.dirty || !this.machines.length || !this.host.clientWidth) {
      this.slow = 0;
      return false;
    }
    this.dirty = false;
    this.keepPace(seconds);
    this.renderer.render(this.stage, this.camera);
    this.placeLabels();
    return true;
  }

  /** Where pictures in motion come too slowly for a while, they are made cheaper: first without shadows, then coarser. */
  keepPace(seconds) {
    this.slow = seconds > SLOW ? this.slow + seconds : 0;
    if (this.slow < PATIENCE) return;
    this.slow = 0;
    if (this.sun.castShadow) this.sun.castShadow = false;
    else if (this.fineness > 0.7) {
      this.fineness /= 1.5;
      this.resize();
    }
  }

  placeLabels() {
    const { clientWidth: width, clientHeight: height } = this.host;
    const point = new Vector3();
    const [first, second] = this.marks.filter(({ mark }) => mark.className === "study-mark");
    const across = ({ model, point: place }) =>
      point.copy(place).applyMatrix4(model.group.matrixWorld).project(this.camera).x;
    // names share the width between two machines
    if (second)
      this.labels.style.setProperty(
        "--room",
        `${Math.max(18, 0.47 * width * Math.abs(across(second) - across(first))).toFixed(0)}px`,
      );
    for (const { mark, model, point: place } of this.marks) {
      point.copy(place).applyMatrix4(model.group.matrixWorld).project(this.camera);
      const [left, top] = [((point.x + 1) * width) / 2, ((1 - point.y) * height) / 2];
      mark.style.transform = `translate(-50%, -50%) translate(${left.toFixed(1)}px, ${top.toFixed(1)}px)`;
      mark.style.visibility = point.z < 1 ? "visible" : "hidden";
    }
  }

  /** The point of a machine's moving part under the pointer, or null; in base axes. */
  pick(event) {
    this.eye.aim(event);
    const { model } = this.machines[0];
    const [hit] = this.eye.raycaster.intersectObjects([model.platform, model.load], false);
    return hit ? hit.point : null;
  }

  /** The picture as a PNG blob, on the theme's ground. */
  picture() {
    this.renderer.render(this.stage, this.camera);
    const { width, height } = this.canvas;
    const sheet = element("canvas", { width, height });
    const context = sheet.getContext("2d");
    context.fillStyle = themed("--scene-back");
    context.fillRect(0, 0, width, height);
    context.drawImage(this.canvas, 0, 0);
    return new Promise((resolve) => sheet.toBlob(resolve, "image/png"));
  }
}
