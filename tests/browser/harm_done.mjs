// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Each kind of harm through the page, and then what is good: the report tells the harm, and a good screw does not
// make up for it. A capitate drilled and taken back; a tendon in the way of a wire beside the corridor; a hole
// too short and a screw turned on until it strips; from volar, a wire far into the radiocarpal joint.
import { farthest, nearestPair, readStructures, readVertices } from "./case_geometry.mjs";
import { check, expect } from "./checks.mjs";
import { Operator, readAxis, readWrist } from "./operator.mjs";
import { expectSaid, expectUnmet, finishedReport } from "./report.mjs";

const TRAINEE = "Browser test, harm";

/** From a wire in the bone on: gauge, drill, a screw that fits, the wire out. */
async function fixOverWire(operator, axis, drillMm = axis.lengthMm - 4) {
  const { page } = operator;
  await page.keyboard.press("m");
  await operator.until((s) => s.gauge_reading_mm > 0, "a reading");
  await operator.take("cannulated_drill");
  await operator.driveOn((drill) => drill.depth_mm >= drillMm, "the drill's depth");
  await operator.holdKey("r", (s) => Operator.held(s)?.instrument !== "cannulated_drill", "the drill out");
  await operator.take((await operator.fittingScrew()).id);
  await operator.holdKey("Space", (s) => Operator.held(s).buried_mm >= 1.5, "the screw buried");
}

async function letGoAndTakeWireOut(operator) {
  await operator.page.keyboard.press("q");
  await operator.takeWireOut();
}

async function capitateDrilledThenAGoodScrew(page, station) {
  const operator = new Operator(page);
  const axis = readAxis(station.caseFolder);
  const { dorsal, distal } = readWrist(station.caseFolder);
  // Its back, away from the radius.
  const back = dorsal.map((v, i) => v + 0.8 * distal[i]);
  const went = await check(page, "a capitate is drilled by mistake, and taken back", async () => {
    await operator.start(station.url, TRAINEE, "dorsal_scaphoid_fixation", "practice");
    const scanned = farthest(readVertices(station.caseFolder, "capitate"), back);
    const pose = await page.evaluate(() => window.carpus.bodyPoses().capitate);
    await operator.placeOn({ entry: Operator.moved(pose, scanned), toHand: dorsal });
    await operator.until((s) => s.hands[0].touched_body === "capitate", "the tip on the capitate");
    await operator.driveWireTo(3);
    await operator.logged("not to be entered");
    await page.keyboard.press("z");
    await operator.until((s) => s.undos === 1 && Operator.held(s).body === "", "the wire taken back");
  });
  if (!went) return;
  const fixed = await check(page, "the scaphoid is fixed well after it", async () => {
    await page.locator("#push").fill("40");
    await page.locator("#push").blur();
    await operator.placeWire(axis);
    await operator.driveWireTo(axis.lengthMm - 2);
    for (const key of ["1", "2", "3"]) await operator.shot(key);
    await fixOverWire(operator, axis);
    await letGoAndTakeWireOut(operator);
    for (const key of ["1", "2", "3", "6"]) await operator.shot(key);
  });
  if (!fixed) return;
  await check(page, "the good screw does not make up for the capitate", async () => {
    const report = await finishedReport(page);
    expectSaid(report, ["wrong_bones_entered"]);
    expectUnmet(report, ["No other bone was drilled"]);
    expect(report.items.wrong_bones_entered.reason.includes("capitate"), report.items.wrong_bones_entered.reason);
    expect(report.items.undos.value === 1, "the undo is not counted");
    for (const good of ["waist_offset_percent", "penetration_mm", "gauge_minus_line_mm"])
      expect(!report.items[good].failed, `${good} is ${JSON.stringify(report.items[good])}`);
    const others = report.unmet.filter((line) => !line.includes("other bone"));
    expect(others.length === 0, `besides: ${others.join("; ")}`);
  });
}

/** Through the extensor tendon that lies nearest to the scaphoid, straight at the bone under it. */
function wayThroughATendon(caseFolder) {
  const bone = ["scaphoid", "scaphoid_proximal", "scaphoid_distal"].flatMap((name) => {
    try {
      return readVertices(caseFolder, name);
    } catch {
      return [];
    }
  });
  const tendons = readStructures(caseFolder, "tendon");
  const { dorsal } = readWrist(caseFolder);
  const height = (p) => dorsal.reduce((sum, d, i) => sum + d * p[i], 0); // a point of a course has a share, too
  const middle = bone.reduce((sum, p) => sum + height(p), 0) / bone.length;
  const over = tendons.flatMap(({ name, course_mm: course }) =>
    course.filter((p) => height(p) > middle).map((p) => ({ name, at: p.slice(0, 3), handShare: p[3] })),
  );
  const best = over
    .map((point) => ({ ...point, ...nearestPair([point.at], bone) }))
    .reduce((a, b) => (b.mm < a.mm ? b : a));
  return { ...best, entry: best.to, toHand: best.at.map((v, i) => (v - best.to[i]) / best.mm) };
}

