// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// An assessed operation: what the page may show, and that ending it early buys no truth.
import { newPage } from "./browser.mjs";
import { check, expect } from "./checks.mjs";
import { Operator } from "./operator.mjs";
import { pixelsOf } from "./pixels.mjs";

const TRAINEE = "Browser test, assessed";

export async function operateAssessed(browser, station) {
  const page = await newPage(browser);
  const operator = new Operator(page);
  const began = await check(
    page,
    "an assessed operation shows closed skin, no names and no undo",
    async () => {
      await operator.start(
        station.url,
        TRAINEE,
        "dorsal_scaphoid_fixation",
        "assessed",
      );
      await page.locator(".badge.mode", { hasText: "assessed" }).waitFor();
      expect(
        await page.isDisabled(".view-bar button:has-text('Names')"),
        "bones can be named",
      );
      expect(await page.isDisabled("#skin-opacity"), "skin can be taken off");
      await page.keyboard.press("l");
      await operator.settle();
      expect(
        !(await page.locator("canvas.bone-names").isVisible()),
        "the key L names bones",
      );
      await page.keyboard.press("Control+z");
      await operator.settle();
      expect(
        (await operator.snapshot()).undos === 0,
        "something was taken back",
      );
    },
  );
  if (!began) return page.close();
  await check(page, "hand and forearm go on beyond the scan, and say that they are generated", async () => {
    const bytes = Buffer.from(await (await fetch(`${station.url}/api/scene.glb`)).arrayBuffer());
    const { nodes } = JSON.parse(bytes.subarray(20, 20 + bytes.readUInt32LE(12)).toString("utf8"));
    for (const name of ["limb_hand", "limb_forearm"])
      expect(nodes.find((node) => node.name === name)?.extras?.generated === true, `no ${name}`);
    // Above the wrist there are fingers: skin where the background was.
    for (let i = 0; i < 12; ++i) await page.keyboard.press("-");
    await operator.settle(4);
    const above = await page.locator(".stage canvas").first().boundingBox();
    const clip = { x: above.x + above.width / 2 - 40, y: above.y + 0.25 * above.height, width: 80, height: 20 };
    const { data } = await pixelsOf(page, await page.screenshot({ clip }));
    let hue = 0;
    for (let i = 0; i < data.length; i += 4) hue = Math.max(hue, data[i] - data[i + 2]);
    expect(hue > 40, `nothing of skin's colour where fingers are: ${hue}`);
  });
  await check(page, "no scan is shown while it runs", async () => {
    const { open } = await (await fetch(`${station.url}/api/cases`)).json();
    for (const file of ["ct.nii.gz", "labels.nii.gz", "case.json", "bones.glb"]) {
      const path = `/api/cases/${encodeURIComponent(open)}/scan/${file}`;
      const { status } = await fetch(station.url + path);
      expect(status === 409, `${file} is answered with ${status}`);
    }
  });
  await check(page, "it ticks off no step and says nothing of one", async () => {
    for (const key of ["1", "2"]) await operator.shot(key);
    await operator.settle(4);
    const { completed_steps: told } = await operator.snapshot();
    expect(told.length === 0, `steps ${told} are told`);
    const marks = await page
      .locator(".step-list .done, .step-list .current")
      .count();
    expect(marks === 0, `${marks} steps are marked`);
    const log = await page.textContent(".log");
    expect(!log.includes("Step done"), `the log says '${log}'`);
  });
  await check(page, "ended without a screw it is void, its truth closed", async () => {
    await page.keyboard.press("f");
    await page.locator("dialog.confirm[open]").waitFor();
    await page.keyboard.press("Enter");
    await page.locator(".verdict", { hasText: "Void" }).waitFor();
    expect(
      (await page.locator(".placement").count()) === 0,
      "the placement is shown",
    );
    const rows = await page.locator(".score-table tbody tr").count();
    expect(rows === 0, `${rows} figures are shown`);
    expect(
      (await page.textContent(".overall strong")) === "0",
      "it earned points",
    );
    await page.getByRole("link", { name: "Past attempts" }).click();
    const row = page.locator("tbody tr", { hasText: TRAINEE }).first();
    await row.waitFor();
    const text = await row.textContent();
    expect(text.includes("assessed"), `the list says '${text}'`);
  });
  await page.close();
}
