// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What is decided wrongly, through the page: a fracture declined that should be fixed, a truth that was to be
// bought by ending early, a displaced fracture fixed as it lies. And how it is led back: by a joystick in each piece.
import { execFileSync } from "node:child_process";
import { mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { newPage } from "./browser.mjs";
import { farthest, nearestPair, readVertices } from "./case_geometry.mjs";
import { check, expect } from "./checks.mjs";
import { Operator, readAxis, readWrist } from "./operator.mjs";
import { expectUnmet, finishedReport, shownReport } from "./report.mjs";
import { program, startStation } from "./station.mjs";

const TRAINEE = "Browser test, wrong answers";
/** Of the stock: a step and a gap, to be reduced first. */
const DISPLACED = "displaced_left";

async function declinedForNothing(page, station) {
  const operator = new Operator(page);
  await check(page, "who declines what can be fixed is told so, and earns nothing", async () => {
    await operator.start(station.url, TRAINEE, "dorsal_scaphoid_fixation", "practice");
    for (const key of ["1", "2"]) await operator.shot(key);
    await page.keyboard.press("Delete");
    await page.locator("dialog.decline[open]").waitFor();
    await page.check("dialog.decline input[value=flexed]");
    await page.check("dialog.decline input[value=arthritis]");
    await page.keyboard.press("Enter");
    const report = await shownReport(page);
    expectUnmet(report, ["Declining is right", "At least one reason"]);
    expect(report.items.wrong_reasons.value === 2, `wrong reasons: ${report.items.wrong_reasons.value}`);
  });
}

/** Taken into the second hand, driven into a piece from dorsal, and led with the driver off. */
async function leadWithJoystick(operator, piece, wayInto, by) {
  const { page } = operator;
  await operator.take("joystick_wire");
  await operator.placeOn(wayInto(await page.evaluate(() => window.carpus.bodyPoses())));
  await operator.until((s) => s.hands[0].touched_body === piece, `the joystick on the ${piece}`);
  await page.locator("#push").fill("45"); // a wire of 1.6 mm takes more than a guide wire
  await page.locator("#push").blur();
  await operator.driveOn((wire) => wire.depth_mm >= 5, "the joystick in the piece");
  const before = (await page.evaluate(() => window.carpus.bodyPoses()))[piece].translation_mm;
  const at = await page.evaluate((mm) => window.carpus.pagePoint(mm), Operator.held(await operator.snapshot()).tip_mm);
  await page.mouse.move(at.x, at.y);
  await page.mouse.down();
  await page.mouse.move(at.x + by.x, at.y + by.y, { steps: 8 });
  await operator.settle(6);
  await page.mouse.up();
  const after = (await page.evaluate(() => window.carpus.bodyPoses()))[piece].translation_mm;
  return Math.hypot(...after.map((v, i) => v - before[i]));
}

/** Into the distal piece as it lies now, from where most room is about the wire: from dorsal or radial. */
function wayIntoTheDistalPiece(caseFolder, poses) {
  const { dorsal, distal, radial } = readWrist(caseFolder);
  const lying = (bone) => readVertices(caseFolder, bone).map((p) => Operator.moved(poses[bone], p));
  const piece = lying("scaphoid_distal");
  const others = Object.keys(poses)
    .filter((bone) => bone !== "scaphoid_distal")
    .flatMap(lying);
  const ways = [];
  for (const r of [0, 0.5, 1, 2])
    for (const d of [-0.5, 0, 0.5]) {
      const way = dorsal.map((v, i) => v + r * radial[i] + d * distal[i]);
      const toHand = way.map((v) => v / Math.hypot(...way));
      const entry = farthest(piece, toHand);
      const shaft = Array.from({ length: 20 }, (_, i) => entry.map((v, axis) => v + 2 * i * toHand[axis]));
      ways.push({ entry, toHand, room: nearestPair(shaft, others).mm });
    }
  return ways.reduce((best, way) => (way.room > best.room ? way : best));
}

async function displacedAndFixedAsItLies(page, station) {
  const operator = new Operator(page);
  const axis = readAxis(station.caseFolder);
  const fixed = await check(page, "a displaced fracture is fixed as it lies", async () => {
    await page.goto(`${station.url}/#/`);
    await operator.start(station.url, TRAINEE, "dorsal_scaphoid_fixation", "practice");
    await operator.placeWire(axis);
    await operator.driveWireTo(axis.lengthMm - 3);
    await page.keyboard.press("m");
    await operator.until((s) => s.gauge_reading_mm > 0, "a reading");
    await operator.take((await operator.fittingScrew()).id);
    await operator.holdKey("Space", (s) => Operator.held(s).buried_mm >= 1.5, "the screw buried");
    await page.keyboard.press("q");
    await operator.takeWireOut();
  });
  if (!fixed) return;
  await check(page, "the report says that the pieces do not meet", async () => {
    const report = await finishedReport(page);
    expectUnmet(report, ["The pieces meet"]);
    expect(report.items.fracture_step_mm.value > 1, `the step is ${report.items.fracture_step_mm.value} mm`);
    expect(report.items.steps_left_out.reason.includes("Reduce"), report.items.steps_left_out.reason);
  });
  await check(page, "a joystick in the distal piece leads it, and undo brings it back", async () => {
    await page.goto(`${station.url}/#/`);
    await operator.start(station.url, TRAINEE, "dorsal_scaphoid_fixation", "practice");
    const where = async () => (await page.evaluate(() => window.carpus.bodyPoses())).scaphoid_distal.translation_mm;
    const begun = await where();
    const led = await leadWithJoystick(
      operator,
      "scaphoid_distal",
      (poses) => wayIntoTheDistalPiece(station.caseFolder, poses),
      { x: 0, y: -60 },
    );
    expect(led > 0.5, `it was led by ${led.toFixed(2)} mm`);
    await page.keyboard.press("F8");
    await operator.logged(/Lead the distal part of the scaphoid/);
    await page.keyboard.press("z");
    await operator.until((s) => s.undos === 1, "the joystick taken back");
    await operator.settle(4);
    const back = Math.hypot(...(await where()).map((v, i) => v - begun[i]));
    expect(back < 0.05, `it came back but for ${back.toFixed(2)} mm`);
  });
}

export async function decidedWrongly(browser) {
  const folder = mkdtempSync(join(tmpdir(), "carpus-displaced-"));
  execFileSync(program(), ["stock", "--out", folder, "--only", DISPLACED], { stdio: "ignore" });
  const station = await startStation(["--open"], join(folder, DISPLACED));
  const page = await newPage(browser);
  await page.setViewportSize({ width: 720, height: 480 });
  await declinedForNothing(page, station);
  await displacedAndFixedAsItLies(page, station);
  await page.close();
  await station.stop();
  rmSync(folder, { recursive: true, force: true });
}
