// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A stored attempt is looked at again: any moment, its pictures, two beside each other; and the report
// tells which views show the screw.
import { expectAccessible } from "./accessibility.mjs";
import { check, expect } from "./checks.mjs";
import { losesGraphics } from "./lost_graphics.mjs";

function shownAt(page, tick) {
  return page.waitForFunction(
    (wanted) => window.carpusReplay?.ticks()[0] === wanted,
    tick,
  );
}

/** The picture with this number is on the monitor, or none where none was taken yet. */
async function expectShot(page, number) {
  const title = page.locator(".replay-monitor .panel-title span");
  await title.filter({ hasText: number === 0 ? /^$/ : new RegExp(`shot ${number}$`) }).waitFor({ state: "attached" });
}

export async function replayAttempt(page, station, id) {
  const attempt = await (
    await fetch(`${station.url}/api/attempts/${id}`)
  ).json();
  const length = Math.round(attempt.duration_s * 1000);
  await check(page, "a replay shows the last moment as it was", async () => {
    await page.goto(`${station.url}/#/replay/${id}?t=${length / 1000}`);
    await shownAt(page, length);
    const [hash] = await page.evaluate(() => window.carpusReplay.hashes());
    expect(hash === attempt.state_hash, `${hash} is not ${attempt.state_hash}`);
    await expectAccessible(page, 8);
  });
  await check(page, "any moment is reached", async () => {
    let worst = 0;
    for (const share of [0.1, 0.85, 0.3, 0.6, 0]) {
      const tick = Math.round(share * length);
      const before = Date.now();
      await page.locator(".scrub input").fill(String(tick));
      await shownAt(page, tick);
      worst = Math.max(worst, Date.now() - before);
    }
    // How soon on a quiet machine, `carpus bench replay` measures.
    console.log(`    the slowest moment took ${worst} ms`);
  });
  await check(
    page,
    "it plays, and the pictures come as they were taken",
    async () => {
      // Shots and live looks in the order of their numbers; a live look counts from its end on.
      const looks = attempt.events.filter(({ kind }) => kind === "shot_taken" || kind === "live_ended");
      const shot = looks.find(({ kind }) => kind === "shot_taken");
      const start = Math.max(0, shot.tick - 300);
      await page.locator(".scrub input").fill(String(start));
      await shownAt(page, start);
      await expectShot(page, looks.filter(({ tick }) => tick <= start).length);
      await page
        .locator(".replay-stage")
        .click({ position: { x: 200, y: 10 } });
      await page.keyboard.press("Space");
      await page.waitForFunction((tick) => window.carpusReplay.ticks()[0] >= tick, shot.tick);
      await page.keyboard.press("Space");
      // How far a slow machine has played by then is its own affair; the picture is that of where it stands.
      await page.getByRole("button", { name: /^Play/ }).waitFor();
      await page.evaluate(() => new Promise(requestAnimationFrame));
      const stopped = Number(await page.locator(".scrub input").inputValue());
      await expectShot(page, looks.filter(({ tick }) => tick <= stopped).length);
    },
  );
  await check(page, "keys go from event to event", async () => {
    await page.keyboard.press("Home");
    await shownAt(page, 0);
    await page.keyboard.press("n");
    const [tick] = await page.evaluate(() => window.carpusReplay.ticks());
    expect(tick >= 0, "no mark");
    await page.keyboard.press("ArrowRight");
    await page.keyboard.press("b");
  });
  await check(page, "two attempts stand side by side", async () => {
    await page.goto(`${station.url}/#/replay/${id}/${id}`);
    await page.waitForFunction(() => window.carpusReplay?.ticks().length === 2);
    const scrub = page.locator(".scrub input").first();
    await scrub.fill(String(Math.round(length / 2)));
    await page.waitForFunction(
      (wanted) => window.carpusReplay.ticks().every((tick) => tick === wanted),
      Math.round(length / 2),
    );
  });
}

export async function debriefByView(page, station, id) {
  await check(page, "the report lays the true outlines over the trainee's pictures", async () => {
    await page.goto(`${station.url}/#/attempts/${id}`);
    await page.locator(".turning canvas").waitFor();
    await page.locator(".view-faults p.good, .view-fault").first().waitFor();
    await page.locator("#true-outlines").check();
    await page.locator(".outline-bone").first().waitFor({ state: "attached" });
    await expectAccessible(page, 10);
  });
  await check(page, "the view that is turned comes back as it was when its graphics are lost", () =>
    losesGraphics(page, ".turning-frame"),
  );
  await check(page, "the report prints on two pages", async () => {
    const pdf = (await page.pdf({ format: "A4" })).toString("latin1");
    const pages = pdf.match(/\/Type\s*\/Page[^s]/g).length;
    expect(pages === 2, `${pages} pages`);
  });
}
