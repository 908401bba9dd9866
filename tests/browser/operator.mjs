// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Operates the page as a person does: with the mouse over the theatre and with keys. It reads where
// things are shown (window.carpus, which shows and cannot act) and knows the true axis from the case
// folder, as a practised eye would.
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { PATIENCE_MS } from "./browser.mjs";

const add = (a, b, f = 1) => a.map((v, i) => v + f * b[i]);
export const dot = (a, b) => a.reduce((sum, v, i) => sum + v * b[i], 0);
export const cross = (a, b) => [
  a[1] * b[2] - a[2] * b[1],
  a[2] * b[0] - a[0] * b[2],
  a[0] * b[1] - a[1] * b[0],
];
const unit = (a) => a.map((v) => v / Math.sqrt(dot(a, a)));

/** Degrees that one pixel of Shift + drag turns the shaft (web/README.md). */
const DEG_PER_PX = 0.25;
const MAX_DRAG_PX = 160;
/** Flexed by more the demo's radius is out of a driver's way. */
const FLEXED_DEG = 48;

/** The central axis as scanned, from `entry` (where the wire goes in) to `end`. */
export function readAxis(caseFolder, from = "proximal") {
  const data = JSON.parse(readFileSync(join(caseFolder, "case.json"), "utf8"));
  const { proximal_mm: proximal, distal_mm: distal } =
    data.scaphoid.central_axis;
  const [entry, end] =
    from === "proximal" ? [proximal, distal] : [distal, proximal];
  return { from, entry, end, lengthMm: Math.hypot(...add(entry, end, -1)) };
}

function turned([w, x, y, z], v) {
  const t = cross([x, y, z], v).map((c) => 2 * c);
  return add(add(v, t, w), cross([x, y, z], t));
}

/** The forearm's directions as scanned, in Patient: docs/units_and_frames.md. */
export function readWrist(caseFolder) {
  const data = JSON.parse(readFileSync(join(caseFolder, "case.json"), "utf8"));
  const [x, y, z] = data.wrist_from_patient.rotation;
  const opposite = (v) => v.map((c) => -c);
  return {
    distal: opposite(x),
    dorsal: opposite(z),
    radial: data.side === "left" ? opposite(y) : y,
  };
}

export class Operator {
  constructor(page) {
    this.page = page;
    /** That the keys and the mouse move. */
    this.hand = 0;
  }

  snapshot() {
    return this.page.evaluate(() => window.carpus?.snapshot());
  }

  exercise() {
    return this.page.evaluate(() => window.carpus?.exercise());
  }

  /** What `hand` holds, of a snapshot. */
  static held(s, hand = 0) {
    return s.items.find((item) => item.hand === hand);
  }

  /** A point of a bone as scanned, where the bone's pose takes it. */
  static moved({ quaternion, translation_mm: moved }, point) {
    return add(turned(quaternion, point), moved);
  }

  /** The axis where the first part of the bone that is operated on is now. */
  async axisNow(axis) {
    const { bodies, name } = await this.page.evaluate(() => ({
      bodies: window.carpus.bodyPoses(),
      name: window.carpus.exercise().bodies.find((body) => body.is_target).name,
    }));
    const { quaternion, translation_mm: moved } = bodies[name];
    const at = (p) => add(turned(quaternion, p), moved);
    const [entry, end] = [at(axis.entry), at(axis.end)];
    return { entry, end, toHand: unit(add(entry, end, -1)) };
  }

  /** Waits until the snapshot satisfies `holds`. Asked from here: the page forbids eval. */
  async until(holds, what, meanwhile = async () => {}) {
    const end = Date.now() + PATIENCE_MS;
    for (;;) {
      await meanwhile();
      const now = await this.snapshot();
      if (now !== undefined && holds(now)) return now;
      if (Date.now() > end)
        throw new Error(
          `waited in vain for: ${what}; now ${JSON.stringify(now)}`,
        );
      await new Promise((done) => setTimeout(done, 50));
    }
  }

