// What `gough report` wrote into the page: studies with their tables. A column is decoded when it is first asked for, so that a
// recording of many rows opens at once.
import { below, known, unit } from "./format.js";
import { unpacked } from "./packed.js";
import { blendAngle, placed, poseOf } from "./pose.js";

const POSE = ["x", "y", "z", "roll", "pitch", "yaw"];

/** Points of a path that is drawn: a longer run is thinned evenly. */
const PATH_POINTS = 4000;

/** What a column counts in, as powers of length, time and force, and whether it is an angle. */
const DIMENSIONS = [
  [/^(x|y|z|ex|ey|ez|l\d)$/, { length: 1 }],
  [/^(roll|pitch|yaw|eroll|epitch|eyaw)$/, { angle: true }],
  [/^(vx|vy|vz|dl\d)$/, { length: 1, time: -1 }],
  [/^(wx|wy|wz)$/, { angle: true, time: -1 }],
  [/^[fh]\d$/, { force: 1 }],
  [/^p\d$/, { force: 1, length: 1, time: -1 }],
  [/^energy$/, { force: 1, length: 1 }],
];

/** Errors of a run reach a hundred times its tolerance; less than this share of a quantity's scale, or more, is not assumed.
 *  The constraints are kept to rounding. */
const NOISE = { of: 100, least: 1e-12, greatest: 1e-6, rounding: 1e-14 };

/** A table of columns, rows at equal steps of time. */
export class Table {
  /** @param radian a radian in the unit of the angles. @param order of the angles. @param inflate zlib's decompression. */
  constructor(columns, radian, order, inflate) {
    this.radian = radian;
    this.order = order;
    this.inflate = inflate;
    this.info = new Map((columns ?? []).map((column) => [column.name, column]));
    this.decoded = new Map();
    this.t = this.column("t") ?? new Float64Array(0);
    this.rows = this.t.length;
    this.step = this.rows > 1 ? (this.t[this.rows - 1] - this.t[0]) / (this.rows - 1) : 1;
  }

  get names() {
    return [...this.info.keys()];
  }

  has(name) {
    return this.info.has(name);
  }

  /** The values of a column, or null. */
  column(name) {
    if (!this.decoded.has(name)) {
      const info = this.info.get(name);
      this.decoded.set(name, info?.packed === undefined ? null : unpacked(info, this.inflate));
    }
    return this.decoded.get(name);
  }

  /** Takes the numbers of a column that the page has computed. */
  set(name, values) {
    this.decoded.set(name, values);
  }

  /** Names of the columns without numbers of their own. */
  get computed() {
    return this.names.filter((name) => this.info.get(name).packed === undefined);
  }

  /** Unit of a column as in the tables: "m/s2", "degree", "1". */
  unit(name) {
    return this.info.get(name)?.unit ?? "";
  }

  longName(name) {
    return this.info.get(name)?.long_name ?? name;
  }

  /** Row at or before a time, and the share of the way to the next one. */
  at(time) {
    const last = Math.max(this.rows - 1, 0);
    const position = Math.min(Math.max((time - (this.t[0] ?? 0)) / this.step, 0), last);
    // times are k·step: a time that is a row's own lies within rounding of it
    const near = Math.round(position);
    if (Math.abs(position - near) < 1e-6) return { row: near, share: 0 };
    return { row: Math.floor(position), share: position - Math.floor(position) };
  }

  /** Value of a column at a time, linear between rows; angles turn the short way. */
  value(name, time) {
    const values = this.column(name);
    if (!values || !this.rows) return NaN;
    const { row, share } = this.at(time);
    if (share === 0) return values[row];
    if (name === "roll" || name === "pitch" || name === "yaw")
      return blendAngle(values[row], values[row + 1], share, this.radian);
    return values[row] + share * (values[row + 1] - values[row]);
  }

  /** The path of a point of the top frame, as x, y, z, …, and how many rows lie between its points. */
  path(point) {
    const stride = Math.max(1, Math.ceil(this.rows / PATH_POINTS));
    const points = [];
    for (let row = 0; row < this.rows; row += stride)
      points.push(...placed(this.pose(this.t[row]), point));
    return { points, stride };
  }

  /** Pose at a time. */
  pose(time) {
    return poseOf(
      POSE.map((name) => this.value(name, time)),
      this.radian,
      this.order,
    );
  }
}

/** One study: what the command wrote, its run and its program as tables. */
export class Study {
  /** @param inflate zlib's decompression. */
  constructor(raw, index, inflate) {
    Object.assign(this, raw);
    this.index = index;
    this.run = new Table(raw.columns, this.factor("angle"), raw.motion?.order, inflate);
    this.plan = new Table(raw.program, this.factor("angle"), raw.motion?.order, inflate);
    this.label = raw.label || raw.title || raw.name || `study ${index + 1}`;
    this.complete = raw.end.status === "done";
    this.lastTime = this.run.rows ? this.run.t[this.run.rows - 1] : 0;
  }

  /** Time up to which there is anything to see. */
  get duration() {
    return Math.max(
      this.run.rows ? this.lastTime : 0,
      this.plan.rows ? this.plan.t[this.plan.rows - 1] : 0,
    );
  }

  /** The pose at home. */
  get home() {
    return poseOf([0, 0, this.machine.height, 0, 0, 0], 1);
  }

  /** What numbers of a kind ("length", "stiffness" …) in the core's units, SI or none, are multiplied by to be the study's. */
  factor(kind) {
    return this.quantities[kind].factor;
  }

  /** Name of the unit of a kind, as in the tables. */
  unitOf(kind) {
    return this.quantities[kind].label;
  }

  get dimensionless() {
    return this.units === "dimensionless";
  }

