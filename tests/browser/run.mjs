// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The real page on the real station in a real browser: the wire is placed with mouse and keyboard,
// driven and measured, pictures are taken, a screw goes in, the score is shown and the attempt is in
// the list. Then what goes wrong: a second page, broken messages, a lost connection. Last the way in by
// a link.
// Run by `npm --prefix web run test:browser`; needs CARPUS_BIN and CARPUS_CASE or their defaults.
import { ratesByAsset } from "./asset.mjs";
import { operateAssessed } from "./assessed.mjs";
import { expectAccessible } from "./accessibility.mjs";
import { holdsDevices } from "./devices.mjs";
import { newPage, startBrowser } from "./browser.mjs";
import { chooseAmongCases } from "./cases.mjs";
import { check, counted, expect } from "./checks.mjs";
import { changesTheLook } from "./appearance.mjs";
import { withPictures } from "./c_arm.mjs";
import { firstLookThroughAScope, firstMinutes } from "./first_minutes.mjs";
import { byFinger, byKeysAlone } from "./hands.mjs";
import { cross, dot, Operator, readAxis, readWrist } from "./operator.mjs";
import { wearsHeadset } from "./headset.mjs";
import { printedPages } from "./report.mjs";
import { putsPointsWhereTheLensDoes } from "./lens.mjs";
import { followFromElsewhere, printedLink, traineesLink } from "./link.mjs";
import { debriefByView, replayAttempt } from "./replay.mjs";
import { reviewClass } from "./review.mjs";
import { lookAtScan } from "./scan.mjs";
import { arthroscopy, basics, biting, examination, removal, shaving } from "./scope.mjs";
import { makesPortals } from "./portals.mjs";
import { preparesPathology } from "./pathology.mjs";
import { screwControl } from "./screw.mjs";
import { startStation } from "./station.mjs";
import { opensSttFirst } from "./stt.mjs";
import { playQuiz } from "./view_quiz.mjs";
import { goesInFromVolar } from "./volar.mjs";

const TRAINEE = "Browser test";
/** Of grey levels: a blank picture with noise stays under this. */
const LEAST_DEVIATION = 12;

/**
 * What a page may not do: errors in the console, exceptions. Bitmaps that were on their way when a
 * document is left are given up by the browser and told as errors; that is no fault of the page.
 */
function watch(page, problems) {
  let isLeaving = false;
  page.on("request", (request) => {
    if (request.isNavigationRequest() && request.frame() === page.mainFrame()) isLeaving = true;
  });
  page.on("domcontentloaded", () => {
    isLeaving = false;
  });
  page.on("console", (message) => {
    if (message.type() !== "error") return;
    if (isLeaving && message.text().includes("Couldn't load texture blob:")) return;
    problems.push(message.text());
  });
  page.on("pageerror", (error) => problems.push(String(error)));
}

