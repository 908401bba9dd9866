// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Bones mended on a scan's page: split and cut by a line, renamed, filled, taken away and found again from a dab;
// HU of a circle; a file that is dropped; cases of one title.
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { gunzipSync } from "node:zlib";
import { expectAccessible } from "./accessibility.mjs";
import { check, expect } from "./checks.mjs";

const PISIFORM = 6;

const reads = (page, what) =>
  page.locator(".scan-reading", { hasText: what }).waitFor();
const says = (page, what) =>
  page.locator(".scan-said", { hasText: what }).waitFor();
const surfacesSay = (page, what) =>
  page.locator(".scan-surfaces", { hasText: what }).waitFor();
const told = (page, what) =>
  page.locator(".scan-told", { hasText: what }).waitFor();
const becomes = (page) => page.getByLabel("It becomes");
const list = (page, bone) => page.locator(`[data-bone=${bone}]`);
const picture = (page, plane) =>
  page.locator(`.scan-panel.${plane} canvas`);

async function take(page, bone, plane) {
  await list(page, bone).click();
  await picture(page, plane).focus();
  await page.keyboard.press("Escape");
}

async function times(page, count, key) {
  for (let i = 0; i < count; ++i) await page.keyboard.press(key);
}

/** Pixels in the colour of what is laid over a slice. */
function drawnOn(page, plane) {
  return page.evaluate((name) => {
    const canvas = document.querySelector(`.scan-panel.${name} canvas`);
    const { data } = canvas
      .getContext("2d")
      .getImageData(0, 0, canvas.width, canvas.height);
    let count = 0;
    for (let i = 0; i < data.length; i += 4)
      if (
        data[i] > 200 &&
        data[i + 1] - data[i + 2] > 60 &&
        data[i] - data[i + 1] > 20
      )
        ++count;
    return count;
  }, plane);
}

async function cutsAndSplits(page) {
  await take(page, "hamate", "coronal");
  await page.keyboard.press("k");
  await times(page, 2, "Shift+ArrowLeft");
  await page.keyboard.press("Enter");
  await says(page, "first end");
  await times(page, 4, "Shift+ArrowRight");
  await page.keyboard.press("Enter");
  await says(page, "Choose what");
  // Below the line, walking to the right: what is to go.
  await times(page, 2, "Shift+ArrowLeft");
  await times(page, 2, "ArrowDown");
  await page.keyboard.press("Enter");
  await reads(page, "Hamate");
  await becomes(page).selectOption("No bone");
  await says(page, "Cut here");
  await expectAccessible(page);
  await reads(page, "Hamate");
  await picture(page, "coronal").focus();
  await page.keyboard.press("Enter");
  await reads(page, "no bone");
  await told(page, /^\d+ mm³ of Hamate is no bone now/);
  await page.keyboard.press("z");
  await reads(page, "Hamate");
  await becomes(page).selectOption("Scaphoid, distal part (not there)");
  const box = await picture(page, "coronal").boundingBox();
  const [x, y] = [box.x + box.width / 2, box.y + box.height / 2];
  const before = await drawnOn(page, "coronal");
  const beside = await drawnOn(page, "sagittal");
  await page.mouse.move(x - 60, y);
  await page.mouse.down();
  await page.mouse.move(x + 60, y, { steps: 3 });
  await page.waitForTimeout(100);
  const now = await drawnOn(page, "coronal");
  expect(now > before + 150, `the line has ${now - before} pixels`);
  const dashed = (await drawnOn(page, "sagittal")) - beside;
  expect(dashed > 50, `in the next picture it has ${dashed}`);
  await page.mouse.up();
  await told(page, "of Hamate is Scaphoid, distal part now");
  await list(page, "scaphoid_proximal").waitFor();
  await list(page, "scaphoid_distal").getByText("by hand").waitFor();
  await page.keyboard.press("z");
  await list(page, "scaphoid_distal").getByText("if broken").waitFor();
  // Beside the bone: nothing is renamed.
  await picture(page, "coronal").focus();
  await becomes(page).selectOption("Radius");
  await page.mouse.move(box.x + 20, box.y + 60);
  await page.mouse.down();
  await page.mouse.move(box.x + 20, box.y + 160, { steps: 3 });
  await page.mouse.up();
  await told(page, "nothing was cut");
}

