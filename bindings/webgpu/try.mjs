// Tries the package in a page that has nothing else: node try.mjs PACKAGE CASES. Recorded cases must come out to the bit.

import { createRequire } from "node:module";
import { readFileSync, readdirSync } from "node:fs";
import { join } from "node:path";

const [packed, cases] = process.argv.slice(2);
const { chromium } = createRequire(join(process.env.EXPLORER_MODULES, "/"))("playwright-core");
const PAGE = "http://localhost/";

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

// In the page: tessellates a batch of all patches, and says where it differs.
async function compare([domain, partitioning, batch]) {
  const { Tessellator, unpackWgsl } = await import("/tess.js");
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
  const { messages } = await device.createShaderModule({ code: unpackWgsl }).getCompilationInfo();
  problems.push(...messages.map(({ message }) => message));
  for (const room of [{ points: 2 ** 30, primitives: 1 }, { points: 2 ** 33, primitives: 1 }]) {
    try {
      tessellator.batch(1, room);
      problems.push(`room for ${room.points} points is not refused`);
    } catch (error) {
      if (!(error instanceof RangeError)) throw error;
    }
  }
  return { problems, points: expected.patches.length };
}

const folders = readdirSync(join(packed, "shaders"));
const args = ["--enable-unsafe-webgpu", "--use-webgpu-adapter=swiftshader", "--no-sandbox"];
const browser = await chromium.launch({ executablePath: "/usr/bin/chromium", args });
const page = await browser.newPage();
await page.route(PAGE + "**", (route) => {
  const name = new URL(route.request().url()).pathname.slice(1);
  return name === "" ? route.fulfill({ contentType: "text/html", body: "<!doctype html>" }) : route.fulfill({ path: join(packed, name) });
});
await page.goto(PAGE);
let compared = 0, passed = 0;
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