  /** The units in words, for the head of the study. */
  get unitsSentence() {
    if (this.dimensionless) return "Dimensionless";
    if (this.units === "si") return "SI units";
    const kinds = ["length", "force", "mass", "angle", "time"];
    return `Units ${kinds.map((kind) => unit(this.unitOf(kind))).join(", ")}`;
  }

  /** Whether another study has the same units. */
  isLike(other) {
    return JSON.stringify(this.units) === JSON.stringify(other.units);
  }

  /** The numbers of the machine that forces and energies follow from, in the core's units. */
  get inside() {
    const { machine } = this;
    const each = (list, kind) => list.map((value) => value / this.factor(kind));
    return {
      mass: machine.mass / this.factor("mass"),
      gravity: each(machine.gravity, "acceleration"),
      radius: machine.base_radius / this.factor("length"),
      centre: each(machine.center_of_mass, "length"),
      top: machine.top.map((joint) => each(joint, "length")),
      inertia: machine.inertia.map((row) => each(row, "inertia")),
    };
  }

  /** What the columns f1 … f6 are: with friction in the legs, those of the drives. */
  get forceWords() {
    return this.machine.legs_take_force ? "drive forces" : "leg forces";
  }

  /** Unit of a dimension: of a column that has it. */
  unit(name) {
    return this.run.has(name) ? this.run.unit(name) : this.plan.unit(name);
  }

  /** Below what size a number of a column ("energy": of an energy) is an error of the run: a share of the column's scale.
   *  The scale follows from the legs' length, a unit of time √(R_b/g) with the earth's g, and the greatest force.
   *  0 for a column that has no scale.
   *  @param program whether the column is the program's, which is known to rounding. */
  noise(name, program = false) {
    if (name === "drift") return NOISE.rounding;
    const dimension = DIMENSIONS.find(([pattern]) => pattern.test(name))?.[1];
    if (!dimension) return 0;
    const { machine, simulation, inside } = this;
    const kinds = { p: "power", energy: "energy" };
    const length = Math.max(...machine.home_length);
    const second = Math.sqrt(inside.radius / (this.dimensionless ? 1 : 9.80665));
    const time = second * this.factor("time");
    const reach = length / this.factor("length");
    const force = Math.max(
      this.greatestForce,
      ((inside.mass * reach) / second ** 2) * this.factor("force"),
    );
    // powers and energies are in W and J, whatever force and length are in
    const kind = kinds[name.replace(/\d$/, "")];
    const watt = kind
      ? this.factor(kind) /
        (this.factor("force") *
          this.factor("length") *
          (kind === "power" ? 1 / this.factor("time") : 1))
      : 1;
    const share = program
      ? NOISE.least
      : Math.min(Math.max(NOISE.of * (simulation.tolerance ?? 0), NOISE.least), NOISE.greatest);
    return (
      share *
      watt *
      (dimension.angle ? this.factor("angle") : 1) *
      length ** (dimension.length ?? 0) *
      time ** (dimension.time ?? 0) *
      force ** (dimension.force ?? 0)
    );
  }

  /** A number of a column in words: no more of it than is known. */
  say(value, name, digits = 5) {
    return known(value, this.noise(name), digits);
  }

  /** A magnitude of a column in words: "below 2·10⁻⁹" where it is only an error of the run. */
  within(value, name, digits = 5) {
    return below(value, this.noise(name), digits);
  }

  /** The same as a bound, which stands behind "at most". */
  most(value, name, digits = 5) {
    return below(value, this.noise(name), digits, true);
  }

  /** Whether a number of a column is only an error of the run. */
  isNoise(value, name) {
    return Math.abs(value) <= this.noise(name);
  }

  /** Whether the run is over at a time, so that it has no numbers there. */
  isOver(time) {
    return time > this.lastTime + 1e-6 * this.run.step;
  }

  /** The largest |force| of a leg in run and program: the end of the colour scale. */
  get peakForce() {
    return this.greatestForce || 1;
  }

  get greatestForce() {
    let peak = 0;
    for (const summary of [this.simulate, this.forces])
      for (const leg of summary?.legs ?? [])
        peak = Math.max(peak, Math.abs(leg.force[0] ?? 0), Math.abs(leg.force[1] ?? 0));
    return peak;
  }

  /** Whether the program is the paper's equation (3.1), heave 0.2 sin t (1 − e^{−t/2})² and nothing else, by its numbers. */
  get isPaper() {
    if (!this.dimensionless || this.plan.rows < 2) return false;
    const { t } = this.plan;
    const z = this.plan.column("z");
    for (const name of ["x", "y", "roll", "pitch", "yaw"])
      if (this.plan.column(name).some((value) => Math.abs(value) > 1e-9)) return false;
    return t.every(
      (time, row) =>
        Math.abs(
          z[row] - this.machine.height - 0.2 * Math.sin(time) * (1 - Math.exp(-time / 2)) ** 2,
        ) < 1e-9,
    );
  }

  /** Unit of the stiffness (order 0) or the damping (order 1) of a leg's feedback, as in the tables. */
  gainUnit(order) {
    return this.unitOf(["stiffness", "damping"][order]);
  }

  /** Whether the legs' forces do not depend on where the top is. */
  get openLoop() {
    return [...this.control.stiffness, ...this.control.damping].every((gain) => gain === 0);
  }
}

/** The studies of the page, or null in the template that nothing has filled yet. */
export function readStudies(inflate) {
  const page = JSON.parse(document.getElementById("gough-data").textContent);
  if (!page) return null;
  return {
    version: page.version,
    studies: page.studies.map((raw, index) => new Study(raw, index, inflate)),
  };
}
