// One machine as meshes: base and top through their joints, legs of cylinder and piston, the load, the program's ghost and the
// paths. Frame of the software, z up; the caller scales and places the group.
import {
  BufferAttribute,
  BufferGeometry,
  Color,
  CylinderGeometry,
  DoubleSide,
  EdgesGeometry,
  Group,
  Line,
  LineBasicMaterial,
  LineDashedMaterial,
  LineSegments,
  Matrix4,
  Mesh,
  MeshBasicMaterial,
  MeshStandardMaterial,
  Quaternion,
  SphereGeometry,
  Vector3,
} from "three";
import { forceColor, GREY, LEGS, plain } from "./color.js";
import { legsOf } from "./pose.js";
import { directions, triangles } from "./reach_core.js";
import { endWords } from "./reach_words.js";
import { cylinderLength, loadAxes, outline, THICK } from "./shape.js";

const UP = new Vector3(0, 0, 1);

/** A plate between `low` and `high` (along z) over an outline, with flat sides. */
function plate(points, low, high) {
  const positions = [];
  const triangle = (...corners) => corners.forEach((corner) => positions.push(...corner));
  const centre = [0, 1, 2].map(
    (axis) => points.reduce((sum, point) => sum + point[axis], 0) / points.length,
  );
  const at = (point, z) => [point[0], point[1], point[2] + z];
  points.forEach((point, index) => {
    const next = points[(index + 1) % points.length];
    triangle(at(centre, high), at(point, high), at(next, high));
    triangle(at(centre, low), at(next, low), at(point, low));
    triangle(at(point, low), at(next, low), at(next, high));
    triangle(at(point, low), at(next, high), at(point, high));
  });
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new BufferAttribute(new Float32Array(positions), 3));
  geometry.computeVertexNormals();
  return geometry;
}

/** The plate of some joints, of a thickness as in THICK, in a machine of this size. */
const plateOf = (joints, { margin, low, high }, size) =>
  plate(outline(joints, margin * size), low * size, high * size);

/** A cylinder from the origin along z to (0, 0, 1). */
function rod(radius, segments = 28) {
  return new CylinderGeometry(radius, radius, 1, segments, 1)
    .rotateX(Math.PI / 2)
    .translate(0, 0, 0.5);
}

/** The mark of a centre of mass: a ball whose octants are dark and light in turn. */
function centreMark(radius) {
  const geometry = new SphereGeometry(radius, 24, 16).toNonIndexed();
  const position = geometry.getAttribute("position");
  const colors = new Float32Array(position.count * 3);
  for (let corner = 0; corner < position.count; corner += 3) {
    const sign = [0, 1, 2].map((axis) => {
      const sum = [0, 1, 2].reduce(
        (total, k) => total + position.array[3 * (corner + k) + axis],
        0,
      );
      return sum >= 0 ? 1 : -1;
    });
    colors.fill(sign[0] * sign[1] * sign[2] > 0 ? 0.02 : 0.95, 3 * corner, 3 * corner + 9);
  }
  geometry.setAttribute("color", new BufferAttribute(colors, 3));
  return new Mesh(
    geometry,
    new MeshBasicMaterial({ vertexColors: true, depthTest: false, transparent: true }),
  );
}

const matrixOf = ({ position: p, rotation: r }) =>
  new Matrix4().set(
    r[0],
    r[1],
    r[2],
    p[0],
    r[3],
    r[4],
    r[5],
    p[1],
    r[6],
    r[7],
    r[8],
    p[2],
    0,
    0,
    0,
    1,
  );

/** Part that is moved by its matrix alone. */
function posed(group) {
  group.matrixAutoUpdate = false;
  return group;
}

