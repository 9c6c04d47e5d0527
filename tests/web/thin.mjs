// Pages that carry pose, rates and forces only: the columns that the page computes are those of the command, and so are the numbers
// that it shows. Files of ten minutes are small.
import assert from "node:assert/strict";
import test, { after } from "node:test";
import { byName, closeAll, open, pictureDrawn, read, report, saved, scrubTo, sizeOf, study, table } from "./browser.mjs";

after(closeAll);

/** Legs with mass and friction, angles that turn, units that are not SI; the second study ends early. */
const machine = `platform:
  base: {radius: 250, half_angle: 10}
  top: {radius: 150, half_angle: 12}
  height: 280
  legs:
    cylinder: {mass: 0.3, center: 60, inertia: 400}
    piston: {mass: 0.2, center: 50, inertia: 300}
    friction: {viscous: 0.01}
load: {mass: 6, center_of_mass: [0, 5, 50], inertia: [50000, 51000, 80000]}
`;
const text = (limits) => `title: Thin
units: {length: mm, force: N, mass: kg, angle: mrad, time: s}
${machine}
motion: {order: xyz, heave: "20*sin(3*t)*ramp(t, 2)", roll: "60*sin(2.1*t)*ramp(t, 2)", yaw: "90*sin(1.3*t)*ramp(t, 2)"}
control: {stiffness: 5, damping: 0.15}
simulation: {duration: 8, output_step: 0.02, method: rk4, step: 0.002}
${limits}`;

/** Every number of the tables in a page, by column. */
const columnsOf = (page) =>
  page.evaluate(() => {
    const { run, plan } = window.goughPage.studies[0];
    const all = (which) =>
      Object.fromEntries(which.names.map((name) => [name, Array.from(which.column(name))]));
    return { run: all(run), plan: all(plan) };
  });

for (const [name, limits] of [
  ["whole", ""],
  ["ends early", "external: [{force: [0, 0, \"-2000*ramp(t - 3, 1)\"]}]\n"],
])
  test(`computed columns are those of the command: ${name}`, async () => {
    const file = study(`thin-${name.replace(" ", "-")}.yaml`, text(limits));
    const page = await open(report(file, "--thin"), { webgl: false });
    assert.deepEqual(page.said, []);
    const { run, plan } = await columnsOf(page);
    for (const [columns, verb] of [[run, "simulate"], [plan, "forces"]]) {
      const { names, rows } = table(verb, file);
      for (const [column, values] of Object.entries(columns)) {
        // the page has the forces in the legs, h1 … h6, which the command writes with --joints only
        const place = names.indexOf(column);
        if (place < 0) assert.match(column, /^h[1-6]$/);
        if (place < 0) continue;
        assert.equal(values.length, rows.length);
        const wanted = rows.map((row) => row[place]);
        // rounding of the pose: angles pass through roll, pitch and yaw
        const scale = Math.max(...wanted.map(Math.abs), column[0] === "e" ? 300 : 1);
        values.forEach((value, row) =>
          assert.ok(Math.abs(value - wanted[row]) <= 1e-13 * scale, `${column} in row ${row}: ${value} for ${wanted[row]}`),
        );
      }
    }
    for (const column of ["l1", "dl6", "p3", "condition", "ex", "eyaw", "h2"]) assert.ok(run[column], column);
    assert.ok(plan.l6 && !run.ax && !run.alz);
    await page.close();
  });

test("numbers that the page shows are those of the command, and its table is saved", async () => {
  const file = study("thin-shown.yaml", text(""));
  const { names, rows } = table("simulate", file);
  const page = await open(report(file, "--thin"), { webgl: false });
  for (const id of ["lengths", "rates", "power", "condition"])
    await byName(page, `curve-${id}`).scrollIntoViewIfNeeded();
  for (const row of [37, 250]) {
    await scrubTo(page, row);
    for (const column of ["l1", "l6", "dl2", "p3", "condition"]) {
      const id = { l: "lengths", d: "rates", p: "power", c: "condition" }[column[0]];
      await byName(page, `curve-${id}`).scrollIntoViewIfNeeded();
      await pictureDrawn(page); // a curve that is scrolled to is drawn then
      const box = byName(page, `value-${id}-${column}`);
      const wanted = rows[row][names.indexOf(column)];
      const shown = read(await box.textContent());
      const digit = 10 ** (Math.ceil(Math.log10(Math.abs(wanted))) - 5);
      assert.ok(Math.abs(shown - wanted) <= 0.51 * digit, `${column}: ${shown} for ${wanted}`);
    }
  }
  const lines = (await saved(page, "save-run-0")).bytes.toString().trim().split("\n");
  assert.equal(lines.length, rows.length + 1);
  assert.ok(lines[0].startsWith("t,x,y,z,") && !lines[0].includes("ax"));
  await page.close();
});

test("without WebAssembly a thin page says what it lacks", async () => {
  const page = await open(report(study("thin-none.yaml", text("")), "--thin"), { webgl: false });
  await page.addInitScript(() => delete window.WebAssembly);
  await page.reload();
  await page.waitForFunction(() => document.getElementById("title").textContent.includes("WebAssembly"));
  await page.context().close();
});

test("ten minutes at 100 rows a second are at most 8 MB", () => {
  const long = text("")
    .replace(/duration: 8.*}/, "duration: 600, output_step: 0.01, method: rk4, step: 0.01}")
    .replace(/  legs:[^]*?load:/, "load:");
  const bytes = sizeOf(report(study("thin-long.yaml", long), "--thin"));
  assert.ok(bytes <= 8e6, `${bytes} bytes`);
});
