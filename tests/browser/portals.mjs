// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Portals made through closed skin by mouse and keys: 3-4 felt for, marked, pricked, cut, spread, entered; the scope goes
// in by it, where it was made; the second one beside the scope, whose picture shows the needle; scored.
// With CARPUS_SCOPE_PICTURES a folder for what is seen on the way.
import { join } from "node:path";
import { newPage } from "./browser.mjs";
import { check, expect } from "./checks.mjs";
import { atRest } from "./hands.mjs";
import { dot, Operator } from "./operator.mjs";
import { minus, size, SkinHands } from "./skin_hands.mjs";

const TRAINEE = "Browser test, portals";
/** Of the exercise: it draws 6R, which asks more of the scope than 4-5, as the second portal. */
const SEED = 1;
const LOW = { width: 1120, height: 680 };
const SMALL = { width: 640, height: 360 };
/** A key that is held so long after fluid came back would lead a needle 10 mm on, and leads it no farther than this. */
const HELD_ON_MS = 1300;
const LED_ON_MM = 4;
/** On the demo's 6R the capsule lies 16 mm under the skin, the disc 19. */
const BEFORE_DISC_MM = 17.2;
/** So much of the way to it a needle of the second portal leans towards the scope's. */
const NEEDLE_LEANS = 0.35;