async function renames(page) {
  await take(page, "pisiform", "axial");
  await page.getByRole("button", { name: "Rename or merge" }).click();
  await says(page, "Choose first");
  await becomes(page).selectOption("Triquetrum");
  await page.getByRole("button", { name: "Merge" }).click();
  await told(page, /^Pisiform, \d+ mm³, is part of Triquetrum now/);
  await list(page, "pisiform").getByText("gone").waitFor();
  await picture(page, "axial").focus();
  await reads(page, "Triquetrum");
  await page.keyboard.press("z");
  await reads(page, "Pisiform");
}

async function fills(page) {
  await take(page, "capitate", "axial");
  await page.keyboard.press("e");
  await page.keyboard.press("Enter");
  await reads(page, "no bone");
  await page.keyboard.press("f");
  await reads(page, "Capitate");
  await told(page, "of hollows in Capitate are filled");
  // The surface comes when it comes: what is asked of a person stays.
  await page.keyboard.press("k");
  await surfacesSay(page, /Capitate.*surface made anew/);
  await says(page, "Drag a line");
  await page.keyboard.press("k");
  await page.keyboard.press("f");
  await told(page, "Capitate has no hollow");
}

/** Takes it away whole, takes the missing bone in hand and finds it again from one dab. */
async function findsAgain(page, station) {
  await take(page, "pisiform", "axial");
  await becomes(page).selectOption("No bone");
  await page.getByRole("button", { name: "Take all of it away" }).click();
  await reads(page, "no bone");
  await list(page, "pisiform").getByText("gone").waitFor();
  await list(page, "hamate").click();
  await list(page, "pisiform").click();
  await says(page, "has no voxels any more. It is in hand: mark it");
  // The crosshair stays where it was: a missing bone has no place.
  await reads(page, "Hamate");
  await picture(page, "axial").focus();
  await page.keyboard.press("z");
  await list(page, "pisiform").click();
  await reads(page, "Pisiform");
  await picture(page, "axial").focus();
  await page.keyboard.press("y");
  await page.keyboard.press("a");
  await page.keyboard.press("Enter");
  await reads(page, "Pisiform");
  await page.keyboard.press("z");
  await reads(page, "no bone");
  // At once: what was taken away before is not what is marked.
  await page.keyboard.press("w");
  await page.keyboard.press("Enter");
  await surfacesSay(page, /border/);
  await surfacesSay(page, /Pisiform.*surface made anew/);
  const saved = page.waitForEvent("download");
  await page.keyboard.press("s");
  const now = gunzipSync(readFileSync(await (await saved).path()));
  const was = gunzipSync(
    readFileSync(join(station.caseFolder, "labels.nii.gz")),
  );
  let [both, found, all] = [0, 0, 0];
  for (let i = 352; i < was.length; ++i) {
    const [a, b] = [was[i] === PISIFORM, now[i] === PISIFORM];
    if (a && b) ++both;
    all += Number(a);
    found += Number(b);
  }
  const dice = (2 * both) / (all + found);
  const figures = `Dice ${dice.toFixed(3)}, ${found} of ${all} voxels`;
  console.log(`     from one dab: ${figures}`);
  expect(dice > 0.85, figures);
}

async function measuresRegion(page) {
  await take(page, "capitate", "axial");
  await page.keyboard.press("r");
  await page.keyboard.press("Enter");
  await page.keyboard.press("Shift+ArrowRight");
  await page.keyboard.press("Enter");
  await says(
    page,
    /Circle of radius 3\.0 mm: mean \d+ HU, SD \d+ HU, \d{2,} voxels/,
  );
  const box = await picture(page, "axial").boundingBox();
  const [x, y] = [box.x + box.width / 2, box.y + box.height / 2];
  const before = await drawnOn(page, "axial");
  await page.mouse.move(x - 60, y - 60);
  await page.mouse.down();
  await page.mouse.move(x - 20, y - 60, { steps: 3 });
  await page.waitForTimeout(100);
  const more = (await drawnOn(page, "axial")) - before;
  expect(more > 150, `the circle has ${more} pixels while it is dragged`);
  await page.mouse.up();
  await says(page, /Circle of radius (?!3\.0)[\d.]+ mm/);
  await page.keyboard.press("Backspace");
  await page.keyboard.press("Backspace");
  await page.keyboard.press("Escape");
}

