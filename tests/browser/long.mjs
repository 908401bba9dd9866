// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What takes minutes in a browser: everything goes wrong, a wire is drawn through and back, a long operation is
// looked at again, both joints are looked round by mouse and keys and an examination is answered, and a scan becomes a
// case that is mended and operated on.
// Run by `npm --prefix web run test:browser:long` and by ./test --all.
import { allGoesWrong } from "./all_goes_wrong.mjs";
import { drawnThrough } from "./drawn_through.mjs";
import { startBrowser } from "./browser.mjs";
import { counted } from "./checks.mjs";
import { addsCases } from "./new_case.mjs";
import { replayLong } from "./long_replay.mjs";
import { startStation } from "./station.mjs";
import { operateByTouch } from "./touch_whole.mjs";
import { completesTour, examinesRightly } from "./whole_tour.mjs";

const station = await startStation();
const browser = await startBrowser();
try {
  await allGoesWrong(browser, station);
  await drawnThrough(browser, station);
  await operateByTouch(browser, station);
  await completesTour(browser, station);
  await examinesRightly(browser);
  await replayLong(browser);
  await addsCases(browser);
} finally {
  await browser.close();
  await station.stop();
}
console.log(`${counted.passed} passed, ${counted.failed} failed`);
process.exit(counted.failed === 0 ? 0 : 1);
