// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// From a scan to a case and on to a mended one, all on the page: a zip of a blurred scan is brought, the bones to be
// checked are found with their reasons, one is painted, taken back and painted again, run again as a new version, which
// is reopened and operated on. What nobody touched stays to be checked. A station of its own, whose cases end with it.
import { execFileSync } from "node:child_process";
import {
  mkdirSync,
  mkdtempSync,
  readdirSync,
  readFileSync,
  rmSync,
  writeFileSync,
} from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { expectAccessible } from "./accessibility.mjs";
import { newPage } from "./browser.mjs";
import { check, expect } from "./checks.mjs";
import { Operator } from "./operator.mjs";
import { program, startStation } from "./station.mjs";

/** A case takes ten seconds where the machine is free, and minutes where it is not. */
const MADE_MS = 540_000;

const THICK = 12;

/** The first slices of a series as another one: its UID ends otherwise. */
function anotherSeries(from, to) {
  mkdirSync(to);
  for (const name of readdirSync(from).sort().slice(0, THICK)) {
    const bytes = readFileSync(join(from, name));
    // (0020,000E), UI, two bytes of length.
    const at = bytes.indexOf(Buffer.from([0x20, 0, 0x0e, 0, 0x55, 0x49]));
    const length = bytes.readUInt16LE(at + 6);
    let last = at + 8 + length - 1;
    if (bytes[last] === 0) --last;
    bytes[last] = bytes[last] === 0x31 ? 0x32 : 0x31;
    writeFileSync(join(to, name), bytes);
  }
}

/** As a person has it who was given a disc: two series, of which one is the scan. Its kernel was so smooth that some
 * bones are doubtful. */
function zipped(folder) {
  const file = join(folder, "disc.zip");
  const simulated = ["phantom", "--out", join(folder, "ct"), "--seed", "1", "--fracture", "waist"];
  execFileSync(program(), [...simulated, "--with", "smooth_kernel", "--severity", "1"], { stdio: "ignore" });
  const dicom = join(folder, "ct", "dicom");
  anotherSeries(dicom, join(folder, "other"));
  execFileSync("python3", ["-m", "zipfile", "-c", file, dicom, join(folder, "other")]);
  return file;
}

/** The bones of the case on the page that are to be checked, by name: why. */
async function doubtful(page, station) {
  const id = decodeURIComponent(page.url().split("/").at(-1));
  const told = await (await fetch(`${station.url}/api/cases/${id}/scan/trust.json`)).json();
  return new Map(told.bones.filter((bone) => bone.flagged).map((bone) => [bone.name, bone.why]));
}

/** As the page says it: only those that are to be checked, each with its reason. */
async function saysWhy(page, doubts) {
  const badges = page.locator(".scan-bone:has(.badge)");
  await badges.nth(doubts.size - 1).waitFor();
  const names = await badges.evaluateAll((all) => all.map((one) => one.dataset.bone));
  expect(names.sort().join() === [...doubts.keys()].sort().join(), `it is said of ${names}, not ${[...doubts.keys()]}`);
  for (const [name, why] of doubts) {
    const said = await page.locator(`li:has(> [data-bone=${name}]) .scan-why`).innerText();
    expect(said === why && why.length > 20, `of ${name} it says '${said}', not '${why}'`);
  }
}

async function shot(page, name) {
  const folder = process.env.CARPUS_SHOTS;
  if (folder === undefined) return;
  mkdirSync(folder, { recursive: true });
  await page.screenshot({ path: join(folder, `${name}.png`) });
}

