// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A case's scan: found from the start, four pictures of one place, bones found by name, keys, measures, and
// held back while an assessed operation runs.
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { gunzipSync } from "node:zlib";
import { expectAccessible } from "./accessibility.mjs";
import { drawn, newPage } from "./browser.mjs";
import { check, expect } from "./checks.mjs";
import { losesGraphics } from "./lost_graphics.mjs";
import { mendsScan } from "./scan_mend.mjs";

const reading = (page) => page.textContent(".scan-reading");

/** Grey levels and colours of a picture's middle. */
function middleOf(page, plane) {
  return page.evaluate((name) => {
    const canvas = document.querySelector(`.scan-panel.${name} canvas`);
    const { width, height } = canvas;
    const side = 60;
    const { data } = canvas
      .getContext("2d")
      .getImageData((width - side) / 2, (height - side) / 2, side, side);
    const colors = new Set();
    for (let i = 0; i < data.length; i += 4)
      colors.add((data[i] << 16) | (data[i + 1] << 8) | data[i + 2]);
    return colors.size;
  }, plane);
}

export async function lookAtScan(browser, station) {
  // Lines on slices are counted by their pixels; nothing of it is drawn in three dimensions for long.
  const page = await newPage(browser, { deviceScaleFactor: 1 });
  const problems = [];
  page.on("pageerror", (error) => problems.push(String(error)));
  const opened = await check(
    page,
    "the scan is found from the start",
    async () => {
      await page.goto(station.url);
      await page.getByRole("link", { name: "Scan", exact: true }).click();
      await page.locator(".scan-reading:not(:empty)").waitFor();
      for (const plane of ["axial", "coronal", "sagittal"]) {
        const colors = await middleOf(page, plane);
        expect(colors > 30, `${plane} has ${colors} colours in its middle`);
      }
      await expectAccessible(page, 10);
    },
  );
  if (opened) {
    await check(page, "the bones come back as they were when their graphics are lost", () =>
      losesGraphics(page, ".scan-panel.bones"),
    );
    await check(page, "a bone is found by its name, and said", async () => {
      await page.locator("[data-bone=capitate]").click();
      await page.locator(".scan-reading", { hasText: "Capitate" }).waitFor();
      expect(
        /-?\d+ HU/.test(await reading(page)),
        `it reads '${await reading(page)}'`,
      );
      const current = page.locator("[data-bone=capitate][aria-current=true]");
      await current.waitFor();
    });
    await check(page, "keys move, measure and open the help", async () => {
      await page.locator(".scan-panel.coronal canvas").focus();
      const before = await reading(page);
      await page.keyboard.press("Shift+ArrowRight");
      await page.waitForFunction(
        (was) => document.querySelector(".scan-reading").textContent !== was,
        before,
      );
      await page.keyboard.press("m");
      await page.keyboard.press("Enter");
      for (let i = 0; i < 2; ++i) await page.keyboard.press("Shift+ArrowDown");
      await page.keyboard.press("Enter");
      await page
        .locator(".scan-said", { hasText: "Distance 6.0 mm" })
        .waitFor();
      await page.keyboard.press("?");
      await page.locator("dialog.scan-help[open]").waitFor();
      await expectAccessible(page);
      await page.keyboard.press("Escape");
    });
    await check(
      page,
      "what is read stays with the pointer, and goes with the keys",
      async () => {
        await page.locator("[data-bone=capitate]").click();
        await page.locator(".scan-reading", { hasText: "Capitate" }).waitFor();
        const canvas = page.locator(".scan-panel.axial canvas");
        const atCross = await reading(page);
        await canvas.hover({ position: { x: 8, y: 60 } });
        const atPointer = await reading(page);
        expect(atPointer !== atCross, `both read '${atCross}'`);
        await page.keyboard.press("o");
        await drawn(page);
        expect((await reading(page)) === atPointer, "a picture drawn anew took it away");
        await page.keyboard.press("o");
        await canvas.focus();
        await page.keyboard.press("ArrowRight");
        await page.locator(".scan-reading", { hasText: "Capitate" }).waitFor();
        await page.locator(".scan-heading h1").hover();
      },
    );
    await check(page, "a bone is painted, taken back, and saved", async () => {
      await page.locator("[data-bone=capitate]").click();
      await page.keyboard.press("Escape");
      await page.locator(".scan-panel.axial canvas").focus();
      await page.keyboard.press("e");
      await page.keyboard.press("Enter");
      await page.locator(".scan-reading", { hasText: "no bone" }).waitFor();
      await page.keyboard.press("z");
      await page.locator(".scan-reading", { hasText: "Capitate" }).waitFor();
      await page.keyboard.press("y");
      await page.locator(".scan-reading", { hasText: "no bone" }).waitFor();
      const saved = page.waitForEvent("download");
      await page.keyboard.press("s");
      const file = gunzipSync(readFileSync(await (await saved).path()));
      const before = gunzipSync(
        readFileSync(join(station.caseFolder, "labels.nii.gz")),
      );
      let erased = 0;
      for (let i = 352; i < before.length; ++i)
        if (before[i] === 9 && file[i] === 0) ++erased;
      expect(file.length === before.length, "it is of another length");
      expect(erased > 20, `${erased} voxels were erased`);
    });
    await check(
      page,
      "what was erased is moved, by keys and by hand",
      async () => {
        const reads = (what) =>
          page.locator(".scan-reading", { hasText: what }).waitFor();
        await page.keyboard.press("Shift+ArrowDown");
        await reads("Capitate");
        await page.keyboard.press("v");
        await page.locator(".scan-said", { hasText: "painted last" }).waitFor();
        await page.keyboard.press("Enter");
        await reads("no bone");
        await page.keyboard.press("Shift+ArrowUp");
        await reads("Capitate");
        await page.keyboard.press("Shift+ArrowDown");
        await reads("no bone");
        const canvas = page.locator(".scan-panel.axial canvas");
        const box = await canvas.boundingBox();
        const [x, y] = [box.x + box.width / 2, box.y + box.height / 2];
        await page.mouse.move(x, y);
        await page.mouse.down();
        await page.mouse.move(x + 90, y, { steps: 4 });
        await page.mouse.up();
        await page.locator(".scan-heading h1").hover();
        await reads("Capitate");
        await page.keyboard.press("z");
        await reads("no bone");
        await page.keyboard.press("z");
        await reads("Capitate");
        await page.keyboard.press("v");
      },
    );
    const began = Date.now();
    await mendsScan(page, station);
    console.log(`     mended in ${((Date.now() - began) / 1000).toFixed(1)} s`);
    await check(page, "nothing went wrong on the scan's page", () => {
      expect(problems.length === 0, problems.join(" | "));
    });
  }
  await page.close();
}
