// The other views, other screens, and pictures of them to look at.

import assert from "node:assert/strict";
import { close, colours, covered, enter, open, openWithoutGpu, picture, test } from "./harness.mjs";

test("the patch is drawn in both themes and on a phone", async () => {
  const page = await open();
  assert.ok(await colours(page, "canvases") > 60 && await covered(page, "canvases") > 0.3, "triangles in many colours");
  await picture(page, "patch");
  await page.click("#theme");
  await page.waitForFunction(() => document.documentElement.dataset.theme === "dark");
  await page.click("#tab-ask");
  await page.fill("#pick-primitive", "12");
  await page.selectOption("#numbers", "both");
  await picture(page, "patch-dark");
  await close(page);
  const phone = await open("", { viewport: { width: 390, height: 844 }, hasTouch: true, isMobile: true });
  const width = await phone.evaluate(() => document.documentElement.scrollWidth);
  assert.ok(width <= 390, `${width} pixels wide`);
  await phone.tap("#overlay");
  await phone.waitForFunction(() => document.getElementById("asked").textContent !== "");
  await picture(phone, "phone");
  await close(phone);
});

test("zooming reaches single units of 16.16", async () => {
  const page = await open("#view=32768,32768,20000");
  const scale = await page.evaluate(() => import("./picture.js").then(({ view }) => view.scale));
  assert.ok(scale > 20, `${scale} pixels a unit`);
  await page.focus("#overlay");
  await page.keyboard.press("0");
  await page.waitForFunction(() => import("./picture.js").then(({ view }) => view.zoom === 1));
  await close(page);
});

test("a link that is followed wins over what the page remembers", async () => {
  const page = await openWithoutGpu();
  await page.evaluate(async () => {
    const { link } = await import("./state.js");
    location.hash = "#tab=surface&surface=flat";
    // The event of the new address is still to come, and the page writes its own.
    link();
  });
  await page.waitForFunction(() => document.getElementById("surface").value === "flat", null, { timeout: 5000 });
  assert.ok(await page.isVisible("#view-surface"));
  await close(page);
});

test("building and animation move, and stop", async () => {
  const page = await open();
  // A small patch is built in two seconds.
  await enter(page, `case quad integer triangle_cw ruler${" 40000000".repeat(6)}`);
  await page.click("#build");
  await page.waitForFunction(() => Number(document.getElementById("built").value) < 8);
  await page.waitForFunction(() => document.getElementById("built").value === "8", null, { timeout: 60000 });
  assert.equal(await page.getAttribute("#build", "aria-pressed"), "false", "whole again");
  await page.click("#animation summary");
  const before = await page.inputValue("#case");
  await page.click("#animate");
  await page.waitForFunction((line) => document.getElementById("case").value !== line, before);
  await page.click("#animate");
  assert.equal(await page.getAttribute("#animate", "aria-pressed"), "false");
  await page.click("#tab-learn");
  await page.click("[data-partitioning=fractional_even] summary");
  await page.click("[data-partitioning=fractional_even] button");
  await page.waitForFunction(() => document.getElementById("partitioning").value === "fractional_even");
  await close(page);
});

test("the CPU and the GPU are measured at every workload", async () => {
  const page = await open("#tab=measure");
  await page.fill("#measure-seconds", "0");
  await page.click("#measure");
  await page.waitForFunction(() => document.getElementById("measure-note").textContent.startsWith("Best"), null, { timeout: 300000 });
  const rows = await page.locator("#rates tbody tr").evaluateAll((all) => all.map((row) => [...row.cells].map((cell) => cell.textContent)));
  assert.ok(rows.length >= 11, "workloads");
  for (const [name, ...numbers] of rows) {
    assert.ok(numbers.every((number) => Number(number.replaceAll(",", "")) > 0), `${name}: ${numbers}`);
  }
  await page.click("#copy-table");
  const table = await page.evaluate(() => navigator.clipboard.readText());
  assert.equal(table.trim().split("\n").length, rows.length + 2, "browser, heading, rows");
  await picture(page, "measure");
  await close(page);
});

test("without WebGPU the page says so and does without", async () => {
  const page = await openWithoutGpu();
  await page.waitForFunction(() => document.getElementById("badge-gpu").textContent !== "");
  assert.equal(await page.textContent("#badge-gpu"), "GPU not compared: this browser has no WebGPU");
  assert.equal(await page.textContent("#badge-cpu"), "CPU equal");
  await enter(page, "case tri integer triangle_cw ruler 40800000 404ccccd 3fd9999a 40800000");
  assert.match(await page.textContent("#counts"), /^17 points, 22 triangles/);
  await close(page);
});
