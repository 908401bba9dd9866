// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// An operation with a headset: one that the Immersive Web Emulation Runtime makes, moved and pressed here.
import { createRequire } from "node:module";
import { dirname, join } from "node:path";
import { newPage } from "./browser.mjs";
import { check, expect } from "./checks.mjs";
import { cross, dot, Operator, readAxis } from "./operator.mjs";
import { root } from "./station.mjs";

/** From the controller to the tip: web/src/headset/tool_in_hand.ts [m]. */
const REACH_M = 0.12;
const plus = (a, b, f = 1) => a.map((v, i) => v + f * b[i]);
const unit = (a) => a.map((v) => v / Math.hypot(...a));

/** Quaternion [x, y, z, w] whose Z axis lies along `back`. */
function aimed(back) {
  const x = unit(cross(Math.abs(back[1]) > 0.9 ? [0, 0, 1] : [0, 1, 0], back));
  const y = cross(back, x);
  const [m, w] = [[x, y, back], 1 + x[0] + y[1] + back[2]];
  const k = [m[1][2] - m[2][1], m[2][0] - m[0][2], m[0][1] - m[1][0]];
  if (w > 1e-6) {
    const s = 0.5 / Math.sqrt(w);
    return [...k.map((v) => v * s), 0.25 / s];
  }
  return [1, 0, 0, 0];
}

class Wearer {
  constructor(page, operator) {
    this.page = page;
    this.operator = operator;
  }

  shown() {
    return this.page.evaluate(() => {
      const shown = window.carpus?.headset();
      return shown && { text: shown.text, enlarged: shown.enlarged };
    });
  }

  async until(holds, what) {
    for (const end = Date.now() + 60_000; Date.now() < end; ) {
      const shown = await this.shown();
      if (holds(shown)) return shown;
      await this.page.waitForTimeout(50);
    }
    throw new Error(`waited in vain for: ${what}; ${JSON.stringify(await this.shown())}`);
  }

  roomPoint(mm) {
    return this.page.evaluate((at) => window.carpus.headset().roomPoint(at), mm);
  }

  /** Holds the right controller so that its tip lies at `tipMm`, its shaft along `shaft` (Patient). */
  async hold(tipMm, shaft) {
    const tip = await this.roomPoint(tipMm);
    const back = unit(plus(await this.roomPoint(plus(tipMm, shaft, 10)), tip, -1));
    await this.page.evaluate(
      ([at, q]) => {
        const { position, quaternion } = window.headset.controllers.right;
        position.set(...at);
        quaternion.set(...q);
      },
      [plus(tip, back, REACH_M), aimed(back)],
    );
  }

  async press(side, button, value = 1) {
    await this.page.evaluate(
      ([which, name, to]) => {
        window.headset.controllers[which].updateButtonValue(name, to);
      },
      [side, button, value],
    );
  }

  async tap(side, button) {
    await this.press(side, button);
    await this.operator.settle(3);
    await this.press(side, button, 0);
    await this.operator.settle(3);
  }
}

