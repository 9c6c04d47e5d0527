// The page on paper: chromium prints it as PDF, poppler's tools read it back. Each figure is there, drawn by vectors, and each tick
// is the number that it stands for: lines are read back by the ticks and compared with the command's table.
import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import { join } from "node:path";
import test, { after } from "node:test";
import { byName, closeAll, example, open, read, report, scrubTo, table } from "./browser.mjs";

const { PICTURES } = process.env;
const SIZES = { A4: [595, 842], Letter: [612, 792] };
/** Dots of the rendered page per inch, and per point of the PDF. */
const DPI = 72;

const UNSEEN = { webgl: false };

after(closeAll);

/** Output of one of poppler's tools. */
function poppler(tool, ...words) {
  const done = spawnSync(tool, words, { maxBuffer: 1 << 28 });
  assert.equal(done.status, 0, `${tool}: ${done.stderr}`);
  return done.stdout;
}

/** Prints a page: {file, pages: [{width, height, words: [{text, x, y, right, bottom}]}]}. */
async function printed(page, name, format) {
  const file = join(PICTURES, `${name}-${format}.pdf`);
  await page.pdf({ path: file, format });
  const layout = poppler("pdftotext", "-bbox", file, "-").toString();
  const signs = { lt: "<", gt: ">", quot: '"', apos: "'", amp: "&" };
  const unescaped = (text) => text.replace(/&(\w+);/g, (_, name) => signs[name]);
  const pages = layout.split("<page ").slice(1).map((text) => {
    const [width, height] = ["width", "height"].map((name) =>
      Number(new RegExp(`${name}="([\\d.]+)"`).exec(text)[1]),
    );
    const pattern = /<word xMin="(.*?)" yMin="(.*?)" xMax="(.*?)" yMax="(.*?)">(.*?)<\/word>/g;
    const words = [...text.matchAll(pattern)].map(
      ([, x, y, right, bottom, word]) => ({ x: +x, y: +y, right: +right, bottom: +bottom, text: unescaped(word) }),
    );
    return { width, height, words, text: words.map(({ text: word }) => word).join(" ") };
  });
  return { file, pages };
}

/** The pixels of a printed page. */
function pixelsOf(file, number) {
  const bytes = poppler("pdftoppm", "-r", String(DPI), "-f", String(number), "-l", String(number), file);
  const [, width, height] = /^P6\s(\d+)\s(\d+)\s255\s/.exec(bytes.subarray(0, 40).toString("latin1")).map(Number);
  const start = bytes.length - 3 * width * height;
  return { width, height, at: (x, y) => bytes.subarray(start + 3 * (y * width + x), start + 3 * (y * width + x) + 3) };
}

/** Pixels within a box that have a colour or, with `dark`, are dark. */
function inked({ width, height, at }, [x0, y0, x1, y1], dark = false) {
  let count = 0;
  for (let y = Math.max(0, Math.round(y0)); y < Math.min(height, y1); y++)
    for (let x = Math.max(0, Math.round(x0)); x < Math.min(width, x1); x++) {
      const [low, high] = [Math.min(...at(x, y)), Math.max(...at(x, y))];
      if (high - low > 40 || (dark && high < 110)) count++;
    }
  return count;
}

/** What the page lays out for paper, read in the document: figures with their headings, ticks and lines. */
const laidOut = (page) =>
  page.evaluate(() => {
    dispatchEvent(new Event("beforeprint"));
    const numbersOf = (text) => [...text.matchAll(/-?[\d.]+/g)].map(([number]) => Number(number));
    const figures = [...document.querySelectorAll("#grid figure")].map((card) => {
      const svg = card.querySelector("svg.printed");
      const ticks = (name, coordinate) =>
        [...svg.querySelectorAll(`.${name}`)].map((node) => ({
          text: node.textContent,
          at: Number(node.getAttribute(coordinate)),
        }));
      return {
        id: card.id.replace("curve-", ""),
        title: card.querySelector("h3").textContent,
        x: ticks("tick-x", "x"),
        y: ticks("tick-y", "y"),
        lines: [...svg.querySelectorAll(".line")].map((line) => ({
          color: line.getAttribute("stroke"),
          dash: line.getAttribute("stroke-dasharray"),
          points: numbersOf(line.getAttribute("d")),
        })),
        names: [...svg.querySelectorAll(".end-name")].map((node) => ({
          text: node.textContent,
          x: Number(node.getAttribute("x")),
        })),
        limits: svg.querySelectorAll(".limit-word").length,
        size: Number(svg.getAttribute("font-size")),
        wide: Number(svg.getAttribute("viewBox").split(" ")[2]),
      };
    });
    dispatchEvent(new Event("afterprint"));
    return { figures, left: document.querySelectorAll(".printed, .print-machine").length };
  });

