// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// An instructor prepares what is wrong in a case, by keyboard alone; a trainee's page has neither the way
// there nor a word of it. With CARPUS_PATHOLOGY_PICTURES a folder for what is seen on the way.
import { cpSync, existsSync, mkdtempSync, readFileSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { expectAccessible } from "./accessibility.mjs";
import { newPage } from "./browser.mjs";
import { check, expect } from "./checks.mjs";
import { printedLink, traineesLink } from "./link.mjs";
import { demoCase, startStation } from "./station.mjs";

const ready = (page) =>
  page.locator("dialog.start button[type=submit]:not([disabled])").waitFor();
const way = (page) => page.getByRole("button", { name: "Pathology…" });
const save = (page) => page.locator("dialog.pathology button[type=submit]");
const said = (page, words) =>
  page.locator(".pathology-note", { hasText: words }).waitFor();

export async function preparesPathology(browser) {
  const folder = mkdtempSync(join(tmpdir(), "carpus-pathology-"));
  const caseFolder = join(folder, "demo");
  cpSync(demoCase(), caseFolder, { recursive: true });
  const file = join(caseFolder, "pathology.json");
  const held = () => JSON.parse(readFileSync(file, "utf8"));
  const station = await startStation([], caseFolder);
  const page = await newPage(browser, {
    viewport: { width: 1280, height: 900 },
  });
  const pictures = process.env.CARPUS_PATHOLOGY_PICTURES;
  const picture = async (name, of = page) => {
    if (pictures !== undefined)
      await of.screenshot({ path: join(pictures, `${name}.png`) });
  };
  try {
    await check(page, "an instructor is told that chance decides", async () => {
      await page.goto(await printedLink(station));
      await ready(page);
      await way(page).waitFor();
      await picture("start");
      await way(page).focus();
      await page.keyboard.press("Enter");
      await said(page, "draws anew");
      await expectAccessible(page, 5);
      await picture("random");
    });
    await check(
      page,
      "grades are chosen by keyboard and kept beside the case",
      async () => {
        await page.getByRole("radio", { name: /At random/ }).focus();
        await page.keyboard.press("ArrowDown");
        await page.keyboard.press("ArrowDown");
        await page.locator("#pathology-scapholunate").waitFor();
        await page.keyboard.press("Tab");
        await page.keyboard.type("III");
        await page.getByLabel(/Triangular fibrocartilage/).focus();
        await page.keyboard.type("1B");
        await said(page, "Not saved yet");
        await picture("chosen");
        await expectAccessible(page, 14);
        await save(page).focus();
        await page.keyboard.press("Enter");
        await said(page, "Saved, from the next examination on.");
        await said(
          page,
          "Scapholunate ligament III, Triangular fibrocartilage 1B",
        );
        await picture("saved");
        const { origin, grades } = held();
        expect(
          origin === "chosen" &&
            JSON.stringify(grades) === '{"scapholunate":"III","disc":"1B"}',
          `the case holds ${JSON.stringify(held())}`,
        );
      },
    );
    await check(
      page,
      "a number draws for everybody, and what is none is not taken",
      async () => {
        await page.getByRole("radio", { name: /By a number/ }).check();
        await page.getByLabel("The number").fill("x");
        await said(page, "whole one");
        expect(await save(page).isDisabled(), "x can be saved");
        await page.getByLabel("The number").fill("7");
        await page.keyboard.press("Enter");
        await said(page, "Drawn by number 7");
        expect(
          held().origin === "seed" && held().seed === 7,
          "another number is kept",
        );
        await picture("number");
      },
    );
    await check(
      page,
      "what a full disk does not take is still there to be saved",
      async () => {
        const put = (route) =>
          route.request().method() === "PUT"
            ? route.fulfill({
                status: 503,
                body: "pathology.json: cannot write the file: No space left on device; free some space and try again. Nothing was changed.",
              })
            : route.continue();
        await page.route("**/api/pathology?*", put);
        await page.getByLabel("The number").fill("8");
        await page.keyboard.press("Enter");
        await said(page, "free some space and try again. Nothing was changed.");
        await picture("full");
        const kept = await page.getByLabel("The number").inputValue();
        expect(kept === "8", `'${kept}' is left of what was entered`);
        expect(held().seed === 7, "the case holds another number");
        await page.unroute("**/api/pathology?*", put);
        await save(page).click();
        await said(page, "Drawn by number 8");
        expect(held().seed === 8, "it is not saved once there is space");
      },
    );
    await check(page, "on a small screen all of it is reached", async () => {
      await page.setViewportSize({ width: 420, height: 720 });
      await page.getByRole("radio", { name: /Chosen/ }).check();
      await page.locator("#pathology-loose_body").scrollIntoViewIfNeeded();
      await picture("small");
      const wide = await page.evaluate(
        () => document.querySelector("dialog.pathology").scrollWidth - 420,
      );
      expect(wide <= 0, `it is ${wide} px too wide`);
      await page.setViewportSize({ width: 1280, height: 900 });
    });
    await check(
      page,
      "who is to be assessed has no way there; the scan has one",
      async () => {
        await page.keyboard.press("Escape");
        await page.locator("dialog.pathology").waitFor({ state: "detached" });
        await page.getByRole("radio", { name: /Assessed/ }).check();
        expect(
          !(await way(page).isVisible()),
          "it is offered before an assessed operation",
        );
        await page.goto(`${station.url}/#/scan`);
        await way(page).waitFor();
        await picture("scan");
      },
    );
    await check(page, "a trainee's page receives nothing of it", async () => {
      const trainee = await newPage(browser);
      const fetched = [];
      trainee.on("request", (request) => fetched.push(request.url()));
      await trainee.goto(traineesLink(station));
      await ready(trainee);
      await trainee.waitForFunction(() =>
        performance
          .getEntriesByName(`${location.origin}/api/pathology`)
          .some((e) => e.responseEnd > 0),
      );
      expect((await way(trainee).count()) === 0, "a trainee is offered it");
      expect(
        !fetched.some((url) => url.includes("pathology?")),
        "its page asks for a case's",
      );
      const asked = await trainee.evaluate(async () => {
        const told = await fetch("/api/pathology?case=demo");
        const put = await fetch("/api/pathology?case=demo", {
          method: "PUT",
          body: JSON.stringify({ origin: "random", seed: null, grades: [] }),
        });
        const may = await (await fetch("/api/pathology")).json();
        return [told.status, put.status, JSON.stringify(may)];
      });
      expect(
        asked.join() ===
          '403,403,{"may_prepare":false,"findings":[],"prepared":null}',
        `a trainee is answered ${asked.join()}`,
      );
      expect(held().seed === 8, "a trainee changed it");
      await trainee.context().close();
    });
    await check(page, "at random again, and the file is gone", async () => {
      await way(page).click();
      await said(page, "Drawn by number 8");
      await page.getByRole("radio", { name: /At random/ }).check();
      await save(page).click();
      await said(page, "draws anew");
      expect(!existsSync(file), "the case still holds one");
    });
  } finally {
    await page.context().close();
    await station.stop();
    rmSync(folder, { recursive: true, force: true });
  }
}
