// The page for everybody: by keys, by fingers, for those who see no colours or nothing at all.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { join } from "node:path";
import test, { after } from "node:test";
import { byName, closeAll, example, open, picture, pictureDrawn, report } from "./browser.mjs";

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

const require = createRequire(join(process.env.BUILD, "web/source/"));
const axe = readFileSync(require.resolve("axe-core/axe.min.js"), "utf8");

/** What axe-core finds wrong with the page, in lines. */
async function findings(page) {
  await page.evaluate(axe);
  return page.evaluate(async () => {
    const { violations } = await window.axe.run(document, {
      resultTypes: ["violations"],
      rules: { "target-size": { enabled: true } },
    });
    return violations.flatMap(({ id, nodes }) =>
      nodes.map(({ target, failureSummary }) => `${id}: ${target.join(" ")}: ${failureSummary}`),
    );
  });
}

/** Each way to see the page. */
const SIGHTS = [
  { name: "light" },
  { name: "dark", dark: true },
  { name: "forced", media: { forcedColors: "active" } },
  { name: "contrast", features: [{ name: "prefers-contrast", value: "more" }] },
];

test("axe-core finds nothing: light, dark, forced colours, more contrast; recorded, live, reach, side by side", async () => {
  const three = report(...["paper-heave", "paper-perturbed", "paper-feedback"].map(example));
  for (const { name, dark = false, media = {}, features = [] } of SIGHTS) {
    const see = async (page) => {
      await page.emulateMedia(media);
      if (!features.length) return;
      const session = await page.context().newCDPSession(page);
      await session.send("Emulation.setEmulatedMedia", { features });
      assert.ok(await page.evaluate(() => matchMedia("(prefers-contrast: more)").matches));
    };
    const page = await open(report(example("own-machine")), { ...UNSEEN, dark });
    await see(page);
    for (const mode of ["recorded", "live", "reach"]) {
      await byName(page, `mode-${mode}`).click();
      if (mode === "live") await page.waitForFunction(() => window.goughPage.live.row);
      if (mode === "reach") await page.locator("#travels li").first().waitFor();
      assert.deepEqual(await findings(page), [], `${name}, ${mode}`);
      await picture(page, `access-${name}-${mode}`);
    }
    await byName(page, "mode-recorded").click();
    // lines that are switched off, and the list of keys
    await byName(page, "leg-3").click();
    assert.deepEqual(await findings(page), [], `${name}, a leg is off`);
    await byName(page, "leg-3").click();
    await page.locator("#keys-open").click();
    assert.deepEqual(await findings(page), [], `${name}, keys`);
    await page.keyboard.press("Escape");
    await page.emulateMedia({ forcedColors: "none" });
    await page.close();
    const all = await open(three, { ...UNSEEN, dark });
    await see(all);
    assert.deepEqual(await findings(all), [], `${name}, side by side`);
    await picture(all, `access-${name}-three`);
    await all.emulateMedia({ forcedColors: "none" });
    await all.close();
  }
});

