// The page of machines whose legs have mass and friction, in a browser: marks at the centres of mass of cylinders and pistons,
// forces of drives and of legs, whose energies are drawn. A study without them has none of it.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import test, { after } from "node:test";
import {
  byName,
  closeAll,
  example,
  limit,
  open,
  picture,
  report,
  scrubTo,
  study,
  table,
} from "./browser.mjs";

const heavy = study(
  "legs.yaml",
  readFileSync(example("flight-simulator-legs"), "utf8")
    .replace("duration: 20", "duration: 6")
    .replace("cylinder: {mass: 60,", "cylinder: {mass: [60, 60, 0, 60, 60, 60],"),
);
const light = example("own-machine");

after(closeAll);

/** Marks of each leg along it, and the leg's length, in the scene as it is drawn. */
const marks = (page) =>
  page.evaluate(() =>
    window.goughPage.scene.machines[0].model.legs.map(({ group, marks, piston }) => ({
      cylinder: marks.cylinder && marks.cylinder.position.toArray(),
      piston: marks.piston && marks.piston.position.toArray(),
      length: piston.position.z + piston.scale.z,
      drawn: Object.values(marks).every((mark) => mark.parent === group && mark.visible),
    })),
  );

test("marks stand at the centres of mass of cylinders and pistons", async () => {
  const page = await open(report(heavy));
  const { names, rows } = table("simulate", heavy);
  for (const row of [0, 60, 117]) {
    await scrubTo(page, row);
    (await marks(page)).forEach(({ cylinder, piston, length, drawn }, leg) => {
      assert.ok(drawn);
      assert.ok(Math.abs(length - rows[row][names.indexOf(`l${leg + 1}`)]) < 1e-6, `${length}`);
      // a cylinder without mass has no centre
      if (leg === 2) assert.equal(cylinder, undefined);
      else assert.deepEqual(cylinder, [0, 0, 0.55]);
      assert.ok(Math.abs(piston[2] - (length - 0.7)) < 1e-6 && piston[0] === 0 && piston[1] === 0);
    });
  }
  await picture(page, "legs");
  assert.deepEqual(page.said, []);
  await page.close();
  const dark = await open(report(heavy), { dark: true });
  await scrubTo(dark, 60);
  await picture(dark, "legs-dark");
  await dark.locator("#curves").scrollIntoViewIfNeeded();
  await picture(dark, "legs-curves-dark", { fullPage: true });
  await dark.close();
});

