// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Checks that are counted and told, each with what a person would see where it fails.
/** How many held and how many did not. */
export const counted = { passed: 0, failed: 0 };

/** What a person would see and try next, for whoever reads of a failure. */
async function situation(page) {
  return page.evaluate(() => {
    const text = (selector) =>
      [...document.querySelectorAll(selector)]
        .map((e) => e.textContent.trim())
        .filter((t) => t !== "")
        .join(" | ");
    const focus = document.activeElement;
    return JSON.stringify({
      address: location.hash,
      notice: text(".notice"),
      frozen: text(".frozen:not([hidden])"),
      dialog: text("dialog[open] h2"),
      said: text("[role=status]:not([hidden])"),
      focus:
        focus &&
        `${focus.tagName} ${focus.className} ${focus.textContent.slice(0, 40)}`,
      snapshot: window.carpus?.snapshot(),
    });
  });
}

export async function check(page, name, run) {
  const start = Date.now();
  try {
    await run();
    ++counted.passed;
    console.log(
      `ok      ${name}  (${((Date.now() - start) / 1000).toFixed(1)} s)`,
    );
    return true;
  } catch (error) {
    ++counted.failed;
    console.log(
      `FAILED  ${name}\n        ${error instanceof Error ? error.message : error}`,
    );
    console.log(`        ${await situation(page).catch(String)}`);
    return false;
  }
}

export function expect(holds, what) {
  if (!holds) throw new Error(what);
}