/** From a place on the sheet to a number, by the ticks; each tick must be where its number is. */
function scaleBy(ticks, name) {
  const places = ticks.map(({ text, at }) => [read(text), at]);
  assert.ok(places.length >= 3, `${name}: ${places.length} ticks`);
  const [[v0, p0]] = places;
  const [v1, p1] = places[places.length - 1];
  for (const [value, place] of places) {
    const wanted = p0 + ((value - v0) / (v1 - v0)) * (p1 - p0);
    assert.ok(Math.abs(place - wanted) < 0.05, `${name}: ${value} is at ${place}, not at ${wanted}`);
  }
  // the words of an ordinate are a little below their line
  return (place) => v0 + ((place - p0) / (p1 - p0)) * (v1 - v0);
}

for (const format of ["A4", "Letter"])
  test(`the whole page is printed on ${format}: title, version, numbers of pages, every figure and every tick`, async () => {
    const page = await open(report(example("own-machine")), { webgl: false, dark: true });
    await scrubTo(page, 30);
    const { figures, left } = await laidOut(page);
    assert.equal(left, 0, "what is laid out for paper is taken away");
    const { file, pages } = await printed(page, "print-own-machine", format);
    const [width, height] = SIZES[format];
    const version = (await byName(page, "version").textContent()).trim();
    pages.forEach((sheet, index) => {
      assert.ok(Math.abs(sheet.width - width) < 1.5 && Math.abs(sheet.height - height) < 1.5, `${sheet.width} × ${sheet.height}`);
      for (const words of ["My machine", version, `page ${index + 1} of ${pages.length}`])
        assert.ok(sheet.text.includes(words), `page ${index + 1} lacks ${words}`);
      for (const word of sheet.words)
        assert.ok(word.x >= 30 && word.right <= width - 30 && word.bottom < height, `${word.text} at ${word.x} to ${word.right}`);
    });
    const images = poppler("pdfimages", "-list", file).toString().trim().split("\n").length - 2;
    assert.equal(images, 0, "nothing is a picture of pixels");
    assert.equal(figures.length, 12);
    for (const figure of figures) {
      const words = figure.title.split(" ");
      const found = pages.flatMap((sheet, number) =>
        sheet.words
          .filter((word, k) => words.every((text, n) => sheet.words[k + n]?.text === text))
          .map((word) => ({ number, sheet, word })),
      );
      // the panel on the first page has a heading like that of a figure
      const { number, sheet, word } = found[found.length - 1] ?? assert.fail(`${figure.title} is not printed`);
      const half = width / 2 - 40;
      const box = [word.x - 2, word.bottom + 24, word.x + half, word.bottom + 175];
      const pixels = pixelsOf(file, number + 1);
      assert.ok(inked(pixels, box) > 60, `${figure.title} is empty: ${inked(pixels, box)} pixels`);
      const inside = sheet.words.filter(({ x, y }) => x >= box[0] - 2 && x < box[2] && y > word.bottom && y < box[3] + 20);
      for (const { text } of [...figure.x, ...figure.y])
        assert.ok(inside.some((each) => each.text === text), `${figure.title}: the tick ${text} is not printed`);
      for (const each of inside) assert.ok(each.bottom - each.y > 5, `${figure.title}: ${each.text} is too small`);
    }
    // paper is white in the dark theme too
    const first = pixelsOf(file, 1);
    assert.deepEqual([...first.at(5, 5)], [255, 255, 255]);
    const machine = inked(first, [40, 90, 370, 420], true);
    assert.ok(machine > 3000, `the machine has ${machine} pixels`);
    await page.close();
  });

