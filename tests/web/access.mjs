// The page for everybody: by keys, by fingers, for those who see no colours or nothing at all.
import assert from "node:assert/strict";
import test, { after } from "node:test";
import { byName, closeAll, example, open, report } from "./browser.mjs";

const paper = () => report(example("paper-perturbed"));
const UNSEEN = { webgl: false };

after(closeAll);

test("the view has five standard directions, and arrows turn it, with WebGL and without", async () => {
  for (const webgl of [true, false]) {
    const page = await open(paper(), { webgl });
    await byName(page, "scene-canvas").focus();
    const direction = () =>
      page.evaluate(() => {
        const { camera, controls } = window.goughPage.scene;
        return camera.position.clone().sub(controls.target).normalize().toArray();
      });
    const is = async (wanted, what) =>
      (await direction()).forEach((part, axis) =>
        assert.ok(Math.abs(part - wanted[axis]) < 2e-4, `${what}: ${part} for ${wanted[axis]}`),
      );
    const radian = Math.PI / 180;
    const from = (azimuth, elevation) => [
      Math.cos(elevation * radian) * Math.cos(azimuth * radian),
      Math.cos(elevation * radian) * Math.sin(azimuth * radian),
      Math.sin(elevation * radian),
    ];
    for (const [key, wanted] of [
      ["1", [0, -1, 0]],
      ["2", [1, 0, 0]],
      ["3", [0, 1, 0]],
      ["4", [0, 0, 1]],
      ["5", from(-62, 15)],
    ]) {
      await page.keyboard.press(key);
      await is(wanted, `view ${key}`);
    }
    await page.keyboard.press("ArrowRight");
    await page.keyboard.press("ArrowUp");
    await is(from(-57, 20), "turned");
    await page.keyboard.press("Shift+ArrowLeft");
    await is(from(-102, 20), "turned by 45°");
    assert.equal(await page.evaluate(() => window.goughPage.player.time), 0);
    assert.deepEqual(page.said, []);
    await page.close();
  }
});

test("letters do nothing outside the stage, where Home and End scroll the page", async () => {
  const page = await open(paper(), UNSEEN);
  await byName(page, "curve-forces").scrollIntoViewIfNeeded();
  await byName(page, "save-png-forces").focus();
  const state = () =>
    page.evaluate(() => {
      const { mode, switched, player } = window.goughPage;
      return JSON.stringify({ mode, switched, time: player.time, open: document.getElementById("keys").open });
    });
  const before = await state();
  for (const key of ["l", "w", "g", "p", "r", "1", "?", "+", "End"]) await page.keyboard.press(key);
  await page.waitForFunction(
    () => Math.abs(scrollY + innerHeight - document.documentElement.scrollHeight) < 3,
  );
  await page.keyboard.press("Home");
  await page.waitForFunction(() => scrollY < 3);
  assert.equal(await state(), before);
  await page.close();
});
