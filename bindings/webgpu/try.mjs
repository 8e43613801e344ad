// Tests the package in pages that have nothing else: node try.mjs FOLDER CASES. FOLDER has the package and three.js in
// node_modules, and the README's pages. The output must equal the recorded cases in the file CASES, bit for bit, and factors
// must equal those of factors.json next to this file. TESS_PROGRAM is the program `tess`.

import { createRequire } from "node:module";
import { mkdirSync, readFileSync, readdirSync } from "node:fs";
import { join } from "node:path";
import { pathToFileURL } from "node:url";
import { tryDraws } from "./try-draws.mjs";
import { model, tryJoining, tryRoom, tryStage, tryThree } from "./try-stage.mjs";

const [folder, cases] = process.argv.slice(2);
const packed = join(folder, "node_modules/tess-webgpu");
const { chromium } = createRequire(join(process.env.EXPLORER_MODULES, "/"))("playwright-core");
const PAGE = "http://localhost/";
const IMPORTS = `<script type="importmap">{ "imports": {
  "three/webgpu": "/build/three.webgpu.js", "three/tsl": "/build/three.tsl.js" } }</script>`;

// Numbers that are no floats and round to this one: a page computes in doubles. Zero and infinity stay as they are.
const above = (x) => x * (1 + 0.9 * 2 ** -25);
const below = (x) => x * (1 - 0.9 * 2 ** -25);

// Calls each factor rule with the recorded arguments, as floats and as doubles that round to them, and compares the
// bits of the results.
async function compareFactors() {
  const factors = await import(pathToFileURL(join(packed, "factors.js")));
  const numbers = (bits) => [...new Float32Array(new Uint32Array(bits).buffer)];
  const calls = JSON.parse(readFileSync(new URL("factors.json", import.meta.url), "utf8"));
  for (const [name, given, bits] of calls) {
    for (const of of [(x) => x, above, below]) {
      const passed = given.map((list) => numbers(list).map(of));
      const results = [factors[name](...passed.map((list) => list.length === 1 ? list[0] : list))].flat();
      const isFloat = results.every((result) => Object.is(Math.fround(result), result));
      const observed = [...new Uint32Array(new Float32Array(results).buffer)];
      if (isFloat && String(observed) === String(bits)) continue;
      throw new Error(`${name}(${passed.join("; ")}): ${results}, not ${numbers(bits)}`);
    }
  }
  for (const point of [undefined, 5, [1, 2]]) {
    try {
      factors.edgeByLength([0, 0, 0], point, 1, 1);
    } catch (error) {
      if (error instanceof TypeError && error.message.includes("an array of 3 numbers")) continue;
      throw error;
    }
    throw new Error(`${point} is taken for a point`);
  }
  if (calls.length < 100) throw new Error(`only ${calls.length} factors were compared`);
  console.log(`test factors ... ok (${calls.length} calls)`);
}

// The recorded batches of each setup that the package has.
function recorded() {
  const batches = {};
  for (const text of readFileSync(cases, "utf8").split("\ncase ").slice(1)) {
    const [head, ...lines] = text.split("\nend")[0].split("\n");
    const [domain, partitioning, output, split, ...factors] = head.split(" ");
    const setup = `${domain}-${partitioning}`;
    if (split !== "ruler" || output !== (domain === "isoline" ? "line" : "triangle_cw")) continue;
    const words = lines.map((line) => line.split(" "));
    const points = words.slice(1, 1 + Number(words[0][1])).flat().map((word) => parseInt(word, 16));
    const indices = words.slice(2 + points.length / 2).flat().map(Number);
    (batches[setup] ??= []).push({ factors: factors.map((word) => parseInt(word, 16)), points, indices });
  }
  return batches;
}