async function operate(page, station, problems) {
  const operator = new Operator(page);
  const axis = readAxis(station.caseFolder);
  await check(page, "the start dialog can be used by everyone", async () => {
    await page.goto(station.url);
    await page
      .locator("dialog.start button[type=submit]:not([disabled])")
      .waitFor();
    await expectAccessible(page, 4);
  });
  const went = await check(
    page,
    "the start dialog says whom one operates on, and starts",
    async () => {
      await operator.start(station.url, TRAINEE, "dorsal_scaphoid_fixation");
      const patient = await page.textContent(".top-bar .patient");
      const described = await (await fetch(`${station.url}/api/case`)).json();
      expect(
        patient.includes(described.pseudonym),
        `the bar names '${patient}'`,
      );
      expect(
        !described.simulated || patient.includes("simulated"),
        "simulated is not said",
      );
    },
  );
  if (!went) return;
  await check(page, "the page can be used by names and keyboard", async () => {
    await expectAccessible(page, 20);
    await page.locator(".stage canvas").first().focus();
  });
  await check(page, "the help opens by ?, stops time, and closes", async () => {
    await page.keyboard.press("?");
    await page.locator("dialog.help[open]").waitFor();
    await operator.until((s) => s.paused, "time that stands still");
    await expectAccessible(page);
    await page.keyboard.press("Escape");
    await page
      .locator("dialog.help:not([open])")
      .waitFor({ state: "attached" });
    await operator.until((s) => !s.paused, "time that goes on");
  });
  await check(
    page,
    "Dorsal and Radial look along the beams of PA and LAT",
    async () => {
      const wrist = readWrist(station.caseFolder);
      for (const [name, source] of [
        ["Radial", wrist.radial],
        ["Dorsal", wrist.dorsal],
      ]) {
        await page.getByRole("button", { name, exact: true }).click();
        await operator.settle();
        const { right, up } = await page.evaluate(() =>
          window.carpus.screenAxes(),
        );
        const back = cross(right, up);
        expect(dot(back, source) > 0.99999, `${name} looks from ${back}`);
        expect(dot(up, wrist.distal) > 0.99999, `${name} has ${up} up`);
      }
    },
  );
  await check(
    page,
    "a view that is turned away is not the chosen one",
    async () => {
      const chosen = page.locator('.view-bar button[aria-pressed="true"]');
      expect((await chosen.textContent()) === "Dorsal", "Dorsal is not chosen");
      await page.keyboard.press("Control+ArrowRight");
      await page
        .locator('.view-bar:not(:has(button[aria-pressed="true"]))')
        .waitFor();
    },
  );
  await check(
    page,
    "the wrist moves by key, and its bones with it",
    async () => {
      const before = await operator.snapshot();
      for (let tap = 0; tap < 5; ++tap) await operator.tap("KeyJ");
      const flexion = before.wrist.flexion_deg;
      await operator.until(
        (s) => s.wrist.flexion_deg > flexion + 4,
        "five degrees of flexion",
      );
      for (let tap = 0; tap < 5; ++tap) await operator.tap("KeyU");
      await operator.until(
        (s) => Math.abs(s.wrist.flexion_deg - flexion) < 0.2,
        "the way back",
      );
    },
  );
  await check(
    page,
    "the pedal shows the forearm turning, live, and holds the last picture",
    async () => {
      const before = await operator.snapshot();
      const pictures = new Set();
      await operator.lookLive(async () => {
        const look = async () => {
          const { mean, deviation } = await operator.picture();
          pictures.add(`${mean} ${deviation}`);
        };
        await look();
        for (let tap = 0; tap < 8; ++tap) await operator.tap("KeyN");
        // A busy machine draws seldom.
        const until = Date.now() + 30_000;
        while (pictures.size < 2 && Date.now() < until) {
          await page.waitForTimeout(200);
          await look();
        }
      });
      expect(pictures.size > 1, "the live picture does not change");
      const after = await operator.snapshot();
      expect(after.shots === before.shots + 1, "a live look is one look");
      expect(after.dose_cgy_cm2 > before.dose_cgy_cm2, "it costs no dose");
      const turned = after.wrist.pronation_deg - before.wrist.pronation_deg;
      const seen = before.c_arm.rotation_deg - after.c_arm.rotation_deg;
      expect(
        turned > 5 && Math.abs(turned - seen) < 1,
        `the forearm turned by ${turned}, what is seen by ${seen} degrees`,
      );
      for (let tap = 0; tap < 8; ++tap) await operator.tap("KeyB");
      const pronation = before.wrist.pronation_deg;
      await operator.until(
        (s) => Math.abs(s.wrist.pronation_deg - pronation) < 0.2,
        "the way back",
      );
    },
  );
  await check(
    page,
    "what cannot be done now says why, in the host's words",
    async () => {
      const undo = page.getByRole("button", { name: "Undo" });
      await page
        .locator('.ways button[aria-disabled="true"]')
        .first()
        .waitFor();
      const why = await undo.getAttribute("title");
      expect(why.length > 0, "no reason");
      await undo.click({ force: true }); // it counts as disabled, and says why
      await page.locator(".notice", { hasText: why }).waitFor();
    },
  );
  await check(page, "a pause is said over the scene", async () => {
    const sign = page.locator(".paused:not([hidden])");
    await page.keyboard.press("p");
    await sign.waitFor();
    const rate = await page.textContent(".timing span");
    expect(rate === "– Hz", `the bar says ${rate}`);
    await page.keyboard.press("p");
    await sign.waitFor({ state: "detached" });
  });
  await check(page, "at 200 % zoom nothing lies below the fold", async () => {
    const usual = page.viewportSize();
    const small = { width: 683, height: 384 };
    await page.setViewportSize(small);
    await operator.settle();
    for (const [what, least] of [
      [".stage", 150],
      [".c-arm", 150],
      [".bottom-bar", 28],
      [".step-list .current", 20],
    ]) {
      const box = await page.locator(what).boundingBox();
      expect(
        box.y >= 0 &&
          box.y + box.height <= small.height + 0.5 &&
          box.x + box.width <= small.width + 0.5 &&
          box.height >= least,
        `${what} at ${JSON.stringify(box)}`,
      );
    }
    await page.setViewportSize(usual);
    await operator.settle();
  });
  await check(page, "two views show bone, not a blank picture", async () => {
    for (const key of ["1", "2"]) {
      await operator.shot(key);
      const { deviation } = await operator.picture();
      expect(
        deviation > LEAST_DEVIATION,
        `deviation of the grey is ${deviation.toFixed(1)}`,
      );
    }
  });
  await check(
    page,
    "the wire's tip is placed on the scaphoid by mouse, the shaft along its axis",
    async () => {
      const angle = await operator.placeWire(axis);
      expect(angle < 3, `the shaft is ${angle.toFixed(1)} degrees off`);
      const { touched_body: bone } = (await operator.snapshot()).hands[0];
      expect(bone.startsWith("scaphoid"), `it touches the ${bone}`);
    },
  );
  await check(
    page,
    "an arrow key moves the tip by a tenth of a millimetre",
    async () => {
      const before = Operator.held(await operator.snapshot()).tip_mm;
      // Down and up in one task: on a slow machine a key pressed from outside is held for a while.
      const movedBy = (s) =>
        Math.hypot(...Operator.held(s).tip_mm.map((v, i) => v - before[i]));
      for (let tap = 0; tap < 2; tap += 1) await operator.tap("ArrowLeft");
      await operator.until((s) => movedBy(s) > 0.05, "the tip's move");
      await page.waitForTimeout(300);
      const moved = movedBy(await operator.snapshot());
      expect(moved < 0.6, `two taps moved it by ${moved.toFixed(3)} mm`);
      for (let tap = 0; tap < 2; tap += 1) await operator.tap("ArrowRight");
      await operator.settle();
    },
  );
  const drove = await check(
    page,
    "Space drives the wire into the scaphoid",
    async () => {
      await operator.driveWireTo(axis.lengthMm - 4);
      const { depth_mm: depth } = Operator.held(await operator.snapshot());
      expect(depth < axis.lengthMm + 4, `it ran to ${depth} mm`);
      await page.keyboard.press("3");
      await operator.settle();
    },
  );
  if (!drove) return;
  await check(page, "M reads the gauge with the other hand", async () => {
    await page.keyboard.press("m");
    const s = await operator.until(
      (now) => now.gauge_reading_mm > 0,
      "a reading",
    );
    const { depth_mm: depth } = Operator.held(s);
    expect(
      Math.abs(s.gauge_reading_mm - depth) <= 0.6,
      `gauge ${s.gauge_reading_mm}, wire ${depth}`,
    );
    await operator.until((now) => now.hands[1].item < 0, "the gauge put down");
  });
  await check(page, "a screw is taken from the tray by keys", async () => {
    await page.keyboard.press("c");
    await page.locator("dialog.tray[open] input:checked").waitFor();
    await expectAccessible(page);
    await page.keyboard.press("Escape");
    const screw = await operator.fittingScrew();
    await operator.take(screw.id);
  });
  await check(page, "Space buries the screw, Q leaves it there, the wire comes out", async () => {
    await operator.holdKey(
      "Space",
      (s) => Operator.held(s).buried_mm >= 1.5,
      "the screw buried",
    );
    await page.keyboard.press("q");
    await operator.until((s) => s.hands[0].item < 0, "an empty hand");
    await operator.takeWireOut();
    for (const key of ["1", "2", "3"]) await operator.shot(key);
    const { deviation } = await operator.picture();
    expect(deviation > LEAST_DEVIATION, "the last picture is blank");
    const holds = await page.locator(".readings", { hasText: "holds" }).count();
    expect(holds === 1, "how well it holds is not said");
  });
  await check(
    page,
    "a second page is told that another one operates",
    async () => {
      const second = await page.context().newPage();
      watch(second, problems);
      await second.goto(station.url);
      await second.locator(".start-note:not([hidden])").waitFor();
      await second.locator(".start-note", { hasText: "operates" }).waitFor();
      expect(
        await second.isDisabled("dialog.start button[type=submit]"),
        "it may start all the same",
      );
      await second.close();
    },
  );
  await check(
    page,
    "finish asks, then shows the score with its reasons",
    async () => {
      await page.keyboard.press("f");
      await page.locator("dialog.confirm[open]").waitFor();
      const open = await page.textContent("dialog.confirm[open] .confirm-note");
      expect(open.includes("Survey"), `what is open: '${open}'`);
      await page.keyboard.press("Enter");
      await page.locator(".score-table tbody tr").first().waitFor();
      const rows = await page.locator(".score-table tbody tr").count();
      expect(rows >= 10, `${rows} rows`);
      const overall = Number(await page.textContent(".overall strong"));
      expect(overall > 0 && overall <= 100, `overall '${overall}'`);
      const angle = await page.textContent(
        '[data-item="angle_to_central_axis_deg"] .figure',
      );
      expect(Number.parseFloat(angle) < 5, `angle to the axis ${angle}`);
      await page.locator(".placement canvas").first().waitFor();
      await expectAccessible(page, 6);
    },
  );
  await check(
    page,
    "an attempt that is not there is said to be none",
    async () => {
      const back = page.url();
      await page.goto(`${station.url}/#/attempts/999`);
      await page.getByText("There is no attempt 999").waitFor();
      await page.getByRole("link", { name: "All past attempts" }).waitFor();
      // The browser itself reports the answer 404.
      problems.splice(
        0,
        problems.length,
        ...problems.filter((p) => !p.includes("404")),
      );
      await page.goto(back);
      await page.locator(".overall").waitFor();
    },
  );
  await check(page, "the attempt is in the list", async () => {
    await page.getByRole("link", { name: "Past attempts" }).click();
    await page.locator(".overall").waitFor({ state: "detached" }); // its table has rows too
    const row = page.locator("tbody tr").first();
    await row.waitFor();
    const text = await row.textContent();
    expect(
      text.includes(TRAINEE) && text.includes("of 100"),
      `the first row is '${text}'`,
    );
    await expectAccessible(page, 4);
  });
  await reviewClass(page, station);
  await replayAttempt(page, station, 1);
  await debriefByView(page, station, 1);
}

