// One look at the page: it opens, the machine moves with the slider, the pose is the command's, the curves
// are drawn, the live run and the poses work. page.mjs, numbers.mjs, live.mjs, legs.mjs and reach.mjs look at each part.
import assert from "node:assert/strict";
import test, { after } from "node:test";
import { byName, closeAll, example, limit, open, picture, pictureDrawn, read, report, scrubTo, table } from "./browser.mjs";

after(closeAll);

test("opens, moves, and says what the command says", async () => {
  const file = example("paper-perturbed");
  const { names, rows } = table("simulate", file);
  const page = await open(report(file));
  assert.equal(await byName(page, "title").textContent(), "The paper's heave with disturbed leg forces");
  const drawn = async () => {
    await pictureDrawn(page);
    return page.evaluate(() => {
      const { renderer, stage, camera, canvas } = window.goughPage.scene;
      renderer.render(stage, camera);
      return canvas.toDataURL();
    });
  };
  const start = await drawn();
  await scrubTo(page, 300);
  assert.notEqual(await drawn(), start);
  const value = rows[300][names.indexOf("z")];
  assert.ok(Math.abs(read(await byName(page, "pose-z").textContent()) - value) <= 0.51e-5);
  assert.ok((await page.locator("figure:has(h3)").count()) > 10);
  await byName(page, "curve-forces").scrollIntoViewIfNeeded();
  await byName(page, "curve-forces").locator("canvas").waitFor();
  await picture(page, "opens");

  await byName(page, "mode-live").click();
  await page.waitForFunction(
    () => {
      const { live } = window.goughPage;
      return live.over || (live.row && live.row[live.place.t] > 0.02);
    },
    null,
    { timeout: limit(60000) },
  );
  await byName(page, "mode-reach").click();
  await page.waitForFunction(() => window.goughPage.reach.answer, null, { timeout: limit(60000) });
  const poses = await byName(page, "reach-poses").locator("tr").count();
  assert.ok((await byName(page, "reach-count").textContent()).startsWith(`${poses} real poses`));
  assert.deepEqual(page.said, []);
});
