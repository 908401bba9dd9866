// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What a newcomer meets: the first touch, ticked by what really happens, sound, and a gamepad.
import { expectAccessible } from "./accessibility.mjs";
import { drawn, newcomersPage } from "./browser.mjs";
import { check, expect } from "./checks.mjs";
import { PAD } from "./fake_pad.mjs";
import { atRest } from "./hands.mjs";
import { Operator } from "./operator.mjs";

export async function firstMinutes(browser, station) {
  const page = await newcomersPage(browser);
  const operator = new Operator(page);
  await page.addInitScript(PAD);
  const card = page.locator(".first-touch");
  const done = card.locator("li.done");
  const sound = () => page.evaluate(() => window.carpus.sound());
  const press = (button, value) =>
    page.evaluate(([b, v]) => window.pressPad(b, v), [button, value]);
  /** Down for as long as a slow page needs to see it. */
  const tap = async (button) => {
    await press(button, 1);
    await drawn(page);
    await press(button, 0);
    await drawn(page);
  };
  const tilt = (...axes) => page.evaluate((a) => window.tiltPad(...a), axes);

  await check(page, "sound waits for a gesture, and stays as it was left", async () => {
    await page.goto(station.url);
    await page.locator("dialog.start[open]").waitFor();
    expect((await sound()) === "waiting", `before a gesture it is ${await sound()}`);
    await operator.start(station.url, "Browser test, newcomer");
    const mute = page.getByRole("button", { name: "Sound" });
    expect((await sound()) === "on", `after a gesture it is ${await sound()}`);
    await page.keyboard.press("Backquote");
    expect((await sound()) === "muted", `muted it is ${await sound()}`);
    expect((await mute.getAttribute("aria-pressed")) === "false", "the bar says on");
    await page.reload();
    await page.locator("dialog.start[open]").waitFor();
    await page.keyboard.press("Shift");
    expect((await sound()) === "muted", `after a reload it is ${await sound()}`);
  });
  await check(page, "the first operation comes with a first touch", async () => {
    await operator.start(station.url, "Browser test, newcomer");
    await atRest(operator);
    await card.waitFor();
    expect((await done.count()) === 0, "something is ticked already");
    await expectAccessible(page);
  });
  await check(page, "it is ticked by what a gamepad really does", async () => {
    await press(15, 1); // the cross turns the view
    await done.filter({ hasText: "Turn the view" }).waitFor();
    await press(15, 0);
    await tilt(0.8, 0, 0, 0);
    await done.filter({ hasText: "Move the tip" }).waitFor();
    await tilt(0, 0, 0.8, 0);
    await done.filter({ hasText: "Aim" }).waitFor();
    await tilt(0, 0, 0, 0);
    await operator.flexBySlider();
    await press(1, 1); // along the sight
    await operator.until((s) => s.hands[0].touching, "the tip on the bone");
    await press(1, 0);
    await press(7, 1);
    await done.filter({ hasText: "Push and drive" }).waitFor();
    await press(7, 0);
    const { depth_mm: depth } = Operator.held(await operator.snapshot());
    expect(depth > 1, `the wire is ${depth} mm deep`);
    await press(0, 1);
    await done.filter({ hasText: "Take a picture" }).waitFor();
    await press(0, 0);
    await tap(8);
    await done.filter({ hasText: "Undo" }).waitFor();
    await card.getByText("All of it in").waitFor();
  });
  await check(page, "it does not come again, but begins from the help", async () => {
    await card.getByRole("button", { name: "Start anew" }).click();
    await page.locator("dialog.confirm[open]").waitFor();
    await page.keyboard.press("Enter");
    await operator.until((s) => s.undos === 0 && s.passes === 0, "a new operation");
    expect(!(await card.isVisible()), "it comes again");
    await page.keyboard.press("F1");
    await page.getByRole("button", { name: "First touch" }).click();
    await card.getByRole("button", { name: "Skip" }).click();
    expect(!(await card.isVisible()), "it cannot be left");
  });
  await check(page, "a gamepad alone judges, flexes the wrist, takes from the tray and asks to finish", async () => {
    await page.locator("canvas").first().focus();
    await press(8, 1); // Back is held: its other buttons
    await tap(15);
    await operator.until((s) => s.judged_displaced === true, "judged");
    await tilt(0, 1, 0, 0);
    await operator.until((s) => s.wrist.flexion_deg > 10, "the wrist flexed");
    await tilt(0, 0, 0, 0);
    await drawn(page);
    await tap(2);
    await page.locator("dialog.tray[open]").waitFor();
    await press(8, 0);
    const focused = () => page.evaluate(() => document.activeElement?.value ?? "");
    for (let i = 0; i < 60 && (await focused()) !== "probe"; ++i) await tap(13);
    expect((await focused()) === "probe", `the cross came to '${await focused()}'`);
    await tap(0);
    await operator.until((s) => Operator.held(s)?.instrument === "probe", "the probe in the hand");
    await press(8, 1);
    await tap(9);
    await page.locator("dialog.confirm[open]").waitFor();
    await press(8, 0);
    await tap(1);
    expect((await page.locator("dialog[open]").count()) === 0, "the question stays");
    const { undos } = await operator.snapshot();
    expect(undos === 0, "Back was taken for undo");
  });
  await page.close();
}

/** The same before a joint is looked into. */
export async function firstLookThroughAScope(browser, station) {
  const page = await newcomersPage(browser);
  const operator = new Operator(page);
  const card = page.locator(".first-touch");
  const done = card.locator("li.done");
  await check(page, "a first arthroscopy comes with a first touch of its own", async () => {
    await operator.start(station.url, "Browser test, newcomer", "arthroscopic_basics");
    await card.waitFor();
    expect((await card.getByText("Push and drive").count()) === 0, "it has one drive a wire");
    await expectAccessible(page);
    await page.locator("canvas").first().focus();
    for (const [key, what] of [
      ["KeyA", "Go in by the portal"],
      ["ArrowLeft", "Lean"],
      ["Comma", "Look round"],
      ["Shift+Comma", "Keep the horizon"],
    ]) {
      const keys = key.split("+");
      for (const one of keys) await page.keyboard.down(one);
      await done.filter({ hasText: what }).waitFor();
      for (const one of keys.reverse()) await page.keyboard.up(one);
    }
    await page.keyboard.press("KeyH");
    await done.filter({ hasText: "The other hand" }).waitFor();
    await card.getByText("All of it in").waitFor();
    await card.getByRole("button", { name: "Go on" }).click();
    expect(!(await card.isVisible()), "it cannot be left");
  });
  await page.close();
}
