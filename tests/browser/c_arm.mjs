// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What one does with pictures: enlarge them, keep one beside, measure on one, save one, see the beam.
import { readFileSync } from "node:fs";
import { newPage } from "./browser.mjs";
import { check, expect } from "./checks.mjs";
import { atRest } from "./hands.mjs";
import { Operator } from "./operator.mjs";

export async function withPictures(browser, station) {
  const page = await newPage(browser);
  const operator = new Operator(page);
  const main = page.locator("canvas.c-arm-picture");
  await check(page, "the picture takes the theatre's place and gives it back", async () => {
    await operator.start(station.url, "Browser test, pictures");
    await atRest(operator);
    await operator.shot("1");
    const before = await main.boundingBox();
    const stage = await page.locator(".stage").boundingBox();
    await page.keyboard.press("7");
    await page.locator(".train.enlarged").waitFor();
    await operator.settle();
    const large = await main.boundingBox();
    const bottom = await page.locator(".bottom-bar").boundingBox();
    expect(
      large.width > 1.25 * before.width &&
        Math.abs(large.width - large.height) < 2 &&
        large.y + large.height < bottom.y,
      `it is ${JSON.stringify(large)}, was ${JSON.stringify(before)}`,
    );
    const small = await page.locator(".stage").boundingBox();
    expect(small.width > 200 && small.height > 150, `${JSON.stringify(small)}`);
    await page.keyboard.press("Escape");
    await page.locator(".train:not(.enlarged)").waitFor();
    const again = await page.locator(".stage").boundingBox();
    expect(again.width === stage.width, "the theatre is not as before");
  });
  await check(page, "a kept picture stays on the second monitor", async () => {
    const second = page.locator(".c-arm-reference");
    expect(!(await second.isVisible()), "it is there before anything was kept");
    await page.keyboard.press("8");
    await second.locator("header", { hasText: "PA, shot 1" }).waitFor();
    await operator.shot("2");
    await second.locator("header", { hasText: "PA, shot 1" }).waitFor();
    await page.locator(".c-arm > header", { hasText: "LAT, shot 2" }).waitFor();
  });
  await check(page, "the ruler tells millimetres at the isocentre", async () => {
    await page.getByRole("button", { name: "Ruler" }).click();
    await main.scrollIntoViewIfNeeded();
    const box = await main.boundingBox();
    const bare = await operator.picture();
    for (const share of [0.25, 0.75])
      await page.mouse.click(box.x + share * box.width, box.y + box.height / 2);
    await operator.settle();
    const ruled = await operator.picture();
    expect(ruled.mean !== bare.mean, "nothing is drawn on the picture");
    const notice = await page.textContent(".c-arm-ruled");
    expect(
      /^3[12]\.\d mm at the isocentre$/.test(notice),
      `half of a field of 64 mm is '${notice}'`,
    );
  });
  await check(page, "a picture is saved as a PNG with its text", async () => {
    const [download] = await Promise.all([
      page.waitForEvent("download"),
      page.getByRole("button", { name: "Save" }).click(),
    ]);
    const name = download.suggestedFilename();
    expect(/_shot_2_LAT\.png$/.test(name), `it is called ${name}`);
    const file = readFileSync(await download.path());
    expect(file.subarray(1, 4).toString() === "PNG", "it is no PNG file");
    expect(file.readUInt32BE(16) === 1024, "it has another size");
  });
  await check(page, "the beam is drawn on request", async () => {
    const shown = () => page.evaluate(() => window.carpus.beamIsDrawn());
    await page.waitForTimeout(2600);
    await operator.settle();
    expect(!(await shown()), "it is there though the C-arm rests");
    await page.keyboard.press("Semicolon");
    await operator.settle();
    expect(await shown(), "it is not there");
    await page.keyboard.press("Semicolon");
    await operator.settle();
    expect(!(await shown()), "it stays");
    await page.keyboard.press("Period");
    await operator.until((s) => Math.abs(s.c_arm.rotation_deg) > 1, "a turn");
    await operator.settle();
    expect(await shown(), "it is not there while the C-arm moves");
  });
  await page.close();
}
