// Tests in a browser: a page, the program `tess` beside it, and a count of what passed.

import { execFileSync } from "node:child_process";
import { createRequire } from "node:module";
import { existsSync, mkdirSync } from "node:fs";
import { join } from "node:path";

const fail = (message) => { throw new Error(message); };
const need = (name) => process.env[name] ?? fail(`${name} is not set: run \`cargo xtask explorer --test\``);

export const address = need("EXPLORER");
const { chromium } = createRequire(join(need("EXPLORER_MODULES"), "/"))("playwright-core");
const shots = need("EXPLORER_SCREENSHOTS");

const executablePath = process.env.PATH.split(":").map((folder) => join(folder, "chromium")).find(existsSync)
  ?? fail("there is no program `chromium`: install it");
// WebGPU and WebGL in software, so that a machine without a GPU will do. Chromium has no sandbox for root.
const args = ["--enable-unsafe-webgpu", "--use-webgpu-adapter=swiftshader"];
if (process.getuid() === 0) args.push("--no-sandbox");

let browser = null;
const tests = [];

export function test(name, run) {
  tests.push({ name, run });
}

// Opens the page at this address's fragment, ready for use; its errors make the test fail.
export async function open(fragment = "", options = {}) {
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
  await page.goto(address + fragment);
  await page.waitForFunction(() => document.documentElement.dataset.drawn !== undefined);
  return page;
}

// Ends with a page, which must not have complained.
export async function close(page) {
  const { problems } = page;
  await page.context().close();
  if (problems.length > 0) throw new Error(`the page complained:\n${problems.join("\n")}`);
}

// What `tess` prints.
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

export async function picture(page, name) {
  mkdirSync(shots, { recursive: true });
  await page.screenshot({ path: join(shots, `${name}.png`) });
}

export async function runAll() {
  browser = await chromium.launch({ executablePath, args });
  let failed = 0, ran = 0;
  const wanted = process.argv[2] ?? "";
  for (const { name, run } of tests.filter(({ name }) => name.includes(wanted))) {
    ran++;
    try {
      await run();
      console.log(`test ${name} ... ok`);
    } catch (error) {
      failed++;
      console.log(`test ${name} ... FAILED\n${error.stack}`);
    }
  }
  await browser.close();
  const verdict = failed === 0 ? "ok" : "FAILED";
  console.log(`test result: ${verdict}. ${ran - failed} passed; ${failed} failed; 0 ignored`);
  process.exitCode = failed === 0 ? 0 : 1;
}
