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

const figure = (id, value) => ({
  id,
  label: `Figure ${id}`,
  value,
  unit: "mm",
  target: "at most 1 mm good, over 3 mm fails",
  grade: value <= 1 ? "good" : "fail",
  points: 0,
  points_possible: 1,
  reason: "Made up for a test.",
});

/** The report of one of them, but for what it measured an attempt that really was. */
async function reportOf(summary, station) {
  const real = await (await fetch(`${station.url}/api/attempts/1`)).json();
  const value = summary.input_device === "script" ? 0.2 : 4 - 0.1 * summary.id;
  const items = [figure("wire_mm", value), figure("unmeasured_mm", null)];
  return { ...real, ...summary, score: { ...real.score, items } };
}

export async function reviewClass(page, station) {
  await page.route(/\/api\/attempts\/\d+$/, async (route) => {
    const id = Number(route.request().url().split("/").at(-1));
    const summary = classOf().find((attempt) => attempt.id === id);
    return route.fulfill({ json: await reportOf(summary, station) });
  });
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
        page.getByRole("button", { name: "CSV", exact: true }).click(),
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
  await check(
    page,
    "each figure stands beside one's past, the others, the expert and what is good",
    async () => {
      await page
        .locator(".review-filter select[name=mode]")
        .selectOption("");
      const rows = page.locator(".figure-table tbody tr");
      await rows.first().waitFor();
      expect((await rows.count()) === 1, "a figure nobody measured has a row");
      const row = await rows.first().innerText();
      expect(row.includes("0.2 mm"), `the expert is not in '${row}'`);
      for (const [part, count] of [
        ["strip-last", 1],
        ["strip-own", 7],
        ["strip-group", 1],
        ["strip-expert", 1],
        ["strip-band", 1],
      ])
        expect(
          (await rows.locator(`.${part}`).count()) === count,
          `not ${count} of ${part}`,
        );
      await expectAccessible(page, 6);
    },
  );
  await page.unroute(/\/api\/attempts(\?|$)/);
  await page.unroute(/\/api\/attempts\/\d+$/);
}
