// Comparisons: equal where it should be, and different, with the place, where a fault is planted.

import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { close, enter, open, patchWords, picture, tess, test } from "./harness.mjs";

const text = (page, id) => page.textContent(`#${id}`);

// Waits until the GPU's badge is about the patch that is shown.
const gpuBadge = async (page) => {
  await page.waitForFunction(() => {
    const badge = document.getElementById("badge-gpu");
    return badge.dataset.line === document.documentElement.dataset.drawn
      && badge.dataset.fault === document.getElementById("fault").value;
  });
  return text(page, "badge-gpu");
};

const CASES = [
  "case quad fractional_odd triangle_cw ruler 40c00000 40800000 40a00000 40e00000 40d33333 40900000",
  "case quad fractional_even triangle_cw center 42800000 41200000 40a00000 42033333 41d33333 42780000",
  "case tri integer triangle_ccw ruler 41000000 41100000 3f800000 41880000",
  "case isoline fractional_even line ruler 40c00000 41833333",
  "case quad pow2 point center 41000000 41000000 41000000 41000000 41000000 41000000",
  "case quad integer triangle_cw ruler 00000000 41000000 41000000 41000000 41000000 41000000",
];

test("both backends are equal to the model, and a planted fault is named", async () => {
  const page = await open();
  await page.click("#tab-compare");
  for (const line of CASES) {
    await enter(page, line);
    assert.equal(await text(page, "badge-cpu"), "CPU equal", line);
    assert.equal(await gpuBadge(page), "GPU equal", line);
  }
  await enter(page, CASES[0]);
  await page.selectOption("#fault", "cpu");
  await page.waitForFunction(() => document.getElementById("badge-cpu").dataset.is === "different");
  const middle = Math.trunc(JSON.parse(tess("explain", ...await patchWords(page), "--json")).points / 2);
  assert.match(await text(page, "badge-cpu"), new RegExp(`^CPU: point ${middle} u: observed 0x`));
  assert.equal(await gpuBadge(page), "GPU equal", "the fault is the CPU's");
  await page.selectOption("#fault", "gpu");
  await page.waitForFunction(() => document.getElementById("badge-cpu").dataset.is === "equal");
  assert.match(await gpuBadge(page), /^GPU: point \d+ [uv]: observed 0x[0-9a-f]+, expected 0x[0-9a-f]+ \(stage: location\)$/);
  await page.selectOption("#against", "gpu");
  await page.waitForFunction(() => /points? and 0 primitives/.test(document.getElementById("verdict").textContent));
  await close(page);
});

test("a hundred patches on the GPU are equal, and a planted fault is named with its case", async () => {
  const page = await open();
  await page.click("#tab-compare");
  const hundred = async () => {
    await page.click("#hundred");
    await page.waitForFunction(() => document.getElementById("hundred-verdict").dataset.is);
    return text(page, "hundred-verdict");
  };
  for (const line of CASES.slice(0, 5)) {
    await enter(page, line);
    assert.equal(await hundred(), "100 patches equal, bit by bit.", line);
  }
  await enter(page, CASES[0]);
  await page.selectOption("#fault", "gpu");
  assert.match(await hundred(), /^case quad fractional_odd .*: point \d+ [uv]: observed/);
  await close(page);
});

// Pixels of the picture that are as red as marks of differences.
const redPixels = (page) => page.evaluate(() => {
  const canvas = document.getElementById("overlay");
  const { data } = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
  let red = 0;
  for (let k = 0; k < data.length; k += 4) red += data[k] > 180 && data[k + 1] < 70 && data[k + 2] < 70 && data[k + 3] > 200;
  return red;
});

