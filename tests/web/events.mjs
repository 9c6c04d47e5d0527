// Events of a run: peaks and changes of sign against closed forms, limits against the command's table of limits; what the list, the
// marks, the glowing legs and the bars of strokes show.
import assert from "node:assert/strict";
import test, { after } from "node:test";
import { eventsOf, glowing } from "../../web/src/events.js";
import { byName, closeAll, example, gough, open, picture, pictureDrawn, read, report, scrubTo, study, table } from "./browser.mjs";
import { readFileSync } from "node:fs";

after(closeAll);

const SIX = [1, 2, 3, 4, 5, 6];

/** A study whose columns are functions of time, f1 … p6 and condition, at 201 rows until t = 10. */
function studyOf(functions, more = {}) {
  const t = Float64Array.from({ length: 201 }, (_, row) => row / 20);
  const none = new Float64Array(201);
  const column = (name) => (name === "t" ? t : functions[name] ? t.map(functions[name]) : none);
  return {
    run: { t, rows: 201, step: 0.05, column },
    machine: { legs_take_force: false },
    complete: true,
    duration: 10,
    peakForce: 3,
    noise: () => 1e-9,
    unit: () => "",
    ...more,
  };
}

test("forces that change sign, peaks and the nearest singular pose are where closed forms have them", () => {
  const shown = studyOf({
    f1: (t) => 3 * Math.sin(t),
    f2: (t) => 2 - t,
    dl3: (t) => -(t * (8 - t)),
    p4: () => 5,
    p5: () => 5,
    condition: (t) => 10 - (t - 7) ** 2 / 10,
  });
  const events = eventsOf(shown);
  assert.deepEqual(events.map(({ time }) => time), events.map(({ time }) => time).sort((a, b) => a - b));
  const signs = events.filter(({ kind }) => kind === "sign");
  const wanted = [
    [2, 2, "push to pull"],
    [Math.PI, 1, "push to pull"],
    [2 * Math.PI, 1, "pull to push"],
    [3 * Math.PI, 1, "push to pull"],
  ];
  assert.equal(signs.length, wanted.length);
  wanted.forEach(([time, leg, words], place) => {
    // a sine is straight about its zero, to (0.05)³/6
    assert.ok(Math.abs(signs[place].time - time) < 3e-5, `${signs[place].time} for ${time}`);
    assert.deepEqual(signs[place].legs, [leg]);
    assert.match(signs[place].text, new RegExp(`leg ${leg} turns from ${words}$`));
  });
  const peak = (figure) => events.find((event) => event.kind === "peak" && event.figure === figure);
  const { time, legs, text } = peak("forces");
  assert.deepEqual([time, legs, text], [10, [2], "Greatest leg force: 8 (pull), leg 2"]);
  // t (8 − t) is 16 at its top, but −20 at the end
  assert.deepEqual([peak("rates").time, peak("rates").text], [10, "Greatest leg speed: 20 (lengthening), leg 3"]);
  assert.deepEqual([peak("power").legs, peak("power").text], [[4, 5], "Greatest leg power: 5 (driving), legs 4 and 5"]);
  assert.deepEqual([peak("condition").time, peak("condition").text], [7, "Nearest to a singular pose: condition number 10"]);
});

test("hundreds of changes of sign are four lines and a number, and six equal legs are one", () => {
  const wave = (t) => Math.sin(3 * Math.PI * t + 0.1);
  const events = eventsOf(studyOf(Object.fromEntries(SIX.map((leg) => [`f${leg}`, wave]))));
  const signs = events.filter(({ kind }) => kind === "sign");
  assert.equal(signs.length, 4);
  assert.match(signs[0].text, /^The force of all six legs turns from push to pull$/);
  assert.match(signs[3].text, /pull to push \(and 26 more times later\)$/);
});

test("what is only an error of the run has no events", () => {
  const names = SIX.flatMap((leg) => ["f", "dl", "p"].map((name) => `${name}${leg}`));
  const tiny = Object.fromEntries(names.map((name) => [name, (t) => 1e-10 * Math.sin(9 * t)]));
  assert.deepEqual(eventsOf(studyOf({ ...tiny, condition: () => 3 })), []);
});

const broken = () =>
  study(
    "broken.yaml",
    readFileSync(example("own-machine"), "utf8").replace(
      /legs:.*/,
      "legs: {length: [0.27, 0.36], max_speed: 0.1, max_force: 15.5}",
    ),
  );

test("limits are exceeded when the command says so, legs glow then, and a click goes there", async () => {
  const file = broken();
  const forces = JSON.parse(gough("forces", file, "--json", "-q"));
  const run = JSON.parse(gough("simulate", file, "--json", "-q"));
  const page = await open(report(file), { webgl: false });
  const events = await page.evaluate(() => window.goughPage.events);
  const exceeded = forces.limits.filter(({ count }) => count > 0);
  assert.ok(exceeded.length >= 6);
  for (const { leg, enter, kind } of exceeded) {
    const event = events.find((each) => each.of === kind && each.legs.includes(leg));
    assert.ok(Math.abs(event.time - enter) < 1e-6, `leg ${leg}: ${event.time} for ${enter}`);
  }
  assert.ok(events.some(({ text, time }) => text.includes("The run ends") && time === run.end.time));
  assert.equal(await page.locator(".event-mark").count(), events.length);
  assert.equal(await page.locator(".events li").count(), events.length);
  const place = events.findIndex(({ of }) => of === "leg_long");
  await byName(page, `event-${place}`).click();
  await pictureDrawn(page);
  assert.equal(await page.evaluate(() => window.goughPage.player.time), events[place].time);
  // legs 3 and 4; in the last row before, legs 1 and 6 have the greatest force
  assert.equal(await page.locator(".drawn .glow").count(), 4);
  assert.equal(glowing(events, 0.2, 0.01).filter(Boolean).length, 0);
  // used of each limit, as the command has it
  const used = await byName(page, "limits-used").locator("dd").allTextContents();
  const most = (kind) => Math.max(...run.limits.filter((limit) => limit.kind === kind).map(({ share }) => share));
  ["leg_short", "leg_long", "leg_speed", "leg_force"].forEach((kind, index) =>
    assert.ok(Math.abs(read(used[index]) - 100 * most(kind)) <= 0.06, `${kind}: ${used[index]}`),
  );
  await picture(page, "events");
  await page.close();
});

test("strokes stand between their stops, in numbers and in the bars", async () => {
  const { names, rows } = table("simulate", example("own-machine"));
  const page = await open(report(example("own-machine")), { webgl: false });
  for (const row of [0, 130, 210]) {
    await scrubTo(page, row);
    for (const leg of SIX) {
      const wanted = rows[row][names.indexOf(`l${leg}`)];
      const text = await byName(page, `stroke-${leg}`).textContent();
      const share = (wanted - 0.25) / 0.15;
      assert.ok(Math.abs(read(text) - wanted) < 1e-5, `${text} for ${wanted}`);
      assert.equal(text.split("·")[1].trim(), `${Math.round(100 * share)} %`);
      const [bar, track] = await byName(page, `stroke-${leg}`).evaluate((node) => {
        const line = node.parentElement.querySelector(".stroke");
        return [line.getBoundingClientRect().width, line.parentElement.clientWidth];
      });
      assert.ok(Math.abs(bar / track - share) < 0.01, `${bar} of ${track} for ${share}`);
    }
  }
  await page.close();
});
