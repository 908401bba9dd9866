// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A force-feedback arm in a hand: chosen in the page, felt at a wall, unplugged while one drills, plugged
// in again. The arm is simulated; the station opens it as any other.
import { expectAccessible } from "./accessibility.mjs";
import { newPage } from "./browser.mjs";
import { check, expect } from "./checks.mjs";
import { atRest } from "./hands.mjs";
import { Operator } from "./operator.mjs";

const TRAINEE = "Browser test, devices";

/** Looks ten times a second until it is so. */
async function within(page, what, is, seconds = 30) {
  const until = Date.now() + 1000 * seconds;
  while (!(await is())) {
    expect(Date.now() < until, `no ${what}`);
    await page.waitForTimeout(100);
  }
}

export async function holdsDevices(browser, station) {
  const page = await newPage(browser);
  const operator = new Operator(page);
  const card = page.locator("section.device").first();
  const held = page.locator(".top-bar .device-held");
  let arm = await station.plugIn();
  await check(
    page,
    "an arm is chosen for a hand, and its figures are shown",
    async () => {
      await operator.start(station.url, TRAINEE, "dorsal_scaphoid_fixation");
      await atRest(operator);
      await held.click();
      await page.locator("dialog.devices[open]").waitFor();
      await operator.until((s) => s.paused, "time that stands still");
      const choice = page.locator("#device-0");
      await choice
        .locator("option", { hasText: "arm_b_7" })
        .waitFor({ state: "attached" });
      await choice.selectOption({ label: "Simulated arm arm_b_7" });
      await card.locator(".device-words.well", { hasText: "good" }).waitFor();
      await card.locator("dd", { hasText: /^\d+ Hz$/ }).waitFor();
      const aim = card.getByLabel("Direction");
      expect(
        (await aim.locator("option:checked").textContent()) ===
          "points from the portal",
        "the arm does not point from the portal",
      );
      await card
        .locator("dd", { hasText: /^[\d.]+ (µs|ms)$/ })
        .first()
        .waitFor();
      await expectAccessible(page, 4);
    },
  );
  await check(page, "a test wall is felt, and the meter shows it", async () => {
    const wall = card.getByRole("button", { name: "Feel a test wall" });
    const meter = card.locator("meter");
    const place = card.locator("dt", { hasText: "Place" }).locator("+ dd");
    const height = async () =>
      Number((await place.textContent()).split(",")[2].replace(" mm", ""));
    // The simulated hand goes 12 mm down and up in five seconds; the wall stands 5 mm below where it is
    // when it is asked for: high up, it meets it within those.
    await within(page, "a hand that is high up", async () => {
      return (await height()) > -2;
    });
    await wall.click();
    await within(page, "a wall that is felt", async () =>
      meter.evaluate((one) => one.value > 0.2),
    );
    const arrow = card.locator(".device-dial .arrow");
    await within(page, "an arrow that points up", async () =>
      /^M0 0L-?[\d.]+ -\d/.test(await arrow.getAttribute("d")),
    );
    if (process.env.CARPUS_PICTURE)
      await page.screenshot({ path: process.env.CARPUS_PICTURE });
    await card.getByRole("button", { name: "Feel a test wall" }).click();
    await page.keyboard.press("Escape");
    await operator.until((s) => !s.paused, "time that goes on");
    expect(
      (await held.textContent()).includes("good"),
      "the bar does not say what is held",
    );
  });
  await check(
    page,
    "the arm moves the tip; unplugged mid-drill, time stops and nothing is lost",
    async () => {
      const first = Operator.held(await operator.snapshot()).tip_mm.join();
      // A simulated arm that the machine leaves alone for 50 ms is silent, as a real one would be.
      await within(page, "tip that moves", async () => {
        const now = await operator.snapshot();
        if (now.paused) await page.keyboard.press("p");
        return !now.paused && Operator.held(now).tip_mm.join() !== first;
      });
      await page.keyboard.down("Space");
      await page.waitForTimeout(300);
      await arm.unplug();
      const paused = await operator.until(
        (s) => s.paused,
        "time that stands still",
      );
      await page.keyboard.up("Space");
      await page.locator(".paused", { hasText: "unplugged" }).waitFor();
      await page.waitForTimeout(500);
      const later = await operator.snapshot();
      expect(later.tick === paused.tick, "time passed on");
      expect(
        later.items.length === paused.items.length,
        "an instrument is lost",
      );
      await held.filter({ hasText: "unplugged" }).waitFor();
      if (process.env.CARPUS_PICTURE)
        await page.screenshot({
          path: process.env.CARPUS_PICTURE.replace(".png", "_unplugged.png"),
        });
    },
  );
  await check(page, "plugged in again, the operation goes on", async () => {
    const { tick } = await operator.snapshot();
    arm = await station.plugIn();
    await held.filter({ hasText: "good" }).waitFor();
    await page.keyboard.press("p");
    await operator.until(
      (s) => !s.paused && s.tick > tick + 50,
      "time that goes on",
    );
    await held.click();
    await page.locator("#device-0").selectOption("");
    await page.keyboard.press("Escape");
    await held.filter({ hasText: "mouse and keys" }).waitFor();
    await operator.until((s) => !s.paused, "time that goes on");
  });
  await arm.unplug();
  await page.close();
}
