// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// One whole operation by touch alone, from the start dialog to the printed report: fingers turn and push
// the wire, hold Drive and Reverse, tap pictures, tray, screw and finish. No key, no mouse.
import { newTouchPage } from "./browser.mjs";
import { check, expect } from "./checks.mjs";
import { Fingers } from "./fingers.mjs";
import { atRest } from "./hands.mjs";
import { dot, Operator, readAxis } from "./operator.mjs";
import { printedPages } from "./report.mjs";

const TRAINEE = "Browser test, touch";
/** Degrees that one pixel of a finger turns the shaft (web/README.md). */
const DEG_PER_PX = 0.25;
const MOST_PX = 160;
/** A finger that goes less far does not mean it [CSS px]; one that does may come back nearer. */
const MEANT_PX = 10;
const WITHIN_DEG = 1;
const WITHIN_PX = 1.5;

class Toucher {
  constructor(page) {
    this.page = page;
    this.operator = new Operator(page);
    this.fingers = new Fingers(page);
  }

  button(name) {
    return this.page.getByRole("button", { name, exact: true });
  }

  async tap(name) {
    await this.button(name).tap();
    await this.operator.settle();
  }

  held() {
    return this.operator.snapshot().then((s) => Operator.held(s));
  }

  async middle() {
    const box = await this.page.locator(".stage canvas").first().boundingBox();
    return { x: box.x + box.width / 2, y: box.y + box.height / 2 };
  }

  /** One finger from the middle by so much; farther, and back, where that is too little to be meant. */
  async slide(dx, dy) {
    const from = await this.middle();
    const way = { from, to: { x: from.x + dx, y: from.y + dy } };
    if (Math.hypot(dx, dy) < MEANT_PX) way.over = { x: from.x + dx + 2 * MEANT_PX, y: from.y + dy };
    await this.fingers.slide([way], way.over === undefined ? 8 : 12);
    await this.operator.settle();
    await this.page.waitForTimeout(500);
  }

  async start(url) {
    const { page } = this;
    await page.goto(url);
    await this.operator.freeSeat();
    await page.locator("input[name=procedure][value=volar_scaphoid_fixation]").tap();
    await page.locator("input[name=mode][value=practice]").tap();
    await page.fill("#trainee-name", TRAINEE); // as a keyboard on the screen would
    await page.locator("dialog.start button[type=submit]").tap();
    await this.operator.until((s) => s.tick > 0 && !s.paused, "the first ticks");
    await atRest(this.operator);
  }

  async shot(name) {
    const { shots } = await this.operator.snapshot();
    await this.page.locator(".c-arm-views button", { hasText: name }).first().tap();
    await this.operator.until((s) => s.shots > shots, `a picture ${name}`);
  }

  /** The shaft along `toHand`, by a finger, seen from two sides. @return degrees that it is off */
  async turnShaft(toHand) {
    let angle = 180;
    await this.tap("Shaft");
    for (const side of ["Radial", "Dorsal", "Radial", "Dorsal"]) {
      await this.tap(side);
      for (let round = 0; round < 4; ++round) {
        const { shaft } = await this.held();
        angle = (180 / Math.PI) * Math.acos(Math.min(1, dot(shaft, toHand)));
        const { right, up } = await this.page.evaluate(() => window.carpus.screenAxes());
        const wanted = toHand.map((v, i) => v - dot(toHand, shaft) * shaft[i]);
        const across = [dot(wanted, right), dot(wanted, up)];
        const size = Math.hypot(...across);
        const px = ((180 / Math.PI) * Math.asin(Math.min(1, size))) / DEG_PER_PX;
        if (angle < WITHIN_DEG || px < WITHIN_PX) break;
        const way = Math.min(MOST_PX, px) / size;
        await this.slide(way * across[0], -way * across[1]);
      }
      if (angle < WITHIN_DEG) break;
    }
    return angle;
  }

  /** The tip onto what is shown at `pointMm`: a finger beside it pushes it along. */
  async pushTip(pointMm) {
    await this.tap("Tip");
    for (let round = 0; round < 6; ++round) {
      const { tip_mm: tip } = await this.held();
      const [a, b] = await this.page.evaluate(
        (points) => points.map((mm) => window.carpus.pagePoint(mm)),
        [tip, pointMm],
      );
      const [dx, dy] = [b.x - a.x, b.y - a.y];
      const isThere = Math.hypot(dx, dy) < WITHIN_PX;
      if (isThere && (await this.operator.snapshot()).hands[0].touching) return;
      await this.slide(dx, dy);
    }
  }

