// How soon the first picture comes and how long each takes. Times are printed; none is demanded.

import assert from "node:assert/strict";
import { close, covered, open, openWithoutGpu, test } from "./harness.mjs";

const median = (list) => list.sort((a, b) => a - b)[Math.trunc(list.length / 2)];

test("the first picture waits for nothing that it does not need", async () => {
  const times = [];
  for (let k = 0; k < 3; k++) {
    // The shaders of the page before would still be compiled.
    const page = await openWithoutGpu();
    const { picture, fetched } = await page.evaluate(() => ({
      picture: performance.getEntriesByName("first picture")[0].startTime,
      fetched: performance.getEntriesByType("resource").map(({ name, startTime }) => [name.split("/").pop(), startTime]),
    }));
    const after = fetched.filter(([, began]) => began > picture).map(([name]) => name).sort();
    const LATER = ["animation", "ask", "batch", "common", "compare", "gpu", "learn", "measure", "orbit", "share", "solid", "surface"];
    assert.deepEqual(after, LATER.map((name) => `${name}.js`), "the other views come after it");
    // One step from the page to every file that it needs.
    const preloaded = await page.locator("link[rel=modulepreload], link[rel=preload]").evaluateAll((all) => all.map((link) => link.href.split("/").pop()));
    const before = fetched.map(([name]) => name).filter((name) => !after.includes(name) && !["main.js", "style.css"].includes(name));
    assert.deepEqual(before.sort(), preloaded.sort(), "everything it needs is preloaded");
    times.push(picture);
    await close(page);
  }
  return `the first picture came after ${times.map((time) => time.toFixed(0)).join(", ")} ms`;
});

test("the first picture has its triangles without WebGL", async () => {
  const page = await open("", { without: () => {
    const get = HTMLCanvasElement.prototype.getContext;
    HTMLCanvasElement.prototype.getContext = function (kind, ...rest) {
      return kind.startsWith("webgl") ? null : get.call(this, kind, ...rest);
    };
  } });
  assert.ok(await covered(page, "canvases") > 0.3, "triangles are drawn");
  await close(page);
});

test("pictures at factor 64, one after the other", async () => {
  const page = await open();
  const times = await page.evaluate(async () => {
    const { flush, set } = await import("./state.js");
    const times = [];
    for (let k = 0; k < 41; k++) {
      const word = (0x427f0000 + 977 * k).toString(16);
      const line = `case quad fractional_odd triangle_cw ruler${` ${word}`.repeat(6)}`;
      set({ line });
      const began = performance.now();
      flush();
      times.push(performance.now() - began);
      if (document.documentElement.dataset.drawn !== line) throw new Error(`${line} is not drawn`);
      await new Promise(requestAnimationFrame);
    }
    return times.slice(10);
  });
  await close(page);
  return `one takes ${median(times).toFixed(1)} ms, the longest ${Math.max(...times).toFixed(1)} ms`;
});