test("in forced colours the play button, the slider, swatches and what is pressed are seen", async () => {
  const page = await open(paper(), UNSEEN);
  await page.emulateMedia({ forcedColors: "active" });
  const seen = await page.evaluate(() => {
    const style = (selector, pseudo) => getComputedStyle(document.querySelector(selector), pseudo);
    const canvas = getComputedStyle(document.body).backgroundColor;
    return {
      canvas,
      play: style("[data-testid=play]", "::before").backgroundColor,
      swatch: style(".chip .swatch").backgroundColor,
      bar: style(".track .bar").backgroundColor,
      pressed: style(".switches [aria-pressed=true]").backgroundColor,
      selected: style(".modes [aria-selected=true]").backgroundColor,
      plain: style(".switches :not([aria-pressed])").backgroundColor,
    };
  });
  for (const name of ["play", "swatch", "bar", "pressed", "selected"])
    assert.notEqual(seen[name], seen.canvas, `${name} is ${seen[name]} on ${seen.canvas}`);
  assert.notEqual(seen.pressed, seen.plain);
  // the slider by its pixels: its track and its thumb are not the colour behind them
  await byName(page, "scrub").scrollIntoViewIfNeeded();
  const png = await byName(page, "scrub").screenshot();
  const colours = await page.evaluate(async (bytes) => {
    const image = await createImageBitmap(new Blob([new Uint8Array(bytes)]));
    const sheet = new OffscreenCanvas(image.width, image.height);
    const context = sheet.getContext("2d");
    context.drawImage(image, 0, 0);
    const { data } = context.getImageData(0, Math.round(image.height / 2) - 3, image.width, 6);
    const found = new Set();
    for (let k = 0; k < data.length; k += 4) found.add(data.slice(k, k + 3).join());
    return found.size;
  }, [...png]);
  assert.ok(colours > 2, `${colours} colours along the slider`);
  await page.emulateMedia({ forcedColors: "none" });
  await page.close();
});

test("each control is 24 pixels high and wide, on a desk and on a phone", async () => {
  for (const width of [1360, 360]) {
    const page = await open(report(example("own-machine")), { ...UNSEEN, width, height: 780 });
    for (const mode of ["recorded", "live", "reach"]) {
      await byName(page, `mode-${mode}`).click();
      if (mode === "reach") await page.locator("#travels li").first().waitFor();
      const small = await page.evaluate(() =>
        [...document.querySelectorAll("button, select, summary, a[href], input")]
          .map((node) => ({ node, box: (node.closest("label") ?? node).getBoundingClientRect() }))
          .filter(({ node, box }) => box.width && !node.matches(".skip") && (box.width < 23.9 || box.height < 23.9))
          .map(({ node, box }) => `${node.outerHTML.slice(0, 90)}: ${box.width} × ${box.height}`),
      );
      assert.deepEqual(small, [], `${mode} at ${width}`);
    }
    await page.close();
  }
});

/** What a drag of fingers changes: scrolling, and where the camera stands. Each drag has a page of its own: a page that a finger
    left scrolls on by its momentum, for a time that nothing bounds. */
async function touched(fingersOf, by, done) {
  const page = await open(paper(), { ...UNSEEN, touch: true });
  const session = await page.context().newCDPSession(page);
  const { x, y, width, height } = await byName(page, "scene-canvas").boundingBox();
  const fingers = fingersOf(x + 0.4 * width, y + 0.7 * height);
  const at = (share) => fingers.map(([fx, fy], id) => ({ x: fx + share * by[0], y: fy + share * by[1], id }));
  const state = () =>
    page.evaluate(() => ({ down: scrollY, eye: window.goughPage.scene.camera.position.toArray() }));
  const before = await state();
  await session.send("Input.dispatchTouchEvent", { type: "touchStart", touchPoints: at(0) });
  for (let step = 1; step <= 8; step++) {
    await session.send("Input.dispatchTouchEvent", { type: "touchMove", touchPoints: at(step / 8) });
    await page.waitForTimeout(20);
  }
  await session.send("Input.dispatchTouchEvent", { type: "touchEnd", touchPoints: [] });
  await page.waitForFunction(done, before);
  await pictureDrawn(page);
  const after = await state();
  assert.deepEqual(page.said, []);
  await page.close();
  return { before, after };
}

test("one finger scrolls the page, two turn the machine", async () => {
  const one = await touched((x, y) => [[x, y]], [0, -160], () => scrollY > 60);
  assert.deepEqual(one.after.eye, one.before.eye, "one finger does not turn");
  const two = await touched((x, y) => [[x, y], [x + 80, y]], [90, -60], (before) => {
    const { x, y, z } = window.goughPage.scene.camera.position;
    return Math.hypot(x - before.eye[0], y - before.eye[1], z - before.eye[2]) > 0.1;
  });
  assert.equal(two.after.down, two.before.down, "two fingers do not scroll");
});
