// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// From a scan to a case and on to a mended one, all on the page: a zip is brought, the bone to be checked is found,
// painted, taken back and painted again, run again as a new version, reopened and operated on. A station of its own,
// whose cases end with it. Needs CARPUS_CT, a folder with a simulated CT.
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
import { root, startStation } from "./station.mjs";

const CT = process.env.CARPUS_CT ?? join(root, "build/system/demo_ct");
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

/** As a person has it who was given a disc: two series, of which one is the scan. */
function zipped(folder) {
  const file = join(folder, "disc.zip");
  anotherSeries(join(CT, "dicom"), join(folder, "other"));
  execFileSync("python3", ["-m", "zipfile", "-c", file, join(CT, "dicom"), join(folder, "other")]);
  return file;
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
    const said = page.locator(".scan-said");
    const anew = async (what) => {
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
    const painted = await anew("painted");
    expect(!painted.equals(before), "the picture of the bones is the same");
    await shot(page, "scan_painted_surface");
    await page.keyboard.press("z");
    await said.filter({ hasText: "Making the surface anew" }).waitFor();
    await anew("taken back");
    await page.keyboard.press("w");
    await page.keyboard.press("Enter");
    await anew("marked");
    await shot(page, "scan_marked_surface");
    await page.keyboard.press("z");
    await said.filter({ hasText: "Making the surface anew" }).waitFor();
    await anew("taken back, with what the marker found");
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