  /** The push's slider, tapped where it stands for so much [N]. */
  async push(newtons) {
    const slider = this.page.locator("#push");
    const box = await slider.boundingBox();
    const most = Number(await slider.getAttribute("max"));
    await slider.tap({
      position: { x: Math.min(box.width - 4, Math.max(4, (newtons / most) * box.width)), y: box.height / 2 },
    });
  }

  async holdUntil(name, holds, what) {
    await this.fingers.hold(this.button(name), () => this.operator.until(holds, what));
    await this.operator.settle();
  }

  /** By short holds of Drive, lightly once the cortex is passed, with more where it stops. */
  async driveTo(reached, what) {
    let push = 0;
    let last = -1;
    for (let turn = 0; turn < 200; ++turn) {
      const item = await this.held();
      if (reached(item)) return;
      const isIn = item.body !== "" || item.wire >= 0;
      const wanted = !isIn ? 40 : item.depth_mm - last < 0.1 ? Math.min(58, push + 4) : Math.min(push, 24);
      if (wanted !== push) await this.push((push = wanted));
      last = item.depth_mm;
      await this.fingers.hold(this.button("Drive"), () => this.page.waitForTimeout(60));
    }
    throw new Error(`in vain: ${what}`);
  }

  async take(id) {
    await this.tap("Tray");
    await this.page.locator(`dialog.tray input[value=${id}]`).tap();
    await this.page.locator("dialog.tray button[type=submit]").tap();
    await this.operator.until((s) => Operator.held(s)?.instrument === id, `${id} in the hand`);
  }
}

export async function operateByTouch(browser, station) {
  const page = await newTouchPage(browser);
  const touch = new Toucher(page);
  const { operator } = touch;
  const axis = readAxis(station.caseFolder, "distal");
  const placed = await check(page, "fingers alone lay a wire onto the bone, along its axis", async () => {
    await touch.start(station.url);
    for (const view of ["PA", "LAT"]) await touch.shot(view);
    const { entry, toHand } = await operator.axisNow(axis);
    const angle = await touch.turnShaft(toHand);
    expect(angle < 2, `the shaft is ${angle.toFixed(1)} degrees off`);
    await touch.tap("Along shaft");
    await touch.pushTip(entry);
    await operator.until((s) => s.hands[0].touching, "the tip touches");
  });
  if (!placed) return page.close();
  const fixed = await check(page, "fingers drive, measure, ream, and put the screw in", async () => {
    await touch.driveTo((wire) => wire.body !== "" && wire.depth_mm >= axis.lengthMm - 3, "the wire in the bone");
    for (const view of ["PA", "LAT", "45P"]) await touch.shot(view);
    await touch.tap("Measure");
    await operator.until((s) => s.gauge_reading_mm > 0, "a reading");
    await operator.until((s) => s.hands[1].item < 0, "the gauge put down");
    await touch.take("cannulated_drill");
    await touch.driveTo((drill) => drill.depth_mm >= axis.lengthMm - 4, "the drill's depth");
    await touch.holdUntil("Reverse", (s) => Operator.held(s)?.instrument !== "cannulated_drill", "the drill out");
    await touch.take((await operator.fittingScrew()).id);
    await touch.driveTo((screw) => screw.buried_mm >= 1.5, "the screw buried");
    await touch.tap("Put down");
    await operator.until((s) => s.hands[0].item < 0, "an empty hand");
    await touch.tap("Take hold");
    await operator.until((s) => Operator.held(s)?.instrument === "guide_wire", "the wire in the hand");
    await touch.holdUntil("Reverse", (s) => Operator.held(s)?.body === "", "the wire out");
  });
  if (!fixed) return page.close();
  await check(page, "finished by a tap, the report tells and prints", async () => {
    for (const view of ["PA", "LAT", "45P", "SKY"]) await touch.shot(view);
    await touch.tap("Finish");
    await page.locator("dialog.confirm[open] button.primary").tap();
    await page.locator(".score-table tbody tr").first().waitFor();
    const overall = Number(await page.textContent(".overall strong"));
    const unmet = await page.locator(".must-haves li", { hasText: /not fulfilled|not judged/ }).allTextContents();
    expect(overall > 0, `${overall} points; not fulfilled: ${unmet.join("; ")}`);
    await page.locator(".placement canvas").first().waitFor();
    const pages = await printedPages(page);
    expect(pages === 2, `${pages} pages`);
  });
  await page.close();
}