test("lines on paper, read by the ticks, are those of the table", async () => {
  const { names, rows } = table("simulate", example("own-machine"));
  const page = await open(report(example("own-machine")), UNSEEN);
  const { figures } = await laidOut(page);
  const height = 0.28;
  const columns = {
    forces: ["f1", "f2", "f3", "f4", "f5", "f6"],
    lengths: ["l1", "l2", "l3", "l4", "l5", "l6"],
    rates: ["dl1", "dl2", "dl3", "dl4", "dl5", "dl6"],
    power: ["p1", "p2", "p3", "p4", "p5", "p6"],
    position: ["x", "y", "z"],
    orientation: ["roll", "pitch", "yaw"],
  };
  let compared = 0;
  for (const [id, list] of Object.entries(columns)) {
    const figure = figures.find((each) => each.id === id);
    const [time, value] = [scaleBy(figure.x, `${id}, abscissa`), scaleBy(figure.y, `${id}, ordinate`)];
    const pixel = Math.abs(value(1) - value(0));
    assert.equal(figure.lines.length, list.length);
    list.forEach((name, k) => {
      const { points } = figure.lines[k];
      for (let n = 0; n < points.length; n += 2) {
        const row = Math.round(time(points[n]) / (rows[1][0] - rows[0][0]));
        const wanted = rows[row][names.indexOf(name)] - (name === "z" ? height : 0);
        // ticks' words are written 3.5 below their lines
        const drawn = value(points[n + 1] + 3.5);
        assert.ok(Math.abs(drawn - wanted) < 0.05 * pixel, `${name} at row ${row}: ${drawn} for ${wanted}`);
        compared++;
      }
    });
  }
  assert.ok(compared > 2000, `${compared} points`);
  await page.close();
});

test("the six legs differ without colours, and text is at least 7 points high on half a page", async () => {
  const page = await open(report(example("own-machine")), UNSEEN);
  const { figures } = await laidOut(page);
  const forces = figures.find(({ id }) => id === "forces");
  assert.equal(new Set(forces.lines.map(({ dash }) => dash)).size, 6);
  // half of A4 without margins and gap: (210 − 28 − 6)/2 mm
  for (const { title, size, wide } of figures)
    assert.ok((size * 88) / wide / 0.3528 >= 7, `${title}: ${(size * 88) / wide / 0.3528} points`);
  await page.close();
});

test("several studies, a run that ended, a zoomed range and the live part are printed", async () => {
  const three = ["paper-heave", "paper-perturbed", "paper-feedback"].map(example);
  const several = await open(report(...three), UNSEEN);
  await scrubTo(several, 340);
  const { pages } = await printed(several, "print-three", "A4");
  const all = pages.map(({ text }) => text).join(" ");
  for (const words of ["3 studies side by side", "The machines at t = 17.00", "The studies beside each other", "Figure 4"])
    assert.ok(all.includes(words), words);
  await several.close();
  const ended = await open(report(example("paper-no-feedforward"), "--set", "control.stiffness=2"), UNSEEN);
  await ended.evaluate(() => window.goughPage.section.range.set(2, 6));
  await byName(ended, "mode-live").click();
  const print = await printed(ended, "print-ended", "Letter");
  const text = print.pages.map((sheet) => sheet.text).join(" ");
  for (const words of ["17.147", "singular", "the live run and the part Reach are not"]) assert.ok(text.includes(words), words);
  const { figures } = await laidOut(ended);
  const times = figures.find(({ id }) => id === "forces").x.map((tick) => Number(tick.text));
  assert.deepEqual([Math.min(...times), Math.max(...times)], [2, 6]);
  assert.deepEqual(ended.said, []);
  await ended.close();
});

/** The study of own machine with limits that end it early, as a reader edits it. */
const broken = () =>
  report(example("own-machine"), "--set", "platform.legs={length: [0.27, 0.36], max_speed: 0.1, max_force: 15.5}");

test("names are where lines end, also in a run that ended early, and limits in the picture have their word", async () => {
  const page = await open(broken(), UNSEEN);
  const { figures } = await laidOut(page);
  const lengths = figures.find(({ id }) => id === "lengths");
  const time = scaleBy(lengths.x, "abscissa");
  assert.deepEqual(lengths.names.map(({ text }) => text).sort(), ["1", "2", "3", "4", "5", "6"]);
  // the run ends at 2.548; names are 8 beside the ends of their lines
  for (const { text, x } of lengths.names) {
    const at = time(x - 8);
    assert.ok(at > 2.5 && at < 2.56, `the name of leg ${text} is at ${at} s`);
  }
  assert.equal(lengths.limits, 2);
  await page.close();
});
