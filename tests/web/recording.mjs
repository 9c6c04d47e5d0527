// A long recording in the page.
import assert from "node:assert/strict";
import test, { after } from "node:test";
import { byName, closeAll, open, picture, report, saved, sizeOf, study } from "./browser.mjs";

after(closeAll);

/** Ten minutes of an own machine at 100 rows a second. */
const text = `title: A long recording
units: si
platform: {base: {radius: 0.25, half_angle: 10}, top: {radius: 0.15, half_angle: 10}, height: 0.28}
load: {mass: 6, center_of_mass: [0, 0, 0.05], inertia: [0.05, 0.05, 0.08]}
motion: {heave: "0.02*sin(3*t)*ramp(t, 2)", roll: "3*sin(2.1*t)*ramp(t, 2)", yaw: "4*sin(1.3*t)*ramp(t, 2)"}
control: {stiffness: 5000, damping: 150}
simulation: {duration: 600, output_step: 0.01, method: rk4, step: 0.01}
`;

for (const [name, most, ...options] of [
  ["long", 14e6],
  ["long-thin", 8e6, "--thin"],
])
  test(`ten minutes at 100 rows a second open, and scrub smoothly: ${name}`, async () => {
    const file = report(study("long.yaml", text), ...options);
    assert.ok(sizeOf(file) <= most, `${sizeOf(file)} bytes`);
    const page = await open(file);
  assert.equal(await page.evaluate(() => window.goughPage.studies[0].run.rows), 60001);
  await byName(page, "curve-forces").scrollIntoViewIfNeeded();
  // the page's own work for one moment: scene, panel, cursors (drawing pixels is the browser's)
  const spent = await page.evaluate(() => {
    const { goughPage } = window;
    const times = [];
    for (let k = 0; k < 60; k++) {
      const begun = performance.now();
      goughPage.player.seekRow(10 * k + 3.21);
      goughPage.show();
      times.push(performance.now() - begun);
    }
    return times.sort((a, b) => a - b)[30];
  });
  assert.ok(spent < 8, `${spent} ms`);
  // zoomed to a second, the drawing has every row
  await page.evaluate(() => window.goughPage.section.range.set(100, 101));
  const drawn = await page.evaluate(
    () =>
      window.goughPage.section.curves.find((curve) => curve.spec.id === "forces").data().data[0]
        .length,
  );
  assert.ok(drawn >= 101 && drawn <= 104, `${drawn} points`);
  const { bytes } = await saved(page, "save-run-0");
  assert.equal(bytes.toString().trim().split("\n").length, 60002);
  await picture(page, name);
  await page.close();
});
