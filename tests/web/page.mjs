// The page of recorded runs in a browser: it draws, its numbers are those of the tables, it can be used without a mouse, on a
// phone, in the dark, without WebGL; what a study file says stays text.
import assert from "node:assert/strict";
import { createHash } from "node:crypto";
import test, { after } from "node:test";
import {
  byName,
  closeAll,
  example,
  factsOf,
  firstPictures,
  gough,
  open,
  picture,
  pictureDrawn,
  read,
  report,
  saved,
  scrubTo,
  sizeOf,
  study,
  table,
} from "./browser.mjs";

const paper = () => report(example("paper-perturbed"));
/** What a test does not look at need not be drawn: pixels of the scene take most of the time here. */
const UNSEEN = { webgl: false };

const shared = new Map();
/** A page that several tests use, one after the other, from its first moment: opening one takes longer than most tests. */
const sharedPage = async (name, file, options) => {
  if (!shared.has(name)) shared.set(name, await open(file, options));
  const page = shared.get(name);
  await page.evaluate(() => scrollTo(0, 0));
  await scrubTo(page, 0);
  return page;
};
const seenPaper = () => sharedPage("seen", paper());
const unseenPaper = () => sharedPage("unseen", paper(), UNSEEN);

/** What the scene draws now, as a short word. */
const pixels = async (page) => {
  await pictureDrawn(page);
  const drawn = await page.evaluate(() => {
    const { renderer, stage, camera, canvas } = window.goughPage.scene;
    renderer.render(stage, camera);
    return canvas.toDataURL();
  });
  return createHash("sha256").update(drawn).digest("hex");
};

after(closeAll);

test("opens without an error and shows the study", async () => {
  const page = await seenPaper();
  assert.deepEqual(page.said, []);
  assert.equal(
    await byName(page, "title").textContent(),
    "The paper's heave with disturbed leg forces",
  );
  await picture(page, "paper");
  await page.locator("#curves").scrollIntoViewIfNeeded();
  await picture(page, "paper-whole", { fullPage: true });
  assert.deepEqual(page.said, []);
});

test("is below 1.3 MB for twenty units, and draws its first picture within a second", async () => {
  assert.ok(sizeOf(paper()) <= 1.3e6, `${sizeOf(paper())} bytes`);
  const tries = await firstPictures(paper());
  assert.ok(
    tries.some(({ time, most }) => time < most),
    `first pictures after ${tries.map(({ time, most }) => `${time} ms, limit ${most.toFixed(0)}`)}`,
  );
});

test("the picture changes with time, and comes back with it", async () => {
  const page = await seenPaper();
  await scrubTo(page, 0);
  const start = await pixels(page);
  await scrubTo(page, 340);
  const later = await pixels(page);
  await scrubTo(page, 0);
  assert.notEqual(start, later);
  assert.equal(await pixels(page), start);
});

test("scrubbing moves all cursors, and the numbers shown are those of the table", async () => {
  const { names, rows } = table("simulate", example("paper-perturbed"));
  const page = await unseenPaper();
  const cursor = () => byName(page, "cursor-forces").evaluate((line) => line.style.transform);
  await byName(page, "curve-forces").scrollIntoViewIfNeeded();
  let before = await cursor();
  for (const row of [40, 137, 300, 400]) {
    await scrubTo(page, row);
    const value = (name) => rows[row][names.indexOf(name)];
    // what is below the noise of the run is shown as 0, and no digit beyond it
    const near = (text, wanted, digits, noise) =>
      assert.ok(
        Math.abs(read(text) - wanted) <=
          noise + 0.51 * 10 ** (Math.ceil(Math.log10(Math.abs(wanted) || 1e-12)) - digits),
        `${text} for ${wanted}`,
      );
    assert.equal(
      read((await byName(page, "clock").textContent()).replace("t = ", "")),
      Number(value("t").toFixed(2)),
    );
    for (const name of ["x", "y", "z"])
      assert.ok(
        Math.abs(read(await byName(page, `pose-${name}`).textContent()) - value(name)) <= 0.51e-5,
      );
    for (const name of ["roll", "pitch", "yaw"])
      assert.ok(
        Math.abs(read(await byName(page, `pose-${name}`).textContent()) - value(name)) <= 0.51e-4,
      );
    for (const axis of ["x", "y", "z", "roll", "pitch", "yaw"])
      near(
        await byName(page, `off-${axis}`).textContent(),
        value(`e${axis}`),
        3,
        axis.length === 1 ? 2e-8 : 1e-6,
      );
    for (const leg of [1, 2, 3, 4, 5, 6]) {
      near(await byName(page, `force-${leg}`).textContent(), value(`f${leg}`), 4, 2e-8);
      near(await byName(page, `value-forces-f${leg}`).textContent(), value(`f${leg}`), 5, 2e-8);
    }
    const moved = await cursor();
    assert.notEqual(moved, before);
    before = moved;
  }
  await scrubTo(page, 137);
  for (const id of ["forces", "rates", "drift", "condition"]) {
    await byName(page, `curve-${id}`).scrollIntoViewIfNeeded();
    await pictureDrawn(page);
    const other = await byName(page, `cursor-${id}`).evaluate((line) => line.style.transform);
    // of the plot, which begins where the numbers of its axis end; the place is written to a tenth of a pixel
    const width = await byName(page, `curve-${id}`)
      .locator(".u-over")
      .evaluate((over) => over.getBoundingClientRect().width);
    const place = Number(/-?[\d.]+/.exec(other)[0]);
    assert.ok(Math.abs(place - (137 / 400) * width) <= 0.06, `${id}: ${place} of ${width}`);
  }
});