// Runs in the page: tessellates all patches as one batch, and returns the differences.
async function compare([domain, partitioning, batch]) {
  const { Tessellator, surfacesWgsl, unpackWgsl } = await import("/tess.js");
  const device = await (await navigator.gpu.requestAdapter()).requestDevice();
  const problems = [];
  device.onuncapturederror = ({ error }) => problems.push(error.message);
  const tessellator = await Tessellator.load(device, { domain, partitioning });
  const factors = new Float32Array(new Uint32Array(batch.flatMap((patch) => patch.factors)).buffer);
  const output = await tessellator.tessellate(factors);
  let base = 0;
  const expected = { uv: [], patches: [], indices: [] };
  batch.forEach(({ points, indices }, patch) => {
    expected.uv.push(...points.map((word) => word / 65536));
    expected.patches.push(...points.slice(points.length / 2).map(() => patch));
    expected.indices.push(...indices.map((index) => base + index));
    base += points.length / 2;
  });
  for (const [name, words] of Object.entries(expected)) {
    const at = words.findIndex((word, i) => word !== output[name][i]);
    if (at >= 0) problems.push(`${name}[${at}]: observed ${output[name][at]}, expected ${words[at]}`);
    if (words.length !== output[name].length) problems.push(`${name}: ${output[name].length}, expected ${words.length}`);
  }
  const modules = ["bezier_factors", "pn_triangle", "flat", "culling", "height", "displacement"];
  for (const code of [unpackWgsl, await surfacesWgsl(modules)]) {
    const { messages } = await device.createShaderModule({ code }).getCompilationInfo();
    problems.push(...messages.map(({ message }) => message));
  }
  const refused = async (what, call, kind = RangeError, says = "") => {
    try {
      await call();
      problems.push(`${what} is not refused`);
    } catch (error) {
      if (!(error instanceof kind) || !error.message.includes(says)) throw error;
    }
  };
  await refused("an unknown domain", () => Tessellator.load(device, { domain: "triangle", partitioning }));
  await refused("an unknown partitioning", () => Tessellator.load(device, { domain, partitioning: "odd" }));
  await refused("an unknown module", () => surfacesWgsl(["curves"]));
  await refused("a patch and a half", () => tessellator.tessellate(factors.subarray(1)));
  await refused("no patch", () => tessellator.tessellate([]));
  await refused("half a patch", () => tessellator.batch(0.5));
  await refused("room for 2^30 points", () => tessellator.batch(1, { points: 2 ** 30, primitives: 1 }));
  await refused("room for 2^33 points", () => tessellator.batch(1, { points: 2 ** 33, primitives: 1 }));
  const untold = (what, call, says) => refused(what, call, TypeError, says);
  await untold("no device", () => Tessellator.load(undefined, { domain, partitioning }), "await openDevice()");
  await untold("one name of a module", () => surfacesWgsl("factors"), "such as [\"factors\"], not \"factors\"");
  await untold("no factors", () => tessellator.tessellate(), "the factors of one patch after another");
  await refused("no setup", () => Tessellator.load(device), RangeError, "there is no domain undefined; choose isoline");
  const half = () => tessellator.batch(1, { points: 10 });
  await refused("room without primitives", half, RangeError, "a whole number of primitives, not undefined");
  const one = tessellator.batch(1);
  await untold("no encoder", () => one.encode(), "`device.createCommandEncoder()`");
  await untold("one name of a buffer", () => one.read("status"), "such as [\"status\"], not \"status\"");
  await refused("an unknown buffer", () => one.read(["uv"]), RangeError, "there is no buffer \"uv\"; choose");
  one.destroy();
  return { problems, points: expected.patches.length };
}

// The pixels of a picture (PNG, in base64), four numbers each.
async function pixels(picture) {
  const image = await createImageBitmap(await (await fetch(`data:image/png;base64,${picture}`)).blob());
  const copy = new OffscreenCanvas(image.width, image.height).getContext("2d");
  copy.drawImage(image, 0, 0);
  return [...copy.getImageData(0, 0, image.width, image.height).data];
}

