// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What of the page as it stands keeps someone out: names, roles, contrast, order of headings, by axe-core.
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { expect } from "./checks.mjs";
import { root } from "./station.mjs";

const axe = readFileSync(
  join(root, "web/node_modules/axe-core/axe.min.js"),
  "utf8",
);

/** @return one line for each fault, and where it is */
export async function accessibilityFaults(page) {
  // By the debugger's own way: the page itself forbids scripts that it did not bring.
  await page.evaluate(axe);
  return page.evaluate(async () => {
    const faults = [];
    const { violations } = await window.axe.run(document, {
      runOnly: ["wcag2a", "wcag2aa", "wcag21a", "wcag21aa", "wcag22aa", "best-practice"],
    });
    for (const { id, help, nodes } of violations)
      for (const node of nodes.slice(0, 5))
        faults.push(
          `${id} (${help}): ${node.target.join(" ")}: ${(node.any[0] ?? node.all[0] ?? node.none[0])?.message ?? ""}`,
        );
    return faults;
  });
}

/** The elements that Tab goes through, in order, that cannot be seen where they have the focus. */
export async function focusFaults(page, steps) {
  const faults = [];
  for (let i = 0; i < steps; ++i) {
    await page.keyboard.press("Tab");
    const fault = await page.evaluate(() => {
      const e = document.activeElement;
      if (e === null || e === document.body) return undefined;
      const box = e.getBoundingClientRect();
      const style = getComputedStyle(e);
      const marked =
        style.outlineStyle !== "none" && parseFloat(style.outlineWidth) > 0;
      const what = `${e.tagName.toLowerCase()}.${e.className}`;
      if (box.width === 0 || box.height === 0) return `${what} has no size`;
      return marked || style.boxShadow !== "none"
        ? undefined
        : `${what} does not show the focus`;
    });
    if (fault !== undefined) faults.push(fault);
  }
  return faults;
}

/** @param tabs  so many times Tab shows where the focus is */
export async function expectAccessible(page, tabs = 0) {
  const faults = await accessibilityFaults(page);
  if (tabs > 0) faults.push(...(await focusFaults(page, tabs)));
  expect(faults.length === 0, faults.join("; "));
}
