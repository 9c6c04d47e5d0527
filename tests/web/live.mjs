// The live run in the page: the core in its thread, sliders, the reader's hand, and what is said when the platform goes.
import assert from "node:assert/strict";
import test, { after } from "node:test";
import {
  byName,
  closeAll,
  example,
  flightSimulator,
  limit,
  open,
  picture,
  pictureDrawn,
  read,
  report,
  saved,
  study,
  table,
} from "./browser.mjs";

after(closeAll);

/** The page of a study, live; without the scene, whose pixels take most of the time here, unless a test looks at it. */
const SEEN = { webgl: true };
async function live(file, options) {
  const page = await open(report(file), { webgl: false, ...options });
  await byName(page, "mode-live").click();
  await page.waitForFunction(() => window.goughPage.live.centre);
  return page;
}

async function set(page, name, value) {
  const box = byName(page, `live-${name}-number`);
  await box.fill(String(value));
  await box.press("Enter");
}

const time = (page) =>
  page.evaluate(() => {
    const { live } = window.goughPage;
    return live.row[live.place.t];
  });
const off = (page) =>
  page.evaluate(() => {
    const { live } = window.goughPage;
    return Math.hypot(...["ex", "ey", "ez"].map((name) => live.row[live.place[name]]));
  });
const turned = (page) =>
  page.evaluate(() => {
    const { live } = window.goughPage;
    return Math.hypot(...["eroll", "epitch", "eyaw"].map((name) => live.row[live.place[name]]));
  });
const reach = (page, wanted) =>
  page.waitForFunction(
    (t) => {
      const { live } = window.goughPage;
      return live.over || live.row[live.place.t] > t;
    },
    wanted,
    { timeout: limit(120000) },
  );

test("below the threshold of G the platform leaves and the page says why; above it stays", async () => {
  const page = await live(example("paper-feedback"), SEEN);
  await set(page, "stiffness", 0.05);
  await set(page, "speed", 10);
  await byName(page, "fallen").waitFor({ state: "visible", timeout: limit(120000) });
  assert.match(await byName(page, "fallen").textContent(), /at t = [\d.]+/);
  // gone in place or, where yaw or tilt was faster, in angle: far beyond what it is when it holds
  assert.ok(Math.max(await off(page), await turned(page)) > 0.1, `${await off(page)} off`);
  await picture(page, "live-fallen");
  await set(page, "stiffness", 50);
  await byName(page, "fallen-restart").click();
  assert.ok(await byName(page, "fallen").isHidden());
  await page.waitForFunction(
    () => !window.goughPage.live.over && window.goughPage.live.row[0] < 30,
  );
  await reach(page, 60);
  assert.ok(await byName(page, "fallen").isHidden());
  assert.ok((await off(page)) < 1e-4, `${await off(page)} off`);
  await picture(page, "live-held");
  assert.deepEqual(page.said, []);
  await page.close();
});

test("begins as the study says, six gains and all", async () => {
  const page = await live(
    study(
      "six-gains.yaml",
      `title: Six gains
units: dimensionless
platform: {base: {radius: 1, half_angle: 10}, top: {radius: 0.6, half_angle: 15}, height: 1}
load: {mass: 1, center_of_mass: [0.05, 0, 0.1], inertia: [0.08, 0.08, 0.15]}
motion: {heave: 0.1*sin(t)}
control: {feedforward: none, stiffness: [20, 25, 30, 35, 40, 45], damping: [1, 2, 1, 2, 1, 2]}
simulation: {duration: 10, output_step: 0.002}
`,
    ),
  );
  await reach(page, 0.5);
  await page.locator("h1").click();
  await page.keyboard.press("Space");
  // rows lie 0.002 apart, so that a straight line between two is right to 1e-6 or so
  const worst = await page.evaluate(() => {
    const { live: run, studies } = window.goughPage;
    const at = (name) => run.row[run.place[name]];
    const recorded = (name) => studies[0].run.value(name, at("t"));
    const degrees = 180 / Math.PI;
    return Math.max(
      ...["x", "y", "z", "l1", "l4"].map((name) => Math.abs(at(name) - recorded(name))),
      ...["roll", "pitch", "yaw"].map(
        (name) => Math.abs(degrees * at(name) - recorded(name)) / degrees,
      ),
    );
  });
  assert.ok(worst < 2e-5, `${worst}`);
  assert.match(await page.locator("#help-stiffness").textContent(), /six values differ/);
  // sliders begin at the greatest of the six
  assert.equal(await byName(page, "live-stiffness-number").inputValue(), "45");
  assert.equal(await byName(page, "live-damping-number").inputValue(), "2");
  // the distance from the program, and the angle in degrees: of the row that was drawn last
  const [words, ...sizes] = await page.evaluate(
    () =>
      new Promise((done) => {
        const { live: run } = window.goughPage;
        const size = (names) => Math.hypot(...names.map((name) => run.row[run.place[name]]));
        const look = () =>
          run.fresh
            ? requestAnimationFrame(look)
            : done([
                run.off.textContent,
                size(["ex", "ey", "ez"]),
                (size(["eroll", "epitch", "eyaw"]) * 180) / Math.PI,
              ]);
        look();
      }),
  );
  assert.match(words, / °$/);
  words
    .split(", ")
    .forEach((text, k) => assert.ok(Math.abs(read(text) - sizes[k]) <= 6e-3 * sizes[k], `${text} for ${sizes[k]}`));
  await page.close();
});

