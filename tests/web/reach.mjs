// Poses and reach in the page. The core in Node gives what the command gives: all poses, travels, rays of the surface, in the
// units of the run. In the browser the panel shows them: ghosts, bars, surface, and a way that a singular pose stops.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { createHash } from "node:crypto";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import test, { after } from "node:test";
import { doublesOf } from "../../web/src/core.js";
import { directions, ReachCore, triangles } from "../../web/src/reach_core.js";
import { countWords, endWords, sameSide, wayWords } from "../../web/src/reach_words.js";
import { byName, closeAll, example, gough, limit, open, picture, pictureDrawn, report, study } from "./browser.mjs";

const { CORE, FLAT, SCRATCH } = process.env;
const module = await WebAssembly.compile(readFileSync(CORE));
const DEGREE = Math.PI / 180;
const AXES = ["surge", "sway", "heave", "roll", "pitch", "yaw"];

// a machine of which all is simple: limits of length and nothing else, the box small
const text = `
units: si
platform: {base: {radius: 1, half_angle: 15}, top: {radius: 0.6, half_angle: 15}, height: 1.2, legs: {length: [1.1, 1.6]}}
load: {mass: 100, center_of_mass: [0, 0, 0.1], inertia: [8, 9, 15]}
control: {stiffness: 1e6, damping: 1e4}
workspace: {orientation: [0, 0, 10]}
motion: {heave: 0.1*sin(t), yaw: 5*sin(t)}
simulation: {duration: 3, output_step: 0.5}
`;
const plainStudy = () => study("plain.yaml", text);

async function coreOf(file) {
  const core = await ReachCore.load(module);
  core.begin(doublesOf(execFileSync(FLAT, [file], { maxBuffer: 1 << 28 })));
  return { core, known: core.reach() };
}

const near = (one, other, error, what) =>
  assert.ok(Math.abs(one - other) <= error, `${what}: ${one} and ${other}`);

/** A component as the command prints it for a study in SI units and degrees. */
const printed = (component, value) => (component < 3 ? value : value / DEGREE);

const answers = new Map();
/** What `gough workspace --json` says of a study. */
function workspaceOf(file) {
  if (!answers.has(file)) answers.set(file, JSON.parse(gough("workspace", file, "--json")));
  return answers.get(file);
}

after(closeAll);

// ---- the core ----

test("all poses are those of the command, and the one at home is the present one", async () => {
  for (const file of [plainStudy(), example("motion-base")]) {
    const { core } = await coreOf(file);
    const { position } = core.pose(-1);
    const lengths = core.stand([...position, 0, 0, 0]);
    const asked = lengths.map((length, leg) => length * (1 + 0.01 * (leg - 2)));
    const way = core.follow(asked);
    const ours = core.poses(asked);
    const theirs = JSON.parse(gough("pose", file, "--all", "--json", "--lengths", asked.join(",")));
    assert.equal(way.refused, "");
    assert.equal(ours.real, theirs.poses.length);
    assert.equal(ours.complete, theirs.complete);
    assert.ok(ours.real > 4);
    ours.poses.forEach((pose, index) => {
      const other = theirs.poses[index];
      pose.components.forEach((value, c) => near(printed(c, value), other[AXES[c]], 1e-7, `pose ${index} ${AXES[c]}`));
      near(pose.determinant, other.determinant, 1e-7 * Math.abs(other.determinant), "determinant");
      assert.equal(pose.present, other.joined_to_home === true, `pose ${index} is joined`);
    });
    // as many poses on either side of the singular ones
    assert.equal(ours.poses.reduce((sum, pose) => sum + Math.sign(pose.determinant), 0), 0);
  }
});

test("a way through a singular pose ends before it, with a sentence", async () => {
  const { core } = await coreOf(plainStudy());
  const lengths = core.stand([0, 0, 1.2, 0, 0, 0]);
  // all legs as short as the top is wide: no such pose is joined to home
  const way = core.follow(lengths.map(() => 0.45));
  assert.ok(way.part > 0.2 && way.part < 1, `${way.part}`);
  assert.match(way.refused, /singular/);
  const { position } = core.pose(-1);
  assert.ok(position[2] > 0 && position[2] < 1.2);
});