async function tendonStruckBesideTheCorridor(page, station) {
  const operator = new Operator(page);
  const way = wayThroughATendon(station.caseFolder);
  const went = await check(page, `a wire is turned through a tendon (${way.name})`, async () => {
    await page.goto(`${station.url}/#/`);
    await operator.start(station.url, TRAINEE, "dorsal_scaphoid_fixation", "practice");
    await operator.placeOn({ entry: way.entry, toHand: way.toHand });
    await operator.until((s) => s.hands[0].touched_body.startsWith("scaphoid"), "the tip on the scaphoid");
    await operator.driveWireTo(6);
    await operator.logged(way.name);
  });
  if (!went) return;
  await check(page, "the report names the tendon, and the line beside the middle", async () => {
    const report = await finishedReport(page);
    expectSaid(report, ["structures_struck", "wires_left_in"]);
    expect(report.items.structures_struck.reason.includes(way.name), report.items.structures_struck.reason);
    expectUnmet(report, ["No tendon, artery or nerve was struck", "A screw lies"]);
    const offsets = ["waist_offset_percent", "proximal_offset_percent", "distal_offset_percent"];
    expect(offsets.some((id) => report.items[id].failed), "the line is beside the middle nowhere");
  });
}

async function strippedInTooShortAHole(page, station) {
  const operator = new Operator(page);
  const axis = readAxis(station.caseFolder);
  const went = await check(page, "a hole drilled too short, a screw turned on until it strips", async () => {
    await page.goto(`${station.url}/#/`);
    await operator.start(station.url, TRAINEE, "dorsal_scaphoid_fixation", "practice");
    await operator.placeWire(axis);
    await operator.driveWireTo(axis.lengthMm - 2);
    await fixOverWire(operator, axis, 6);
    await page.keyboard.down("Space");
    await operator.logged("gave way");
    await page.keyboard.up("Space");
    await letGoAndTakeWireOut(operator);
  });
  if (!went) return;
  await check(page, "the report says that it holds no more, and that the hole was short", async () => {
    const report = await finishedReport(page);
    expectSaid(report, ["ream_short_of_far_cortex_mm"]);
    expectUnmet(report, ["No screw was turned on until its thread gave way"]);
    expect(report.items.compression_n.reason.includes("gave way"), report.items.compression_n.reason);
  });
}

async function farIntoTheRadiocarpalJoint(page, station) {
  const operator = new Operator(page);
  const axis = readAxis(station.caseFolder, "distal");
  const went = await check(page, "from volar the wire comes far out of the proximal pole", async () => {
    await page.goto(`${station.url}/#/`);
    await operator.start(station.url, TRAINEE, "volar_scaphoid_fixation", "practice");
    await operator.placeWire(axis);
    await operator.driveWireTo(axis.lengthMm + 5);
    await page.keyboard.press("m");
    await operator.until((s) => s.gauge_reading_mm > axis.lengthMm + 2, "a reading that is too long");
    await operator.holdKey("r", (s) => Operator.held(s).depth_mm < axis.lengthMm - 2, "the wire back in the bone");
    const screw = await operator.fittingScrew();
    await operator.take(screw.id);
    await operator.holdKey("Space", (s) => Operator.held(s).buried_mm >= 1.5, "the screw buried");
    await letGoAndTakeWireOut(operator);
  });
  if (!went) return;
  await check(page, "the report names the joint, the gauge's error and the drill that was left out", async () => {
    const report = await finishedReport(page);
    expectSaid(report, ["beyond_far_cortex_mm", "gauge_minus_line_mm", "screw_length_minus_ideal_mm"]);
    expectUnmet(report, ["beyond the far cortex"]);
    const { reason } = report.items.beyond_far_cortex_mm;
    expect(/lies the (radius|lunate): that joint was entered/.test(reason), reason);
    expect(report.items.gauge_minus_line_mm.reason.includes("beyond the far cortex"), "the gauge's error is not explained");
  });
}

export async function harmIsTold(page, station) {
  await capitateDrilledThenAGoodScrew(page, station);
  await tendonStruckBesideTheCorridor(page, station);
  await strippedInTooShortAHole(page, station);
  await farIntoTheRadiocarpalJoint(page, station);
}
