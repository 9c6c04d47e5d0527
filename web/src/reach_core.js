// Poses and reach by the C core (web/core/reach.h says what each call does). Angles in radians, units of the run. Runs in a worker
// and in Node.
import { Core } from "./core.js";

const LIMITS = 13;

export class ReachCore extends Core {
  static async load(module) {
    const made = await WebAssembly.instantiate(module, {});
    return new ReachCore((made.instance ?? made).exports);
  }

  constructor(exports) {
    super(exports);
    this.limits = Array.from({ length: LIMITS }, (_, limit) =>
      this.text(exports.reach_limit_name(limit)),
    );
  }

  get said() {
    return this.text(this.calls.reach_message());
  }

  /** Puts numbers in, calls, and returns its status with the numbers that it left. */
  #ask(name, numbers, ...words) {
    const address = this.calls.reach_numbers();
    this.doubles(address, numbers.length).set(numbers);
    const status = this.calls[name](...words);
    return { status, numbers: this.doubles(address, 24).slice() };
  }

  #binding([limit, which, other]) {
    return { limit: this.limits[limit], which, other };
  }

  /** What is known at home: limits of the lengths, the point, the orientation of the surface; a sentence if poses have no reach. */
  reach() {
    const { status, numbers } = this.#ask("reach_begin", []);
    return {
      lengths: Array.from({ length: 6 }, (_, leg) => [...numbers.slice(2 * leg, 2 * leg + 2)]),
      point: [...numbers.slice(12, 15)],
      orientation: [...numbers.slice(15, 18)],
      side: numbers[18],
      refused: status ? this.said : "",
    };
  }

  /** Travel of a component: {ends, bindings, refused}. */
  travel(component) {
    const { status, numbers } = this.#ask("reach_travel", [], component);
    return {
      ends: [...numbers.slice(0, 2)],
      bindings: [2, 5].map((at) => this.#binding(numbers.slice(at, at + 3))),
      refused: status ? this.said : "",
    };
  }

  /** How far a straight line of components goes from a start, and what ends it. */
  ray(start, direction) {
    const { numbers } = this.#ask("reach_ray", [...start, ...direction]);
    return { reach: numbers[0], ...this.#binding(numbers.slice(1, 4)) };
  }

  /** The present pose is there: x, y, z of the top frame's origin, roll, pitch, yaw. Returns its lengths. */
  stand(pose) {
    return [...this.#ask("reach_place", pose).numbers.slice(0, 6)];
  }

  /** The present pose follows the lengths: {part of the way, refused}. */
  follow(lengths) {
    const { status, numbers } = this.#ask("reach_follow", lengths);
    return { part: numbers[0], refused: status ? this.said : "" };
  }

  /** All poses of these lengths: {real, nonreal, infinite, singular, complete, poses}. */
  poses(lengths) {
    const { numbers } = this.#ask("reach_poses", lengths);
    const [real, nonreal, infinite, singular, complete] = numbers;
    const poses = Array.from({ length: real }, (_, index) => this.pose(index));
    return { real, nonreal, infinite, singular, complete: ["no", "counted", "proved"][complete], poses };
  }

  /** Pose `index` of those, or the present one (−1). */
  pose(index) {
    const x = this.doubles(this.calls.reach_pose(index), 21).slice();
    return {
      components: [...x.slice(0, 6)],
      position: [...x.slice(6, 9)],
      rotation: [...x.slice(9, 18)],
      determinant: x[18],
      condition: x[19],
      present: x[20] === 1,
    };
  }

  /** Pose `index` becomes the present one. */
  take(index) {
    this.calls.reach_take(index);
  }
}

/** Directions of the surface: from straight down to straight up, in rings. */
export function directions(azimuths, rings) {
  const all = [[0, 0, -1]];
  for (let ring = 1; ring <= rings; ring++) {
    const elevation = Math.PI * (ring / (rings + 1) - 0.5);
    for (let k = 0; k < azimuths; k++) {
      const azimuth = (2 * Math.PI * k) / azimuths;
      all.push([
        Math.cos(elevation) * Math.cos(azimuth),
        Math.cos(elevation) * Math.sin(azimuth),
        Math.sin(elevation),
      ]);
    }
  }
  return [...all, [0, 0, 1]];
}

/** Triangles between them, by their places, outside first. */
export function triangles(azimuths, rings) {
  const all = [];
  const at = (ring, k) => 1 + (ring - 1) * azimuths + (k % azimuths);
  const top = 1 + rings * azimuths;
  for (let k = 0; k < azimuths; k++) {
    all.push([0, at(1, k + 1), at(1, k)], [top, at(rings, k), at(rings, k + 1)]);
    for (let ring = 1; ring < rings; ring++)
      all.push(
        [at(ring, k), at(ring, k + 1), at(ring + 1, k + 1)],
        [at(ring, k), at(ring + 1, k + 1), at(ring + 1, k)],
      );
  }
  return all;
}
