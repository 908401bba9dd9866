// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Plays the view quiz as a person does: looks, answers by keys, reads the truth.

import { readFileSync } from "node:fs";

/** Of grey levels: a blank picture with noise stays under this. */
const LEAST_DEVIATION = 12;

export class QuizPlayer {
  constructor(page) {
    this.page = page;
    /** Text frames from the station, as they came. */
    this.heard = [];
    page.on("websocket", (socket) => {
      socket.on("framereceived", ({ payload }) => {
        if (typeof payload === "string") this.heard.push(payload);
      });
    });
  }

  async open(url, seed) {
    await this.page.goto(`${url}/#/views?seed=${seed}`);
    await this.asked(1);
  }

  async asked(number) {
    await this.page.getByText(`Question ${number}.`).waitFor();
    await this.pictureTaken();
  }

  pictureTaken() {
    return this.page
      .locator(".quiz-waiting[hidden]")
      .waitFor({ state: "attached" });
  }

  /** Deviation of the grey levels in the middle of the picture. */
  contrast() {
    return this.page.evaluate(() => {
      const canvas = document.querySelector(".quiz-frame canvas");
      const side = canvas.width / 2;
      const { data } = canvas
        .getContext("2d")
        .getImageData(side / 2, side / 2, side, side);
      let sum = 0;
      let squares = 0;
      for (let i = 0; i < data.length; i += 4) {
        sum += data[i];
        squares += data[i] * data[i];
      }
      const mean = sum / (data.length / 4);
      return Math.sqrt(squares / (data.length / 4) - mean * mean);
    });
  }

  tally(name) {
    return this.page
      .locator(".quiz-tally div", { hasText: name })
      .locator("dd")
      .textContent();
  }
}

/** With letters that are keys of the quiz. */
const PLAYER = "Quiz, Ida Ovsen";

function expect(holds, what) {
  if (!holds) throw new Error(what);
}

/**
 * @param check  names, runs and counts one check
 * @param expectAccessible  of what is shown
 */
export async function playQuiz(page, station, check, expectAccessible) {
  const player = new QuizPlayer(page);
  const went = await check(
    page,
    "the view quiz is reached from the start dialog and shows a picture",
    async () => {
      await page.goto(station.url);
      await page.evaluate(() => localStorage.removeItem("carpus.trainee"));
      await page.getByRole("link", { name: "View quiz" }).click();
      await page.fill("#quiz-name", "");
      await page.locator("#quiz-name").pressSequentially(PLAYER);
      await page.keyboard.press("Enter");
      await player.asked(1);
      expect((await player.contrast()) > LEAST_DEVIATION, "it is blank");
      await expectAccessible(page, 8);
    },
  );
  if (!went) return;
  await check(page, "it asks before it tells, by keys alone", async () => {
    await page.goto("about:blank");
    player.heard.length = 0;
    await player.open(station.url, 7);
    await page.keyboard.press("6");
    await player.pictureTaken();
    await page
      .locator(".quiz-views button[aria-pressed=true]", { hasText: "SKY" })
      .waitFor();
    const told = player.heard.filter((text) =>
      /overhang|"is_false_safety"|"towards"/.test(text),
    );
    expect(told.length === 0, `the page knew before: ${told[0]}`);
    const outlines = page.locator(".quiz-outlines polygon");
    await page.keyboard.press("o");
    expect((await outlines.count()) === 0, "outlines before the answer");
    const answer = page.getByRole("button", { name: "Answer" });
    expect(await answer.isDisabled(), "it can be sent empty");
    await page.keyboard.press("i");
    await page.keyboard.press("Shift+Digit3");
    await page.keyboard.press("Enter");
    await page.locator(".quiz-verdict").waitFor();
  });
  await check(page, "the truth has figures, views and outlines", async () => {
    const text = await page.locator(".quiz-truth").textContent();
    expect(/\d\.\d mm/.test(text), `it says '${text}'`);
    expect(
      (await page.locator(".quiz-truth tbody tr").count()) === 6,
      "not six views",
    );
    const outlines = page.locator(".quiz-outlines polygon");
    await page.keyboard.press("o");
    await outlines.nth(1).waitFor({ state: "attached" });
    await page.keyboard.press("2");
    await player.pictureTaken();
    expect((await outlines.count()) >= 2, "no outlines over another view");
    await expectAccessible(page);
  });
  await check(page, "what was answered is counted", async () => {
    const right = await player.tally("Where");
    const falseSafety = Number(await player.tally("False safety"));
    const verdict = await page.locator(".quiz-verdict").textContent();
    expect(
      right === (verdict.startsWith("Right") ? "1 of 1" : "0 of 1"),
      `where: ${right}`,
    );
    expect(
      falseSafety === (verdict.startsWith("False") ? 1 : 0),
      `${falseSafety} of false safety for '${verdict}'`,
    );
    expect((await player.tally("Views taken")) === "2", "views taken");
    await page.keyboard.press("n");
    await player.asked(2);
    expect(await page.locator(".quiz-truth").isHidden(), "the truth stays");
  });
  await check(page, "the answer is kept with the name, and leaves as a file", async () => {
    await page.goto(`${station.url}/#/review`);
    await page.locator(".review-filter select[name=trainee]").selectOption(PLAYER);
    const row = page.locator(".review-quiz tbody tr").first();
    await row.waitFor();
    const told = await row.innerText();
    expect(told.startsWith(`${PLAYER}\t1\t`), `it says '${told}'`);
    await page.locator(".review-quiz .curve").waitFor();
    const [download] = await Promise.all([
      page.waitForEvent("download"),
      page.getByRole("button", { name: "Quiz answers as CSV" }).click(),
    ]);
    const lines = readFileSync(await download.path(), "utf8").trim().split("\r\n");
    expect(lines.length === 2 && lines[1].includes(`"${PLAYER}"`), lines.join(" / "));
    await expectAccessible(page, 8);
  });
}