test("pointing into a curve shows the numbers there, and a click moves the scene to that moment", async () => {
  const page = await unseenPaper();
  await byName(page, "curve-forces").scrollIntoViewIfNeeded(); // it is drawn when it comes near
  const plot = byName(page, "curve-forces").locator(".u-over");
  await plot.scrollIntoViewIfNeeded();
  const { names, rows } = table("simulate", example("paper-perturbed"));
  const shown = async () => read(await byName(page, "value-rates-dl1").textContent());
  const clock = async () => read((await byName(page, "clock").textContent()).slice(4));
  await byName(page, "curve-rates").scrollIntoViewIfNeeded();
  await pictureDrawn(page);
  const atStart = await shown();
  const over = byName(page, "curve-rates").locator(".u-over");
  const rates = await over.boundingBox();
  await page.mouse.move(rates.x + 0.75 * rates.width, rates.y + 60);
  await pictureDrawn(page);
  assert.equal(await clock(), 0);
  const pointed = await shown();
  const near = rows.slice(295, 306).map((row) => row[names.indexOf("dl1")]);
  assert.ok(near.some((rate) => Math.abs(rate - pointed) <= 1e-4 * Math.abs(rate)), `${pointed} of ${near}`);
  await page.mouse.move(5, 5);
  await pictureDrawn(page);
  assert.equal(await shown(), atStart);
  await byName(page, "curve-forces").scrollIntoViewIfNeeded();
  const place = await plot.boundingBox();
  await page.mouse.click(place.x + 0.75 * place.width, place.y + 60);
  await pictureDrawn(page);
  assert.ok(Math.abs((await clock()) - 15) <= 0.1);
});

test("the saved table has the bits of the command's", async () => {
  const { names, rows } = table("simulate", example("paper-perturbed"));
  const page = await unseenPaper();
  const { name, bytes } = await saved(page, "save-run-0");
  assert.equal(name, "the-paper-s-heave-with-disturbed-leg-forces-run.csv");
  const [head, ...lines] = bytes.toString().trim().split("\n");
  assert.deepEqual(head.split(","), names);
  assert.equal(lines.length, rows.length);
  lines.forEach((line, row) =>
    line
      .split(",")
      .forEach((text, column) =>
        assert.ok(
          Object.is(Number(text), rows[row][column]),
          `row ${row}, ${names[column]}: ${text}`,
        ),
      ),
  );
});

