// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A portal made through closed skin by mouse and keys: felt for, marked, pricked, cut, spread, entered; the scope goes
// in by it, where it was made; scored.
// With CARPUS_SCOPE_PICTURES a folder for what is seen on the way.
import { join } from "node:path";
import { newPage } from "./browser.mjs";
import { check, expect } from "./checks.mjs";
import { atRest } from "./hands.mjs";
import { dot, Operator } from "./operator.mjs";

const TRAINEE = "Browser test, portals";
const PATIENCE_MS = 20_000;
const minus = (a, b) => a.map((v, i) => v - b[i]);
const plus = (a, b, f) => a.map((v, i) => v + f * b[i]);

export async function makesPortals(browser, station) {
  const page = await newPage(browser);
  const operator = new Operator(page);
  const pictures = process.env.CARPUS_SCOPE_PICTURES;
  const picture = async (name) => {
    if (pictures === undefined) return;
    await page.waitForTimeout(600);
    await page.screenshot({ path: join(pictures, `portals_${name}.png`) });
  };
  const skin = () => page.evaluate(() => window.carpus?.skin());
  const hand = async () => (await skin()).hands[0];
  /** Holds a key until what is told of the skin satisfies `holds`. */
  const until = async (key, holds, what) => {
    await page.keyboard.down(key);
    const end = Date.now() + PATIENCE_MS;
    try {
      for (;;) {
        const now = await skin();
        if (now !== undefined && holds(now)) return now;
        if (Date.now() > end) throw new Error(`in vain: ${what}; ${JSON.stringify(now)}`);
        await new Promise((done) => setTimeout(done, 20));
      }
    } finally {
      await page.keyboard.up(key);
      await operator.settle(1);
    }
  };
  const drawOut = () => until("d", (s) => s.hands[0].under_mm === 0, "drawn out");

  let spot;
  await check(page, "closed skin is felt, and a word says what is there", async () => {
    await operator.start(station.url, TRAINEE, "arthroscopy_from_the_skin", "practice");
    await picture("start");
    await atRest(operator);
    for (let i = 0; i < 45; ++i) await page.keyboard.press("w");
    await operator.until((s) => s.wrist.traction_n >= 34, "traction");
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
    expect((await hand()).under_mm === 0, "it pricks before it is placed");
    await operator.dragTipTo(spot);
    await until("a", (s) => s.hands[0].is_wet, "fluid");
    await operator.logged("Fluid comes back");
    await picture("needle");
    await drawOut();
    await operator.push("d", 400);
  });
  await check(page, "skin is cut, the way is spread, the sheath goes in", async () => {
    await operator.take("blade_15");
    const { up } = await page.evaluate(() => window.carpus.screenAxes());
    await operator.dragTipTo(plus(spot, up, -2.2));
    await until("a", (s) => s.hands[0].under_mm > 1, "a cut");
    const start = (await hand()).on_skin_mm;
    await until(
      "ArrowUp",
      (s) => Math.abs(dot(minus(s.hands[0].on_skin_mm, start), up)) > 4.2,
      "a cut as long as the sheath is wide",
    );
    await drawOut();
    await operator.push("d", 400);
    await picture("cut");
    await operator.take("mosquito_clamp");
    await operator.dragTipTo(spot);
    await until("a", (s) => s.hands[0].under_mm > 12, "the clamp in the cut");
    for (let tries = 0; tries < 8; ++tries) {
      await operator.push("Space", 700);
      if ((await page.locator(".log", { hasText: "Spread, down" }).count()) > 0) break;
      await operator.push("a", 400);
    }
    await operator.logged("Spread, down to the capsule");
    await drawOut();
    await operator.push("d", 400);
    await operator.take("scope_sheath_1_9");
    await operator.dragTipTo(spot);
    await until("a", (s) => s.made === 1, "the sheath in the joint");
    await picture("sheath");
  });
  await check(page, "the scope goes in by the portal as it was made", async () => {
    const told = () => page.evaluate(() => window.carpus?.scope());
    const isAtScope = () => page.locator(".scope").isVisible();
    expect(!(await isAtScope()), "there is a scope's picture without a scope");
    await drawOut();
    await operator.push("d", 400);
    // From elsewhere: it is brought before the portal.
    await operator.take("fingertip");
    await operator.dragTipTo((await skin()).spot_mm);
    await operator.take("arthroscope_1_9_30");
    await page.locator(".scope").waitFor({ state: "visible" });
    const { ways } = await skin();
    expect(ways.length === 1 && ways[0].id === "3-4", `portals: ${JSON.stringify(ways)}`);
    const isIn = async () => (await told())?.in_joint[0] === 1;
    const end = Date.now() + 3 * PATIENCE_MS; // two pictures are drawn meanwhile, on a slow machine slowly
    await page.keyboard.down("a");
    while (!(await isIn()) && Date.now() < end) await page.waitForTimeout(20);
    await page.keyboard.up("a");
    expect(await isIn(), `the scope is not in the joint: ${JSON.stringify(await told())}`);
    const item = Operator.held(await operator.snapshot());
    const off = minus(item.tip_mm, ways[0].skin_mm);
    expect(Math.sqrt(dot(off, off)) < 30, "it went in elsewhere");
    await picture("scope");
  });
  await check(page, "its picture stays beside the skin while the other hand works there", async () => {
    const large = page.locator(".scope:not(.is-inset)");
    const inset = page.locator(".scope.is-inset");
    await operator.otherHand();
    await operator.take("needle_22g");
    await inset.waitFor({ state: "visible" });
    await picture("inset");
    await page.keyboard.press("7");
    await large.waitFor({ state: "visible" });
    await page.getByRole("button", { name: "Change places" }).click();
    await inset.waitFor({ state: "visible" });
    await operator.otherHand();
    await large.waitFor({ state: "visible" });
    const { in_joint: inJoint } = await page.evaluate(() => window.carpus.scope());
    expect(inJoint[0] === 1, "the scope came out meanwhile");
    await operator.take("needle_22g");
    await page.locator(".scope").waitFor({ state: "hidden" });
    await picture("skin_again");
  });
  await check(page, "it is scored", async () => {
    await page.keyboard.press("f");
    await page.click("dialog[open] button[value=finish], dialog[open] .primary");
    await page.waitForURL(/#\/attempts\/\d+/);
    await page.getByText("3-4: needle off its place").first().waitFor();
    await picture("score");
  });
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
    expect((await hand()).under_mm === 0, "it pricked on its way");
    await picture("volar");
  });
  await page.context().close();
}
