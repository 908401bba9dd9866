// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Control of a screw by keys: the scope goes in, the screw is drawn, what was found is answered and judged. With
// CARPUS_SCOPE_PICTURES a folder for what is seen on the way.
import { join } from "node:path";
import { newPage } from "./browser.mjs";
import { check, expect } from "./checks.mjs";
import { Operator } from "./operator.mjs";
import { bringInScope, CALLS_OF_FOCUS, expectAnswersKept } from "./scope.mjs";

const TRAINEE = "Browser test, screw";

export async function screwControl(browser, station) {
  const page = await newPage(browser);
  const operator = new Operator(page);
  const pictures = process.env.CARPUS_SCOPE_PICTURES;
  const picture = async (name) => {
    if (pictures === undefined) return;
    await page.waitForTimeout(600);
    await page.screenshot({ path: join(pictures, `screw_${name}.png`) });
  };
  let screw;
  await check(page, "a screw lies in the joint that the scope shows", async () => {
    await operator.start(station.url, TRAINEE, "arthroscopic_screw_control");
    ({ screw } = (await operator.exercise()).arthroscopy);
    expect(screw !== null && screw.length_mm > 10, "the host tells of no screw");
    await bringInScope(page, operator);
    await picture("radiocarpal");
    const calls = await page
      .locator(".scope")
      .evaluate((e) => Number(e.dataset.calls));
    const own = calls - CALLS_OF_FOCUS;
    expect(own >= 2 && own <= 5, `${calls} draw calls`);
  });
  await check(page, "what was found is answered, kept and judged", async () => {
    await page.keyboard.press("9");
    const report = await page.locator(".findings-report").innerText();
    expect(
      report.includes(`${screw.line_mm} mm measured`),
      `the report says '${report}'`,
    );
    const rows = page.locator(".finding");
    const count = await rows.count();
    expect(count === 4, `${count} things are asked`);
    for (let i = 0; i < count; ++i)
      await rows.nth(i).locator("label").first().click();
    await picture("answers");
    await expectAnswersKept(page, count);
    await page.keyboard.press("Escape");
    await page.waitForTimeout(9_000); // the least look that is judged
    await page.keyboard.press("f");
    await page.click(
      "dialog[open] button[value=finish], dialog[open] .primary",
    );
    await page.waitForURL(/#\/attempts\/\d+/);
    await page.getByText("Places judged rightly").first().waitFor();
    await picture("score");
    const id = /attempts\/(\d+)/.exec(page.url())[1];
    const again = await (
      await fetch(`${station.url}/api/attempts/${id}/replay/exercise`)
    ).json();
    expect(
      JSON.stringify(again.arthroscopy.screw) === JSON.stringify(screw),
      "a replay has another screw",
    );
  });
  await page.context().close();
}