export class Machine {
  /** @param machine as in the page's data; @param peak the force at the end of the colour scale; @param accent CSS colour of the
   *  ghost and the path; without it the theme's. All thicknesses follow the base radius. */
  constructor(machine, peak, accent) {
    this.machine = machine;
    this.size = machine.base_radius;
    this.accent = accent;
    const { size } = this;
    this.peak = peak;
    this.group = new Group();
    this.solid = new Group();
    this.group.add(this.solid);
    this.material = {
      base: new MeshStandardMaterial({ roughness: 0.75, metalness: 0.1 }),
      top: new MeshStandardMaterial({ roughness: 0.5, metalness: 0.15 }),
      piston: new MeshStandardMaterial({ roughness: 0.28, metalness: 0.55 }),
      load: new MeshStandardMaterial({
        roughness: 0.6,
        metalness: 0,
        transparent: true,
        opacity: 0.42,
        depthWrite: false,
      }),
      joints: LEGS.map(() => new MeshStandardMaterial({ roughness: 0.5 })),
      edge: new LineBasicMaterial({ transparent: true, opacity: 0.5 }),
      ghost: new MeshBasicMaterial({
        transparent: true,
        opacity: 0.16,
        side: DoubleSide,
        depthWrite: false,
      }),
      ghostEdge: new LineBasicMaterial({ transparent: true, opacity: 0.8 }),
      pose: new MeshBasicMaterial({ transparent: true, opacity: 0.13, side: DoubleSide, depthWrite: false }),
      poseEdge: new LineBasicMaterial({ transparent: true, opacity: 0.9 }),
      otherEdge: new LineBasicMaterial({ transparent: true, opacity: 0.9 }),
      poseLegs: new LineBasicMaterial({ transparent: true, opacity: 0.35 }),
      path: new LineBasicMaterial({ depthTest: false, transparent: true }),
      plan: new LineDashedMaterial({
        depthTest: false,
        transparent: true,
        opacity: 0.55,
        dashSize: 0.03 * size,
        gapSize: 0.03 * size,
      }),
    };
    this.buildBase();
    this.buildTop();
    this.buildLegs();
    this.buildGhost();
    this.buildPaths();
    this.poses = new Group();
    this.surface = new Group();
    this.group.add(this.poses, this.surface);
  }

  withEdges(geometry, material) {
    const mesh = new Mesh(geometry, material);
    mesh.castShadow = mesh.receiveShadow = true;
    mesh.add(new LineSegments(new EdgesGeometry(geometry, 20), this.material.edge));
    return mesh;
  }

  buildBase() {
    const s = this.size;
    this.solid.add(
      this.withEdges(
        plateOf(this.machine.base, THICK.base, s),
        this.material.base,
      ),
    );
    this.machine.base.forEach((joint, leg) => {
      const foot = new Mesh(
        new CylinderGeometry(0.032 * s, 0.06 * s, 0.055 * s, 24).rotateX(Math.PI / 2),
        this.material.base,
      );
      foot.position.set(joint[0], joint[1], joint[2] - 0.03 * s);
      const ball = new Mesh(new SphereGeometry(THICK.baseJoint * s, 24, 16), this.material.joints[leg]);
      ball.position.set(...joint);
      ball.castShadow = foot.castShadow = true;
      this.solid.add(foot, ball);
    });
  }

  buildTop() {
    const s = this.size;
    this.top = posed(new Group());
    this.platform = this.withEdges(
      plateOf(this.machine.top, THICK.top, s),
      this.material.top,
    );
    this.top.add(this.platform);
    this.machine.top.forEach((joint, leg) => {
      const ball = new Mesh(new SphereGeometry(THICK.topJoint * s, 24, 16), this.material.joints[leg]);
      ball.position.set(...joint);
      ball.castShadow = true;
      this.top.add(ball);
    });
    const semi = loadAxes(this.machine);
    const c = this.machine.center_of_mass;
    this.load = posed(new Mesh(new SphereGeometry(1, 48, 32), this.material.load));
    this.load.matrix.makeBasis(...semi.map((axis) => new Vector3(...axis))).setPosition(...c);
    this.load.renderOrder = 2;
    this.centre = centreMark(0.05 * s);
    this.centre.position.set(...c);
    this.centre.renderOrder = 5;
    this.top.add(this.load, this.centre);
    this.solid.add(this.top);
  }

  buildLegs() {
    const s = this.size;
    const shared = { cylinder: rod(THICK.cylinder * s), collar: rod(0.044 * s), piston: rod(THICK.piston * s) };
    this.legs = this.machine.home_length.map((_, index) => {
      const body = new MeshStandardMaterial({ roughness: 0.45, metalness: 0.05 });
      const leg = {
        body,
        group: new Group(),
        cylinder: new Mesh(shared.cylinder, body),
        collar: new Mesh(shared.collar, body),
        piston: new Mesh(shared.piston, this.material.piston),
      };
      leg.group.add(leg.cylinder, leg.collar, leg.piston);
      leg.group.children.forEach((mesh) => (mesh.castShadow = mesh.receiveShadow = true));
      leg.collar.scale.z = 0.04 * s;
      leg.marks = this.markCentres(leg.group, index);
      this.solid.add(leg.group);
      return leg;
    });
  }

