// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The whole tour of both joints with mouse and keys; and an examination of a wrist whose pathology was prepared,
// looked round in the same way and answered rightly. They take minutes: of the long run.
import { execFileSync } from "node:child_process";
import { cpSync, mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { newPage } from "./browser.mjs";
import { check, expect } from "./checks.mjs";
import { atRest } from "./hands.mjs";
import { Operator } from "./operator.mjs";
import { expertsWay, ScopeGuide } from "./scope_guide.mjs";
import { demoCase, program, startStation } from "./station.mjs";

const TRAINEE = "Browser test, whole tour";
/** For which the host wants to see a place, and a little. */
const LOOK_MS = 1300;

/** Of the score that is shown now. */
async function scoreOf(page, station) {
  await page.waitForURL(/#\/attempts\/\d+/);
  const id = /attempts\/(\d+)/.exec(page.url())[1];
  const { score } = await (await fetch(`${station.url}/api/attempts/${id}`)).json();
  return score;
}

async function finish(page) {
  await page.keyboard.press("f");
  await page.click("dialog[open] button[value=finish], dialog[open] .primary");
}

/** Pulls at the fingers and goes round as the expert does. @return what the host said of it at the end */
async function goRound(page, operator, caseFolder, procedure, folder) {
  await atRest(operator);
  for (let i = 0; i < 75; ++i) await page.keyboard.press("w");
  await operator.until((s) => s.wrist.traction_n >= 60, "traction");
  const guide = new ScopeGuide(page, operator);
  const places = expertsWay(caseFolder, procedure, folder);
  expect(places.some((one) => one.isRest), "the expert rests nowhere");
  await guide.walk(places, async (place) => {
    if (place.hand === 1) await page.mouse.wheel(0, -100);
    await page.waitForTimeout(LOOK_MS);
    const { points_seen: seen, points_probed: probed } = await guide.scope();
    if (process.env.CARPUS_TELL !== undefined)
      process.stdout.write(`  ${Math.round(place.seconds)} s, hand ${place.hand} at ${guide.at}: ${seen.length} seen, ${probed.length} probed; the expert ${place.seen}\n`);
  });
  return { told: await guide.scope(), expert: places.at(-1) };
}

export async function completesTour(browser, station) {
  const page = await newPage(browser);
  const operator = new Operator(page);
  const folder = mkdtempSync(join(tmpdir(), "carpus-tour-"));
  await check(page, "the whole tour of both joints by mouse and keys", async () => {
    const procedure = "diagnostic_arthroscopy";
    await operator.start(station.url, TRAINEE, procedure, "practice");
    const { told, expert } = await goRound(page, operator, station.caseFolder, procedure, folder);
    expectSeen(told, expert, (await operator.exercise()).arthroscopy.points);
    await finish(page);
    const score = await scoreOf(page, station);
    const seen = score.items.find((one) => one.id === "points_seen").value;
    expect(seen === told.points_seen.length, `${seen} scored, ${told.points_seen.length} told`);
    expectEarned(score);
  });
  rmSync(folder, { recursive: true });
  await page.context().close();
}

/** Who heeds the warnings has pressed nothing too hard for long, by mouse and keys too, and what was seen earns its points. */
function expectEarned({ overall, items, must_haves: mustHaves }) {
  const missed = mustHaves.filter((one) => !one.fulfilled).map((one) => one.label);
  const forces = items.filter((one) => one.id.startsWith("force_over")).map((one) => `${one.id} ${one.value}`);
  process.stdout.write(`  overall ${overall.toFixed(1)}; ${forces.join(", ")}\n`);
  expect(missed.length === 0, `must-haves missed: ${missed.join("; ")}; ${forces.join(", ")}`);
  expect(overall > 0, `overall ${overall}`);
}

/** Four fifths of what the expert saw: hands that wait for pictures drawn in software are not as steady. */
function expectSeen(told, expert, points) {
  const missed = points.filter(({ number }) => !told.points_seen.includes(number));
  expect(
    told.points_seen.length >= 0.8 * expert.seen,
    `${told.points_seen.length} seen, by the expert ${expert.seen}; not: ${missed.map((one) => one.name).join("; ")}`,
  );
}

/** What is there, and the grades that are to be found. */
const PREPARED = { scapholunate: "II", disc: "1A", cartilage_lunate_fossa: "III" };

export async function examinesRightly(browser) {
  const folder = mkdtempSync(join(tmpdir(), "carpus-examination-"));
  const caseFolder = join(folder, "case");
  cpSync(demoCase(), caseFolder, { recursive: true });
  const sets = Object.entries(PREPARED).flatMap(([finding, grade]) => ["--set", `${finding}=${grade}`]);
  execFileSync(program(), ["pathology", caseFolder, ...sets], { stdio: "pipe" });
  const station = await startStation(undefined, caseFolder);
  const page = await newPage(browser);
  const operator = new Operator(page);
  await check(page, "an examination of what was prepared, looked round and answered rightly", async () => {
    const procedure = "arthroscopic_examination";
    await operator.start(station.url, TRAINEE, procedure, "assessed");
    const { told, expert } = await goRound(page, operator, caseFolder, procedure, folder);
    const { points, findings } = (await operator.exercise()).arthroscopy;
    expectSeen(told, expert, points);
    await page.keyboard.press("9");
    for (const { id } of findings) {
      const grade = PREPARED[id] ?? "0";
      await page.locator(`.finding label:has(input[name="${id}"][value="${grade}"])`).click();
    }
    await page.waitForTimeout(300); // the host has the last answer
    await page.keyboard.press("Escape");
    await page.waitForFunction(() => document.querySelector("dialog[open]") === null);
    await finish(page);
    const score = await scoreOf(page, station);
    for (const [id, wanted] of [["findings_found", 100], ["grades_right", 100], ["findings_invented", 0], ["findings_unjudged", 0], ["lesions_seen_share", 100]]) {
      const item = score.items.find((one) => one.id === id);
      expect(item.value === wanted, `${id}: ${JSON.stringify(item)}`);
    }
    expectEarned(score);
  });
  await page.context().close();
  await station.stop();
  rmSync(folder, { recursive: true });
}