test("forces of drives and legs are apart, and energies say whose they are", async () => {
  const page = await open(report(heavy), { webgl: false });
  const { names, rows } = table("simulate", heavy, "--joints");
  const title = (figure) => byName(page, `curve-${figure}`).locator("h3").textContent();
  const note = (figure) => byName(page, `curve-${figure}`).locator(".note").textContent();
  assert.equal(await title("forces"), "Drive forces");
  assert.equal(await title("leg-forces"), "Leg forces");
  // beside the scene and under it
  assert.match(await page.locator(".bars h3").textContent(), /^Drive forces/);
  assert.equal(await page.locator("#legend .legend-title").textContent(), "force of a drive [N]");
  assert.match(await note("leg-forces"), /^Drive forces less friction\./);
  assert.match(await note("energy"), /The work of the drives is .* drive force times rate\./);
  assert.match(await note("energy"), /The energies are the load's alone/);
  assert.equal(await title("work"), "Work of each drive");
  const machine = page.locator("dl", { hasText: "height at home" });
  assert.match(await machine.textContent(), /mass of the legs480 kg/);
  const colors = await page.evaluate(() =>
    [...document.querySelectorAll("#grid > *")]
      .map(({ curve }) => curve.spec)
      .find(({ id }) => id === "energy")
      .lines.map(({ color }) => getComputedStyle(document.body).getPropertyValue(color.slice(4, -1))),
  );
  assert.equal(new Set(colors).size, colors.length, `${colors}`);
  const drawn = await page.evaluate(() => {
    const { run } = window.goughPage.studies[0];
    const figures = [...document.querySelectorAll("#grid > *")].map(({ curve }) => curve.spec);
    const lost = figures
      .find(({ id }) => id === "energy")
      .lines.find(({ label }) => label === "lost by friction").y;
    return {
      h: [1, 2, 3, 4, 5, 6].map((leg) => [...run.column(`h${leg}`)]),
      lost: [...lost],
      names: run.names,
    };
  });
  drawn.h.forEach((column, leg) =>
    column.forEach((value, row) =>
      assert.ok(Object.is(value, rows[row][names.indexOf(`h${leg + 1}`)])),
    ),
  );
  assert.ok(!drawn.names.some((name) => /^([tb][xyz]|s)\d$/.test(name)), `${drawn.names}`);
  // the same loss by hand, and friction takes work at all times
  let lost = 0;
  const at = (row, name) => rows[row][names.indexOf(name)];
  const power = (row) =>
    [1, 2, 3, 4, 5, 6].reduce(
      (sum, k) => sum + (at(row, `f${k}`) - at(row, `h${k}`)) * at(row, `dl${k}`),
      0,
    );
  for (let row = 1; row < rows.length; row++) {
    lost += ((at(row, "t") - at(row - 1, "t")) * (power(row) + power(row - 1))) / 2;
    assert.ok(Math.abs(drawn.lost[row] - lost) <= 1e-9 * (1 + lost), `${drawn.lost[row]}`);
    assert.ok(drawn.lost[row] >= drawn.lost[row - 1]);
  }
  assert.ok(lost > 1000);
  await page.close();
});

test("a study without mass and friction has neither marks nor leg forces of their own", async () => {
  const page = await open(report(light));
  (await marks(page)).forEach((leg) => assert.ok(!leg.cylinder && !leg.piston));
  assert.equal(await byName(page, "curve-leg-forces").count(), 0);
  assert.match(await page.locator(".bars h3").textContent(), /^Leg forces/);
  assert.equal(await page.locator("#legend .legend-title").textContent(), "force in a leg [N]");
  assert.equal(await byName(page, "curve-forces").locator("h3").textContent(), "Leg forces");
  assert.match(
    await byName(page, "curve-energy").locator(".note").textContent(),
    /The work of the legs is the sum over six of the integral of force times rate\.$/,
  );
  await byName(page, "mode-live").click();
  await page.waitForFunction(() => window.goughPage.live.centre);
  assert.equal(await byName(page, "strip-switch").count(), 0);
  assert.equal(await byName(page, "strip-forces").locator("h3").textContent(), "Leg forces");
  await page.close();
});

test("a switch changes the live strip from drive forces to leg forces and back", async () => {
  const page = await open(report(heavy), { webgl: false });
  await byName(page, "mode-live").click();
  await page.waitForFunction(
    () => {
      const { live } = window.goughPage;
      return live.row && live.row[live.place.t] > 1.5;
    },
    null,
    { timeout: limit(60000) },
  );
  const state = () =>
    page.evaluate(() => {
      const { strips } = window.goughPage.live;
      const { t, drives, legs } = strips.samples;
      strips.drawn = 0;
      strips.draw();
      const shown = strips.strips[1].plot.data;
      const same = (list) => list.every((values, k) => values === shown[k + 1]);
      return { drives: same(drives), legs: same(legs), count: t.length, drive: drives[4].at(-1), leg: legs[4].at(-1) };
    });
  const title = () => byName(page, "strip-forces").locator("h3").textContent();
  const button = byName(page, "strip-switch");
  assert.equal(await title(), "Drive forces");
  assert.equal(await button.textContent(), "show leg forces");
  const first = await state();
  assert.ok(first.drives && !first.legs && first.count > 10);
  assert.ok(Number.isFinite(first.leg) && Math.abs(first.drive - first.leg) > 1e-3);
  await button.click();
  assert.equal(await title(), "Leg forces");
  assert.equal(await button.textContent(), "show drive forces");
  const second = await state();
  assert.ok(second.legs && !second.drives);
  await byName(page, "strip-forces").scrollIntoViewIfNeeded();
  await picture(page, "legs-live");
  await button.click();
  assert.equal(await title(), "Drive forces");
  assert.deepEqual(page.said, []);
  await page.close();
});
