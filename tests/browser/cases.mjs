// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Several cases at one station: what their cards say in either way to operate, going from one to
// another, and declining where that is the right answer. The cases are the demo twice, each with a
// lesson of its own.
import { cpSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { expectAccessible } from "./accessibility.mjs";
import { newPage } from "./browser.mjs";
import { check, expect } from "./checks.mjs";
import { Operator } from "./operator.mjs";
import { demoCase, startStation } from "./station.mjs";

const lesson = (title, overall, more) => ({
  format: "carpus lesson",
  schema_version: 2,
  title,
  history: `Told by patient ${overall}.`,
  goal: `Learn from ${title}.`,
  size: "average",
  reason: `Because it is: ${title}.`,
  difficulty: {
    corridor_clearance_mm: 1,
    corridor_length_mm: 20,
    smaller_part_mm: 9,
    gap_mm: 0.5,
    step_mm: 0,
    flexion_deg: 0,
    overall,
  },
  ...more,
});

/** As a reconstruction says it that doubts one bone, and the scan. */
function doubt(caseFolder, bone, why, ofScan) {
  const file = join(caseFolder, "trust.json");
  const trust = JSON.parse(readFileSync(file, "utf8"));
  const line = trust.bones.find(({ name }) => name === bone);
  Object.assign(line, { confidence: 0.2, flagged: true, why });
  trust.of_scan = [ofScan];
  writeFileSync(file, JSON.stringify(trust));
}

/** The demo again is another wrist, by its name and by as much as tells cases apart. */
function makeAnother(caseFolder, pseudonym) {
  const file = join(caseFolder, "case.json");
  const described = JSON.parse(readFileSync(file, "utf8"));
  described.pseudonym = pseudonym;
  described.scaphoid.waist_mm[0] += 0.01;
  writeFileSync(file, JSON.stringify(described));
}

function twoCases() {
  const folder = mkdtempSync(join(tmpdir(), "carpus-cases-"));
  const put = (name, what) => {
    cpSync(demoCase(), join(folder, name), { recursive: true });
    writeFileSync(join(folder, name, "lesson.json"), JSON.stringify(what));
  };
  put("easy", lesson("Easy one", 20, { right_answer: "fix" }));
  doubt(join(folder, "easy"), "hamate", "a leak across a joint", "the wrist is small");
  put(
    "humpback",
    lesson("Old humpback", 70, {
      right_answer: "decline",
      decline_for: ["flexed", "bone_lost"],
    }),
  );
  makeAnother(join(folder, "humpback"), "old wrist");
  return folder;
}

const ready = (page) =>
  page.locator("dialog.start button[type=submit]:not([disabled])").waitFor();

async function chooseAndDecline(page, station) {
  const card = (id) => page.locator(`.case-card[data-case=${id}]`);
  await check(page, "cards show the cases, easiest first", async () => {
    await page.goto(station.url);
    await ready(page);
    await page.check("input[name=mode][value=practice]");
    const texts = await page.locator(".case-card").allTextContents();
    expect(texts.length === 2, `${texts.length} cards`);
    expect(texts[0].includes("Easy one"), `the first says '${texts[0]}'`);
    expect(
      texts[1].includes("Old humpback") &&
        texts[1].includes("Difficulty 70 of 100") &&
        texts[1].includes("Learn from"),
      `the second says '${texts[1]}'`,
    );
    await expectAccessible(page, 4);
  });
  await check(page, "a bone in doubt is found from the card on its scan", async () => {
    const said = await card("easy").innerText();
    expect(/Check .*hamate/i.test(said), `the card says '${said}'`);
    expect(said.includes("The wrist is small."), `the card says '${said}' of the scan`);
    const above = await page.locator(".start-facts ~ p.case-card-doubt:visible").allInnerTexts();
    expect(above.includes("The wrist is small."), `above Start it says '${above.join("; ")}'`);
    await page.getByRole("link", { name: "Scan", exact: true }).click();
    const flagged = page.locator("[data-bone=hamate]", { hasText: "look here" });
    await flagged.waitFor();
    await page.locator(".scan-why", { hasText: "a leak across a joint" }).waitFor();
    // One is there from the start, and comes back from elsewhere.
    await page.locator(".scan-reading", { hasText: "Hamate" }).waitFor();
    await page.locator("[data-bone=capitate]").click();
    await page.locator(".scan-reading", { hasText: "Capitate" }).waitFor();
    await flagged.click();
    await page.locator(".scan-reading", { hasText: "Hamate" }).waitFor();
    await page.locator(".scan-said", { hasText: "a leak across a joint" }).waitFor();
    await page.goBack();
    await ready(page);
  });
  await check(page, "whoever is assessed is told no diagnosis", async () => {
    await page.check("input[name=mode][value=assessed]");
    const said = await page.locator("dialog.start").innerText();
    for (const told of ["humpback", "Learn from", "in 2 parts", "fracture waist"])
      expect(!said.includes(told), `the start says '${told}'`);
    expect(said.includes("Told by patient 70."), "the history is not told");
  });
  await check(page, "another case opens, and the page goes with it", async () => {
    await card("humpback").click();
    await page
      .locator(".case-card[data-case=humpback][aria-current=true]")
      .waitFor();
    await ready(page);
    const { open } = await (await fetch(`${station.url}/api/cases`)).json();
    expect(open === "humpback", `'${open}' is open`);
  });
  const operator = new Operator(page);
  await check(page, "one declines, with reasons, after looking", async () => {
    await operator.start(
      station.url,
      "Browser test, cases",
      "volar_scaphoid_fixation",
      "assessed",
    );
    for (const key of ["1", "2"]) await operator.shot(key);
    await page.keyboard.press("Delete");
    const dialog = page.locator("dialog.decline[open]");
    await dialog.waitFor();
    const yes = dialog.getByRole("button", { name: "Decline and end" });
    expect(await yes.isDisabled(), "it can be declined without a reason");
    await expectAccessible(page, 4);
    await dialog.getByLabel(/humpback/).check();
    await dialog.getByLabel(/Bone is lost/).check();
    await yes.click();
    await page.locator(".verdict", { hasText: "Declined, rightly" }).waitFor();
    const verdict = await page.locator(".verdict").innerText();
    expect(verdict.startsWith("100"), `the verdict says '${verdict}'`);
    expect(verdict.includes("Because it is"), "the lesson is not told afterwards");
  });
  await check(page, "an attempt of a case that is not open leads to it, and to its replay", async () => {
    const attempt = /#\/attempts\/(\d+)$/.exec(page.url())[1];
    await page.goto(`${station.url}/#/`);
    await ready(page);
    await card("easy").click();
    await page.locator(".case-card[data-case=easy][aria-current=true]").waitFor();
    await ready(page);
    await page.goto(`${station.url}/#/attempts/${attempt}`);
    await page.getByRole("link", { name: "Open its case" }).waitFor();
    await page.goto(`${station.url}/#/replay/${attempt}`);
    await page.locator("[role=alert]", { hasText: "made on another case" }).waitFor();
    await page.getByRole("link", { name: "Open its case, old wrist" }).click();
    await page.waitForURL(`**/#/replay/${attempt}`);
    await page.waitForFunction(() => window.carpusReplay?.ticks()[0] !== undefined);
    const { open } = await (await fetch(`${station.url}/api/cases`)).json();
    expect(open === "humpback", `'${open}' is open`);
  });
}

export async function chooseAmongCases(browser) {
  const folder = twoCases();
  const station = await startStation(["--open"], folder);
  const page = await newPage(browser);
  try {
    await chooseAndDecline(page, station);
  } finally {
    await page.close();
    await station.stop();
    rmSync(folder, { recursive: true, force: true });
  }
}