// The share of a picture's pixels for which `is` holds.
function share(data, is) {
  let count = 0;
  for (let i = 0; i < data.length; i += 4) count += is(data[i], data[i + 1], data[i + 2], i) ? 1 : 0;
  return count / (data.length / 4);
}

// A page without WebGPU is told so.
async function openWithoutGpu(page) {
  const told = await page.evaluate(async () => {
    const { openDevice } = await import("/tess.js");
    const gpu = { value: undefined, configurable: true };
    Object.defineProperty(navigator, "gpu", gpu);
    const without = await openDevice().catch(({ message }) => message);
    Object.defineProperty(navigator, "gpu", { ...gpu, value: { requestAdapter: async () => null } });
    const adapter = await openDevice().catch(({ message }) => message);
    delete navigator.gpu;
    return [without, adapter, String((await openDevice()).limits.maxBufferSize)];
  });
  const expected = [/there is no WebGPU here/, /no adapter; update/, /^\d+$/];
  const wrong = told.find((message, i) => !expected[i].test(message));
  if (wrong) throw new Error(`without WebGPU: ${wrong}`);
  console.log("test pages without WebGPU ... ok");
}

// Opens a page of the README, changed by `change`, and returns its text and the pixels of its canvas, or of its first and last one.
// The picture is kept.
async function openReadmePage(browser, name, change = (text) => text, picture = name) {
  const page = await browser.newPage();
  const errors = [];
  page.on("pageerror", (error) => errors.push(error.message));
  page.on("console", (message) => message.type() === "error" && errors.push(message.text()));
  await page.route(PAGE + "**", (route) => {
    const file = new URL(route.request().url()).pathname.slice(1);
    if (file === "favicon.ico") return route.fulfill({ status: 204 });
    if (file !== "") return route.fulfill({ path: join(folder, file) });
    return route.fulfill({ contentType: "text/html", body: change(readFileSync(join(folder, name), "utf8")) });
  });
  await page.goto(PAGE);
  try {
    await page.waitForFunction(() => document.querySelector("p").textContent !== "", null, { timeout: 120_000 });
  } catch (error) {
    throw new Error(`${name}: ${errors.join("\n") || error.message}`);
  }
  const text = await page.textContent("p");
  // The frame of the page's first request is drawn by now, and one more.
  await page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(() => setTimeout(done, 1000)))));
  const path = join(SCREENSHOTS, `${picture.replace(".html", "")}.png`);
  const shot = await page.locator("canvas").first().screenshot({ path });
  const last = await page.locator("canvas").last().screenshot();
  if (errors.length > 0) throw new Error(`${name}: ${errors.join("\n")}`);
  const [data, ofLast] = await Promise.all([shot, last].map((one) => page.evaluate(pixels, one.toString("base64"))));
  await page.close();
  return { text, data, ofLast };
}

function check(name, is, what) {
  if (!is) throw new Error(`the README's page ${name}: ${what}`);
}

