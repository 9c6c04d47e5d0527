// What the tests of the page share: reports written by the command, pages of them in Debian's chromium from file://, and every
// error that a page utters. Screenshots go to PICTURES, to be looked at.
import { spawnSync } from "node:child_process";
import { existsSync, mkdirSync, readFileSync, statSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { cpus, loadavg } from "node:os";
import { join } from "node:path";
import { pathToFileURL } from "node:url";

const { BUILD, CHROMIUM, GOUGH, PICTURES, SCRATCH, SOURCE } = process.env;
const { chromium } = createRequire(join(BUILD, "web/source/"))("playwright-core");
mkdirSync(PICTURES, { recursive: true });

/** Path of an example. */
export const example = (name) => join(SOURCE, "examples", `${name}.yaml`);

/** The example whose motion is recorded, with its record. */
export function flightSimulator() {
  const samples = spawnSync("awk", ["-f", join(SOURCE, "examples/ship-deck.awk")], {
    encoding: "utf8",
    maxBuffer: 1 << 26,
  }).stdout;
  writeFileSync(join(SCRATCH, "ship-deck.csv"), samples);
  return study("flight-simulator.yaml", readFileSync(example("flight-simulator"), "utf8"));
}

/** A study file with this text. */
export function study(name, text) {
  const file = join(SCRATCH, name);
  writeFileSync(file, text);
  return file;
}

/** Runs the command; a numerical end (1) is an answer. */
export function gough(...words) {
  const done = spawnSync(GOUGH, words, { encoding: "utf8", maxBuffer: 1 << 30, cwd: SCRATCH });
  if (done.status === null || done.status > 1)
    throw new Error(`gough ${words.join(" ")}: ${done.status} ${done.stderr}`);
  return done.stdout;
}

const written = new Map();

/** The page of some studies; the same call gives the same file. */
export function report(...words) {
  const key = words.join("\n");
  if (!written.has(key)) {
    const file = join(SCRATCH, `report-${written.size}.html`);
    gough("report", ...words, "-q", "-o", file);
    written.set(key, file);
  }
  return written.get(key);
}

/** A table of the command as {names, rows: [[number]]}. */
export function table(verb, file, ...options) {
  const [head, ...lines] = gough(verb, file, ...options, "-q", "-o", "-")
    .trim()
    .split("\n");
  return { names: head.split(","), rows: lines.map((line) => line.split(",").map(Number)) };
}

/** Milliseconds that a quiet machine may take, for this one: every wait of the tests has its limit from here. */
export function limit(milliseconds) {
  const slowness = Number(process.env.GOUGH_TEST_SLOWNESS);
  return milliseconds * (slowness >= 1 ? slowness : 4);
}

let browsers = {};

async function browser(webgl) {
  browsers[webgl] ??= chromium.launch({
    executablePath: CHROMIUM,
    timeout: limit(30000),
    args: [
      "--no-sandbox",
      ...(webgl
        ? ["--use-angle=swiftshader", "--enable-unsafe-swiftshader"]
        : ["--disable-gpu", "--disable-3d-apis"]),
    ],
  });
  return browsers[webgl];
}

const EMPTY = `<!doctype html><canvas id="c" width="900" height="600"></canvas><script>
const gl = document.getElementById("c").getContext("webgl2", { antialias: true });
const add = (type, text) => {
  const shader = gl.createShader(type);
  gl.shaderSource(shader, text);
  gl.compileShader(shader);
  gl.attachShader(program, shader);
};
const program = gl.createProgram();
const corner = "vec4(float(gl_VertexID) - 1.0, float(gl_VertexID & 1), 0, 1)";
add(gl.VERTEX_SHADER, "#version 300 es\\nvoid main() { gl_Position = " + corner + "; }");
add(gl.FRAGMENT_SHADER, "#version 300 es\\nprecision highp float; out vec4 c; void main() { c = vec4(1); }");
gl.linkProgram(program);
gl.useProgram(program);
gl.drawArrays(gl.TRIANGLES, 0, 3);
gl.finish();
requestAnimationFrame(() => { document.documentElement.dataset.firstPicture = performance.now(); });
</script>`;

/** Milliseconds until a page that shows one triangle and nothing else has drawn it: what this machine takes for any picture now. */
async function emptyPicture() {
  const file = join(SCRATCH, "empty.html");
  writeFileSync(file, EMPTY);
  const page = await (await browser(true)).newPage();
  await page.goto(pathToFileURL(file).href);
  await page.waitForFunction(() => document.documentElement.dataset.firstPicture, null, {
    timeout: limit(60000),
  });
  const time = Number(await page.evaluate(() => document.documentElement.dataset.firstPicture));
  await page.close();
  return time;
}

let closed = [];

/** A page without a file, of a browser with or without WebGL. To start the processes of a page takes longer than to load one, so a
 *  page that a test has closed is taken again, unless a fresh one is asked for. */
async function emptyPage(webgl, touch, fresh) {
  const again = closed.findIndex((page) => !fresh && page.kind === `${webgl} ${touch}`);
  if (again >= 0) return closed.splice(again, 1)[0];
  const context = await (await browser(webgl)).newContext({ acceptDownloads: true, hasTouch: touch });
  context.setDefaultTimeout(limit(30000));
  context.setDefaultNavigationTimeout(limit(30000));
  const page = await context.newPage();
  page.kind = `${webgl} ${touch}`;
  page.on(
    "console",
    (message) => ["error", "warning"].includes(message.type()) && page.said.push(message.text()),
  );
  page.on("pageerror", (error) => page.said.push(error.stack));
  page.on(
    "request",
    (request) =>
      /^(https?|ws):/.test(request.url()) &&
      page.said.push(`asks the network for ${request.url()}`),
  );
  page.close = async () => {
    page.said = [];
    await page.goto("about:blank");
    closed.push(page);
  };
  return page;
}

/** Opens a page and waits until its curves are there. page.said collects errors of the console and of scripts. */
export async function open(
  file,
  { width = 1360, height = 860, dark = false, motion = false, webgl = true, touch = false, fresh = false } = {},
) {
  const page = await emptyPage(webgl, touch, fresh);
  page.said = [];
  await page.setViewportSize({ width, height });
  await page.emulateMedia({
    colorScheme: dark ? "dark" : "light",
    reducedMotion: motion ? "no-preference" : "reduce",
  });
  await page.mouse.move(0, 0);
  await page.goto(pathToFileURL(file).href);
  await page.waitForFunction(() => document.documentElement.dataset.ready === "true", null, {
    timeout: limit(60000),
  });
  if (webgl)
    await page.waitForFunction(() => document.documentElement.dataset.firstPicture, null, {
      timeout: limit(60000),
    });
  return page;
}

/** First pictures of a page in milliseconds, each with its limit, until one is within it or there are eight. Others use this
 *  machine too, and some machines draw slowly: the limit is a second, or ten times what an empty page takes just before. */
export async function firstPictures(file) {
  const tries = [];
  const busy = Math.max(1, loadavg()[0] / cpus().length);
  while (tries.length < 8 && !tries.some(({ time, most }) => time < most)) {
    const most = Math.max(1000 * busy, 10 * (await emptyPicture()));
    const page = await open(file, { fresh: true });
    const time = await page.evaluate(() => document.documentElement.dataset.firstPicture);
    tries.push({ time: Number(time), most });
    await page.close();
  }
  return tries;
}

export async function closeAll() {
  for (const one of Object.values(browsers)) await (await one).close();
  browsers = {};
  closed = [];
}

/** Keeps a picture of the page. */
export async function picture(page, name, options = {}) {
  await page.screenshot({ path: join(PICTURES, `${name}.png`), ...options });
}

/** An element by its test name. */
export const byName = (page, name) => page.locator(`[data-testid="${name}"]`);

/** Clicks what offers a file, and reads it. */
export async function saved(page, name) {
  const [download] = await Promise.all([page.waitForEvent("download"), byName(page, name).click()]);
  const file = join(SCRATCH, `saved-${download.suggestedFilename()}`);
  await download.saveAs(file);
  return { name: download.suggestedFilename(), bytes: readFileSync(file) };
}

/** The number that a text of the page stands for: "−1.5·10⁻⁷ m" gives −1.5e-7. */
export function read(text) {
  const plain = text
    .replace(/[\u2212]/g, "-")
    .replace(/[⁻⁰¹²³⁴⁵⁶⁷⁸⁹]/g, (mark) => "-0123456789"["⁻⁰¹²³⁴⁵⁶⁷⁸⁹".indexOf(mark)]);
  const [, mantissa, power] = /(-?[\d.]+)(?:·10(-?\d+))?/.exec(plain) ?? [null, "NaN"];
  return Number(power === undefined ? mantissa : `${mantissa}e${power}`);
}

/** Moves the slider of time to a row, as a reader does. */
export async function scrubTo(page, row) {
  await byName(page, "scrub").evaluate((slider, value) => {
    slider.value = String(value);
    slider.dispatchEvent(new Event("input", { bubbles: true }));
  }, row);
  await pictureDrawn(page);
}

/** Waits until the page has drawn twice. */
export const pictureDrawn = (page) =>
  page.evaluate(
    () => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))),
  );

export const sizeOf = (file) => statSync(file).size;
export const present = (file) => existsSync(file);

/** The facts of a list: {term: text}. */
export const factsOf = (page, name) =>
  byName(page, name)
    .locator("dl")
    .first()
    .evaluate((list) =>
      Object.fromEntries(
        [...list.querySelectorAll("dt")].map((term) => [term.textContent, term.nextElementSibling.textContent]),
      ),
    );
