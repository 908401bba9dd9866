// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Debian's Chromium, headless, with WebGL 2 in software, speaking to nobody but the station.
import { createRequire } from "node:module";
import { join } from "node:path";
import { root } from "./station.mjs";

const { chromium } = createRequire(join(root, "web/package.json"))(
  "playwright-core",
);

/** A machine without graphics may take its time: no wait fails a check before this [ms]. */
export const PATIENCE_MS = 180_000;
const VIEWPORT = { width: 1120, height: 680 };

/** A page with cookies and storage of its own, closed with its browser at the latest. */
export async function newPage(browser) {
  const context = await browser.newContext({ viewport: VIEWPORT });
  context.setDefaultTimeout(PATIENCE_MS);
  return context.newPage();
}

/** The same on a screen that is touched. */
export async function newTouchPage(browser) {
  const context = await browser.newContext({
    viewport: VIEWPORT,
    hasTouch: true,
  });
  context.setDefaultTimeout(PATIENCE_MS);
  return context.newPage();
}

export function startBrowser() {
  return chromium.launch({
    executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium",
    args: [
      "--no-sandbox",
      "--use-angle=swiftshader",
      "--enable-unsafe-swiftshader",
      "--ignore-gpu-blocklist",
      "--disable-background-networking",
      "--disable-component-update",
      "--disable-sync",
      "--no-first-run",
    ],
  });
}
