// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Ends an operation and reads its report as a person would: what each figure is and why, what must hold and does not.
import { expect } from "./checks.mjs";

/** The report's figures by id, with what must hold and does not. */
export async function finishedReport(page) {
  await page.keyboard.press("f");
  await page.locator("dialog.confirm[open]").waitFor();
  const note = await page.textContent("dialog.confirm[open] .confirm-note");
  await page.keyboard.press("Enter");
  return { note, ...(await shownReport(page)) };
}

/** The same of the one that is shown. */
export async function shownReport(page) {
  await page.locator(".score-table tbody tr").first().waitFor();
  const rows = await page.locator(".score-table tbody tr").evaluateAll((all) =>
    all.map((row) => ({
      id: row.dataset.item,
      value: Number.parseFloat(row.querySelector(".figure").textContent),
      failed: row.querySelector(".grade.fail") !== null,
      reason: row.querySelector(".reason").textContent,
    })),
  );
  return {
    items: Object.fromEntries(rows.map((row) => [row.id, row])),
    overall: Number(await page.textContent(".overall strong")),
    verdict: await page.locator(".verdict").innerText(),
    unmet: await page
      .locator(".must-haves li", { hasText: "not fulfilled" })
      .allTextContents(),
    unjudged: await page
      .locator(".must-haves li", { hasText: "not judged" })
      .allTextContents(),
  };
}

/** Each figure fails and says why. */
export function expectSaid({ items }, ids) {
  for (const id of ids) {
    const item = items[id];
    expect(item !== undefined, `${id} is not in the report`);
    expect(item.failed, `${id} is ${JSON.stringify(item)}`);
    expect(item.reason.length > 20, `${id} has no reason: '${item.reason}'`);
  }
}

/** These conditions are told as missing, in words. */
export function expectUnmet({ unmet, overall, verdict }, words) {
  for (const text of words)
    expect(
      unmet.some((line) => line.includes(text)),
      `'${text}' is not among what is missing: ${unmet.join("; ")}`,
    );
  expect(overall === 0, `${overall} points`);
  expect(/not acceptable|not as it should be/i.test(verdict), `the verdict: '${verdict}'`);
}

/** How many sheets of A4 the shown report takes. */
export async function printedPages(page) {
  const pdf = (await page.pdf({ format: "A4" })).toString("latin1");
  return pdf.match(/\/Type\s*\/Page[^s]/g).length;
}