/** A file let go over the pictures. */
function drop(page, name, bytes) {
  return page.evaluate(
    ([called, content]) => {
      const brought = new DataTransfer();
      brought.items.add(new File([new Uint8Array(content)], called));
      document
        .querySelector(".scan-pictures")
        .dispatchEvent(
          new DragEvent("drop", {
            dataTransfer: brought,
            bubbles: true,
            cancelable: true,
          }),
        );
    },
    [name, bytes],
  );
}

async function dropsFiles(page) {
  const dialog = page.locator("dialog.new-case[open]");
  const refused = dialog.getByRole("alert");
  await drop(page, "notes.txt", [1, 2, 3]);
  await refused.filter({ hasText: "There is no scan in it." }).waitFor();
  await page.keyboard.press("Escape");
  await dialog.waitFor({ state: "detached" });
  // Goes to the host, which says what is wrong with it.
  await drop(page, "ct.nii", [1, 2, 3]);
  await refused.filter({ hasText: /ct|volume|NIfTI|nii/i }).waitFor();
  const why = await refused.textContent();
  expect(!why.includes("There is no scan in it"), `it says '${why}'`);
  await page.keyboard.press("Escape");
  await dialog.waitFor({ state: "detached" });
}

async function tellsCasesApart(page, station) {
  const cases = await (await fetch(`${station.url}/api/cases`)).json();
  const [one] = cases.cases;
  const alike = [one, { ...one, id: "another" }];
  await page.route("**/api/cases", (route) =>
    route.fulfill({ json: { ...cases, cases: alike } }),
  );
  page.once("dialog", (asked) => asked.accept());
  await page.reload();
  const options = page.getByLabel("Case", { exact: true }).locator("option");
  await options.first().waitFor({ state: "attached" });
  const titles = await options.allTextContents();
  expect(
    titles.length === 2 &&
      titles[0] !== titles[1] &&
      titles[1].endsWith("(another)"),
    `it offers ${JSON.stringify(titles)}`,
  );
  await page.unroute("**/api/cases");
}

/** For a picture of it: HU in the capitate, and the hamate about to be cut. */
export async function showMending(page) {
  await page.locator(".scan-reading:not(:empty)").waitFor();
  await take(page, "hamate", "coronal");
  await times(page, 4, "+");
  const drag = async (key, plane, from, to) => {
    await page.keyboard.press(key);
    const box = await picture(page, plane).boundingBox();
    const [x, y] = [box.x + box.width / 2, box.y + box.height / 2];
    await page.mouse.move(x + from[0], y + from[1]);
    await page.mouse.down();
    await page.mouse.move(x + to[0], y + to[1], { steps: 3 });
    await page.mouse.up();
  };
  await drag("r", "axial", [0, 0], [24, 8]);
  await drag("k", "coronal", [-60, 20], [60, 50]);
  await page.mouse.move(5, 5);
  await page.waitForTimeout(2500);
}

/** On a page that shows a whole case's scan. */
export async function mendsScan(page, station) {
  await check(page, "a bone is cut and split by lines that are seen", () =>
    cutsAndSplits(page),
  );
  await check(page, "a bone becomes part of another", () => renames(page));
  await check(page, "a hollow is filled", () => fills(page));
  await check(page, "a missing bone is taken in hand and found", () =>
    findsAgain(page, station),
  );
  await check(page, "HU are measured in a circle", () => measuresRegion(page));
  await check(page, "a file that is dropped is taken or refused", () =>
    dropsFiles(page),
  );
  await check(page, "cases of one title are told apart", () =>
    tellsCasesApart(page, station),
  );
}
