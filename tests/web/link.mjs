// The address of the page says what it shows, and a page that is opened with it shows the same; the reader's view stays when
// another study is chosen; the machine or its play bar is in sight beside the curves.
import assert from "node:assert/strict";
import test, { after } from "node:test";
import { byName, closeAll, example, open, picture, pictureDrawn, report, scrubTo } from "./browser.mjs";

const UNSEEN = { webgl: false };
const three = () => report(example("paper-heave"), example("paper-perturbed"), example("paper-feedback"));

after(closeAll);

/** What is shown, as far as the address should keep it. */
const shownOn = (page) =>
  page.evaluate(() => {
    const { chosen, mode, player, scene, section, switched } = window.goughPage;
    return {
      chosen,
      mode,
      time: player.time,
      playing: player.playing,
      view: scene.eye.view,
      range: section.range.shown,
      switched: { ...switched },
      legs: section.hiddenLegs,
    };
  });

function assertSame(actual, wanted) {
  for (const name of ["chosen", "mode", "playing", "switched", "legs"])
    assert.deepEqual(actual[name], wanted[name], name);
  assert.ok(Math.abs(actual.time - wanted.time) < 1e-9, `${actual.time} for ${wanted.time}`);
  // the address has six digits
  for (const name of ["view", "range"])
    actual[name].forEach((value, place) => {
      const expected = wanted[name][place];
      assert.ok(Math.abs(value - expected) <= 1e-5 * Math.max(1, Math.abs(expected)), `${name}: ${actual[name]}`);
    });
}

/** The page at an address, opened anew. */
async function reopened(address) {
  const page = await open(address.split("#")[0].replace("file://", ""), UNSEEN);
  await page.goto("about:blank");
  await page.goto(address);
  await page.waitForFunction(() => document.documentElement.dataset.ready === "true");
  return page;
}

test("copy link: study, time, view, range, switches and legs come back on a page that is opened with it", async () => {
  const page = await open(three(), UNSEEN);
  await byName(page, "tab-1").click();
  await page.waitForFunction(() => window.goughPage.section.shown.length === 1);
  await scrubTo(page, 137);
  const scene = byName(page, "scene-canvas");
  await scene.focus();
  for (const key of ["ArrowLeft", "Shift+ArrowRight", "ArrowUp", "+"]) await page.keyboard.press(key);
  await page.locator('[data-part="ghost"]').click();
  await page.evaluate(() => window.goughPage.section.range.set(3, 9.5));
  await byName(page, "leg-2").click();
  await byName(page, "copy-link").click();
  await page.waitForFunction(() => document.getElementById("link-said").textContent !== "");
  const address = page.url();
  const wanted = await shownOn(page);
  assert.match(address, /^file:.*#study=1&t=6\.85&/);
  assert.deepEqual(page.said, []);
  await page.close();
  const again = await reopened(address);
  assertSame(await shownOn(again), wanted);
  assert.deepEqual([wanted.chosen, wanted.switched.ghost, wanted.legs], [1, false, [2]]);
  assert.deepEqual(again.said, []);
  await again.close();
});

test("settings of the live run come back", async () => {
  const page = await open(report(example("paper-perturbed")), UNSEEN);
  await byName(page, "mode-live").click();
  await byName(page, "live-stiffness-number").fill("0.37");
  await byName(page, "live-stiffness-number").press("Enter");
  await byName(page, "live-feedforward").click();
  await page.waitForFunction(() => location.hash.includes("stiffness=0.37") && location.hash.includes("feedforward=0"));
  const address = page.url();
  await page.close();
  const again = await reopened(address);
  assert.equal(await again.evaluate(() => window.goughPage.mode), "live");
  assert.equal(await byName(again, "live-stiffness-number").inputValue(), "0.37");
  assert.equal(await byName(again, "live-feedforward").isChecked(), false);
  assert.equal(await byName(again, "live-damping-number").inputValue(), "0");
  await again.close();
});

test("an address that makes no sense shows the page as it begins", async () => {
  const page = await open(three(), UNSEEN);
  const wanted = await shownOn(page);
  const [address] = page.url().split("#");
  await page.close();
  for (const words of [
    "study=9&t=x&view=1,2&range=5,1&part=none&off=sun&legs-off=0,7",
    "%%%",
    "study=__proto__&view=1,2,-3,4,5,6&t=1e999",
  ]) {
    const again = await reopened(`${address}#${words}`);
    const shown = await shownOn(again);
    assertSame(shown, wanted);
    assert.deepEqual(again.said, []);
    await again.close();
  }
});

test("the view stays when another study is chosen, and the button resets it", async () => {
  const page = await open(three(), UNSEEN);
  const view = () =>
    page.evaluate(() => {
      const { eye } = window.goughPage.scene;
      return eye.view.slice(0, 3).map((part) => part.toFixed(4)).join();
    });
  const first = await view();
  await byName(page, "scene-canvas").focus();
  for (const key of ["ArrowLeft", "ArrowLeft", "ArrowUp", "-"]) await page.keyboard.press(key);
  const turned = await view();
  assert.notEqual(turned, first);
  await byName(page, "tab-2").click();
  assert.equal(await view(), turned);
  await page.setViewportSize({ width: 900, height: 1000 });
  await pictureDrawn(page);
  await pictureDrawn(page);
  assert.equal(await view(), turned);
  await byName(page, "reset-view").click();
  assert.equal(await view(), first);
  await page.close();
});

test("beside the curves the machine stays in sight in a wide window, its play bar in a narrow one", async () => {
  const box = (page, id) =>
    page.evaluate((name) => {
      const { left, top, right, bottom } = document.getElementById(name).getBoundingClientRect();
      return { left, top, right, bottom };
    }, id);
  const scrolled = async (width) => {
    const page = await open(report(example("own-machine")), { ...UNSEEN, width, height: 900 });
    await byName(page, "curve-orientation").evaluate((card) => card.scrollIntoView({ block: "start", behavior: "instant" }));
    await pictureDrawn(page);
    return page;
  };
  const wide = await scrolled(1280);
  const view = await box(wide, "view");
  const transport = await box(wide, "transport");
  const card = await box(wide, "curve-orientation");
  assert.ok(view.top >= 0 && view.bottom - view.top > 250, JSON.stringify(view));
  assert.ok(transport.bottom <= 900, JSON.stringify(transport));
  assert.ok(view.right <= card.left && card.top < 900, "side by side");
  await picture(wide, "beside");
  await wide.close();
  const narrow = await scrolled(900);
  await narrow.waitForFunction(() => document.getElementById("transport").classList.contains("afloat"));
  const bar = await box(narrow, "transport");
  assert.ok(bar.bottom <= 900.5 && bar.bottom > 890, JSON.stringify(bar));
  await byName(narrow, "play").click();
  await narrow.waitForFunction(() => window.goughPage.player.playing);
  await narrow.evaluate(() => scrollTo({ top: 0, behavior: "instant" }));
  await narrow.waitForFunction(() => !document.getElementById("transport").classList.contains("afloat"));
  await narrow.close();
});

test("labels name studies in place of their titles", async () => {
  const file = report(example("paper-heave"), example("paper-heave"), "--label", "light <b>", "--label", "heavy");
  const page = await open(file, UNSEEN);
  const names = await page.locator("#studies [role=tab]").allTextContents();
  assert.deepEqual(names, ["All", "light <b>", "heavy"]);
  await byName(page, "tab-1").click();
  assert.equal(await byName(page, "title").textContent(), "heavy");
  await page.close();
});
