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
/** The page is laid out as ever; a processor that draws in place of graphics has a quarter of the pixels to fill. */
const PIXELS_PER_CSS = 0.5;

/** A page with storage of its own that nobody has seen yet, closed with its browser at the latest. */
export async function newcomersPage(browser, more = {}) {
  const context = await browser.newContext({
    viewport: VIEWPORT,
    deviceScaleFactor: PIXELS_PER_CSS,
    ...more,
  });
  context.setDefaultTimeout(PATIENCE_MS);
  return context.newPage();
}

/** The same of someone who knows the first touch, of bones and of scopes. */
export async function newPage(browser, more = {}) {
  const page = await newcomersPage(browser, more);
  await page.context().addInitScript(() => {
    try {
      localStorage.setItem("carpus.first_touch", "seen");
      localStorage.setItem("carpus.first_touch.scope", "seen");
    } catch {
      // The browser's own pages have no storage.
    }
  });
  return page;
}

/** For pictures that are to be looked at: every pixel is drawn. */
export function newPageForPictures(browser) {
  return newPage(browser, { deviceScaleFactor: 1 });
}

/** And on a screen that is touched. */
export function newTouchPage(browser) {
  return newPage(browser, { hasTouch: true });
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

/** Until the page has drawn what it was asked for. */
export const drawn = (page) =>
  page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));