  /** A key down and up in one moment, however busy the machine is. */
  async tap(code) {
    await this.page.evaluate((place) => {
      for (const type of ["keydown", "keyup"]) {
        const press = new KeyboardEvent(type, {
          code: place,
          key: place,
          bubbles: true,
        });
        document.activeElement.dispatchEvent(press);
      }
    }, code);
  }

  /** The log says it; a small screen hides the log. */
  async logged(text) {
    await this.page.locator(".log", { hasText: text }).waitFor({ state: "attached" });
  }

  /** Lets the page draw and send what was done. */
  async settle(frames = 2) {
    await this.page.evaluate(
      (n) =>
        new Promise((done) => {
          const next = (left) =>
            left === 0 ? done() : requestAnimationFrame(() => next(left - 1));
          next(n);
        }),
      frames,
    );
    await this.page.waitForTimeout(120);
  }

  /** An operation whose page has gone holds the seat for half a minute more: it is ended. */
  async freeSeat() {
    const { page } = this;
    const free = page.locator(
      "dialog.start button[type=submit]:not([disabled])",
    );
    const end = page.getByRole("button", { name: "End that operation" });
    const sure = page.locator("dialog.confirm[open] button.primary");
    // It may end by itself meanwhile, and the buttons go.
    const press = (button) =>
      button.dispatchEvent("click", {}, { timeout: 1000 }).catch(() => {});
    await free.or(end).first().waitFor();
    while (!(await free.isVisible())) {
      if (await sure.isVisible()) await press(sure);
      else if (await end.isVisible()) await press(end);
      await page.waitForTimeout(200);
    }
    if (await sure.isVisible()) await page.keyboard.press("Escape");
  }

  /** @param mode  "practice" or "assessed"; what was chosen last where it is not said */
  async start(url, trainee, procedure, mode) {
    await this.page.goto(url);
    await this.freeSeat();
    if (procedure !== undefined)
      await this.page.check(`input[name=procedure][value=${procedure}]`);
    if (mode !== undefined)
      await this.page.check(`input[name=mode][value=${mode}]`);
    await this.page.fill("#trainee-name", trainee);
    await this.page.click("dialog.start button[type=submit]");
    // Where another operation waits, the page asks; until this one begins, that is what is seen.
    const anew = this.page.locator("dialog.confirm[open] button.primary");
    await this.until((s) => s.tick > 0 && !s.paused, "the first ticks", async () => {
      if (await anew.isVisible()) await anew.click();
    });
  }

  /** Turns the shaft by Shift + drag, then by Shift + arrows, until it lies along `toHand`. */
  async turnShaft(toHand, withinDeg = 1.5) {
    const box = await this.page.locator(".stage canvas").first().boundingBox();
    const from = { x: box.x + box.width * 0.5, y: box.y + box.height * 0.5 };
    let angle = 180;
    for (let round = 0; round < 12 && angle > withinDeg; ++round) {
      const { shaft } = Operator.held(await this.snapshot(), this.hand);
      angle =
        (180 / Math.PI) * Math.acos(Math.min(1, dot(unit(shaft), toHand)));
      if (angle <= withinDeg) break;
      const { right, up } = await this.page.evaluate(() =>
        window.carpus.screenAxes(),
      );
      const wanted = add(toHand, shaft, -dot(toHand, shaft));
      const across = [dot(wanted, right), dot(wanted, up)];
      const size = Math.hypot(...across);
      // What is left is a turn towards the viewer: nothing of it can be done from this side.
      if (size < 0.02) break;
      if (angle > 4) {
        const seen = (180 / Math.PI) * Math.asin(Math.min(1, size));
        const pixels = Math.min(MAX_DRAG_PX, seen / DEG_PER_PX);
        await this.page.keyboard.down("Shift");
        await this.page.mouse.move(from.x, from.y);
        await this.page.mouse.down();
        await this.page.mouse.move(
          from.x + (pixels * across[0]) / size,
          from.y - (pixels * across[1]) / size,
          { steps: 3 },
        );
        await this.page.mouse.up();
        await this.page.keyboard.up("Shift");
      } else {
        const key =
          Math.abs(across[0]) > Math.abs(across[1])
            ? across[0] > 0
              ? "ArrowRight"
              : "ArrowLeft"
            : across[1] > 0
              ? "ArrowUp"
              : "ArrowDown";
        const taps = Math.max(1, Math.floor((180 / Math.PI) * size));
        for (let tap = 0; tap < taps; ++tap)
          await this.page.keyboard.press(`Shift+${key}`);
      }
      await this.settle();
      await this.page.waitForTimeout(400);
    }
    return angle;
  }

