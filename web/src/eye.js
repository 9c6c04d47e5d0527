// Where the reader stands before the scene: the camera, turned by mouse, fingers and keys, with five standard views.
import { PerspectiveCamera, Raycaster, TOUCH, Vector2, Vector3 } from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";
import { Projection } from "./projection.js";

/** Angle of the picture's height, in degrees. */
export const FIELD = 30;

/** Directions from the machine to the reader: azimuth from x towards y, and elevation, in degrees. */
export const VIEWS = {
  front: [-90, 0],
  right: [0, 0],
  back: [90, 0],
  top: [-90, 90],
  first: [-62, 15],
};

/** The elevation stays so far from straight up and down, where the picture would have no upright, in radians. */
const UPRIGHT = 1e-4;
const RADIAN = Math.PI / 180;

export class Eye {
  /** @param surface the element that is turned by hand; @param onChange called after each change. */
  constructor(surface, onChange) {
    this.surface = surface;
    this.onChange = onChange;
    this.camera = new PerspectiveCamera(FIELD, 1, 0.01, 1000);
    this.camera.up.set(0, 0, 1);
    this.controls = new OrbitControls(this.camera, surface);
    this.controls.enableDamping = false;
    this.controls.maxPolarAngle = 0.96 * Math.PI;
    this.controls.addEventListener("change", onChange);
    this.raycaster = new Raycaster();
    this.framed = { height: 0, factor: 1 };
    this.bindFingers();
  }

  /** One finger scrolls the page; two turn and zoom, and the page stays. */
  bindFingers() {
    this.controls.touches = { ONE: null, TWO: TOUCH.DOLLY_ROTATE };
    this.surface.style.touchAction = "pan-x pan-y";
    for (const kind of ["touchstart", "touchmove"])
      this.surface.addEventListener(
        kind,
        (event) => event.touches.length > 1 && event.preventDefault(),
        { passive: false },
      );
  }

  /** Direction from the machine to the reader: unit vector of the first view. */
  static direction(name) {
    const [azimuth, elevation] = VIEWS[name].map((angle) => angle * RADIAN);
    return [
      Math.cos(elevation) * Math.cos(azimuth),
      Math.cos(elevation) * Math.sin(azimuth),
      Math.sin(elevation),
    ];
  }

  /** The view that machines fill: @param size base radius; @param height and @param width of them all. The reader's own
   *  direction, distance and place are kept, measured by the machines. */
  fit({ size, height, width }) {
    const view = this.home && this.view;
    const own = view?.some((part, place) => Math.abs(part - this.standard.view[place]) > 1e-9);
    Object.assign(this, { size, home: { height, width } });
    this.look(own ? "first" : (this.standard?.name ?? "first"));
    if (own) this.take(view);
  }

  /** The reader's view in plain numbers: azimuth and elevation in degrees, the distance as a multiple of that which all machines
   *  fill, and how far the target is from their middle, in base radii. */
  get view() {
    const offset = this.camera.position.clone().sub(this.controls.target);
    const distance = offset.length();
    const shift = this.controls.target.clone().sub(this.middle);
    shift.z -= this.framed.height;
    return [
      Math.atan2(offset.y, offset.x) / RADIAN,
      Math.asin(Math.min(Math.max(offset.z / distance, -1), 1)) / RADIAN,
      distance / (this.whole * this.framed.factor),
      ...shift.toArray().map((part) => part / this.size),
    ];
  }

  /** Takes a view in these numbers. */
  take([azimuth, elevation, times, ...shift]) {
    const { target } = this.controls;
    target.copy(this.middle);
    target.z += this.framed.height;
    target.add(new Vector3(...shift).multiplyScalar(this.size));
    this.stand(azimuth * RADIAN, elevation * RADIAN, times * this.whole * this.framed.factor);
    this.onChange();
  }

  /** The point in the middle of the machines at home. */
  get middle() {
    return new Vector3(0, 0, 0.5 * this.home.height - 0.02 * this.size);
  }

  /** The distance from which the machines at home fill a picture of these proportions. */
  distanceFor(aspect) {
    const { size } = this;
    const { height, width } = this.home;
    const half = Math.tan((FIELD * Math.PI) / 360);
    const across = (0.5 * width) / (half * Math.max(aspect, 0.3));
    return Math.max((0.5 * (height + 1.15 * size)) / half, across) + 0.9 * size;
  }

  /** How much higher the reader looks, and by which factor the distance grows, where tops have risen by a length. */
  raised(rise) {
    const high = Math.max(rise ?? 0, 0);
    return { height: 0.5 * high, factor: 1 + (0.8 * high) / (this.home.height + 1.15 * this.size) };
  }

