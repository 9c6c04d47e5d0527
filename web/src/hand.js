// The reader's hand in a live run: takes the load in the scene and pulls, and an arrow shows with what force.
import { byId } from "./dom.js";
import { number, unit } from "./format.js";

export class Hand {
  /** @param scene the scene with one machine; @param study whose load it is; @param onForce called with a force, base axes;
   *  @param free whether the load can be taken now. */
  constructor(scene, study, onForce, free) {
    this.scene = scene;
    this.study = study;
    this.onForce = onForce;
    this.grip = null;
    const { mass, gravity } = study.inside;
    // a pull of one base radius is half the weight; both in the study's units
    const weight = mass * (Math.hypot(...gravity) || 1) * study.factor("force");
    this.scale = (0.5 * weight) / study.machine.base_radius;
    this.listening = new AbortController();
    const { canvas, controls } = scene;
    const { signal } = this.listening;
    canvas.addEventListener(
      "pointerdown",
      (event) => {
        if (event.button !== 0 || !free() || !scene.pick(event)) return;
        controls.enabled = false;
        canvas.setPointerCapture(event.pointerId);
        this.grip = event;
        event.stopImmediatePropagation();
      },
      { capture: true, signal },
    );
    canvas.addEventListener(
      "pointermove",
      (event) => {
        if (this.grip) this.grip = event;
        else canvas.style.cursor = event.buttons === 0 && scene.pick(event) ? "grab" : "";
      },
      { signal },
    );
    for (const end of ["pointerup", "pointercancel"])
      canvas.addEventListener(end, () => this.letGo(), { signal });
  }

  /** Pulls on from where the pointer is: the force goes from the centre of mass towards it, in the plane that faces the
   *  reader. Called for each picture, for the load moves under a hand that rests. */
  pull(centre) {
    if (!this.grip) return;
    const { point, screen } = this.scene.eye.handAt(this.grip, centre);
    const force = point.map((value, axis) => this.scale * (value - centre[axis]));
    this.onForce(force);
    this.draw(screen, Math.hypot(...force));
  }

  draw([from, to], size) {
    byId("push").toggleAttribute("hidden", false);
    const line = byId("push-line");
    line.setAttribute("x1", from[0]);
    line.setAttribute("y1", from[1]);
    line.setAttribute("x2", to[0]);
    line.setAttribute("y2", to[1]);
    const angle = (Math.atan2(to[1] - from[1], to[0] - from[0]) * 180) / Math.PI;
    byId("push-head").setAttribute("transform", `translate(${to[0]} ${to[1]}) rotate(${angle})`);
    const words = byId("push-size");
    words.setAttribute("x", to[0] + 12);
    words.setAttribute("y", to[1] - 10);
    words.textContent = `${number(size, 3)} ${this.study.dimensionless ? "M g" : unit(this.study.unitOf("force"))}`;
  }

  letGo() {
    if (this.grip) this.onForce([0, 0, 0]);
    this.grip = null;
    byId("push").toggleAttribute("hidden", true);
    this.scene.controls.enabled = true;
  }

  dispose() {
    this.letGo();
    this.listening.abort();
    this.scene.canvas.style.cursor = "";
  }
}