test("a dropped listing with one flipped triangle is marked", async () => {
  const page = await open();
  const listing = tess("patch", ...await patchWords(page)).toString();
  const lines = listing.split("\n");
  const first = lines.findIndex((line) => line.startsWith("indices")) + 1;
  const drop = (contents) => page.evaluate((text) => {
    const data = new DataTransfer();
    data.items.add(new File([text], "device.txt"));
    document.body.dispatchEvent(new DragEvent("drop", { dataTransfer: data, bubbles: true, cancelable: true }));
  }, contents);
  const verdict = async (pattern) => {
    await page.waitForFunction((text) => new RegExp(text).test(document.getElementById("verdict").textContent), pattern);
    return text(page, "verdict");
  };
  await drop(listing);
  assert.equal(await verdict("bit by bit"), "Equal, bit by bit.");
  assert.equal(await redPixels(page), 0, "nothing is marked");
  const [a, b, c] = lines[first + 12].split(" ");
  lines[first + 12] = [a, c, b].join(" ");
  await drop(lines.join("\n"));
  assert.match(await verdict("Differences"), /^Differences: 0 points and 1 primitive\. The first: index 1 of primitive 12: /);
  assert.ok(await redPixels(page) > 50, "the triangle is marked");
  await picture(page, "flipped-triangle");
  await page.click("#tab-share");
  await page.click('button[aria-label="Copy: Link to this view"]');
  const link = await page.evaluate(() => navigator.clipboard.readText());
  await page.click("#tab-compare");
  const other = await open(link.slice(link.indexOf("#")));
  assert.equal(await text(other, "verdict"), await text(page, "verdict"), "the link shows the wrong triangle");
  assert.equal(await redPixels(other), await redPixels(page));
  await enter(other, CASES[0]);
  await other.waitForFunction(() => document.getElementById("verdict").textContent.startsWith("Paste"));
  await close(other);
  await drop(lines.join("\n").replace(/end\n$/, ""));
  await verdict("ends");
  await close(page);
});

test("the error of the first listing stays", async () => {
  const page = await open();
  await page.click("#tab-compare");
  await page.fill("#pasted", "case quad\n");
  await page.waitForTimeout(300);
  const said = await text(page, "verdict");
  assert.ok(said !== "" && !said.startsWith("Paste"), said);
  await page.fill("#pasted", "");
  await page.waitForFunction(() => document.getElementById("verdict").textContent.startsWith("Paste"));
  await close(page);
});

test("split orders and partitionings are compared", async () => {
  const page = await open();
  await enter(page, CASES[0]);
  await page.click("#tab-compare");
  await page.selectOption("#against", "split");
  await page.waitForFunction(() => document.getElementById("verdict").textContent.includes(" center "));
  assert.match(await text(page, "verdict"), /points and \d+ primitives\. The first: point/);
  await page.selectOption("#against", "integer");
  await page.waitForFunction(() => document.getElementById("verdict").textContent.includes("quad integer"));
  await close(page);
});

test("a file with many listings offers its cases", async () => {
  const page = await open();
  await page.click("#tab-compare");
  await page.setInputFiles("#listing-file", "golden/cases.txt");
  await page.waitForFunction(() => document.getElementById("listing-cases").options.length > 40);
  const cases = readFileSync("golden/cases.txt", "utf8").match(/^case .*/gm);
  for (const line of [cases[0], cases[5], cases[30]]) {
    await page.selectOption("#listing-cases", line);
    await page.waitForFunction((wanted) => document.documentElement.dataset.drawn === wanted, line);
    assert.equal(await text(page, "verdict"), "Equal, bit by bit.");
  }
  await close(page);
});

test("the browser's compiler takes every shader of every configuration", async () => {
  const page = await open();
  const complaints = await page.evaluate(async () => {
    const { choices, shader_sources } = await import("./tess_explorer.js");
    const { open: openGpu } = await import("./gpu.js");
    const { device } = await openGpu();
    const known = JSON.parse(choices()), seen = new Set(), complaints = [];
    for (const domain of known.domains) for (const { name } of known.partitionings) {
      for (const output of known.outputs) for (const split of known.splits) {
        const line = `case ${domain.name} ${name} ${output} ${split}${" 40400000".repeat(domain.factors.length)}`;
        for (const [stage, code] of Object.entries(JSON.parse(shader_sources(line)))) {
          if (seen.has(code)) continue;
          seen.add(code);
          const { messages } = await device.createShaderModule({ code }).getCompilationInfo();
          for (const { type, message } of messages) if (type === "error") complaints.push(`${line}: ${stage}: ${message}`);
        }
      }
    }
    return { complaints, count: seen.size };
  });
  assert.deepEqual(complaints.complaints, []);
  assert.ok(complaints.count > 100, `${complaints.count} different shaders`);
  await close(page);
});
