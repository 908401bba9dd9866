// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A picture whose graphics context is lost says so, and looks as before once it has it again.
import { expect } from "./checks.mjs";
import { pixelsOf } from "./pixels.mjs";

const PATIENCE_MS = 10_000;
/** Of 255: smoothed edges alone, which not every context draws alike, were 1.5 off; another ground behind them 12. */
const MOST_APART = 4;

/** How far two pictures of one size are apart, the mean of all pixels' colours, of 255. */
async function apart(page, one, other) {
  const [a, b] = [(await pixelsOf(page, one)).data, (await pixelsOf(page, other)).data];
  return a.reduce((sum, value, i) => sum + Math.abs(value - b[i]), 0) / a.length;
}

/** @param around  of the picture: its canvas, and what is said over it */
export async function losesGraphics(page, around) {
  const picture = page.locator(around);
  const said = picture.locator(".lost-picture");
  const before = await picture.screenshot();
  const lose = await picture
    .locator("canvas")
    .first()
    .evaluateHandle((canvas) => canvas.getContext("webgl2").getExtension("WEBGL_lose_context"));
  await lose.evaluate((it) => it.loseContext());
  await said.waitFor({ state: "visible" });
  await lose.evaluate((it) => it.restoreContext());
  await said.waitFor({ state: "hidden" });
  const end = Date.now() + PATIENCE_MS;
  for (;;) {
    const off = await apart(page, before, await picture.screenshot());
    if (off < MOST_APART) return;
    expect(Date.now() < end, `once it has its graphics again it is ${off.toFixed(2)} of 255 off`);
    await page.waitForTimeout(100);
  }
}
