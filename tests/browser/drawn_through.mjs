// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The dorsal procedure whole, with its own way with the wire: driven through, taken at the base of the thumb and
// drawn until nothing stands over the radius; the wrist straightened and looked at; flexed, pushed out dorsally,
// taken there and drawn back. Then measured, reamed, fixed, to the printed report. One step is done a second time.
import { newPage } from "./browser.mjs";
import { check, expect } from "./checks.mjs";
import { Operator, readAxis, readWrist } from "./operator.mjs";
import { finishedReport, printedPages } from "./report.mjs";

const TRAINEE = "Browser test, drawn through";

const wireOf = (s) => s.items.find((item) => item.instrument === "guide_wire");

async function placeOf(operator, id) {
  const { steps } = await operator.exercise();
  const index = steps.findIndex((step) => step.id === id);
  expect(index >= 0, `there is no step ${id}`);
  return index;
}

async function hasDone(operator, id) {
  const index = await placeOf(operator, id);
  await operator.until((s) => s.completed_steps.includes(index), `step ${id} ticked`);
}

/** Lets go and takes hold again: of the end that `key` names. */
async function changeEnds(operator, key, byFarEnd) {
  await operator.page.keyboard.press("q");
  await operator.until((s) => s.hands[0].item < 0, "an empty hand");
  await operator.settle();
  await operator.page.keyboard.press(key);
  await operator.until((s) => wireOf(s).hand === 0, "the wire in the hand");
  const { by_far_end: far } = wireOf(await operator.snapshot());
  expect(far === byFarEnd, `held by its ${far ? "far" : "near"} end`);
}

/** Within the central third, but aimed radial: beside the tubercle runs the flexor carpi radialis, ulnar of it. */
function awayFromFlexor(axis, { radial }) {
  return { ...axis, end: axis.end.map((v, i) => v + 1.3 * radial[i]) };
}