/** Over the other pole: another procedure needs nothing of the page but what the host says. */
async function operateFromVolar(page, station) {
  const operator = new Operator(page);
  const axis = readAxis(station.caseFolder, "distal");
  const went = await check(page, "another procedure starts", async () => {
    await page.goto(`${station.url}/#/`);
    await operator.start(station.url, TRAINEE, "volar_scaphoid_fixation");
    const steps = await page.locator(".step-list li").count();
    const { steps: told, procedure } = await operator.exercise();
    expect(steps === told.length, `${steps} steps of ${told.length}`);
    const bar = await page.textContent(".top-bar .procedure");
    expect(bar.includes(procedure.title), `the bar says '${bar}'`);
  });
  if (!went) return;
  const drove = await check(page, "its wire is placed and driven", async () => {
    for (const key of ["1", "2"]) await operator.shot(key);
    const angle = await operator.placeWire(axis);
    expect(angle < 3, `the shaft is ${angle.toFixed(1)} degrees off`);
    await operator.driveWireTo(axis.lengthMm - 3);
    await operator.shot("3");
  });
  if (!drove) return;
  await check(page, "gauge, drill and screw follow to a score", async () => {
    await page.keyboard.press("m");
    await operator.until((s) => s.gauge_reading_mm > 0, "a reading");
    await operator.take("cannulated_drill");
    await operator.driveOn(
      (drill) => drill.depth_mm >= axis.lengthMm - 4,
      "the drill's depth",
    );
    await operator.holdKey(
      "r",
      (s) => Operator.held(s)?.instrument !== "cannulated_drill",
      "the drill out",
    );
    const screw = await operator.fittingScrew();
    await operator.take(screw.id);
    await operator.holdKey(
      "Space",
      (s) => Operator.held(s).buried_mm >= 1.5,
      "the screw buried",
    );
    await page.keyboard.press("q");
    await operator.takeWireOut();
    for (const key of ["1", "2", "3", "6"]) await operator.shot(key);
    await page.keyboard.press("f");
    await page.locator("dialog.confirm[open]").waitFor();
    await page.keyboard.press("Enter");
    await page.locator(".score-table tbody tr").first().waitFor();
    const overall = Number(await page.textContent(".overall strong"));
    expect(overall > 0 && overall <= 100, `overall '${overall}'`);
    await page.locator(".placement canvas").first().waitFor();
    const pages = await printedPages(page);
    expect(pages === 2, `it prints on ${pages} pages`);
  });
}

