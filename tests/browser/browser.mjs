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