export async function drawnThrough(browser, station) {
  const page = await newPage(browser);
  // Few pixels: a machine without graphics draws each of them itself.
  await page.setViewportSize({ width: 720, height: 480 });
  const operator = new Operator(page);
  const axis = awayFromFlexor(readAxis(station.caseFolder), readWrist(station.caseFolder));
  const went = await check(page, "the wire is driven through and drawn at the thumb's base", async () => {
    await operator.start(station.url, TRAINEE, "dorsal_scaphoid_fixation", "practice");
    for (const key of ["1", "2"]) await operator.shot(key);
    await page.getByRole("button", { name: "Aligned" }).click();
    await hasDone(operator, "survey");
    await operator.logged("Judged: the fracture is aligned");
    await operator.placeSleeve(axis);
    await operator.placeWire(axis);
    await operator.driveWireTo(axis.lengthMm - 2);
    await operator.putDownSleeve();
    await page.locator("#push").fill("40");
    await page.locator("#push").blur();
    await operator.holdKey(
      "Space",
      (s) => wireOf(s).depth_mm > axis.lengthMm + 45,
      "the wire far through",
    );
    await changeEnds(operator, "Shift+G", true);
    await operator.holdKey(
      "r",
      (s) => wireOf(s).depth_mm >= wireOf(s).length_mm - 0.5,
      "its dorsal end level with the bone",
    );
    await hasDone(operator, "draw_through");
  });
  if (!went) return page.close();
  const looked = await check(page, "the wrist is straightened without harm and looked at", async () => {
    await operator.holdKey("u", (s) => s.wrist.flexion_deg < 2, "a straight wrist");
    for (const key of ["1", "2"]) await operator.shot(key);
    await hasDone(operator, "extend");
    const { length_mm: length, bent_at_mm: bentAt } = wireOf(await operator.snapshot());
    expect(bentAt >= length - 0.01, "the wire is bent");
  });
  if (!looked) return page.close();
  const back = await check(page, "flexed again it is pushed out dorsally and drawn back to the far cortex", async () => {
    await operator.flex();
    await operator.holdKey(
      "Space",
      (s) => wireOf(s).length_mm - wireOf(s).depth_mm > 60,
      "enough of it out dorsally",
    );
    await changeEnds(operator, "g", false);
    await operator.holdKey(
      "r",
      (s) => wireOf(s).depth_mm <= axis.lengthMm - 1,
      "its tip at the far cortex",
    );
    // A slow page lets go late.
    if (wireOf(await operator.snapshot()).depth_mm < axis.lengthMm - 1.5)
      await operator.driveWireTo(axis.lengthMm - 1.3);
    for (const key of ["1", "2", "3"]) await operator.shot(key);
    await hasDone(operator, "drive_back");
  });
  if (!back) return page.close();
  const fixed = await check(page, "it is measured, reamed and fixed", async () => {
    await page.keyboard.press("m");
    await hasDone(operator, "measure");
    const hold = await placeOf(operator, "hold");
    await operator.holdKey("Space", (s) => s.completed_steps.includes(hold), "the wire out at both ends");
    await operator.take("cannulated_drill");
    await operator.driveOn((drill) => drill.depth_mm >= axis.lengthMm - 3.5, "the drill's depth");
    await operator.holdKey("r", (s) => Operator.held(s)?.instrument !== "cannulated_drill", "the drill out");
    await hasDone(operator, "ream");
    await operator.take((await operator.fittingScrew()).id);
  });
  if (!fixed) return page.close();
  await check(page, "a step is done again from the list, counted once", async () => {
    const { steps } = await operator.exercise();
    const ream = steps.findIndex((step) => step.id === "ream");
    await page.getByRole("button", { name: "All steps" }).click(); // a small screen shows the current one alone
    await page.getByRole("button", { name: `Do again: ${steps[ream].title}` }).click();
    await page.locator("dialog.confirm[open]", { hasText: steps[ream].title }).waitFor();
    await page.keyboard.press("Enter");
    await operator.until((s) => s.undos === 1 && !s.completed_steps.includes(ream), "back before reaming");
    await operator.settle();
    await operator.logged(`Back to step: ${steps[ream].title}`);
    if (Operator.held(await operator.snapshot())?.instrument !== "cannulated_drill")
      await operator.take("cannulated_drill");
    await operator.driveOn((drill) => drill.depth_mm >= axis.lengthMm - 3, "the drill's depth");
    await operator.holdKey("r", (s) => Operator.held(s)?.instrument !== "cannulated_drill", "the drill out");
    await hasDone(operator, "ream");
  });
  await check(page, "a screw in, the wire out, looked at from four sides: acceptable, on two pages", async () => {
    await operator.take((await operator.fittingScrew()).id);
    await operator.holdKey("Space", (s) => Operator.held(s).buried_mm >= 1.9, "the screw buried");
    await hasDone(operator, "insert");
    for (const key of ["1", "2", "3", "6"]) await operator.shot(key);
    await hasDone(operator, "verify");
    await page.keyboard.press("q");
    await operator.takeWireOut();
    const report = await finishedReport(page);
    const struck = report.items.structures_struck.reason;
    expect(report.unmet.length === 0, `not fulfilled: ${report.unmet.join("; ")} (${struck})`);
    expect(/acceptable/i.test(report.verdict) && !/not acceptable/i.test(report.verdict), report.verdict);
    expect(report.overall > 70, `${report.overall} points`);
    expect(report.items.undos.value === 1, "the step taken back is not counted");
    expect(report.items.wire_held_while_reaming.value === 1, "the wire was not held at both ends");
    expect(report.items.judgement_right.value === 1, report.items.judgement_right.reason);
    expect(report.items.far_exits.value === 2, `${report.items.far_exits.value} ways out at the far side`);
    const pages = await printedPages(page);
    expect(pages === 2, `${pages} pages`);
  });
  await page.close();
}