  /** Marks where the cylinder and the piston of a leg have their centres of mass, each if it has mass. */
  markCentres(group, index) {
    const marks = {};
    for (const part of ["cylinder", "piston"]) {
      if (!(this.machine[part]?.mass[index] > 0)) continue;
      marks[part] = centreMark(0.034 * this.size);
      marks[part].renderOrder = 5;
      group.add(marks[part]);
    }
    return marks;
  }

  buildGhost() {
    const s = this.size;
    this.ghost = new Group();
    this.ghostTop = posed(new Group());
    const geometry = plateOf(this.machine.top, THICK.ghost, s);
    this.ghostTop.add(
      new Mesh(geometry, this.material.ghost),
      new LineSegments(new EdgesGeometry(geometry, 20), this.material.ghostEdge),
    );
    const lines = new BufferGeometry();
    lines.setAttribute("position", new BufferAttribute(new Float32Array(36), 3));
    this.ghostLegs = new LineSegments(lines, this.material.ghostEdge);
    this.ghostLegs.frustumCulled = false;
    this.ghost.add(this.ghostTop, this.ghostLegs);
    this.group.add(this.ghost);
  }

  buildPaths() {
    this.paths = new Group();
    const line = (material) => {
      const path = new Line(new BufferGeometry(), material);
      path.frustumCulled = false;
      path.renderOrder = 4;
      path.visible = false;
      this.paths.add(path);
      return path;
    };
    this.path = line(this.material.path);
    this.plan = line(this.material.plan);
    this.group.add(this.paths);
  }

  /** The whole path of the run (drawn up to the present row) and of the program: arrays of x, y, z. */
  setPaths(run, plan) {
    for (const [path, points] of [
      [this.path, run],
      [this.plan, plan],
    ]) {
      path.geometry.dispose();
      path.geometry = new BufferGeometry();
      path.visible = Boolean(points?.length);
      if (!path.visible) continue;
      path.geometry.setAttribute("position", new BufferAttribute(new Float32Array(points), 3));
      if (path === this.plan) path.computeLineDistances();
    }
  }

  /** Draws the run's path up to a point. */
  showPath(points) {
    this.path.geometry.setDrawRange(0, points);
  }

  /** A path that grows while it is drawn: the trail of a live run, as x, y, z, …. */
  showTrail(points) {
    const room = 3 * 1024;
    const position = this.path.geometry.getAttribute("position");
    if (position?.array.length !== room) {
      this.path.geometry.dispose();
      this.path.geometry = new BufferGeometry();
      this.path.geometry.setAttribute("position", new BufferAttribute(new Float32Array(room), 3));
      return this.showTrail(points);
    }
    const kept = points.slice(-room);
    position.array.set(kept);
    position.needsUpdate = true;
    this.path.visible = true;
    return this.showPath(kept.length / 3);
  }

  /** Pose and leg forces of the moment; @param glow whether each leg glows. */
  move(pose, forces, glow) {
    this.top.matrix.copy(matrixOf(pose));
    this.top.matrixWorldNeedsUpdate = true;
    const direction = new Vector3();
    legsOf(this.machine, pose).forEach(({ base, along, length }, index) => {
      const leg = this.legs[index];
      const cylinder = cylinderLength(this.machine, index, length);
      const inside = Math.min(0.1 * this.size, cylinder);
      leg.group.visible = length > 0;
      leg.group.position.set(...base);
      leg.group.quaternion.copy(
        new Quaternion().setFromUnitVectors(UP, direction.set(...along).normalize()),
      );
      leg.cylinder.scale.z = cylinder;
      leg.collar.position.z = cylinder - leg.collar.scale.z;
      leg.piston.position.z = cylinder - inside;
      leg.piston.scale.z = length - cylinder + inside;
      const { cylinder: low, piston: high } = leg.marks;
      if (low) low.position.z = this.machine.cylinder.center[index];
      if (high) high.position.z = length - this.machine.piston.center[index];
      const [red, green, blue] = forceColor(forces[index] / this.peak);
      leg.body.color.setRGB(red / 255, green / 255, blue / 255, "srgb");
      leg.body.emissive.setHex(glow?.[index] ? 0xc08a00 : 0);
    });
  }

