// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The review room: curves of what is in the records, filtered, beside others, and out as files.
import { readFileSync } from "node:fs";
import { expectAccessible } from "./accessibility.mjs";
import { check, expect } from "./checks.mjs";

/** A class that learns, as the station would list it; nobody waits for so many operations here. */
function classOf() {
  const attempts = [];
  const add = (trainee, overall, device = "mouse") =>
    attempts.unshift({
      id: attempts.length + 1,
      trainee,
      case: "demo wrist",
      case_fingerprint: "0",
      case_simulated: true,
      procedure: "dorsal_scaphoid_fixation",
      mode: "practice",
      input_device: device,
      started_at: "2026-11-02T10:00:00Z",
      ended_at: "2026-11-02T10:10:00Z",
      outcome: "finished",
      overall,
      duration_s: 600,
      state_hash: "0",
    });
  add("scripted expert 1", 92, "script");
  for (let i = 0; i < 8; ++i) {
    add("Bela", 30 + 4 * i);
    add("Cleo", 40 + 5 * i);
    add("Ada", i < 2 ? 0 : 35 + 6 * i);
  }
  return attempts;
}

export async function reviewClass(page, station) {
  await page.route(/\/api\/attempts(\?|$)/, (route) => {
    const attempts = classOf();
    return route.fulfill({
      json: { attempts, older: false, total: attempts.length },
    });
  });
  await check(
    page,
    "the learning curve shows one trainee beside the others",
    async () => {
      await page.goto(`${station.url}/#/review`);
      await page.locator(".curve").nth(1).waitFor();
      expect(
        (await page.locator(".curve-failed").count()) >= 2,
        "failures are not marked",
      );
      expect(
        (await page.locator(".curve-group").count()) === 1,
        "no band of the others",
      );
      const rows = await page
        .locator(".review-compare tbody th")
        .allTextContents();
      expect(
        rows.includes("Scripted expert, in silico"),
        `compared with ${rows.join()}`,
      );
      await expectAccessible(page, 6);
    },
  );
  await check(
    page,
    "a filter acts at once, and what is shown leaves as CSV",
    async () => {
      await page
        .locator(".review-filter select[name=trainee]")
        .selectOption("Bela");
      await page.getByRole("heading", { name: "Bela" }).waitFor();
      const [download] = await Promise.all([
        page.waitForEvent("download"),
        page.getByRole("button", { name: "CSV" }).click(),
      ]);
      const lines = readFileSync(await download.path(), "utf8")
        .trim()
        .split("\r\n");
      expect(lines.length === 9, `${lines.length} lines for 8 attempts`);
      await page
        .locator(".review-filter select[name=mode]")
        .selectOption("assessed");
      await page.getByText("No attempt is like that.").waitFor();
    },
  );
  await page.unroute(/\/api\/attempts(\?|$)/);
}
