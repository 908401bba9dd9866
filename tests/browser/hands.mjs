// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Other hands than those with a mouse: keys alone, and fingers on a screen. A wire is brought to the bone
// and driven into it by nothing else.
import { newPage, newTouchPage } from "./browser.mjs";
import { check, expect } from "./checks.mjs";
import { Fingers } from "./fingers.mjs";
import { dot, Operator } from "./operator.mjs";

const TRAINEE = "Browser test, hands";
/** Within it someone who knows the keys has a wire in the bone [s]; a machine draws slowly. */
const KEYS_ALONE_S = 60;

/** The hand has come to where an operation begins. */
export async function atRest(operator) {
  // What is seen first may be the operation before.
  await operator.page.waitForTimeout(500);
  let last;
  await operator.until((s) => {
    const tip = Operator.held(s)?.tip_mm.join();
    const rests = tip !== undefined && tip === last;
    last = tip;
    return rests && !s.paused && s.tick > 1000;
  }, "the hand at rest");
}

/** Begins a practice whose wrist is pulled at by 45 N. */
export async function underTraction(operator, url, trainee, procedure) {
  await operator.start(url, trainee, procedure, "practice");
  await atRest(operator);
  const pull = operator.page.locator("#wrist-traction_n");
  await pull.fill("45");
  await pull.blur(); // as a mouse leaves it: the keys are the hand's again
  await operator.until((s) => s.wrist.traction_n >= 44, "traction");
}

async function inBone(operator, mm) {
  return operator.until((s) => {
    const item = Operator.held(s);
    return item.body !== "" && item.depth_mm >= mm;
  }, `${mm} mm of wire in bone`);
}

export async function byKeysAlone(browser, station) {
  const page = await newPage(browser);
  const operator = new Operator(page);
  await check(page, "keys alone aim and drive a wire, soon", async () => {
    await operator.start(station.url, TRAINEE, "dorsal_scaphoid_fixation");
    await atRest(operator);
    const began = Date.now();
    await page.keyboard.press("Enter");
    await operator.until((s) => s.hands[0].touching, "the tip on the bone");
    const { right, up } = await page.evaluate(() => window.carpus.screenAxes());
    const { shaft } = Operator.held(await operator.snapshot());
    expect(
      Math.abs(dot(shaft, right)) < 0.02 && Math.abs(dot(shaft, up)) < 0.02,
      `the shaft is not along the sight but ${shaft}`,
    );
    // With the push that the hand begins with.
    await page.keyboard.down("Space");
    await inBone(operator, 1);
    await page.keyboard.up("Space");
    const took = (Date.now() - began) / 1000;
    expect(took < KEYS_ALONE_S, `it took ${took.toFixed(0)} s`);
  });
  await check(page, "coarse steps are ten times the fine ones", async () => {
    await page.keyboard.press("z");
    await operator.until((s) => Operator.held(s)?.body === "", "the wire free");
    const moved = async () => {
      const before = Operator.held(await operator.snapshot()).tip_mm;
      await operator.tap("KeyD");
      await page.waitForTimeout(600);
      const { tip_mm: now } = Operator.held(await operator.snapshot());
      return Math.hypot(...now.map((v, i) => v - before[i]));
    };
    await moved(); // off the bone
    const fine = await moved();
    await page.keyboard.press("y");
    const coarse = await moved();
    expect(
      Math.abs(fine - 0.1) < 0.05 && Math.abs(coarse - 1) < 0.1,
      `a fine step is ${fine.toFixed(2)} mm, a coarse one ${coarse.toFixed(2)} mm`,
    );
  });
  await check(
    page,
    "keys are named as a German keyboard has them",
    async () => {
      for (const [code, key] of [
        ["BracketRight", "+"],
        ["KeyZ", "y"],
      ])
        await page.evaluate(
          (init) =>
            document.activeElement.dispatchEvent(
              new KeyboardEvent("keydown", { ...init, bubbles: true }),
            ),
          { code, key },
        );
      const undo = page.locator(".ways button", { hasText: "Undo" });
      expect(
        (await undo.getAttribute("aria-keyshortcuts")) === "Y",
        "Undo has another key",
      );
      await page.keyboard.press("F1");
      await page
        .locator("dialog.help kbd", { hasText: "[ / +, 9 / 0" })
        .waitFor();
      await page.keyboard.press("Escape");
    },
  );
  await page.close();
}

export async function byFinger(browser, station) {
  const page = await newTouchPage(browser);
  const operator = new Operator(page);
  const fingers = new Fingers(page);
  const middle = async () => {
    const box = await page.locator(".stage canvas").first().boundingBox();
    return { x: box.x + box.width / 2, y: box.y + box.height / 2 };
  };
  await check(
    page,
    "two fingers turn the view and leave the hand",
    async () => {
      await operator.start(station.url, TRAINEE, "dorsal_scaphoid_fixation");
      await atRest(operator);
      await operator.flexBySlider();
      const { x, y } = await middle();
      const before = await page.evaluate(() => window.carpus.screenAxes());
      const tip = Operator.held(await operator.snapshot()).tip_mm;
      await fingers.slide([
        { from: { x: x - 40, y }, to: { x: x + 40, y } },
        { from: { x: x + 40, y }, to: { x: x + 120, y } },
      ]);
      await operator.settle();
      const after = await page.evaluate(() => window.carpus.screenAxes());
      expect(dot(before.right, after.right) < 0.99, "the view does not turn");
      const { tip_mm: now } = Operator.held(await operator.snapshot());
      const moved = Math.hypot(...now.map((v, i) => v - tip[i]));
      expect(moved < 0.1, `the tip moved by ${moved.toFixed(2)} mm`);
    },
  );
  await check(page, "one finger pushes the tip along, beside it", async () => {
    await page.getByRole("button", { name: "Aim as seen" }).tap();
    await operator.until((s) => s.hands[0].touching, "the tip on the bone");
    const place = async () => {
      const { tip_mm: tip } = Operator.held(await operator.snapshot());
      return page.evaluate((mm) => window.carpus.pagePoint(mm), tip);
    };
    const before = await place();
    const { x, y } = await middle();
    await fingers.slide([
      { from: { x: x + 90, y: y + 90 }, to: { x: x + 110, y: y + 90 } },
    ]);
    await operator.settle();
    await page.waitForTimeout(800);
    const after = await place();
    const [dx, dy] = [after.x - before.x, after.y - before.y];
    expect(
      Math.abs(dx - 20) < 8 && Math.abs(dy) < 8,
      `20 px of the finger moved it by ${dx.toFixed(0)}, ${dy.toFixed(0)} px`,
    );
  });
  await check(
    page,
    "a finger on Drive drives, and stops when lifted",
    async () => {
      await page.getByRole("button", { name: "Aim as seen" }).tap();
      await operator.until((s) => s.hands[0].touching, "the tip on the bone");
      const drive = page.getByRole("button", { name: "Drive" });
      await fingers.hold(drive, async () => {
        await inBone(operator, 1);
        expect(
          (await drive.getAttribute("aria-pressed")) === "true",
          "the button does not show it",
        );
      });
      await operator.settle();
      await page.waitForTimeout(400);
      const { depth_mm: rested } = Operator.held(await operator.snapshot());
      await page.waitForTimeout(500);
      const { depth_mm: later } = Operator.held(await operator.snapshot());
      expect(later === rested, `it drives on by ${later - rested} mm`);
      await page.locator("#push").fill("55");
      await page.locator(".push-reading", { hasText: "55 N" }).waitFor();
    },
  );
  await page.close();
}