  /** The program's pose; null hides the ghost. */
  moveGhost(pose) {
    this.ghost.visible = pose !== null && !this.ghostHidden;
    if (!pose) return;
    this.ghostTop.matrix.copy(matrixOf(pose));
    this.ghostTop.matrixWorldNeedsUpdate = true;
    const position = this.ghostLegs.geometry.getAttribute("position");
    legsOf(this.machine, pose).forEach(({ base, top }, leg) => {
      position.setXYZ(2 * leg, ...base);
      position.setXYZ(2 * leg + 1, ...top);
    });
    position.needsUpdate = true;
  }

  /** Other poses of the same lengths as ghosts: {position, rotation, other}, other being the opposite sign of the determinant. */
  showPoses(poses) {
    this.poses.children.forEach((ghost) => ghost.traverse((part) => part.geometry?.dispose()));
    this.poses.clear();
    const geometry = plateOf(this.machine.top, THICK.top, this.size);
    const edges = new EdgesGeometry(geometry, 20);
    for (const pose of poses) {
      const { pose: face, poseEdge, otherEdge, poseLegs } = this.material;
      const top = posed(new Group());
      top.add(new Mesh(geometry, face), new LineSegments(edges, pose.other ? otherEdge : poseEdge));
      top.matrix.copy(matrixOf(pose));
      const ends = legsOf(this.machine, pose).flatMap((leg) => [...leg.base, ...leg.top]);
      const lines = new BufferGeometry();
      lines.setAttribute("position", new BufferAttribute(new Float32Array(ends), 3));
      this.poses.add(top, new LineSegments(lines, poseLegs));
    }
  }

  /** The surface that rays from a point reach, each face in the colour of the leg that ends its first ray; null for none. */
  showSurface(surface) {
    this.surface.children.forEach((part) => (part.geometry.dispose(), part.material.dispose()));
    this.surface.clear();
    if (!surface) return;
    const { azimuths, rings, rays, point, scale } = surface;
    const ways = directions(azimuths, rings);
    const corner = (place) =>
      ways[place].map((part, axis) => point[axis] + scale * rays[place].reach * part);
    const faces = triangles(azimuths, rings);
    const geometry = new BufferGeometry();
    const positions = faces.flatMap((face) => face.flatMap(corner));
    const colours = faces.flatMap(([place]) => {
      const { leg } = endWords(rays[place]);
      const { r, g, b } = new Color(plain(leg ? LEGS[rays[place].which] : GREY));
      return [r, g, b, r, g, b, r, g, b];
    });
    geometry.setAttribute("position", new BufferAttribute(new Float32Array(positions), 3));
    geometry.setAttribute("color", new BufferAttribute(new Float32Array(colours), 3));
    geometry.computeVertexNormals();
    const skin = new MeshStandardMaterial({
      vertexColors: true,
      transparent: true,
      opacity: 0.42,
      side: DoubleSide,
      depthWrite: false,
      roughness: 0.8,
    });
    const mesh = new Mesh(geometry, skin);
    mesh.renderOrder = 3;
    this.surface.add(mesh);
  }

  /** Colours of the theme. */
  paint(theme) {
    const accent = this.accent ? plain(this.accent) : theme.ghost;
    for (const part of ["ghost", "ghostEdge", "path"])
      this.material[part].color = new Color(accent);
    this.material.joints.forEach((material, leg) => (material.color = new Color(plain(LEGS[leg]))));
    this.material.base.color = new Color(theme.base);
    this.material.top.color = new Color(theme.top);
    this.material.piston.color = new Color(theme.piston);
    this.material.load.color = new Color(theme.load);
    this.material.edge.color = new Color(theme.edge);
    this.material.plan.color = new Color(theme.plan);
    this.material.pose.color = new Color(plain(GREY));
    this.material.poseLegs.color = new Color(plain(GREY));
    this.material.poseEdge.color = new Color(theme.side);
    this.material.otherEdge.color = new Color(theme.other);
  }

  dispose() {
    this.group.traverse((part) => {
      part.geometry?.dispose();
      part.material?.dispose?.();
    });
  }
}
