// Tests in a browser: a page, the program `tess` beside it, and a count of what passed.

import { execFileSync } from "node:child_process";
import { createRequire } from "node:module";
import { existsSync, mkdirSync, readFileSync } from "node:fs";
import { createServer } from "node:http";
import { extname, join } from "node:path";

const fail = (message) => { throw new Error(message); };
export const need = (name) => process.env[name] ?? fail(`${name} is not set: run \`cargo xtask explorer --test\``);

const TYPES = { ".html": "text/html", ".css": "text/css", ".js": "text/javascript", ".wasm": "application/wasm" };

// The page, and beside it the stage of `stage.mjs`, which is no part of it.
const server = createServer(({ url }, answer) => {
  const [, folder, name] = /^\/(stage\/)?([^/?]*)/.exec(url);
  const file = join(need(folder ? "EXPLORER_STAGE" : "EXPLORER"), name || "index.html");
  if (existsSync(file)) answer.writeHead(200, { "Content-Type": TYPES[extname(file)] }).end(readFileSync(file));
  else answer.writeHead(404).end();
});
await new Promise((ready) => server.listen(0, "127.0.0.1", ready));
const address = `http://127.0.0.1:${server.address().port}/`;
const { chromium } = createRequire(join(need("EXPLORER_MODULES"), "/"))("playwright-core");
const shots = need("EXPLORER_SCREENSHOTS");

const executablePath = process.env.PATH.split(":").map((folder) => join(folder, "chromium")).find(existsSync)
  ?? fail("there is no program `chromium`: install it");
// WebGPU and WebGL in software, so that a machine without a GPU will do. Chromium has no sandbox for root.
const SOFTWARE = ["--enable-unsafe-webgpu", "--use-webgpu-adapter=swiftshader", ...(process.getuid() === 0 ? ["--no-sandbox"] : [])];
// A canvas of WebGPU is only shown if the browser draws by the same driver, which makes everything slower.
const DRAWING = [
  ...SOFTWARE, "--enable-unsafe-swiftshader", "--ignore-gpu-blocklist", "--enable-gpu", "--use-angle=swiftshader",
  "--enable-features=Vulkan", "--use-vulkan=swiftshader",
];

// Browsers by their arguments.
const browsers = new Map();
const tests = [];

// The result of `run` is printed beside the test's name.
export function test(name, run) {
  tests.push({ name, run });
}

// Opens the page at this address's fragment, ready for use; its errors make the test fail.
export async function open(fragment = "", { without = null, ...options } = {}, args = SOFTWARE) {
  if (!browsers.has(args)) browsers.set(args, await chromium.launch({ executablePath, args }));
  const browser = browsers.get(args);
  const context = await browser.newContext({ viewport: { width: 1400, height: 850 }, acceptDownloads: true, ...options });
  await context.grantPermissions(["clipboard-read", "clipboard-write"]);
  const page = await context.newPage();
  page.problems = [];
  page.on("pageerror", (error) => page.problems.push(error.stack));
  page.on("console", (message) => message.type() === "error" && page.problems.push(message.text()));
  page.on("request", (request) => {
    const url = request.url();
    if (!url.startsWith(address) && !/^(blob|data):/.test(url)) page.problems.push(`asked for ${url}`);
  });
  if (without) await page.addInitScript(without);
  await page.goto(address + fragment);
  await page.waitForFunction(() => document.documentElement.dataset.ready !== undefined);
  return page;
}

// The same where surfaces are to be drawn by WebGPU.
export const openDrawing = (fragment) => open(fragment, {}, DRAWING);

// The same without WebGPU, for what does not need it: the page compares with no GPU then.
export const openWithoutGpu = (fragment) =>
  open(fragment, { without: () => Object.defineProperty(Navigator.prototype, "gpu", { get: () => undefined }) });

// Ends with a page, which must not have complained.
export async function close(page) {
  const { problems } = page;
  await page.context().close();
  if (problems.length > 0) throw new Error(`the page complained:\n${problems.join("\n")}`);
}

// The output of `tess`.
export function tess(...words) {
  return execFileSync(need("TESS_PROGRAM"), words, { maxBuffer: 1 << 26 });
}

// The arguments of `tess` that a case line stands for.
export async function patchWords(page) {
  const command = await page.evaluate(() => import("./patch.js").then(({ patch }) => patch.view.command()));
  return command.split(" ").slice(2);
}

// Types a case line into its field.
export async function enter(page, line) {
  await page.fill("#case", line);
  await page.press("#case", "Enter");
  await page.waitForFunction((wanted) => document.documentElement.dataset.drawn === wanted, line);
}

// Picture of a part of the page: width, height and its pixels, four numbers each.
export async function pixels(page, id) {
  const shot = await page.locator(`#${id}`).screenshot();
  const { size, text } = await page.evaluate(async (base64) => {
    const image = await createImageBitmap(await (await fetch(`data:image/png;base64,${base64}`)).blob());
    const paint = new OffscreenCanvas(image.width, image.height).getContext("2d");
    paint.drawImage(image, 0, 0);
    const { data } = paint.getImageData(0, 0, image.width, image.height);
    let text = "";
    for (let k = 0; k < data.length; k += 8192) text += String.fromCharCode(...data.subarray(k, k + 8192));
    return { size: [image.width, image.height], text: btoa(text) };
  }, shot.toString("base64"));
  return { size, data: Buffer.from(text, "base64") };
}

// The part of it that is not as its ground.
export async function covered(page, id) {
  const { size: [width], data } = await pixels(page, id);
  const words = new Uint32Array(data.buffer, data.byteOffset, data.length / 4);
  return words.filter((word) => word !== words[10 * width + 10]).length / words.length;
}

// How many different colours it has.
export async function colours(page, id) {
  const { data } = await pixels(page, id);
  return new Set(new Uint32Array(data.buffer, data.byteOffset, data.length / 4)).size;
}

export async function picture(page, name) {
  mkdirSync(shots, { recursive: true });
  await page.screenshot({ path: join(shots, `${name}.png`) });
}

export async function runAll() {
  let failed = 0, ran = 0;
  const wanted = process.argv[2] ?? "";
  for (const { name, run } of tests.filter(({ name }) => name.includes(wanted))) {
    ran++;
    const began = performance.now();
    try {
      const note = await run();
      const seconds = ((performance.now() - began) / 1000).toFixed(1);
      console.log(`test ${name} ... ok (${seconds} s${note ? `; ${note}` : ""})`);
    } catch (error) {
      failed++;
      console.log(`test ${name} ... FAILED\n${error.stack}`);
    }
  }
  for (const browser of browsers.values()) await browser.close();
  server.close();
  const verdict = failed === 0 ? "ok" : "FAILED";
  console.log(`test result: ${verdict}. ${ran - failed} passed; ${failed} failed; 0 ignored`);
  process.exitCode = failed === 0 ? 0 : 1;
}