  /** Drags the tip onto the point of the bone that is shown at `pointMm`. */
  async dragTipTo(pointMm) {
    const at = await this.page.evaluate(
      (mm) => window.carpus.pagePoint(mm),
      pointMm,
    );
    await this.page.mouse.move(at.x - 30, at.y + 10);
    await this.page.mouse.down();
    await this.page.mouse.move(at.x, at.y, { steps: 4 });
    await this.settle();
    await this.page.mouse.up();
    await this.settle();
  }

  /** Holds a key until the snapshot satisfies `holds`. */
  async holdKey(key, holds, what) {
    await this.page.keyboard.down(key);
    try {
      await this.until(holds, what);
    } finally {
      await this.page.keyboard.up(key);
    }
    await this.settle();
  }

  async push(key, ms) {
    await this.page.keyboard.down(key);
    await this.page.waitForTimeout(ms);
    await this.page.keyboard.up(key);
    await this.settle(1);
  }

  /** Short pushes, as strong as the hand begins through the near cortex, then light, with more where the wire stops. */
  async driveWireTo(depthMm) {
    const { page } = this;
    let isLight = false;
    let last = -1;
    for (let push = 0; push < 400; ++push) {
      const { depth_mm: depth, body } = Operator.held(await this.snapshot());
      const isEngaged = body !== "";
      if (isEngaged && depth >= depthMm) return;
      if (!isLight && isEngaged && depth >= 0.5) {
        isLight = true;
        for (let i = 0; i < 5; ++i) await page.keyboard.press("BracketLeft");
      } else if (isLight && depth - last < 0.1) {
        await page.keyboard.press("BracketRight");
      }
      last = depth;
      await this.push("Space", 40);
    }
    throw new Error("the wire does not reach its depth");
  }

  async shot(key) {
    const before = (await this.snapshot()).shots;
    await this.page.keyboard.press(key);
    await this.until((s) => s.shots > before, `picture by key ${key}`);
    const shown = this.page.locator(
      `.c-arm-strip button[aria-label*="shot ${before + 1},"]`,
    );
    await shown.waitFor();
    await this.settle();
  }

  /** Holds the C-arm's pedal while `meanwhile` goes on; the last picture stays. */
  async lookLive(meanwhile) {
    const before = (await this.snapshot()).shots;
    await this.page.keyboard.down("e");
    await this.until((s) => s.c_arm.live, "live pictures");
    await this.page.locator(".c-arm header span", { hasText: "live" }).waitFor();
    await meanwhile();
    await this.page.keyboard.up("e");
    await this.until((s) => !s.c_arm.live, "the pedal let go");
    await this.page
      .locator(`.c-arm-strip button[aria-label*="shot ${before + 1},"]`)
      .waitFor();
  }

  /** Mean and standard deviation of the middle of the shown picture. */
  picture() {
    return this.page.evaluate(() => {
      const canvas = document.querySelector("canvas.c-arm-picture");
      const side = canvas.width;
      const data = canvas
        .getContext("2d")
        .getImageData(side / 4, side / 4, side / 2, side / 2).data;
      let sum = 0;
      let squares = 0;
      const count = data.length / 4;
      for (let i = 0; i < data.length; i += 4) {
        sum += data[i];
        squares += data[i] * data[i];
      }
      return {
        mean: sum / count,
        deviation: Math.sqrt(squares / count - (sum / count) ** 2),
      };
    });
  }

  /** Takes an instrument of the tray by its list. */
  async take(id) {
    await this.page.keyboard.press("c");
    await this.page.locator("dialog.tray[open] input:checked").waitFor();
    await this.page.check(`dialog.tray input[value=${id}]`);
    await this.page.keyboard.press("Enter");
    await this.until(
      (s) => Operator.held(s, this.hand)?.instrument === id,
      `${id} in the hand`,
    );
  }

