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
      const choice = card.locator("select");
      await choice
        .locator("option", { hasText: "arm_b_7" })
        .waitFor({ state: "attached" });
      await choice.selectOption({ label: "Simulated arm arm_b_7" });
      await card.locator(".device-words.well", { hasText: "good" }).waitFor();
      await card.locator("dd", { hasText: /^\d+ Hz$/ }).waitFor();
      await card
        .locator("dd", { hasText: /^[\d.]+ (µs|ms)$/ })
        .first()
        .waitFor();
      await expectAccessible(page, 4);
    },
  );
  await check(page, "a test wall is felt, and the meter shows it", async () => {
    const wall = card.getByRole("button", { name: "Feel a test wall" });
    const pressed = async (is) =>
      card
        .locator(`button[aria-pressed="${is}"]`, { hasText: "Feel" })
        .waitFor();
    const meter = card.locator("meter");
    const felt = async () => meter.evaluate((one) => one.value > 0.2);
    // The wall stands 5 mm below where the hand is when it is asked for; the simulated hand moves by
    // itself, and may be at its lowest then.
    await wall.click();
    await pressed(true);
    const until = Date.now() + 150_000;
    for (let look = 1; !(await felt()); ++look) {
      expect(Date.now() < until, "nothing was felt");
      await page.waitForTimeout(50);
      if (look % 60 !== 0) continue;
      await wall.click();
      await pressed(false);
      await page.waitForTimeout(700);
      await wall.click();
      await pressed(true);
    }
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
      await operator.until(
        (s) => Operator.held(s).tip_mm.join() !== first,
        "a tip that moves",
      );
      await page.keyboard.down("Space");
      await page.waitForTimeout(300);
      await arm.unplug();
      const paused = await operator.until(
        (s) => s.paused,
        "time that stands still",
      );
      await page.keyboard.up("Space");
      // Where the machine is slow to close its line, it is silent first.
      await page.locator(".paused", { hasText: /unplugged|silent/ }).waitFor();
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
    await card.locator("select").selectOption("");
    await page.keyboard.press("Escape");
    await held.filter({ hasText: "mouse and keys" }).waitFor();
    await operator.until((s) => !s.paused, "time that goes on");
  });
  await arm.unplug();
  await page.close();
}