test("travel is that of the command, in ends and in what ends them", async () => {
  for (const file of [plainStudy(), example("motion-base")]) {
    const { core, known } = await coreOf(file);
    assert.equal(known.refused, "");
    const { travel } = workspaceOf(file);
    AXES.forEach((axis, component) => {
      const ours = core.travel(component);
      [travel[axis].least, travel[axis].greatest].forEach((theirs, end) => {
        near(printed(component, ours.ends[end]), theirs.end, 1e-6, `${axis} ${end}`);
        assert.equal(ours.bindings[end].limit, theirs.limit);
        if (theirs.leg) assert.equal(ours.bindings[end].which + 1, theirs.leg);
      });
    });
  }
});

test("rays of the surface are those of the command's table, and the surface is closed", async () => {
  const file = plainStudy();
  const { core, known } = await coreOf(file);
  assert.deepEqual(known.orientation.map((angle) => Math.round(angle / DEGREE)), [0, 0, 10]);
  const csv = join(SCRATCH, "surface.csv");
  gough("workspace", file, "-q", "-o", csv);
  const rows = readFileSync(csv, "utf8").trim().split("\n").slice(1).map((line) => line.split(",").map(Number));
  const ways = directions(72, 35);
  assert.equal(rows.length, ways.length);
  for (let i = 0; i < rows.length; i += 97) {
    const ray = core.ray([0, 0, 0, ...known.orientation], [...ways[i], 0, 0, 0]);
    ways[i].forEach((part, axis) => near(ray.reach * part, rows[i][axis], 1e-6, `ray ${i}`));
    assert.equal(ray.which + 1, rows[i][7]);
  }
  // each edge belongs to two triangles, once in each direction
  const edges = new Set(triangles(8, 3).flatMap(([a, b, c]) => [`${a} ${b}`, `${b} ${c}`, `${c} ${a}`]));
  assert.equal(edges.size, 3 * triangles(8, 3).length);
  for (const edge of edges) assert.ok(edges.has(edge.split(" ").reverse().join(" ")), edge);
  // and each triangle turns outwards
  const at = directions(8, 3);
  for (const [a, b, c] of triangles(8, 3)) {
    const [u, v] = [b, c].map((k) => at[k].map((x, axis) => x - at[a][axis]));
    const normal = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
    assert.ok(normal.reduce((sum, x, axis) => sum + x * at[a][axis], 0) > 0, `${a} ${b} ${c}`);
  }
});

test("sentences say how many poses there are, and how certain that is", () => {
  const found = { real: 8, nonreal: 20, infinite: 12, singular: 0, complete: "counted" };
  assert.match(countWords(found), /^8 real poses have these lengths\. .* not proved: 20 solutions are not real, and 12 paths/);
  assert.match(countWords({ ...found, complete: "proved", nonreal: 32 }), /no others: all 40 solutions are certified, and 32/);
  const lost = { ...found, real: 0, complete: "no", singular: 1 };
  assert.match(countWords(lost), /^No real pose was found\. There may be more: 1 path /);
  assert.match(wayWords({ because: "follow", followed: { refused: "x", part: 0.5 } }), /after 50\.0 % of the way: x\.$/);
  assert.deepEqual(endWords({ limit: "clearance", which: 1, other: 2 }), { text: "legs 2 and 3 touch", leg: true });
  assert.equal(endWords({ limit: "longest", which: 5 }).text, "leg 6: greatest length");
  assert.equal(endWords({ limit: "singular", which: 0 }).leg, false);
  assert.ok(sameSide({ determinant: -2 }, { side: -1 }) && !sameSide({ determinant: 2 }, { side: -1 }));
});

// ---- the panel ----

const pixels = async (page) => {
  await pictureDrawn(page);
  const drawn = await page.evaluate(() => {
    const { renderer, stage, camera, canvas } = window.goughPage.scene;
    renderer.render(stage, camera);
    return canvas.toDataURL();
  });
  return createHash("sha256").update(drawn).digest("hex");
};