/** Stands between station and page: puts in frames that are none of the protocol's, cuts the line. */
class PoorConnection {
  async watch(page) {
    await page.routeWebSocket(/\/ws$/, (socket) => {
      this.socket = socket;
      this.server = socket.connectToServer();
    });
  }

  toPage() {
    for (const frame of [
      "",
      "{",
      "null",
      '{"type":"snapshot"}',
      '{"type":"nothing"}',
      Buffer.from([1, 2, 3]),
    ]) {
      this.socket.send(frame);
    }
  }

  toHost() {
    this.server.send("this is no message");
  }

  cut() {
    this.server.close();
    this.socket.close();
  }
}

async function goesWrong(browser, station, problems) {
  const page = await newPage(browser);
  const operator = new Operator(page);
  const connection = new PoorConnection();
  watch(page, problems);
  // Each message takes a detour through this program, hence a page of its own, in use for a moment.
  await connection.watch(page);
  await check(
    page,
    "broken messages are passed over and the exercise goes on",
    async () => {
      await operator.start(station.url, TRAINEE);
      const before = (await operator.snapshot()).tick;
      const notice = page.locator(".notice:not(:empty)");
      connection.toPage();
      await notice.filter({ hasText: "Passed over" }).waitFor();
      connection.toHost();
      await notice.filter({ hasText: "Message refused" }).waitFor();
      await operator.until(
        (s) => s.tick > before + 100,
        "ticks after the broken messages",
      );
      expect(problems.length === 0, problems.slice(0, 5).join(" | "));
    },
  );
  await check(
    page,
    "an operation goes on when the connection comes back",
    async () => {
      const { tick } = await operator.snapshot();
      connection.cut();
      await page.locator(".notice", { hasText: "Connected again" }).waitFor();
      await operator.until((s) => s.tick > tick + 100, "ticks after the loss");
    },
  );
  await check(page, "after a reload the operation waits to go on", async () => {
    await page.keyboard.press("1");
    await operator.until((s) => s.shots > 0, "a picture");
    const log = page.locator(".log li");
    await log.first().waitFor({ state: "attached" });
    const { tick } = await operator.snapshot();
    await page.reload();
    const goOn = page.getByRole("button", { name: "Go on" });
    await goOn.waitFor();
    const note = page.locator(".start-note", { hasText: "at step 1," });
    await note.waitFor();
    const text = await note.textContent();
    expect(text.includes(`operation of ${TRAINEE}`), `it says '${text}'`);
    await goOn.click();
    await operator.until((s) => s.tick > tick + 100, "ticks after the reload");
    expect((await log.count()) > 0, "the log is empty");
  });
  await check(
    page,
    "a lost connection freezes the scene and says so",
    async () => {
      await station.stop();
      await page.locator(".frozen:not([hidden])").waitFor();
      const text = await page.textContent(".frozen");
      expect(/lost/.test(text), `it says '${text}'`);
    },
  );
  await page.close();
}

