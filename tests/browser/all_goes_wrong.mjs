// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Everything that can go wrong does, through the page, and the report says each of it: the wire far
// through the bone and taken back, too long a screw, the drill beyond the far cortex, no picture, steps left out;
// a wire that is left over the radius while the wrist is straightened; each other harm (harm_done.mjs) and each
// wrong decision (wrong_answers.mjs).
import { newPage } from "./browser.mjs";
import { check, expect } from "./checks.mjs";
import { dot, Operator, readAxis } from "./operator.mjs";
import { harmIsTold } from "./harm_done.mjs";
import { expectSaid, finishedReport } from "./report.mjs";
import { decidedWrongly } from "./wrong_answers.mjs";

const TRAINEE = "Browser test, all wrong";
/** Bent by 15 degrees and more. */
const STRAIGHT_COSINE = 0.966;

async function harmUndoneAndTooLong(page, station) {
  const operator = new Operator(page);
  const axis = readAxis(station.caseFolder);
  const began = await check(page, "a wire driven far through the bone and taken back", async () => {
    await operator.start(station.url, TRAINEE, "dorsal_scaphoid_fixation", "practice");
    await operator.placeWire(axis);
    await operator.driveWireTo(axis.lengthMm + 3);
    await page.keyboard.press("z");
    await operator.until((s) => s.undos === 1, "the step taken back");
    await operator.settle();
  });
  if (!began) return;
  const went = await check(page, "over-drilled, and too long a screw put in", async () => {
    // As strong as the hand begins: the far cortex was passed with little.
    await page.locator("#push").fill("40");
    await operator.placeWire(axis);
    await operator.driveWireTo(axis.lengthMm + 2);
    await operator.take("cannulated_drill");
    await operator.driveOn((drill) => drill.depth_mm >= axis.lengthMm + 4, "the drill too deep");
    await operator.holdKey(
      "r",
      (s) => Operator.held(s)?.instrument !== "cannulated_drill",
      "the drill out",
    );
    const { instruments } = await operator.exercise();
    const long = instruments
      .filter((one) => one.family !== "" && one.length_mm >= axis.lengthMm + 2)
      .reduce((a, b) => (b.length_mm < a.length_mm ? b : a));
    await operator.take(long.id);
    await operator.holdKey("Space", (s) => Operator.held(s).buried_mm >= 1.5, "the screw buried");
    await page.keyboard.press("q");
    await operator.takeWireOut();
  });
  if (!went) return;
  await check(page, "the report says each of it, and gives no point", async () => {
    const report = await finishedReport(page);
    expect(report.note.includes("Check the views"), `open steps: '${report.note}'`);
    expectSaid(report, [
      "penetration_mm",
      "screw_length_minus_ideal_mm",
      "follower_beyond_far_cortex_mm",
      "views_with_wire",
      "views_with_screw",
      "steps_left_out",
    ]);
    expect(report.items.undos.value === 1, "the undo is not counted");
    expect(report.items.shots.value === 0, "shots without a picture");
    expect(report.overall === 0, `${report.overall} points`);
    expect(/not acceptable/i.test(report.verdict), `the verdict: '${report.verdict}'`);
    expect(report.unmet.length >= 3, `unmet: ${report.unmet.join("; ")}`);
    const stands = await page.locator(".lengths").innerText();
    expect(/Stands out/.test(stands), `where it stands out is not said: '${stands}'`);
  });
}

async function wireOverTheRadius(page, station) {
  const operator = new Operator(page);
  const axis = readAxis(station.caseFolder);
  const went = await check(page, "a wire left over the radius breaks as the wrist is straightened", async () => {
    await page.goto(`${station.url}/#/`);
    await operator.start(station.url, TRAINEE, "dorsal_scaphoid_fixation", "practice");
    await operator.placeWire(axis);
    await operator.driveWireTo(axis.lengthMm - 8);
    await page.keyboard.press("q");
    await operator.until((s) => s.hands[0].item < 0, "an empty hand");
    const whole = (await operator.snapshot()).items[0].length_mm;
    await operator.holdKey(
      "u",
      (s) =>
        s.wrist.flexion_deg < -20 ||
        s.items.some(
          (item) =>
            item.length_mm < whole - 5 ||
            dot(item.shaft, item.outer_shaft) < STRAIGHT_COSINE,
        ),
      "a wire bent over the radius",
    );
  });
  if (!went) return;
  await check(page, "ended early, the report says what the wire suffered and that it stays", async () => {
    const report = await finishedReport(page);
    const bent = ["wire_bend_deg", "wires_broken"].filter((id) => report.items[id]?.failed);
    expect(bent.length > 0, `neither bent nor broken: ${JSON.stringify(report.items.wire_bend_deg)}`);
    expectSaid(report, [...bent, "wires_left_in", "steps_left_out"]);
    const told = (texts, words) => texts.some((text) => text.includes(words));
    expect(told(report.unmet, "A screw lies"), `unmet: ${report.unmet.join("; ")}`);
    // No screw went in: of its cover nothing is known, and of the bone that the wire entered something is.
    expect(told(report.unjudged, "over the screw"), `unjudged: ${report.unjudged.join("; ")}`);
    expect(!told(report.unjudged, "other bone"), `unjudged: ${report.unjudged.join("; ")}`);
    expect(report.overall === 0, `${report.overall} points`);
    expect(/not acceptable/i.test(report.verdict), `the verdict: '${report.verdict}'`);
  });
}

export async function allGoesWrong(browser, station) {
  const page = await newPage(browser);
  // Few pixels: what is looked at here is said in words.
  await page.setViewportSize({ width: 720, height: 480 });
  await harmUndoneAndTooLong(page, station);
  await wireOverTheRadius(page, station);
  await harmIsTold(page, station);
  await decidedWrongly(browser);
  await page.close();
}