test("begins with the study's period and delay, and a period that is too long shakes the platform off", async () => {
  const page = await live(example("sampled-flight-simulator"));
  const shown = async (name) => Number(await byName(page, `live-${name}-number`).inputValue());
  assert.equal(await shown("period"), 0.001);
  assert.equal(await shown("delay"), 0.001);
  assert.match(await page.locator("body").textContent(), /sampled every 0\.001 s/);
  await reach(page, 0.5);
  assert.ok((await off(page)) < 1e-3, `${await off(page)} off`);
  await set(page, "period", 0.05);
  await byName(page, "fallen").waitFor({ state: "visible", timeout: limit(120000) });
  assert.match(await byName(page, "fallen").textContent(), /speed/);
  assert.deepEqual(page.said, []);
  await page.close();
});

// The simulator at 1000 samples a second, whose drives lag and have a greatest force: by its own gains it stands, with a delay
// that the slider makes longer it shakes until a leg is too fast, and the period's slider changes the samples that a row counts.
test("sliders of period and delay move a sampled loop whose drives lag and saturate", async () => {
  const page = await live(example("sampled-flight-simulator"));
  const slide = async (name, part) => {
    await byName(page, `live-${name}`).evaluate((slider, share) => {
      slider.value = String(Number(slider.min) + share * (Number(slider.max) - Number(slider.min)));
      slider.dispatchEvent(new Event("input", { bubbles: true }));
    }, part);
    return Number(await byName(page, `live-${name}-number`).inputValue());
  };
  await reach(page, 0.5);
  assert.ok((await off(page)) < 2e-3, `${await off(page)} off`);
  const period = await slide("period", 0.3);
  assert.ok(period > 0 && period < 0.01, `${period}`);
  await reach(page, 1);
  const delay = await slide("delay", 0.85);
  assert.ok(delay > 0.02, `${delay}`);
  await byName(page, "fallen").waitFor({ state: "visible", timeout: limit(120000) });
  assert.deepEqual(page.said, []);
  await page.close();
});

test("the slider does what the number does", async () => {
  const page = await live(example("paper-feedback"));
  await byName(page, "live-stiffness").evaluate((slider) => {
    slider.value = "0";
    slider.dispatchEvent(new Event("input", { bubbles: true }));
  });
  assert.equal(await byName(page, "live-stiffness-number").inputValue(), "0");
  await set(page, "speed", 10);
  await byName(page, "fallen").waitFor({ state: "visible", timeout: limit(120000) });
  assert.match(await byName(page, "fallen").textContent(), /below the threshold/);
  await page.close();
});

test("without program forces a stiff feedback still carries the platform", async () => {
  const page = await live(example("paper-feedback"));
  await set(page, "stiffness", 100);
  await byName(page, "live-feedforward").uncheck();
  await byName(page, "live-restart").click();
  await set(page, "speed", 10);
  await reach(page, 20);
  // legs must be shorter to carry the weight: the top hangs M g l²/(6 h² G) = 2.5e-3 low at rest, and moves about that
  const deviation = await page.evaluate(() =>
    Math.max(...window.goughPage.live.strips.samples.off),
  );
  assert.ok(deviation > 1e-3 && deviation < 7e-3, `${deviation}`);
  await page.close();
});

