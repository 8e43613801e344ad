// The patch: what is entered, asked, copied and saved.

import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { close, enter, need, openWithoutGpu as open, patchWords, tess, test } from "./harness.mjs";

const golden = readFileSync("golden/cases.txt", "utf8");
const records = golden.split(/^(?=case )/m).slice(1);
const lineOf = (record) => record.slice(0, record.indexOf("\n"));

// Copies a text of the page's tab Share.
async function copied(page, name) {
  await page.click("#tab-share");
  await page.click(`button[aria-label="Copy: ${name}"]`);
  return page.evaluate(() => navigator.clipboard.readText());
}

test("every recorded case, entered, gives the recorded listing", async () => {
  assert.equal(records.length, Number(/count=(\d+)/.exec(golden)[1]), "all records of the file");
  const page = await open();
  for (const record of records) {
    await enter(page, lineOf(record));
    assert.equal(await copied(page, "Listing of the whole patch"), record, lineOf(record));
  }
  await close(page);
});

test("the case line and the command of a patch give the same patch to tess", async () => {
  const page = await open();
  for (const record of records.slice(0, 6)) {
    await enter(page, lineOf(record));
    assert.equal(await copied(page, "Case line for tess check"), lineOf(record));
    const [program, ...words] = (await copied(page, "Command")).split(" ");
    assert.equal(program, "tess");
    assert.ok(tess(...words).toString().endsWith(record), "the command prints the listing");
  }
  await close(page);
});

// Where a point lies in the picture, computed here again: the layout of `tess draw`, 0.9 of the shorter side.
async function place(page, isTriangle, u, v) {
  const box = await page.locator("#overlay").boundingBox();
  const side = 0.9 * Math.min(box.width, box.height);
  const [du, dv] = isTriangle ? [u - 0.25, v - 0.25] : [u - 0.5, v - 0.5];
  const [x, y] = isTriangle ? [(du - dv) / 2, (du + dv) * Math.sqrt(0.75)] : [du, dv];
  return [box.x + box.width / 2 + side * x, box.y + box.height / 2 + side * y];
}

const asked = async (page) => JSON.parse(await page.textContent("#asked-json"));

for (const line of [
  "case quad fractional_even triangle_cw ruler 40c00000 40800000 40a00000 40e00000 40d33333 40900000",
  "case tri fractional_odd triangle_ccw center 40a00000 40400000 40e00000 40c80000",
  "case isoline fractional_odd line ruler 40800000 40b00000",
]) {
  test(`hovering says what tess explain says: ${line}`, async () => {
    const page = await open();
    await enter(page, line);
    const words = await patchWords(page);
    const output = JSON.parse(tess("patch", ...words, "--format", "json"));
    const isTriangle = output.domain === "tri";
    for (const [i, { u, v }] of output.points.entries()) {
      await page.mouse.move(...await place(page, isTriangle, u, v));
      const expected = JSON.parse(tess("explain", ...words, "--point", String(i), "--json"));
      assert.deepEqual(await asked(page), expected, `point ${i}`);
    }
    for (const [t, primitive] of output.primitives.entries()) {
      const middle = (key) => primitive.reduce((sum, i) => sum + output.points[i][key], 0) / primitive.length;
      await page.mouse.move(...await place(page, isTriangle, middle("u"), middle("v")));
      const expected = JSON.parse(tess("explain", ...words, "--primitive", String(t), "--json"));
      assert.deepEqual(await asked(page), expected, `primitive ${t}`);
    }
    await close(page);
  });
}

test("the stages are those of tess explain", async () => {
  const page = await open();
  await page.click("#tab-ask");
  const boxes = page.locator("#stages details");
  const parts = await boxes.evaluateAll((all) => all.map((box) =>
    [box.querySelector("summary").textContent, box.querySelector("pre").textContent].join("\n")));
  const words = (text) => text.split(/\s+/).filter(Boolean).join(" ");
  const [, ...sections] = tess("explain", ...await patchWords(page)).toString().split("\n\n");
  assert.equal(words(parts.join("\n")), words(sections.join("\n")));
  assert.ok(parts.length >= 6, "a section for each stage");
  await close(page);
});

// The contents of the file that a button of the tab Share saves. A browser may drop one of several downloads that
// follow each other within a second, and nobody is there to press the button again.
async function saved(page, extension, presses = 5) {
  await page.click("#tab-share");
  const begun = page.waitForEvent("download", { timeout: 5000 }).catch(() => null);
  await page.click(`#save-${extension}`);
  const download = await begun;
  if (download) return readFileSync(await download.path());
  assert.ok(presses > 1, `no download of ${extension} begins`);
  return saved(page, extension, presses - 1);
}

test("saved files are what tess writes", async () => {
  const page = await open();
  await page.selectOption("#colours", "plain");
  for (const line of [records[0], records[7], records[20], records[40]].map(lineOf)) {
    await enter(page, line);
    const words = await patchWords(page);
    for (const [extension, format] of [["svg", "svg"], ["png", "png"], ["obj", "obj"], ["csv", "csv"], ["txt", "text"]]) {
      const file = join(need("EXPLORER_MODULES"), `expected.${extension}`);
      tess("patch", ...words, "--format", format, "-o", file);
      assert.ok(readFileSync(file).equals(await saved(page, extension)), `${extension} of ${line}`);
    }
  }
  await page.selectOption("#colours", "order");
  await page.selectOption("#numbers", "points");
  const drawn = tess("draw", ...await patchWords(page), "--number-primitives", "--number-points");
  assert.ok(drawn.equals(await saved(page, "svg")), "order and numbers");
  await close(page);
});

