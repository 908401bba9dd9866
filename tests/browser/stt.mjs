// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The scaphotrapeziotrapezoid portal by mouse and keys, the other way round than others: skin cut and way spread first, as
// its step says, then needle and sheath, which comes into the joint; nothing beside its way is struck.
// With CARPUS_SCOPE_PICTURES a folder for what is seen on the way.
import { join } from "node:path";
import { newPage } from "./browser.mjs";
import { check, expect } from "./checks.mjs";
import { underTraction } from "./hands.mjs";
import { Operator } from "./operator.mjs";
import { minus, plus, size, SkinHands } from "./skin_hands.mjs";

const TRAINEE = "Browser test, STT";
/** Of the exercise: it draws STT as the second portal. */
const SEED = 20;

export async function opensSttFirst(browser, station) {
  const page = await newPage(browser);
  await page.addInitScript((seed) => {
    crypto.getRandomValues = (numbers) => numbers.fill(seed);
  }, SEED);
  const operator = new Operator(page);
  const hands = new SkinHands(page, operator);
  const pictures = process.env.CARPUS_SCOPE_PICTURES;
  const picture = async (name) => {
    if (pictures !== undefined) await page.screenshot({ path: join(pictures, `stt_${name}.png`) });
  };
  const begin = (procedure) => underTraction(operator, station.url, TRAINEE, procedure);
  let spot;
  await check(page, "STT is asked for, and its step says to cut and spread before the needle", async () => {
    await begin("diagnostic_arthroscopy");
    const portal = (await operator.exercise()).arthroscopy.portals.find((one) => one.id === "STT");
    await begin("arthroscopic_portal_making_harder");
    await picture("start");
    await page.locator(".step-list li", { hasText: "First cut the skin and spread the way" }).first().waitFor();
    const pose = (await page.evaluate(() => window.carpus.bodyPoses()))[portal.body];
    spot = Operator.moved(pose, portal.skin_mm);
    const inwards = minus(Operator.moved(pose, plus(portal.skin_mm, portal.inwards)), spot);
    await operator.take("fingertip");
    const toHand = inwards.map((v) => -v / size(inwards));
    for (const side of ["Dorsal", "Radial"]) {
      await page.getByRole("button", { name: side, exact: true }).click();
      await operator.settle();
      await operator.turnShaft(toHand, 3);
    }
    await page.getByRole("button", { name: "Along shaft" }).click();
    await operator.settle();
    await picture("along_the_way");
  });
  await check(page, "opened first, the way is free for needle and sheath, and the joint is come into", async () => {
    await hands.cut(spot);
    await picture("cut");
    await hands.spread(spot);
    await picture("spread");
    await hands.prick(spot);
    await picture("needle");
    await hands.drawOut();
    await hands.enter(spot, 1);
    await picture("sheath");
    const { touched_body: met } = (await operator.snapshot()).hands[0];
    expect(["scaphoid", "trapezium", "trapezoid"].includes(met), `the sheath meets '${met}'`);
    await page.locator(".step-list li", { hasText: "Now the scaphotrapeziotrapezoid portal" }).first().waitFor();
    await hands.drawOut();
    await page.keyboard.press("f");
    await page.click("dialog[open] button[value=finish], dialog[open] .primary");
    await page.waitForURL(/#\/attempts\/\d+/);
    await page.getByText("What lies there is generated. None was.").first().waitFor();
  });
  await page.context().close();
}