test("a hand on the load moves it, an arrow shows it, and feedback takes it back", async () => {
  const page = await live(example("paper-feedback"), SEEN);
  await set(page, "stiffness", 2);
  await set(page, "damping", 1);
  await set(page, "amplitude", 0);
  const box = await byName(page, "scene-canvas").boundingBox();
  const grip = await page.evaluate(() => {
    const { scene, live } = window.goughPage;
    return scene.eye.handAt({ clientX: 0, clientY: 0 }, live.centre).screen[0];
  });
  await page.mouse.move(box.x + grip[0], box.y + grip[1]);
  await page.mouse.down();
  await page.mouse.move(box.x + grip[0] + 150, box.y + grip[1] - 40, { steps: 5 });
  await page.waitForFunction(
    () => {
      const { live } = window.goughPage;
      return Math.hypot(live.row[live.place.ex], live.row[live.place.ey]) > 0.01;
    },
    null,
    { timeout: limit(60000) },
  );
  assert.ok(await page.locator("#push").isVisible());
  assert.match(await page.locator("#push-size").textContent(), /M g/);
  await picture(page, "live-push");
  await page.mouse.up();
  assert.ok(await page.locator("#push").isHidden());
  await set(page, "speed", 10);
  await page.waitForFunction(
    () => {
      const { live } = window.goughPage;
      return live.over || Math.hypot(live.row[live.place.ex], live.row[live.place.ey]) < 1e-3;
    },
    null,
    { timeout: limit(60000) },
  );
  assert.ok(await byName(page, "fallen").isHidden());
  assert.deepEqual(page.said, []);
  await page.close();
});

test("runs faster than real time, and keys pause it and start it again", async () => {
  const page = await live(flightSimulator(), SEEN);
  await page.waitForFunction(() => window.goughPage.live.ratio > 0);
  assert.ok(
    (await page.evaluate(() => window.goughPage.live.ratio)) > 3,
    `${await page.evaluate(() => window.goughPage.live.ratio)}`,
  );
  await reach(page, 1);
  await picture(page, "live-simulator");
  await page.locator("h1").click();
  await page.keyboard.press("Space");
  await page.waitForTimeout(300);
  const stopped = await time(page);
  await page.waitForTimeout(300);
  assert.equal(await time(page), stopped);
  await byName(page, "scene-canvas").focus();
  await page.keyboard.press("Home");
  await page.waitForFunction((before) => window.goughPage.live.row[0] < before, stopped);
  await page.close();
});

test("strips do not draw errors of the run as a signal, and have numbers at their axes", async () => {
  const page = await live(example("own-machine"));
  const strips = () =>
    page.evaluate(() => {
      const { strips, samples } = window.goughPage.live.strips;
      return strips.map(({ plot, said }, number) => ({
        scale: [plot.scales.y.min, plot.scales.y.max],
        numbers: plot.axes[1]._values.filter((text) => text !== ""),
        said: said.hidden ? "" : said.textContent,
        most: number ? null : Math.max(...samples.off),
      }));
    });
  await reach(page, 0.2); // at rest until t = 0.5
  const [resting, forces] = await strips();
  assert.ok(resting.most < 1e-9, `${resting.most} m off at rest`);
  // errors are 1e-8 of the longest leg, 0.32 m, at this study's tolerance; an axis has a hundred of them
  assert.ok(resting.scale[0] === 0 && resting.scale[1] > 1e-9, `${resting.scale}`);
  assert.match(resting.said, /no finer than the accuracy/);
  for (const strip of [resting, forces]) assert.ok(strip.numbers.length >= 2, `${strip.numbers}`);
  await picture(page, "live-resting", { fullPage: true });
  // a kick is a signal: the scale follows it, and the sentence goes
  await page.evaluate(() => {
    const { live } = window.goughPage;
    const begin = live.strips.samples.t.at(-1);
    for (let i = 1; i <= 5; i++)
      live.strips.take([begin + i * 1e-3, i * 1e-3, ...Array(12).fill(i)]);
    live.strips.drawn = 0;
    live.strips.draw();
  });
  const [kicked] = await strips();
  assert.equal(kicked.said, "");
  assert.ok(kicked.scale[1] >= 5e-3 && kicked.scale[1] < 0.02, `${kicked.scale}`);
  await page.close();
});