async function bringAndMend(page, station, zip) {
  const dialog = page.locator("dialog.new-case[open]");
  const brought = await check(page, "a zip becomes a case", async () => {
    await page.goto(`${station.url}/#/scan`);
    await page.getByRole("button", { name: "Add a scan…" }).click();
    await dialog.waitFor();
    await expectAccessible(page, 4);
    await shot(page, "new_case_choice");
    await dialog.getByLabel("What the case is called").fill("From the disc");
    await dialog.locator('input[type=file]:not([webkitdirectory])').setInputFiles(zip);
    await dialog.locator(".new-case-note", { hasText: "%" }).waitFor();
    await shot(page, "new_case_progress");
    const series = dialog.locator(".new-case-series");
    await series.first().waitFor({ timeout: MADE_MS });
    await expectAccessible(page, 4);
    await shot(page, "new_case_series");
    const offered = await series.allInnerTexts();
    expect(
      offered.length === 2 && offered[1].includes(`${THICK} slices, voxels of`),
      `it offers ${JSON.stringify(offered)}`,
    );
    await page.keyboard.press("Enter");
    await dialog.getByRole("link", { name: "Look at it" }).click({ timeout: MADE_MS });
    await page.locator(".scan-heading", { hasText: "From the disc" }).waitFor({ timeout: 30_000 });
  });
  if (!brought) return;
  let doubts = new Map();
  await check(page, "the bones to be checked are found, each with its reason", async () => {
    doubts = await doubtful(page, station);
    expect(doubts.size >= 2 && doubts.size <= 8, `${doubts.size} bones are to be checked`);
    expect(doubts.has("capitate"), `the capitate is not among ${[...doubts.keys()]}`);
    await saysWhy(page, doubts);
    await page.locator(".scan-bone:has(.badge)[data-bone=capitate]").click();
    await page.locator(".scan-reading", { hasText: "Capitate" }).waitFor();
    await expectAccessible(page, 10);
    await shot(page, "scan_doubtful");
  });
  await check(page, "bringing can be given up, and leaves nothing", async () => {
    await page.getByRole("button", { name: "Add a scan…" }).click();
    await dialog.locator('input[type=file]:not([webkitdirectory])').setInputFiles(zip);
    await dialog.locator(".new-case-note", { hasText: "%" }).waitFor();
    await dialog.getByRole("button", { name: "Cancel" }).click();
    await dialog.waitFor({ state: "detached" });
    const { cases } = await (await fetch(`${station.url}/api/cases`)).json();
    expect(cases.length === 2, `${cases.length} cases`);
  });
  await check(page, "what is painted or marked is shown as a surface at once", async () => {
    const MAKING = "Making the surface anew";
    const said = page.locator(".scan-surfaces");
    const anew = async (what, first) => {
      await said.filter({ hasText: first }).waitFor();
      await said.filter({ hasText: /Hamate.*: surface made anew in [\d.]+ s/ }).waitFor({ timeout: 60_000 });
      const seconds = Number(/in ([\d.]+) s/.exec(await said.textContent())[1]);
      console.log(`     ${what}: ${seconds} s`);
      await page.waitForTimeout(300);
      return page.locator(".scan-panel.bones").screenshot();
    };
    await page.locator("[data-bone=hamate]").click();
    await page.locator(".scan-panel.coronal canvas").focus();
    const before = await page.locator(".scan-panel.bones").screenshot();
    for (let i = 0; i < 5; ++i) await page.keyboard.press("Shift+ArrowRight");
    await page.keyboard.press("a");
    await page.keyboard.press(".");
    await page.keyboard.press("Enter");
    const painted = await anew("painted", MAKING);
    expect(!painted.equals(before), "the picture of the bones is the same");
    await shot(page, "scan_painted_surface");
    await page.keyboard.press("z");
    await anew("taken back", MAKING);
    await page.keyboard.press("w");
    await page.keyboard.press("Enter");
    await anew("marked", "Looking for the bone's border");
    await shot(page, "scan_marked_surface");
    await page.keyboard.press("z");
    await anew("taken back, with what the marker found", MAKING);
    await page.keyboard.press("Escape");
  });
  const mended = await check(page, "a bone is painted and run again as a new version", async () => {
    await page.locator("[data-bone=capitate]").click();
    await page.locator(".scan-panel.axial canvas").focus();
    await page.keyboard.press("e");
    await page.keyboard.press("Enter");
    await page.locator(".scan-reading", { hasText: "no bone" }).waitFor();
    await page.keyboard.press("z");
    await page.locator(".scan-reading", { hasText: "Capitate" }).waitFor();
    await page.keyboard.press("y");
    await page.locator(".scan-reading", { hasText: "no bone" }).waitFor();
    await page.keyboard.press("g");
    await dialog.getByRole("link", { name: "Look at it" }).click({ timeout: MADE_MS });
    await page
      .locator(".scan-heading", { hasText: "From the disc, version" })
      .waitFor({ timeout: 30_000 });
    await shot(page, "new_case_version");
    const { cases } = await (await fetch(`${station.url}/api/cases`)).json();
    const id = decodeURIComponent(page.url().split("/").at(-1));
    expect(cases.some((one) => one.id === id), `'${id}' is not in the list`);
    const told = await (await fetch(`${station.url}/api/cases/${id}/scan/case.json`)).json();
    const said = told.provenance.conventions.filter((text) => /corrected by a person, capitate/.test(text));
    expect(said.length === 1, `it says ${JSON.stringify(told.provenance.conventions)}`);
  });
  if (!mended) return;
  await check(page, "of bones that nobody touched the new version says the same", async () => {
    const now = await doubtful(page, station);
    await saysWhy(page, now);
    for (const doubt of [doubts, now]) doubt.delete("capitate");
    expect(doubts.size >= 1, "there is no other bone");
    expect(JSON.stringify([...now]) === JSON.stringify([...doubts]), `it says ${JSON.stringify([...now])}`);
  });
  await check(page, "one press leads back to the version before, and to this one", async () => {
    const id = decodeURIComponent(page.url().split("/").at(-1));
    await page.getByRole("link", { name: "Back to the version before" }).click();
    await page.locator(".scan-heading p", { hasText: /^From the disc · / }).waitFor();
    await page.goBack();
    await page.locator(".scan-heading", { hasText: "From the disc, version" }).waitFor();
    expect(page.url().endsWith(`/${id}`), `it is at ${page.url()}`);
  });
  await check(page, "the new version is operated on", async () => {
    const id = decodeURIComponent(page.url().split("/").at(-1));
    await page.getByRole("link", { name: "Operate" }).click();
    await page.locator("dialog.start button[type=submit]:not([disabled])").waitFor();
    await shot(page, "new_case_list");
    const { cases } = await (await fetch(`${station.url}/api/cases`)).json();
    const flagged = cases.find((one) => one.id === id).flagged;
    expect(flagged.length > 0, "its card knows of nothing to be checked");
    await page.locator(`.case-card[data-case="${id}"]`, { hasText: /Check .* on its scan/ }).waitFor();
    const picture = page.locator(`.case-card[data-case="${id}"] img`);
    await picture.waitFor();
    const pixels = await picture.evaluate((image) => image.decode().then(() => image.naturalWidth));
    expect(pixels > 100, `its picture is ${pixels} pixels wide`);
    await page.locator(`.case-card[data-case="${id}"]`).click();
    await page.locator(`.case-card[data-case="${id}"][aria-current=true]`).waitFor({ timeout: 30_000 });
    const operator = new Operator(page);
    await operator.start(station.url, "Browser test, new case", "dorsal_scaphoid_fixation");
    await operator.until((s) => s.tick > 100, "ticks on the new case");
  });
}

export async function addsCases(browser) {
  const folder = mkdtempSync(join(tmpdir(), "carpus-new-case-"));
  const station = await startStation();
  const page = await newPage(browser);
  try {
    await bringAndMend(page, station, zipped(folder));
  } finally {
    await page.close();
    await station.stop();
    rmSync(folder, { recursive: true, force: true });
  }
}