export async function wearsHeadset(browser, station) {
  // Both eyes are drawn into the page's canvas, by the processor: a small one will do.
  const page = await newPage(browser, { viewport: { width: 640, height: 480 } });
  const iwer = createRequire(join(root, "web/package.json")).resolve("iwer");
  await page.addInitScript({ path: join(dirname(iwer), "../build/iwer.min.js") });
  await page.addInitScript(() => {
    window.headset = new window.IWER.XRDevice(window.IWER.metaQuest3);
    window.headset.installRuntime({ forceInstall: true });
  });
  const operator = new Operator(page);
  const wearer = new Wearer(page, operator);
  const button = page.getByRole("button", { name: "Headset", exact: true });
  const worn = await check(page, "a headset is put on, and says what is to be done", async () => {
    await operator.start(station.url, "Browser test, headset", "dorsal_scaphoid_fixation", "practice");
    await button.click();
    const { steps } = await operator.exercise();
    await wearer.until((s) => s?.text.startsWith(steps[0].title), "the first step's words");
  });
  if (!worn) return page.close();
  const axis = await operator.axisNow(readAxis(station.caseFolder));
  await check(page, "a controller is the instrument, life-size, then enlarged", async () => {
    const above = plus(axis.entry, axis.toHand, 40);
    await wearer.hold(above, axis.toHand);
    const near = (s, mm) => Math.hypot(...plus(Operator.held(s).tip_mm, mm, -1)) < 0.5;
    // The hand follows over some ticks: the shaft may come to rest after the tip.
    const along = (s) => dot(Operator.held(s).shaft, axis.toHand) > 0.9999;
    const there = (s) => near(s, above) && along(s);
    await operator.until(there, "tip and shaft where the hand is");
    await page.evaluate(() => {
      window.headset.controllers.right.position.y += 0.01;
    });
    const moved = (now) => Math.hypot(...plus(Operator.held(now).tip_mm, above, -1));
    await operator.until((now) => Math.abs(moved(now) - 10) < 0.5, "10 mm of the hand as 10 mm");
    await page.evaluate(() => window.headset.controllers.left.updateAxes("thumbstick", 0, -1));
    await wearer.until((now) => now.enlarged > 1.9, "twice the size");
    await page.evaluate(() => window.headset.controllers.left.updateAxes("thumbstick", 0, 0));
    await wearer.hold(above, axis.toHand);
    await operator.until(there, "tip and shaft where the hand is, enlarged");
  });
  await check(page, "A takes a picture, Y stops time, the trigger is the pedal", async () => {
    const { shots } = await operator.snapshot();
    await wearer.tap("right", "a-button");
    await operator.until((s) => s.shots > shots, "a picture");
    await wearer.press("left", "trigger");
    const live = (await operator.snapshot()).dose_cgy_cm2;
    await operator.until((s) => s.dose_cgy_cm2 > live, "live X-ray");
    await wearer.press("left", "trigger", 0);
    await wearer.tap("left", "y-button");
    await operator.until((s) => s.paused, "time that stands still");
    await wearer.until((s) => s.text.includes("Time stands still"), "the words for it");
    await wearer.tap("left", "y-button");
    await operator.until((s) => !s.paused, "time that goes on");
  });
  await check(page, "the trigger drives the wire in, the grip draws it out", async () => {
    await wearer.press("right", "trigger");
    await wearer.until((s) => s.text.includes("no bone: lead it onto the bone"), "words without keys");
    await wearer.press("right", "trigger", 0);
    await wearer.hold(plus(axis.entry, axis.toHand, -0.2), axis.toHand);
    await operator.until((s) => s.hands[0].touching, "the tip on the bone");
    await wearer.press("right", "trigger");
    await operator.until((s) => Operator.held(s).depth_mm > 6, "6 mm of bone");
    await wearer.press("right", "trigger", 0);
    await wearer.hold(plus(axis.entry, axis.toHand, 60), axis.toHand);
    await operator.settle(4);
    expect(Operator.held(await operator.snapshot()).depth_mm > 5, "the hand pulled it out of bone");
    await wearer.press("right", "squeeze");
    await operator.until((s) => Operator.held(s).body === "", "the wire out");
    await wearer.press("right", "squeeze", 0);
    const far = plus(axis.entry, axis.toHand, 60);
    const off = (s) => Math.hypot(...plus(Operator.held(s).tip_mm, far, -1));
    await operator.until((s) => off(s) < 0.5, "the wire in the hand again");
  });
  await check(page, "the stick chooses another instrument and takes it", async () => {
    const before = Operator.held(await operator.snapshot()).instrument;
    await page.evaluate(() => window.headset.controllers.right.updateAxes("thumbstick", 1, 0));
    await operator.settle(3);
    await page.evaluate(() => window.headset.controllers.right.updateAxes("thumbstick", 0, 0));
    await operator.settle(3);
    await wearer.tap("right", "thumbstick");
    await operator.until((s) => Operator.held(s)?.instrument !== before, "another in the hand");
  });
  await check(page, "the other grip and its stick flex the wrist, X supinates it", async () => {
    const { wrist } = await operator.snapshot();
    await wearer.press("left", "squeeze");
    await page.evaluate(() => window.headset.controllers.left.updateAxes("thumbstick", 0, 1));
    await operator.until((s) => s.wrist.flexion_deg > wrist.flexion_deg + 4, "a flexed wrist");
    await page.evaluate(() => window.headset.controllers.left.updateAxes("thumbstick", 0, -1));
    await operator.until((s) => s.wrist.flexion_deg < wrist.flexion_deg + 1, "it extended again");
    await page.evaluate(() => window.headset.controllers.left.updateAxes("thumbstick", 0, 0));
    await wearer.press("left", "x-button");
    await operator.until((s) => s.wrist.pronation_deg < wrist.pronation_deg - 2, "a supinated one");
    await wearer.press("left", "x-button", 0);
    await wearer.press("left", "y-button");
    await operator.until((s) => s.wrist.pronation_deg > wrist.pronation_deg - 1, "and back");
    await wearer.press("left", "y-button", 0);
    await wearer.press("left", "squeeze", 0);
    expect(!(await operator.snapshot()).paused, "the clock was stopped");
  });
  await check(page, "taken off, the page goes on by mouse and keys", async () => {
    // The emulated eyes' canvas lies over the page.
    await button.dispatchEvent("click");
    await wearer.until((s) => s === undefined, "a headset that is off");
    const before = (await operator.snapshot()).wrist.flexion_deg;
    for (let tap = 0; tap < 4; ++tap) await operator.tap("KeyJ");
    await operator.until((s) => s.wrist.flexion_deg > before + 2, "a wrist that moves by key");
  });
  await check(page, "an arthroscopy, whose picture a headset does not show, is not begun with one", async () => {
    await operator.start(station.url, "Browser test, headset", "diagnostic_arthroscopy", "practice");
    await page.locator('button[aria-disabled="true"]', { hasText: "Headset" }).waitFor();
    await button.dispatchEvent("click"); // one that is disabled is not clicked
    await page.locator(".notice", { hasText: "led at the page" }).waitFor();
    expect((await wearer.shown()) === undefined, "it was put on");
  });
  await page.close();
}