/** A station that is not open to all: its link is the only way in. */
async function byItsLink(browser) {
  const station = await startStation([]);
  const page = await newPage(browser);
  const operator = new Operator(page);
  try {
    const link = await printedLink(station);
    const token = new URL(link).searchParams.get("token");
    await check(page, "without the link a page says what to do", async () => {
      const answer = await page.goto(station.url);
      expect(answer.status() === 403, `status ${answer.status()}`);
      await page.getByText("Open the link that the station printed").waitFor();
      await expectAccessible(page);
      await page.goto(`${station.url}/?token=${token.slice(1)}A`);
      await page.getByText("is not valid").waitFor();
      for (const path of ["/api/case", "/api/attempts", "/carpus.svg"]) {
        const { status } = await fetch(`${station.url}${path}`);
        expect(status === 403, `${path} is answered with ${status}`);
      }
    });
    await check(
      page,
      "the link opens the room, from another site too",
      async () => {
        await followFromElsewhere(page, link);
        await page
          .locator("dialog.start button[type=submit]:not([disabled])")
          .waitFor();
        expect(!page.url().includes(token), "the token stays in the address");
        const seen = await page.evaluate(() => document.cookie);
        expect(seen === "", "scripts see the cookie");
        const [cookie] = await page.context().cookies(station.url);
        expect(
          cookie.httpOnly && cookie.sameSite === "Strict",
          `the cookie is ${JSON.stringify(cookie)}`,
        );
        await page.click("dialog.start button[type=submit]");
        await operator.until((s) => s.tick > 0, "the first ticks");
      },
    );
    await check(
      page,
      "an instructor ends another page's operation",
      async () => {
        const other = await newPage(browser);
        await other.goto(link);
        await other
          .getByRole("button", { name: "End that operation" })
          .click();
        await other.locator("dialog.confirm[open]").waitFor();
        await other.keyboard.press("Enter");
        await other
          .locator("dialog.start button[type=submit]:not([disabled])")
          .waitFor();
        await page.locator(".frozen:not([hidden])").waitFor();
        await other.close();
      },
    );
    await check(page, "a trainee looks at the scan and is offered no new case", async () => {
      const theirs = await browser.newContext();
      const look = await theirs.newPage();
      await look.goto(traineesLink(station));
      await look.waitForURL((url) => url.search === "");
      await look.goto(`${station.url}/#/scan`);
      await look.locator(".scan-reading:not(:empty)").waitFor();
      for (const name of ["Add a scan…", "Run again as a new version"]) {
        const offered = await look.getByText(name).count();
        expect(offered === 0, `'${name}' is offered`);
      }
      await theirs.close();
    });
    await check(page, "the token is not in the browser's history", async () => {
      await page.goBack();
      expect(!page.url().includes(token), "it is");
    });
    await check(page, "the station's lines do not hold the token again", () => {
      const lines = station.output.join("").split(token).length - 1;
      expect(lines === 1, `it is there ${lines} times`);
    });
  } finally {
    await page.close();
    await station.stop();
  }
}