test("a link restores the view", async () => {
  const page = await open();
  await enter(page, lineOf(records[3]));
  await page.selectOption("#colours", "rings");
  await page.selectOption("#numbers", "both");
  await page.check("#marks");
  await page.click("#zoom-in");
  await page.focus("#overlay");
  await page.keyboard.press("PageDown");
  await page.keyboard.press("ArrowLeft");
  const link = await copied(page, "Link to this view");
  const other = await open(link.slice(link.indexOf("#")));
  const shown = (of) => of.evaluate(async () => ({
    state: { ...(await import("./state.js")).state },
    marked: document.getElementById("marks").checked,
    overlay: document.getElementById("overlay").toDataURL(),
    chosen: ["domain", "partitioning", "output", "split", "colours", "numbers", "case", "pick-point"].map((id) => document.getElementById(id).value),
  }));
  assert.deepEqual(await shown(other), await shown(page));
  await close(other);
  await close(page);
});

test("everything can be done with the keyboard alone", async () => {
  const page = await open();
  const reach = async (id) => {
    for (let k = 0; k < 80; k++) {
      if (await page.evaluate(() => document.activeElement.id) === id) return;
      await page.keyboard.press("Tab");
    }
    assert.fail(`${id} cannot be reached`);
  };
  const line = () => page.inputValue("#case");
  await reach("factor-u0");
  await page.keyboard.press("Control+A");
  await page.keyboard.type("0x40490fdb");
  await page.keyboard.press("Enter");
  await page.waitForFunction(() => document.getElementById("case").value.includes("40490fdb"));
  await page.keyboard.press("ArrowUp");
  await page.waitForFunction(() => document.getElementById("case").value.includes("40490fdc"));
  await reach("overlay");
  await page.keyboard.press("PageDown");
  await page.keyboard.press("PageDown");
  await page.waitForFunction(() => document.getElementById("pick-point").value === "1");
  await page.keyboard.press("Shift+PageUp");
  const last = JSON.parse(tess("explain", ...await patchWords(page), "--json")).primitives - 1;
  await page.waitForFunction((t) => document.getElementById("pick-primitive").value === String(t), last);
  await reach("tab-ask");
  await page.keyboard.press("ArrowRight");
  await page.keyboard.press("ArrowRight");
  assert.equal(await page.getAttribute("#tab-share", "aria-selected"), "true");
  const before = await line();
  await page.keyboard.press("Tab");
  await page.keyboard.press("Tab");
  await page.keyboard.press("Tab");
  await page.keyboard.press("Tab");
  await page.keyboard.press("Enter");
  assert.equal(await page.evaluate(() => navigator.clipboard.readText()), before, "the case line is copied");
  await close(page);
});

test("bad input is refused with a reason, and the patch stays", async () => {
  const page = await open();
  const before = await page.textContent("#counts");
  await page.fill("#case", "case quad integer triangle_cw ruler 3f800000");
  await page.press("#case", "Enter");
  await page.waitForFunction(() => document.getElementById("case-error").textContent.includes("quad patches have 6 factors"));
  assert.equal(await page.textContent("#counts"), before);
  await page.fill("#factor-u0", "five");
  await page.press("#factor-u0", "Enter");
  const reason = await page.locator("#factor-u0").evaluate((field) => field.validationMessage);
  assert.match(reason, /a factor is a decimal number/);
  await close(page);
});

test("links between factors, special values and curiosities change the patch", async () => {
  const page = await open();
  const factors = async () => (await page.inputValue("#case")).split(" ").slice(5);
  await page.selectOption("#link", "all");
  await page.locator("#factor-u1 + select").selectOption("inf");
  await page.waitForFunction(() => document.getElementById("case").value.endsWith("7f800000"));
  assert.deepEqual(await factors(), Array(6).fill("7f800000"));
  await page.selectOption("#link", "edges");
  await page.fill("#factor-v0", "9");
  await page.press("#factor-v0", "Enter");
  await page.waitForFunction(() => document.getElementById("case").value.includes("41100000"));
  assert.deepEqual((await factors()).slice(0, 4), ["7f800000", "41100000", "7f800000", "41100000"]);
  await page.focus("#curiosities");
  assert.equal(await page.locator("#curiosities optgroup:last-child option").count(), 420);
  await page.locator("#curiosities").selectOption({ label: "0x060001 = 6.0000153" });
  await page.selectOption("#colours", "orientation");
  await page.waitForFunction(() => document.documentElement.dataset.drawn.endsWith(document.getElementById("curiosities").value.slice(-8)));
  const areas = await page.evaluate(() => import("./patch.js").then(({ patch }) => [...patch.view.areas()]));
  assert.ok(areas.some((area) => area < 0), "a factor whose locations go backwards has flipped triangles");
  await close(page);
});

for (const words of [
  "colours=nope", "answer=compare&against=nope", "tab=surface&surface=nope", "tab=nope", "answer=nope", "numbers=nope",
  "link=nope", "answer=compare&fault=nope", "theme=nope", "tab=surface&spacing=nope", "tab=surface&rule=nope",
  "tab=surface&by=nope", "tab=surface&factor=nope", "tab=surface&eye=nope", "pick=nope", "built=nope", "view=nope",
  "answer=compare&against=listing&device=nope", "tab=surface&kept=nope", "line=nope",
]) {
  test(`a link with an unknown value is shown: ${words}`, async () => {
    const page = await open(`#${words}`);
    // A link may have opened the surfaces, where no patch can be entered.
    await page.click("#tab-patch");
    await enter(page, lineOf(records[0]));
    await page.click("#tab-share");
    assert.equal(await copied(page, "Listing of the whole patch"), records[0]);
    await close(page);
  });
}
