// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The scope's picture puts a known point where the lens model puts it: the page's own picture, with marks alone before
// it, against r = R * angle / half the field, as src/arthroscopy/optics_test.cpp has it for the host.
import { createRequire } from "node:module";
import { join } from "node:path";
import { pathToFileURL } from "node:url";
import { newPageForPictures } from "./browser.mjs";
import { check, expect } from "./checks.mjs";
import { root } from "./station.mjs";

const SIDE_PX = 720;
const FIELDS_DEG = [75, 80, 115];
/** Of a mark, from the lens. */
const FAR_MM = 9;
const MOST_OFF_PX = 0.5;

/** The page's module for the picture, as a script of its own. */
async function pictureScript() {
  const require = createRequire(join(root, "web/package.json"));
  const { build } = await import(pathToFileURL(require.resolve("vite").replace("index.cjs", "dist/node/index.js")));
  const [{ output }] = await build({
    configFile: false,
    root: join(root, "web"),
    logLevel: "silent",
    build: {
      write: false,
      minify: false,
      lib: {
        entry: join(root, "web/src/scope/scope_picture.ts"),
        formats: ["iife"],
        name: "scopePicture",
      },
    },
  });
  return output[0].code;
}

/** In the page: where marks in such directions come to lie, from the picture's middle [px]. */
function marksShown({ sidePx, fieldDeg, farMm, directions, axis, up, eyeMm }) {
  const picture = new window.scopePicture.ScopePicture([]);
  picture.setField(fieldDeg);
  picture.setWrong([], [], ["bone"]);
  const still = [{ quaternion: [1, 0, 0, 0], translation_mm: [0, 0, 0] }];
  const small = document.createElement("canvas");
  small.width = small.height = sidePx;
  const context = small.getContext("2d", { willReadFrequently: true });
  const found = directions.map((to) => {
    const atMm = eyeMm.map((v, i) => v + farMm * to[i]);
    picture.setBeads([{ atMm, body: "bone", kind: "passed" }]);
    picture.lay("none", still);
    const nothing = { loose: [], pieces_left: [], running: [], scuffs: [] };
    picture.draw("none", { eyeMm, axis, up }, undefined, nothing, sidePx, undefined);
    context.drawImage(picture.canvas, 0, 0);
    const { data } = context.getImageData(0, 0, sidePx, sidePx);
    let [sum, right, down] = [0, 0, 0];
    for (let y = 0; y < sidePx; ++y) {
      for (let x = 0; x < sidePx; ++x) {
        const i = 4 * (y * sidePx + x);
        const green = data[i + 1] - Math.max(data[i], data[i + 2]);
        if (green < 40) continue;
        sum += 1;
        right += x + 0.5 - sidePx / 2;
        down += y + 0.5 - sidePx / 2;
      }
    }
    return { pixels: sum, right: right / sum, down: down / sum };
  });
  picture.dispose();
  return found;
}

export async function putsPointsWhereTheLensDoes(browser) {
  const page = await newPageForPictures(browser);
  await page.goto("about:blank");
  await page.addScriptTag({ content: await pictureScript() });
  for (const fieldDeg of FIELDS_DEG) {
    await check(page, `a lens of ${fieldDeg} degrees draws points where its model puts them`, async () => {
      // Looking along -y, distal (-z) up: so the picture's right is axis x up = +x.
      const [axis, up, right] = [[0, -1, 0], [0, 0, -1], [1, 0, 0]];
      const expected = [];
      const directions = [];
      for (let from = 0; from < fieldDeg / 2 - 3; from += 9) {
        for (let at = 10; at < 360; at += from === 0 ? 360 : 87) {
          const [angle, around] = [from, at].map((deg) => (deg * Math.PI) / 180);
          const aside = axis.map((_, i) => Math.sin(around) * right[i] + Math.cos(around) * up[i]);
          directions.push(axis.map((v, i) => Math.cos(angle) * v + Math.sin(angle) * aside[i]));
          const r = (SIDE_PX / 2) * (from / (fieldDeg / 2));
          expected.push({ right: r * Math.sin(around), down: -r * Math.cos(around) });
        }
      }
      const shown = await page.evaluate(marksShown, {
        sidePx: SIDE_PX, fieldDeg, farMm: FAR_MM, directions, axis, up, eyeMm: [3, -20, 41],
      });
      let most = 0;
      shown.forEach((one, i) => {
        expect(one.pixels > 20, `mark ${i} is not there: ${one.pixels} pixels`);
        most = Math.max(most, Math.hypot(one.right - expected[i].right, one.down - expected[i].down));
      });
      process.stdout.write(`  ${shown.length} points, at most ${most.toFixed(2)} pixels off\n`);
      expect(most < MOST_OFF_PX, `${most.toFixed(2)} pixels off`);
    });
  }
  await page.context().close();
}