export async function makesPortals(browser, station) {
  const page = await newPage(browser);
  await page.addInitScript((seed) => {
    crypto.getRandomValues = (numbers) => numbers.fill(seed);
  }, SEED);
  const operator = new Operator(page);
  const pictures = process.env.CARPUS_SCOPE_PICTURES;
  const picture = async (name) => {
    if (pictures === undefined) return;
    await page.waitForTimeout(600);
    await page.screenshot({ path: join(pictures, `portals_${name}.png`) });
  };
  const hands = new SkinHands(page, operator);
  const skin = () => hands.told();
  const until = (key, holds, what) => hands.until(key, holds, what);

  let spot;
  await check(page, "closed skin is felt, and a word says what is there", async () => {
    await operator.start(station.url, TRAINEE, "arthroscopy_from_the_skin", "practice");
    await picture("start");
    await atRest(operator);
    const pull = page.locator("#wrist-traction_n");
    await pull.fill("45");
    await pull.blur(); // as a mouse leaves it: the keys are the hand's again
    await operator.until((s) => s.wrist.traction_n >= 44, "traction");
    expect((await skin()).spot_mm === null, "the portal's place is told unasked");
    await page.keyboard.press("F2");
    await operator.until(() => true, "a moment");
    for (let i = 0; i < 50 && (await skin()).spot_mm === null; ++i)
      await page.waitForTimeout(50);
    const told = await skin();
    spot = told.spot_mm;
    expect(spot !== null, "a ghost that was asked for shows no place");
    await operator.dragTipTo(told.landmark_mm);
    await until("a", (s) => s.hands[0].felt !== "nothing", "something felt");
    for (const key of ["ArrowUp", "ArrowRight", "ArrowDown", "ArrowLeft"])
      await operator.push(key, 700);
    const word = await page.locator(".skin-word").innerText();
    expect(/bone|tendon|soft/.test(word), `the word is '${word}'`);
    await picture("felt");
    await until("d", (s) => s.hands[0].felt === "nothing", "let go");
  });
  await check(page, "ink stays where the marker pressed", async () => {
    await operator.take("skin_marker");
    await operator.dragTipTo(spot);
    await until("a", (s) => s.ink_mm.length > 0, "ink");
    const off = minus((await skin()).ink_mm[0], spot);
    expect(Math.sqrt(dot(off, off)) < 3, "the ink lies elsewhere");
    await picture("ink");
    await operator.push("d", 500);
  });
  await check(page, "a needle finds the joint, and fluid comes back", async () => {
    await operator.take("needle_22g");
    expect((await hands.hand()).under_mm === 0, "it pricks before it is placed");
    await operator.dragTipTo(spot);
    let wet;
    const held = await until("a", (s) => {
      if (wet === undefined && s.hands[0].is_wet) wet = { mm: s.hands[0].under_mm, at: Date.now() };
      return wet !== undefined && Date.now() - wet.at > HELD_ON_MS;
    }, "fluid");
    await operator.logged("Fluid comes back");
    await picture("needle");
    await hands.drawOut();
    const on = held.hands[0].under_mm - wet.mm;
    expect(on < LED_ON_MM, `the key led it on by ${on.toFixed(1)} mm`);
  });
  await check(page, "skin is cut, the way is spread, the sheath goes in", async () => {
    await hands.cut(spot);
    await picture("cut");
    await hands.spread(spot);
    await hands.enter(spot, 1);
    await picture("sheath");
  });
  const large = page.locator(".scope:not(.is-inset)");
  const inset = page.locator(".scope.is-inset");
  await check(page, "the scope goes in by the portal as it was made", async () => {
    expect(!(await page.locator(".scope").isVisible()), "there is a scope's picture without a scope");
    await hands.drawOut();
    // From elsewhere: it is brought before the portal.
    await operator.take("fingertip");
    await operator.dragTipTo((await skin()).spot_mm);
    await operator.take("arthroscope_1_9_30");
    await large.waitFor({ state: "visible" });
    const { ways } = await skin();
    expect(ways.length === 1 && ways[0].id === "3-4", `portals: ${JSON.stringify(ways)}`);
    await hands.goIn();
    const item = Operator.held(await operator.snapshot());
    expect(size(minus(item.tip_mm, ways[0].skin_mm)) < 30, "it went in elsewhere");
    const current = page.locator(".step-list .current", { hasText: "Now the 6R portal" });
    await current.waitFor();
    const { width, height } = page.viewportSize();
    await page.setViewportSize(LOW);
    await picture("low");
    const [list, words] = [page.locator(".step-list"), current.locator(".step-sentence")];
    await page.waitForTimeout(300);
    const [around, said] = [await list.boundingBox(), await words.boundingBox()];
    const isShown = said.y >= around.y && said.y + said.height <= around.y + around.height;
    expect(isShown, `the step's words are cut off: ${JSON.stringify({ around, said })}`);
    await page.setViewportSize({ width, height });
    await picture("scope");
  });
  await check(page, "the needle of the second portal is seen to come in", async () => {
    const seen = page.locator(".log li", { hasText: "The needle is seen in the scope's picture" });
    await operator.otherHand();
    await operator.take("needle_22g");
    await inset.waitFor({ state: "visible" });
    expect(!(await page.locator(".scope-press").isVisible()), "a needle in the air injures cartilage");
    const told = await skin();
    spot = told.spot_mm;
    await operator.turnShaft(SkinHands.wayFrom(spot, told.ways[0], NEEDLE_LEANS), 4);
    await operator.dragTipTo(spot);
    await picture("needle_before");
    await until("a", (s) => hands.own(s).is_wet, "fluid");
    // Between the capsule and the disc: deeper it is in that, and what lines the joint stands before it. By coarse steps.
    await page.keyboard.press("y");
    for (let off; Math.abs((off = (await hands.hand()).under_mm - BEFORE_DISC_MM)) > 0.6; ) {
      await page.keyboard.press(off > 0 ? "d" : "a");
      await page.waitForTimeout(400);
    }
    await page.keyboard.press("y");
    expect((await hands.hand()).is_wet, "it is not in the joint");
    const { width, height } = page.viewportSize();
    await page.setViewportSize(SMALL);
    const [steps, small] = [await page.locator(".steps").boundingBox(), await inset.boundingBox()];
    expect(small.x >= steps.x + steps.width, "the scope's picture lies over the steps");
    await page.keyboard.press("7");
    await large.waitFor({ state: "visible" });
    const shown = await page.locator(".scope-picture").boundingBox();
    expect(shown.width > SMALL.height / 2, `large it is ${shown.width} px wide`);
    await page.getByRole("button", { name: "Change places" }).click();
    await inset.waitFor({ state: "visible" });
    await page.setViewportSize({ width, height });
    await operator.otherHand();
    await large.waitFor({ state: "visible" });
    await hands.lookForPoint(async () => (await seen.count()) > 0);
    expect((await seen.count()) === 1, "nobody has seen the needle in the scope's picture");
    await picture("needle_seen");
    await operator.otherHand();
    await inset.waitFor({ state: "visible" });
    await picture("needle_seen_inset");
    await hands.drawOut();
  });
  await check(page, "the second portal is made beside the scope, and the probe goes in by it", async () => {
    await hands.cut(spot);
    await hands.spread(spot);
    await hands.enter(spot, 2);
    await picture("second_sheath");
    await hands.drawOut();
    await operator.take("hook_probe");
    await large.waitFor({ state: "visible" });
    await hands.goIn();
    expect((await hands.scope()).in_joint.join() === "1,1", "the scope came out meanwhile");
    await picture("probe");
  });
  await check(page, "it is scored", async () => {
    await page.keyboard.press("f");
    await page.click("dialog[open] button[value=finish], dialog[open] .primary");
    await page.waitForURL(/#\/attempts\/\d+/);
    await page.getByText("3-4: needle off its place").first().waitFor();
    await page.getByText("Second portal: needle seen in the joint").first().waitFor();
    await picture("score");
  });
  operator.hand = 0;
  await check(page, "another side of the limb is gone round to with a fingertip alone", async () => {
    await operator.start(station.url, TRAINEE, "arthroscopic_portal_making_harder", "practice");
    await atRest(operator);
    const held = async () => Operator.held(await operator.snapshot());
    const before = await held();
    await operator.take("needle_22g");
    await page.getByRole("button", { name: "Volar", exact: true }).click();
    await page.keyboard.press("Enter");
    await page.getByText("lay a fingertip there first").waitFor();
    const still = await held();
    expect(dot(still.shaft, before.shaft) > 0.99, "a needle was swung round");
    await operator.take("fingertip");
    await page.keyboard.press("Enter");
    await operator.until((s) => dot(Operator.held(s).shaft, before.shaft) < -0.7, "the finger from volar");
    await operator.take("needle_22g");
    expect(dot((await held()).shaft, before.shaft) < -0.7, "the needle begins elsewhere");
    expect((await hands.hand()).under_mm === 0, "it pricked on its way");
    await picture("volar");
  });
  await check(page, "an assessed page says which portal is asked for, and no step of the way", async () => {
    await operator.start(station.url, TRAINEE, "arthroscopy_from_the_skin", "assessed");
    const { width, height } = page.viewportSize();
    for (const size of [{ width, height }, LOW, SMALL]) {
      await page.setViewportSize(size);
      await page.locator(".steps .task", { hasText: "make the 6R portal" }).waitFor();
      expect(!(await page.locator(".step-sentence").first().isVisible()), "a step's words are shown");
      await picture(`assessed_${size.width}`);
    }
    await page.setViewportSize({ width, height });
  });
  await page.context().close();
}