  /** The longest screw of the tray that is at least 4 mm shorter than measured. */
  async fittingScrew() {
    const { gauge_reading_mm: measured } = await this.snapshot();
    const { instruments } = await this.exercise();
    const fitting = instruments.filter(
      (one) => one.family !== "" && one.length_mm <= measured - 4,
    );
    if (fitting.length === 0) throw new Error(`no screw for ${measured} mm`);
    return fitting.reduce((a, b) => (b.length_mm > a.length_mm ? b : a));
  }

  /** The empty hand takes hold of the wire that is left in the bone and draws it out. */
  async takeWireOut() {
    await this.until((s) => s.hands[0].item < 0, "an empty hand");
    await this.settle();
    await this.page.keyboard.press("g");
    await this.until(
      (s) => Operator.held(s)?.instrument === "guide_wire",
      "the wire in the hand",
    );
    await this.holdKey(
      "r",
      (s) => Operator.held(s)?.body === "",
      "the wire out",
    );
  }

  /** Drives what rides on the wire by short pushes, with more where it stops, until `holds` of it. */
  async driveOn(holds, what, pushMs = 60) {
    let last = -1;
    for (let push = 0; push < 400; ++push) {
      const item = Operator.held(await this.snapshot());
      if (holds(item)) return;
      if (item.depth_mm - last < 0.05) await this.page.keyboard.press("BracketRight");
      last = item.depth_mm;
      await this.push("Space", pushMs);
    }
    throw new Error(`in vain: ${what}`);
  }

  /** Flexes the wrist until the radius no longer stands before the proximal pole. */
  async flex() {
    if ((await this.snapshot()).wrist.flexion_deg > FLEXED_DEG) return;
    await this.holdKey("j", (s) => s.wrist.flexion_deg > FLEXED_DEG, "a flexed wrist");
  }

  /** The same by its slider, as a finger does it. */
  async flexBySlider() {
    // Its steps begin at a limit that is no whole number: the nearest one is taken.
    await this.page.locator("#wrist-flexion_deg").evaluate((slider, deg) => {
      slider.value = String(deg);
      slider.dispatchEvent(new Event("input", { bubbles: true }));
    }, FLEXED_DEG + 5);
    await this.until((s) => s.wrist.flexion_deg > FLEXED_DEG, "a flexed wrist");
  }

  /** Entry and aim, of a wrist that is posed for it: the tip on the bone, the shaft along the axis. @return degrees that it is off */
  async placeWire(axis) {
    if (axis.from === "proximal") await this.flex();
    return this.placeOn(await this.axisNow(axis));
  }

  async otherHand() {
    await this.page.keyboard.press("h");
    this.hand = 1 - this.hand;
    await this.settle();
  }

  /** The needle sleeve in the other hand, on the bone where the wire is to go in: it spreads what lies over it. */
  async placeSleeve(axis) {
    if (axis.from === "proximal") await this.flex();
    await this.otherHand();
    await this.take("needle_sleeve_14g");
    await this.placeOn(await this.axisNow(axis));
    await this.otherHand();
  }

  async putDownSleeve() {
    await this.otherHand();
    await this.page.keyboard.press("q");
    await this.until((s) => s.hands[this.hand].item < 0, "the sleeve put down");
    await this.otherHand();
  }

  /** The tip on the bone that is shown at `entry`, the shaft along `toHand`. @return degrees that it is off */
  async placeOn({ entry, toHand }) {
    // A turn towards the viewer is none on the screen: from two sides, which two is all the same.
    const angles = [];
    for (const side of ["Radial", "Dorsal", "Radial"]) {
      if (angles.length > 1 && angles.at(-1) < 3) break;
      await this.page.getByRole("button", { name: side, exact: true }).click();
      await this.settle();
      angles.push(await this.turnShaft(toHand));
    }
    const angle = angles.at(-1);
    // Looking along the shaft the entry point is in front of everything else that matters.
    await this.page.getByRole("button", { name: "Along shaft" }).click();
    await this.settle();
    await this.dragTipTo(entry);
    await this.until((s) => s.hands[this.hand].touching, "the tip touches");
    return angle;
  }
}