test("each figure is saved as PNG and as SVG, and the scene as PNG", async () => {
  const page = await open(report(example("own-machine")));
  for (const figure of ["forces", "lengths", "deviation", "energy"]) {
    await byName(page, `curve-${figure}`).scrollIntoViewIfNeeded();
    const svg = (await saved(page, `save-svg-${figure}`)).bytes.toString();
    const broken = await page.evaluate(
      (text) =>
        new DOMParser().parseFromString(text, "image/svg+xml").querySelector("parsererror")
          ?.textContent ?? "",
      svg,
    );
    assert.equal(broken, "");
    assert.match(svg, /<path d="M[\d. L-]{400}/);
    const png = (await saved(page, `save-png-${figure}`)).bytes;
    assert.equal(png.subarray(1, 4).toString(), "PNG");
    assert.ok(png.length > 8000, `${png.length} bytes`);
  }
  assert.equal((await saved(page, "save-scene")).bytes.subarray(1, 4).toString(), "PNG");
  assert.deepEqual(page.said, []);
  await page.close();
});

test("figures 3 and 4 stand on the paper's study, and on no other", async () => {
  const page = await unseenPaper();
  // the force of the program at t = 5 and 15, and η* there
  for (const [row, force] of [
    [100, 0.255489804668],
    [300, 0.170547755345],
  ]) {
    await byName(page, "curve-figure-3").scrollIntoViewIfNeeded();
    await scrubTo(page, row);
    assert.ok(
      Math.abs(read(await byName(page, "value-figure-3-f1").textContent()) - force) <= 0.51e-5,
    );
  }
  await scrubTo(page, 320);
  assert.ok(
    Math.abs(
      read(await byName(page, "value-figure-4-0").textContent()) -
        read(await byName(page, "value-figure-4-program").textContent()) -
        0.285908,
    ) <= 2e-5,
  );
  await picture(page, "figures-3-and-4");
  const other = await open(report(example("all-six")), UNSEEN);
  assert.equal(
    (await byName(other, "curve-figure-3").count()) +
      (await byName(other, "curve-figure-4").count()),
    0,
  );
  await other.close();
});

test("legs can be switched off, time zoomed and shown whole again", async () => {
  const page = await open(report(example("all-six")), UNSEEN);
  const plot = byName(page, "curve-forces").locator(".u-over");
  await plot.scrollIntoViewIfNeeded();
  const drawn = () =>
    byName(page, "curve-forces")
      .locator("canvas")
      .evaluate((canvas) => canvas.toDataURL());
  const whole = await drawn();
  await byName(page, "leg-3").click();
  assert.notEqual(await drawn(), whole);
  await byName(page, "leg-3").click();
  await pictureDrawn(page);
  const box = await plot.boundingBox();
  await page.mouse.move(box.x + 0.3 * box.width, box.y + 50);
  await page.mouse.down();
  await page.mouse.move(box.x + 0.5 * box.width, box.y + 60, { steps: 4 });
  await page.mouse.up();
  const [from, to] = await page.evaluate(() => window.goughPage.section.range.shown);
  assert.ok(Math.abs(from - 6) < 0.2 && Math.abs(to - 10) < 0.2, `${from} to ${to}`);
  await picture(page, "zoomed");
  await byName(page, "whole-range").click();
  assert.deepEqual(await page.evaluate(() => window.goughPage.section.range.shown), [0, 20]);
  await page.close();
});

test("limits are drawn where the study has them", async () => {
  const limitPixels = async (file) => {
    const page = await open(file, UNSEEN);
    await byName(page, "curve-lengths").scrollIntoViewIfNeeded();
    await pictureDrawn(page);
    const count = await byName(page, "curve-lengths")
      .locator("canvas")
      .evaluate((canvas) => {
        const { data } = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
        let found = 0;
        for (let k = 0; k < data.length; k += 4)
          if (
            Math.abs(data[k] - 0xb0) + Math.abs(data[k + 1] - 0x3a) + Math.abs(data[k + 2] - 0x0c) <
              12 &&
            data[k + 3] > 200
          )
            found++;
        return found;
      });
    await picture(page, `limits-${count > 0}`);
    await page.close();
    return count;
  };
  assert.ok((await limitPixels(report(example("own-machine")))) > 200);
  assert.equal(await limitPixels(paper()), 0);
});

test("keys of the stage play, step, jump and turn the view", async () => {
  const page = await seenPaper();
  const time = () => page.evaluate(() => window.goughPage.player.time);
  const near = async (wanted) =>
    assert.ok(Math.abs((await time()) - wanted) < 1e-9, `${await time()} for ${wanted}`);
  const scene = byName(page, "scene-canvas");
  await scene.focus();
  await page.keyboard.press("Home");
  await byName(page, "play").focus();
  await page.keyboard.press("ArrowRight");
  await near(0.05);
  await page.keyboard.press("Shift+ArrowRight");
  await near(0.55);
  await page.keyboard.press("ArrowLeft");
  await near(0.5);
  await page.keyboard.press("End");
  await near(20);
  await page.keyboard.press("Home");
  await near(0);
  const view = await pixels(page);
  const box = await scene.boundingBox();
  await page.mouse.move(box.x + 200, box.y + 300);
  await page.mouse.down();
  await page.mouse.move(box.x + 320, box.y + 260, { steps: 4 });
  await page.mouse.up();
  await pictureDrawn(page);
  assert.notEqual(await pixels(page), view);
  await page.keyboard.press("r");
  await pictureDrawn(page);
  assert.equal(await pixels(page), view);
  await page.keyboard.press("Space");
  await page.waitForFunction(() => window.goughPage.player.time > 0.1);
  await page.keyboard.press("Space");
  const stopped = await time();
  await page.waitForTimeout(200);
  assert.equal(await time(), stopped);
});

test("plays by itself, but not for a reader who wants less motion", async () => {
  const still = await open(paper(), UNSEEN);
  await still.waitForTimeout(300);
  assert.equal(await still.evaluate(() => window.goughPage.player.time), 0);
  await still.close();
  const moving = await open(paper(), { motion: true });
  await moving.waitForFunction(() => window.goughPage.player.time > 0.1);
  await moving.close();
});

test("a narrow window lays out without overflow", async () => {
  for (const [width, files] of [
    [360, [example("own-machine")]],
    [360, [example("paper-heave"), example("paper-perturbed"), example("paper-feedback")]],
    [768, [example("own-machine")]],
  ]) {
    const page = await open(report(...files), { width, height: 780, webgl: width === 360 && files.length === 1 });
    for (const section of ["#stage", "#panel", "#curves", "#numbers"]) {
      await page.locator(section).scrollIntoViewIfNeeded();
      assert.ok(
        (await page.evaluate(() => document.documentElement.scrollWidth - innerWidth)) <= 0,
        `${section} at ${width}`,
      );
    }
    // words of headings are whole, and so are buttons
    const broken = await page.evaluate(() => {
      const found = [];
      for (const heading of document.querySelectorAll("thead th")) {
        const text = heading.firstChild;
        for (const word of text?.data?.matchAll(/[^\s-]+/g) ?? []) {
          const range = document.createRange();
          range.setStart(text, word.index);
          range.setEnd(text, word.index + word[0].length);
          if (range.getClientRects().length > 1) found.push(word[0]);
        }
      }
      for (const button of document.querySelectorAll(".switches button"))
        if (button.getBoundingClientRect().right > button.parentElement.getBoundingClientRect().right + 1)
          found.push(button.textContent);
      return found;
    });
    assert.deepEqual(broken, [], `cut at ${width}`);
    await page.evaluate(() => scrollTo(0, 0));
    await picture(page, `narrow-${width}-${files.length}`);
    await page.close();
  }
});

test("figures that are drawn late have their room from the beginning", async () => {
  const page = await open(paper(), { width: 1400, height: 900, ...UNSEEN });
  const height = () => page.evaluate(() => document.documentElement.scrollHeight);
  const before = await height();
  assert.ok(before > 3000, "there is something below the window");
  for (let y = 0; y < before; y += 600) {
    await page.evaluate((y) => scrollTo(0, y), y);
    await page.waitForTimeout(50);
  }
  // lines of numbers in a key may still wrap
  assert.ok(Math.abs((await height()) - before) < 60, `${before} becomes ${await height()}`);
  await page.close();
});

test("light and dark follow the system and the button", async () => {
  const back = (page) => page.evaluate(() => getComputedStyle(document.body).backgroundColor);
  const light = await open(paper(), UNSEEN);
  const dark = await open(paper(), { dark: true });
  const [day, night] = [await back(light), await back(dark)];
  assert.notEqual(day, night);
  await picture(dark, "dark");
  await byName(light, "theme").click();
  assert.equal(await back(light), night);
  await byName(dark, "theme").click();
  assert.equal(await back(dark), day);
  assert.deepEqual([...light.said, ...dark.said], []);
  await light.close();
  await dark.close();
});

test("without WebGL the page says so and draws the machine by lines; curves and numbers work", async () => {
  const page = await open(paper(), { webgl: false });
  assert.match(await byName(page, "no-webgl").textContent(), /WebGL/);
  // places of joints on the sheet against the camera of three.js, which the drawing does not use
  const joints = await page.evaluate(() => {
    const { camera, canvas, entries } = window.goughPage.scene;
    camera.updateMatrixWorld();
    const { clientWidth: width, clientHeight: height } = canvas.parentElement;
    const drawn = [...canvas.querySelectorAll(".joint")].map((node) => [
      Number(node.getAttribute("cx")),
      Number(node.getAttribute("cy")),
    ]);
    return entries[0].machine.base.map((joint) => {
      const seen = camera.position.clone().set(...joint).project(camera);
      const [x, y] = [((seen.x + 1) * width) / 2, ((1 - seen.y) * height) / 2];
      return Math.min(...drawn.map((place) => Math.hypot(place[0] - x, place[1] - y)));
    });
  });
  joints.forEach((off) => assert.ok(off < 0.01, `a joint is drawn ${off} pixels beside its place`));
  const drawn = () => byName(page, "scene-canvas").evaluate((svg) => svg.innerHTML);
  const before = await drawn();
  await scrubTo(page, 300);
  assert.notEqual(await drawn(), before);
  assert.equal((await saved(page, "save-scene")).bytes.subarray(1, 4).toString(), "PNG");
  assert.ok(Math.abs(read(await byName(page, "pose-z").textContent()) - 1.3125748) < 2e-4);
  await byName(page, "curve-forces").scrollIntoViewIfNeeded();
  await byName(page, "cursor-forces").waitFor();
  await pictureDrawn(page);
  assert.ok(Math.abs(read(await byName(page, "value-forces-f1").textContent()) - 0.17045) < 2e-5);
  assert.deepEqual(page.said, []);
  await picture(page, "without-webgl");
  await page.close();
});

test("several studies stand side by side, and each by itself", async () => {
  const page = await open(
    report(example("paper-heave"), example("paper-perturbed"), example("paper-feedback")),
  );
  await scrubTo(page, 340);
  assert.equal(await page.locator("#studies [role=tab]").count(), 4);
  assert.equal(await page.locator(".contender").count(), 3);
  await picture(page, "comparison");
  const table = await byName(page, "comparison").innerText();
  for (const words of [
    "Vertical oscillation of a symmetric hexapod",
    "The paper's heave with disturbed leg forces",
    "The paper's heave, disturbed and fed back",
  ])
    assert.ok(table.includes(words), words);
  await byName(page, "curve-figure-4").scrollIntoViewIfNeeded();
  await pictureDrawn(page);
  assert.ok(
    read(await byName(page, "value-figure-4-1").textContent()) >
      read(await byName(page, "value-figure-4-2").textContent()) + 0.3,
  );
  await byName(page, "tab-2").click();
  await page.waitForFunction(
    () =>
      document.getElementById("title").textContent === "The paper's heave, disturbed and fed back",
  );
  assert.equal(await byName(page, "curve-forces").count(), 1);
  assert.deepEqual(page.said, []);
  await page.close();
});

test("studies of different units are not mixed up", async () => {
  const page = await open(report(example("own-machine"), example("paper-heave")), UNSEEN);
  await scrubTo(page, 100);
  assert.ok(!(await byName(page, "clock").textContent()).includes("s"));
  assert.match(await byName(page, "curve-all-height").textContent(), /own units/);
  await picture(page, "mixed-units");
  assert.deepEqual(page.said, []);
  await page.close();
});

const hostile = `</script><script>window.broken = 1</script><img src=x onerror="window.broken = 2">'"\`&amp; ξηζ 六足 \\u2028`;

test("what a study says is text and runs nothing", async () => {
  const text = `title: ${JSON.stringify(hostile)}
# </script><script>window.broken = 3</script>
units: dimensionless
platform: {base: {radius: 1, half_angle: 10}, top: {radius: 0.6, half_angle: 15}, height: 1}
load: {mass: 1, center_of_mass: [0, 0, 0], inertia: [0.08, 0.08, 0.15]}
motion: {heave: 0.1*sin(t)}
control: {stiffness: 20, damping: 2}
simulation: {duration: 2, output_step: 0.05}
`;
  const said = JSON.parse(JSON.stringify(hostile).replace("\\\\u2028", "\\\\u2028"));
  const file = study("hostile.yaml", text);
  const page = await open(report(file, example("own-machine")), UNSEEN);
  await page.waitForTimeout(200);
  await byName(page, "tab-0").click();
  assert.equal(await byName(page, "title").textContent(), said);
  assert.equal(await page.evaluate(() => window.broken), undefined);
  assert.equal(await page.locator("img, script:not([type])").count(), 0);
  assert.ok((await byName(page, "study-text").textContent()).includes("window.broken = 3"));
  await byName(page, "curve-forces").scrollIntoViewIfNeeded();
  const svg = (await saved(page, "save-svg-forces")).bytes.toString();
  assert.ok(!svg.includes("<script") && !svg.includes("<img"));
  assert.deepEqual(page.said, []);
  await picture(page, "hostile");
  await page.close();
});

test("a run that ended early says where and why", async () => {
  const page = await open(report(example("paper-no-feedforward"), "--set", "control.stiffness=2"));
  const ending = await byName(page, "ending").textContent();
  assert.match(ending, /17\.147/);
  assert.match(ending, /singular/);
  assert.match(await byName(page, "end-facts").textContent(), /singular pose at t = 17\.14699/);
  await byName(page, "scene-canvas").focus();
  await page.keyboard.press("End");
  await pictureDrawn(page);
  await picture(page, "ended-early");
  assert.deepEqual(page.said, []);
  await page.close();
});

test("stability and peaks stand as the command finds them", async () => {
  const found = JSON.parse(gough("stability", example("paper-perturbed"), "--json", "-q"));
  const page = await unseenPaper();
  const shown = async (name, column) => {
    const cells = byName(page, name).locator(`tbody td:nth-child(${column})`);
    return (await cells.allTextContents()).map(read);
  };
  const sizes = found.multipliers
    .filter(([, im]) => im >= 0)
    .map((multiplier) => Math.hypot(...multiplier))
    .sort((a, b) => b - a);
  (await shown("multipliers", 2)).forEach((size, index) => {
    assert.ok(Math.abs(size / sizes[index] - 1) < 1e-5, `${size} for ${sizes[index]}`);
  });
  const thresholds = await shown("thresholds", 2);
  for (const { stiffness } of found.thresholds)
    assert.ok(
      thresholds.some((threshold) => Math.abs(threshold / stiffness - 1) < 1e-5),
      `${stiffness}`,
    );
  assert.match(await byName(page, "stability").textContent(), /Some mode grows about the program/);
  assert.match(
    await byName(page, "stability").locator("svg").getAttribute("aria-label"),
    new RegExp(`${sizes.filter((size) => size > 1).length} of 12 outside`),
  );
  const { legs } = JSON.parse(gough("simulate", example("paper-perturbed"), "--json", "-q"));
  const speeds = await shown("legs-run", 4);
  legs.forEach(({ speed }, leg) => assert.ok(Math.abs(speeds[leg] / speed - 1) < 1e-4));
  await byName(page, "stability").scrollIntoViewIfNeeded();
  await picture(page, "stability");
});

test("limits of single legs, of joints and of the platform are among the facts of the machine", async () => {
  const page = await open(
    report(
      example("own-machine"),
      ...["--set", "platform.legs={max_speed: [0.25, 0.26, 0.27, 0.28, 0.29, 0.3], force: [-70, 80], max_acceleration: 6}"],
      ...["--set", "platform.joints={base_swing: 31, top_swing: [41, 42, 43, 44, 45, 46]}"],
      ...["--set", "platform.limits={heave: [-0.05, 0.08], yaw: 22, speed: {surge: 0.5, yaw: 40}}"],
      ...["--set", "platform.limits.acceleration={heave: [-5, 7], roll: 90}"],
    ),
    { webgl: false },
  );
  const machine = await factsOf(page, "machine-facts");
  const minus = (text) => text.replaceAll("\u2212", "-");
  for (const [term, text] of [
    ["greatest speed", "0.25, 0.26, 0.27, 0.28, 0.29, 0.3 m/s"],
    ["force limits", "-70 to 80 N"],
    ["greatest acceleration of a leg", "6 m/s²"],
    ["swing at the base", "31 °"],
    ["swing at the top", "41, 42, 43, 44, 45, 46 °"],
    ["heave", "-0.05 to 0.08 m"],
    ["yaw", "±22 °"],
    ["surge velocity", "±0.5 m/s"],
    ["yaw velocity", "±40 °/s"],
    ["heave acceleration", "-5 to 7 m/s²"],
    ["roll acceleration", "±90 °/s²"],
  ])
    assert.equal(minus(machine[term] ?? "missing"), text, term);
  assert.ok(!("greatest force" in machine) && !("length limits" in machine) && !("pitch" in machine));
  await page.close();
});
