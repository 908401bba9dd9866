// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// From the palm by mouse and keys: the scope goes round to the volar radial portal, which is then in sight, and in; and
// the palm's closed skin is opened there until the scope shows the joint by that way.
// With CARPUS_SCOPE_PICTURES a folder for what is seen on the way.
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { newPage } from "./browser.mjs";
import { check, expect } from "./checks.mjs";
import { underTraction } from "./hands.mjs";
import { dot, Operator, readWrist } from "./operator.mjs";
import { pixelsOf } from "./pixels.mjs";
import { minus, plus, SkinHands } from "./skin_hands.mjs";
import { root } from "./station.mjs";

const TRAINEE = "Browser test, volar";
/** Of grey levels: a blank picture stays under this. */
const LEAST_DEVIATION = 12;

/** Of the palm's skin, about so far before the wrist [mm]. */
const PALM_MM = 15;
/** A crease is sought from so far before to so far beyond where it lay as scanned: pulled at, the hand takes it along. */
const SOUGHT_MM = [-1, 5];
const STEP_MM = 0.25;
/** Beside a crease, in which light is lost. */
const BESIDE_STEPS = 6;
/** Beside a crease skin is lighter, by grey levels. */
const LEAST_DIP = 7;

/** How much darker than on both its sides the palm is, at most about so far distal of the radius; the mean across it. */
async function crease(page, caseFolder, distalMm) {
  const { rotation, translation_mm: moved } = JSON.parse(
    readFileSync(join(caseFolder, "case.json"), "utf8"),
  ).wrist_from_patient;
  const patient = (at) => [0, 1, 2].map((c) => at.reduce((sum, v, r) => sum + rotation[r][c] * (v - moved[r]), 0));
  const [from, to] = SOUGHT_MM;
  const steps = Math.round((to - from) / STEP_MM) + 2 * BESIDE_STEPS;
  const lines = [-9, -6, -3, 0, 3, 6, 9].map((across) =>
    Array.from({ length: steps + 1 }, (_, i) =>
      patient([-(distalMm + from + (i - BESIDE_STEPS) * STEP_MM), across, PALM_MM]),
    ),
  );
  const { width, data } = await pixelsOf(page, await page.screenshot());
  const { places, across } = await page.evaluate(
    (all) => ({ places: all.map((line) => line.map((mm) => window.carpus.pagePoint(mm))), across: innerWidth }),
    lines,
  );
  const scale = width / across;
  const grey = ({ x, y }) => {
    const at = 4 * (Math.round(y * scale) * width + Math.round(x * scale));
    return (data[at] + data[at + 1] + data[at + 2]) / 3;
  };
  const dips = places.map((line) => {
    const levels = line.map(grey);
    const dip = (i) => Math.min(levels[i - BESIDE_STEPS], levels[i + BESIDE_STEPS]) - levels[i];
    return Math.max(...levels.map((_, i) => (i < BESIDE_STEPS || i + BESIDE_STEPS >= levels.length ? 0 : dip(i))));
  });
  return dips.reduce((a, b) => a + b, 0) / dips.length;
}

export async function goesInFromVolar(browser, station) {
  const page = await newPage(browser);
  const operator = new Operator(page);
  const hands = new SkinHands(page, operator);
  const { dorsal } = readWrist(station.caseFolder);
  const { creases } = JSON.parse(readFileSync(join(root, "data/skin_creases.json"), "utf8"));
  const large = page.locator(".scope:not(.is-inset) .scope-picture");
  const pictures = process.env.CARPUS_SCOPE_PICTURES;
  const picture = async (name) => {
    if (pictures !== undefined) await page.screenshot({ path: join(pictures, `volar_${name}.png`) });
  };
  const begin = (procedure) => underTraction(operator, station.url, TRAINEE, procedure);
  /** Of grey levels in the middle of the scope's picture. */
  const deviation = () =>
    large.evaluate((canvas) => {
      const side = 64;
      const small = new OffscreenCanvas(side, side).getContext("2d");
      small.drawImage(canvas, canvas.width / 4, canvas.height / 4, canvas.width / 2, canvas.height / 2, 0, 0, side, side);
      const { data } = small.getImageData(0, 0, side, side);
      const grey = Array.from({ length: side * side }, (_, i) => data[4 * i + 1]);
      const mean = grey.reduce((a, b) => a + b, 0) / grey.length;
      return Math.sqrt(grey.reduce((sum, v) => sum + (v - mean) ** 2, 0) / grey.length);
    });
  const showsTheJoint = async () => {
    for (let waited = 0; waited < 5000; waited += 200) {
      if ((await deviation()) > LEAST_DEVIATION) return;
      await page.waitForTimeout(200);
    }
    throw new Error(`the scope's picture is blank: ${await deviation()}`);
  };

  let portal;
  await check(page, "V leads the scope round to the palm, in sight, and in by it", async () => {
    await begin("diagnostic_arthroscopy");
    portal = (await operator.exercise()).arthroscopy.portals.find((one) => one.id === "VR");
    const said = page.locator(".notice", { hasText: "volar radial portal" });
    for (let tries = 0; tries < 12 && !(await said.isVisible()); ++tries) {
      await page.keyboard.press("v");
      await page.waitForTimeout(100);
    }
    await page.locator('.view-bar button[aria-pressed="true"]', { hasText: "Volar" }).waitFor();
    // The step is told for the portal that was chosen, and is done by it.
    await page.locator(".step-list li", { hasText: "by the volar radial portal: at the proximal wrist crease" }).waitFor();
    await operator.until((s) => dot(Operator.held(s).shaft, dorsal) < -0.7, "the scope from volar");
    await hands.goIn();
    const { steps } = await operator.exercise();
    const step = steps.findIndex((one) => one.id === "look_in");
    await operator.until((s) => s.completed_steps.includes(step), "the scope's step done");
    expect((await hands.scope()).portals[0] === "VR", "it is in another portal");
    await showsTheJoint();
    await picture("by_v");
  });
  await check(page, "the palm's skin is opened, and the scope goes in by that way", async () => {
    await begin("arthroscopy_from_the_skin");
    const pose = (await page.evaluate(() => window.carpus.bodyPoses()))[portal.body];
    const spot = Operator.moved(pose, portal.skin_mm);
    const inwards = minus(Operator.moved(pose, plus(portal.skin_mm, portal.inwards)), spot);
    await operator.take("fingertip");
    await page.getByRole("button", { name: "Volar", exact: true }).click();
    await page.keyboard.press("Enter");
    await operator.until((s) => dot(Operator.held(s).shaft, dorsal) < -0.7, "the finger from volar");
    await operator.push("d", 1500); // the finger out of sight of the creases
    for (const { id, distal_mm: mm } of creases) {
      const dip = await crease(page, station.caseFolder, mm);
      expect(dip > LEAST_DIP, `${id} is ${dip.toFixed(1)} grey levels darker than beside it`);
    }
    await page.getByRole("button", { name: "Radial", exact: true }).click();
    await operator.settle();
    await operator.turnShaft(inwards.map((v) => -v), 4);
    await page.getByRole("button", { name: "Volar", exact: true }).click();
    await operator.settle();
    await hands.prick(spot);
    await picture("needle");
    await hands.drawOut();
    await hands.cut(spot);
    await picture("cut");
    await hands.spread(spot);
    await hands.enter(spot, 1);
    await picture("sheath");
    await hands.drawOut();
    await operator.take("arthroscope_1_9_30");
    await large.waitFor();
    await hands.goIn();
    await showsTheJoint();
    await picture("by_own_way");
  });
  await page.context().close();
}
