// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// How bones look is a person's to change, and stays as it was left.
import { newPage } from "./browser.mjs";
import { check, expect } from "./checks.mjs";
import { Operator } from "./operator.mjs";

/** Of the theatre's pixels, by a grid of them: enough to tell one look from another. */
async function shown(page) {
  await page.waitForTimeout(200);
  return (await page.locator(".stage canvas").first().screenshot()).toString(
    "base64",
  );
}

export async function changesTheLook(browser, station) {
  const page = await newPage(browser);
  const operator = new Operator(page);
  await check(
    page,
    "materials, lamps, bitmaps, facets and hulls are changed and kept",
    async () => {
      await operator.start(station.url, "Browser test, look");
      await page.getByRole("button", { name: "Pause" }).click();
      await page.getByRole("button", { name: "Look", exact: true }).click();
      const panel = page.getByRole("region", { name: "Appearance" });
      const before = await shown(page);
      expect((await shown(page)) === before, "it moves by itself");
      for (const what of ["texture", "facets", "hulls"]) {
        const was = await shown(page);
        await panel.locator(`#look-${what}`).click();
        expect((await shown(page)) !== was, `${what} changes nothing`);
        await panel.locator(`#look-${what}`).click();
      }
      await panel.getByLabel("Transparency").fill("0.6");
      await panel.getByLabel("How many").fill("3");
      await panel.getByLabel("Lamp 3", { exact: true }).nth(0).waitFor();
      const changed = await shown(page);
      expect(changed !== before, "a clear bone looks as an opaque one");
      await panel.getByRole("button", { name: "Close" }).click();
      await page.reload();
      await page.locator(".stage canvas").first().waitFor();
      // It opens once the station has answered.
      await page.locator("dialog.start[open]").waitFor();
      await page.evaluate(() =>
        document.querySelector("dialog[open]")?.close(),
      );
      await page.getByRole("button", { name: "Look", exact: true }).click();
      expect(
        (await panel.getByLabel("Transparency").inputValue()) === "0.6",
        "it is forgotten",
      );
      await panel.getByRole("button", { name: "As it was at first" }).click();
      expect(
        (await panel.getByLabel("Transparency").inputValue()) === "0",
        "it does not go back",
      );
    },
  );
  await page.close();
}