/** The page of a study, with poses, travels and surface. */
async function reach(file, options) {
  const page = await open(report(file), options);
  await byName(page, "mode-reach").click();
  await page.waitForFunction(
    () => document.querySelectorAll(".travels li").length === 6 && window.goughPage.reach.answer,
    null,
    { timeout: limit(60000) },
  );
  if (options?.webgl !== false)
    await page.waitForFunction(() => document.documentElement.dataset.surface, null, { timeout: limit(60000) });
  return page;
}

test("shows poses, bars and surface of the motion base, by day and at night", async () => {
  const page = await reach(example("motion-base"));
  const { travel } = workspaceOf(example("motion-base"));
  const surge = await byName(page, "travel-surge").textContent();
  assert.ok(surge.includes(`${travel.surge.greatest.end.toPrecision(4)} m`), surge);
  assert.match(surge, /leg 5: greatest force.*leg 2: greatest length/);
  const poses = await byName(page, "reach-poses").locator("tr").count();
  assert.ok((await byName(page, "reach-count").textContent()).startsWith(`${poses} real poses`));
  assert.equal(await byName(page, "reach-poses").locator("tr.present").count(), 1);
  await picture(page, "reach");
  const with_surface = await pixels(page);
  await byName(page, "reach-surface").click();
  const without = await pixels(page);
  assert.notEqual(with_surface, without);
  // the pose of home is home: no noise is shown as a number
  assert.deepEqual(await byName(page, "reach-poses").locator("tr.present td").allTextContents(), Array(6).fill("0"));
  await picture(page, "reach-poses");
  await byName(page, "mode-recorded").click();
  assert.notEqual(await pixels(page), without);
  assert.match(await byName(page, "legend").textContent(), /force/);
  assert.deepEqual(page.said, []);
  await page.close();
  const night = await reach(example("motion-base"), { dark: true });
  await picture(night, "reach-night");
  assert.deepEqual(night.said, []);
  await night.close();
});

test("the pose follows the sliders, stops at a singular pose, and can be put into another", async () => {
  const page = await reach(plainStudy(), { webgl: false });
  const answered = async (act) => {
    const before = await page.evaluate(() => (window.goughPage.reach.answer.seen = true));
    assert.ok(before);
    await act();
    await page.waitForFunction(() => !window.goughPage.reach.busy && !window.goughPage.reach.answer.seen);
  };
  const set = (leg, value) =>
    answered(async () => {
      const box = byName(page, `reach-l${leg}-number`);
      await box.fill(String(value));
      await box.press("Enter");
    });
  await answered(() => byName(page, "reach-home").click());
  await set(1, 1.3);
  assert.match(await byName(page, "reach-way").textContent(), /joined to the last one/);
  const theirs = JSON.parse(
    gough("pose", plainStudy(), "--json", "--lengths", (await page.evaluate(() => window.goughPage.reach.lengths)).join(",")),
  );
  const ours = await page.evaluate(() => window.goughPage.reach.answer.present.components);
  near(ours[2], theirs.poses[0].heave, 1e-9, "heave");
  for (let leg = 1; leg <= 6; leg++) await set(leg, 0.45);
  assert.match(await byName(page, "reach-way").textContent(), /stopped after .* % of the way: .*singular/);
  await answered(() => byName(page, "reach-home").click());
  const rows = byName(page, "reach-poses").locator("tr");
  await answered(() => rows.nth(1).locator("button").click());
  assert.equal(await rows.nth(1).getAttribute("class"), "present");
  assert.deepEqual(page.said, []);
  await page.close();
});

test("fits a phone", async () => {
  const page = await reach(plainStudy(), { width: 390, height: 800 });
  const wide = await page.evaluate(() => document.documentElement.scrollWidth);
  assert.ok(wide <= 390, `${wide} px`);
  await picture(page, "reach-phone", { fullPage: true });
  assert.deepEqual(page.said, []);
  await page.close();
});