const station = await startStation();
const browser = await startBrowser();
const problems = [];
try {
  const page = await newPage(browser);
  watch(page, problems);
  await operate(page, station, problems);
  await operateFromVolar(page, station);
  await playQuiz(page, station, check, expectAccessible);
  await check(page, "no errors in the browser's console", () => {
    expect(problems.length === 0, problems.slice(0, 5).join(" | "));
  });
  await page.close();
  await lookAtScan(browser, station);
  await byKeysAlone(browser, station);
  await byFinger(browser, station);
  await holdsDevices(browser, station);
  await withPictures(browser, station);
  await changesTheLook(browser, station);
  await wearsHeadset(browser, station);
  await operateAssessed(browser, station);
  await firstMinutes(browser, station);
  await firstLookThroughAScope(browser, station);
  await arthroscopy(browser, station);
  await examination(browser, station);
  await basics(browser, station);
  await removal(browser, station);
  await putsPointsWhereTheLensDoes(browser);
  await screwControl(browser, station);
  await shaving(browser, station);
  await biting(browser, station);
  await makesPortals(browser, station);
  await goesInFromVolar(browser, station);
  await opensSttFirst(browser, station);
  // Its problems are its own: the browser reports each vain attempt to connect.
  await goesWrong(browser, station, []);
  await byItsLink(browser);
  await chooseAmongCases(browser);
  await ratesByAsset(browser);
  await preparesPathology(browser);
} finally {
  await browser.close();
  await station.stop();
}
console.log(`${counted.passed} passed, ${counted.failed} failed`);
process.exit(counted.failed === 0 ? 0 : 1);