  /** Goes to one of the five views. */
  look(name) {
    const { size } = this;
    this.controls.target.copy(this.middle);
    this.camera.near = 0.02 * size;
    this.camera.far = 400 * size;
    this.camera.updateProjectionMatrix();
    this.controls.minDistance = 0.5 * size;
    this.controls.maxDistance = 150 * size;
    this.framed = { height: 0, factor: 1 };
    this.whole = this.distanceFor(this.camera.aspect);
    const [azimuth, elevation] = VIEWS[name].map((angle) => angle * RADIAN);
    this.stand(azimuth, elevation, this.whole);
    this.follow();
    // to tell one of the five views from the reader's own
    this.standard = { name, view: this.view };
    this.onChange();
  }

  /** Stands at an azimuth, an elevation and a distance from the target. */
  stand(azimuth, elevation, distance) {
    const { target } = this.controls;
    const most = Math.PI / 2 - UPRIGHT;
    const least = Math.PI / 2 - this.controls.maxPolarAngle;
    const raised = Math.min(Math.max(elevation, least), most);
    const away = Math.min(Math.max(distance, this.controls.minDistance), this.controls.maxDistance);
    const flat = away * Math.cos(raised);
    this.camera.position.set(
      target.x + flat * Math.cos(azimuth),
      target.y + flat * Math.sin(azimuth),
      target.z + away * Math.sin(raised),
    );
    this.controls.update();
  }

  /** Turns by angles in degrees, and changes the distance by a factor. */
  turn(azimuth, elevation, factor = 1) {
    const offset = this.camera.position.clone().sub(this.controls.target);
    const distance = offset.length();
    this.stand(
      Math.atan2(offset.y, offset.x) + azimuth * RADIAN,
      Math.asin(offset.z / distance) + elevation * RADIAN,
      factor * distance,
    );
    this.onChange();
  }

  /** Steps back and looks higher as the tops rise by a length, on top of the reader's own view. */
  follow(rise = this.rise) {
    this.rise = rise;
    if (!this.home) return;
    const wanted = this.raised(rise);
    if (
      Math.abs(wanted.height - this.framed.height) < 1e-9 &&
      Math.abs(wanted.factor - this.framed.factor) < 1e-9
    )
      return;
    const { target } = this.controls;
    const offset = this.camera.position
      .clone()
      .sub(target)
      .multiplyScalar(wanted.factor / this.framed.factor);
    target.z += wanted.height - this.framed.height;
    this.camera.position.copy(target).add(offset);
    this.framed = wanted;
    this.controls.update();
  }

  /** Takes the proportions of the picture; @return whether the machines may no longer fill it. */
  proportion(width, height) {
    const changed = Math.abs(width / height - this.camera.aspect) > 0.05;
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
    return changed;
  }

  /** The same view in plain numbers, for a sheet. */
  projection(width, height) {
    return new Projection({
      eye: this.camera.position.toArray(),
      target: this.controls.target.toArray(),
      field: FIELD,
      width,
      height,
    });
  }

  /** A view in the reader's direction that all machines fill, for a sheet of another size. @param rise of the tops. */
  wholeView(width, height, rise) {
    const offset = this.camera.position.clone().sub(this.controls.target).normalize();
    const { height: higher, factor } = this.raised(rise);
    const target = this.middle;
    target.z += higher;
    const eye = offset.multiplyScalar(factor * this.distanceFor(width / height)).add(target);
    return new Projection({
      eye: eye.toArray(),
      target: target.toArray(),
      field: FIELD,
      width,
      height,
    });
  }

  /** Aims the ray at the pointer. */
  aim(event) {
    this.camera.updateMatrixWorld();
    const box = this.surface.getBoundingClientRect();
    const pointer = new Vector2(
      (2 * (event.clientX - box.left)) / box.width - 1,
      1 - (2 * (event.clientY - box.top)) / box.height,
    );
    this.raycaster.setFromCamera(pointer, this.camera);
  }

  /** Where the pointer's ray meets the plane through `point` that faces the reader. */
  facing(event, point) {
    this.aim(event);
    const normal = this.camera.getWorldDirection(new Vector3());
    const { origin, direction } = this.raycaster.ray;
    return direction
      .clone()
      .multiplyScalar(point.clone().sub(origin).dot(normal) / direction.dot(normal))
      .add(origin);
  }

  /** The hand: the pointer's point in the plane through `centre` that faces the reader, and both on the screen. */
  handAt(event, centre) {
    const from = new Vector3(...centre);
    const point = this.facing(event, from);
    const box = this.surface.getBoundingClientRect();
    const seen = from.clone().project(this.camera);
    return {
      point: point.toArray(),
      screen: [
        [((seen.x + 1) * box.width) / 2, ((1 - seen.y) * box.height) / 2],
        [event.clientX - box.left, event.clientY - box.top],
      ],
    };
  }
}