async function openReadmePages(browser) {
  const triangle = await openReadmePage(browser, "index.html");
  const filled = share(triangle.data, (r, g, b) => b === 255 && r + g < 500);
  check("index.html", triangle.text === "19 points, 29 triangles", triangle.text);
  check("index.html", Math.abs(filled - 0.5) < 0.02, `the triangle fills ${filled} of its canvas, not half`);
  console.log("test the README's page ... ok");

  const stage = await openReadmePage(browser, "stage.html");
  const columns = Array.from({ length: 16 }, (_, number) => 2 << number % 4);
  const { indices } = model(columns.map((left) => [left, left, 2 * left, left, left, 1.5 * left]));
  check("stage.html", stage.text === `${indices.length / 3} triangles`, `${stage.text}, not ${indices.length / 3}`);
  const colours = new Set();
  const drawn = share(stage.data, (r, g, b) => { colours.add(r << 16 | g << 8 | b); return b > 0; });
  check("stage.html", drawn > 0.4 && drawn < 0.7 && colours.size > 1000, `${drawn} of it is drawn in ${colours.size} colours`);
  console.log("test the README's page of the stage ... ok");

  const two = await openReadmePage(browser, "canvases.html");
  check("canvases.html", two.text === `${model([Array(6).fill(8)]).indices.length / 3} triangles on 2 canvases`, two.text);
  const [whole, quarter] = [two.data, two.ofLast].map((data) => share(data, (r, g, b) => b === 255));
  check("canvases.html", whole > 0.99 && Math.abs(quarter - 0.25) < 0.01, `${whole} and ${quarter} of its canvases are drawn`);
  console.log("test the README's page of two canvases ... ok");

  const lit = await openReadmePage(browser, "three.html");
  check("three.html", parseInt(lit.text) > 2000, lit.text);
  const green = share(lit.data, (r, g, b) => g > 1.2 * b && g > r && g > 20);
  check("three.html", green > 0.3, `only ${green} of it is green`);
  const noShadow = (text) => text.replace("ball.castShadow = true", "ball.castShadow = false");
  const plain = await openReadmePage(browser, "three.html", noShadow, "three-without-shadow");
  const shadow = share(lit.data, (r, g, b, i) => g + 20 < plain.data[i + 1]);
  const lighter = share(lit.data, (r, g, b, i) => g > plain.data[i + 1] + 20);
  check("three.html", shadow > 0.002 && lighter < 0.001, `the ball darkens ${shadow} of it, and lightens ${lighter}`);
  console.log(`test the README's page of three.js ... ok (${lit.text}; the ball's shadow is ${(100 * shadow).toFixed(1)} % of it)`);
}

const folders = readdirSync(join(packed, "shaders"));
const args = ["--enable-unsafe-webgpu", "--use-webgpu-adapter=swiftshader", "--no-sandbox"];
// A WebGPU canvas is shown only if the browser draws with the same driver, which makes everything slower.
const drawing = [
  ...args, "--enable-unsafe-swiftshader", "--ignore-gpu-blocklist", "--enable-gpu", "--use-angle=swiftshader",
  "--enable-features=Vulkan", "--use-vulkan=swiftshader",
];
const open = (args) => chromium.launch({ executablePath: "/usr/bin/chromium", args });

const SCREENSHOTS = join(process.env.EXPLORER_MODULES, "screenshots");
mkdirSync(SCREENSHOTS, { recursive: true });

await compareFactors();
await tryRoom(packed);
await tryJoining(packed);
const showing = await open(drawing);
await openReadmePages(showing);
await showing.close();
const browser = await open(args);
const page = await browser.newPage();
await page.route(PAGE + "**", (route) => {
  const name = new URL(route.request().url()).pathname.slice(1);
  if (name === "") return route.fulfill({ contentType: "text/html", body: `<!doctype html>${IMPORTS}` });
  const built = /^build\/(.*)/.exec(name);
  return route.fulfill({ path: built ? join(folder, "node_modules/three/build", built[1]) : join(packed, name) });
});
await page.goto(PAGE);
await openWithoutGpu(page);
await tryStage(page);
await tryDraws(page);
await tryThree(page);
let compared = 0, passed = 14;
for (const [setup, batch] of Object.entries(recorded())) {
  if (!folders.includes(setup)) throw new Error(`the package has no ${setup}`);
  const [domain, partitioning] = setup.split("-");
  const { problems, points } = await page.evaluate(compare, [domain, partitioning, batch]);
  if (problems.length > 0) throw new Error(`${setup}: ${problems.join("\n")}`);
  compared += batch.length;
  passed++;
  console.log(`test ${setup} ... ok (${batch.length} patches, ${points} points)`);
}
await browser.close();
if (compared < 30) throw new Error(`only ${compared} patches were compared`);
console.log(`test result: ok. ${passed} passed; 0 failed; 0 ignored`);