test("a recorded live run is a table with the command's columns and units, row by row consistent", async () => {
  const text = `units: {length: mm, force: N, mass: kg, angle: mrad, time: ms}
platform: {base: {radius: 250, half_angle: 10}, top: {radius: 150, half_angle: 10}, height: 280}
load: {mass: 6, center_of_mass: [0, 0, 50], inertia: [50000, 50000, 80000]}
motion: {heave: 20*sin(0.003*t), roll: 50*sin(0.002*t)}
control: {stiffness: 5, damping: 150}
simulation: {duration: 1000, output_step: 10}
`;
  const file = study("recorded-live.yaml", text);
  const { names } = table("simulate", file);
  const page = await live(file);
  await byName(page, "live-record").click();
  await page.waitForFunction(() => window.goughPage.live.record.rows.length >= 12, null, { timeout: limit(60000) });
  const { name, bytes } = await saved(page, "live-record");
  assert.match(name, /-live\.csv$/);
  const [head, ...lines] = bytes.toString().trim().split("\n");
  assert.deepEqual(head.split(","), names);
  assert.ok(lines.length >= 12);
  const rows = lines.map((line) => line.split(",").map(Number));
  const at = (row, column) => row[names.indexOf(column)];
  const joints = await page.evaluate(() => {
    const { base, top } = window.goughPage.studies[0].machine;
    return { base, top };
  });
  rows.forEach((row, index) => {
    if (index) assert.ok(at(row, "t") > at(rows[index - 1], "t"));
    // N mm/ms are W
    assert.ok(Math.abs(at(row, "p4") - at(row, "f4") * at(row, "dl4")) <= 1e-12 * (1 + Math.abs(at(row, "p4"))));
    // no pitch and no yaw but the run's own errors: leg 1 by the roll alone
    const roll = at(row, "roll") / 1000;
    const [x, y, z] = joints.top[0];
    const turned = [x, y * Math.cos(roll) - z * Math.sin(roll), y * Math.sin(roll) + z * Math.cos(roll)];
    const leg = turned.map((part, axis) => part + at(row, "xyz"[axis]) - joints.base[0][axis]);
    assert.ok(Math.abs(Math.hypot(...leg) - at(row, "l1")) < 1e-3, `${Math.hypot(...leg)} for ${at(row, "l1")}`);
  });
  await page.close();
});

test("presets set both gains: open loop, below and above the threshold, the study's", async () => {
  const page = await live(example("paper-feedback"));
  const gains = async () =>
    Promise.all(["stiffness", "damping"].map(async (name) => Number(await byName(page, `live-${name}-number`).inputValue())));
  const own = await gains();
  const most = await page.evaluate(() => {
    const { stability } = window.goughPage.studies[0];
    return Math.max(0, ...(stability.thresholds ?? []).map(({ stiffness }) => stiffness));
  });
  const click = (word) => page.locator(".presets button", { hasText: word }).click();
  await click("open loop");
  assert.deepEqual(await gains(), [0, 0]);
  await click("large G");
  const [large, damping] = await gains();
  assert.equal(damping, own[1]);
  await click("small G");
  const [small] = await gains();
  assert.ok(small > 0 && Math.abs(large / small - 8) < 0.01, `${small}, ${large}`);
  assert.ok(0 < small && small < most && most < large, `${small}, ${most}, ${large}`);
  await click("the study's");
  assert.deepEqual(await gains(), own);
  await page.close();
});

test("leaving the live run gives the recorded one back", async () => {
  const page = await live(example("own-machine"));
  await reach(page, 0.3);
  await byName(page, "mode-recorded").click();
  await byName(page, "scrub").focus();
  await page.keyboard.press("End");
  await pictureDrawn(page);
  assert.equal(read((await byName(page, "clock").textContent()).slice(4)), 8);
  assert.ok(Math.abs(read(await byName(page, "pose-z").textContent()) - 0.28) < 1e-3);
  assert.deepEqual(page.said, []);
  await page.close();
});

test("works without WebGL too, and on a phone without overflow", async () => {
  const page = await live(example("paper-feedback"), { width: 360, height: 780 });
  await reach(page, 0.5);
  assert.ok((await page.evaluate(() => document.documentElement.scrollWidth - innerWidth)) <= 0);
  assert.deepEqual(page.said, []);
  await picture(page, "live-narrow", { fullPage: true });
  await page.close();
});
