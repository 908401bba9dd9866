// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Works on closed skin by mouse and keys as a practised hand does: pricks, cuts, spreads, goes in; and looks with the
// scope for what came into the joint. Where things are the page says.
import { expect } from "./checks.mjs";
import { cross, dot, Operator } from "./operator.mjs";
import { ScopeGuide } from "./scope_guide.mjs";

const PATIENCE_MS = 20_000;
/** The needle of a second portal goes in by about so much. */
const NEEDLE_DEEP_MM = 13;
/** The scope is brought so near to what it is to show; seen counts up to 15 mm. */
const LOOK_FROM_MM = [10, 8, 12, 6];
const SEEN_WAIT_MS = 2500;
/** The last of the way out goes by fine steps. */
const LAST_MM = 3;
const DEG = 180 / Math.PI;

export const minus = (a, b) => a.map((v, i) => v - b[i]);
export const plus = (a, b, f = 1) => a.map((v, i) => v + f * b[i]);
export const size = (a) => Math.hypot(...a);

export class SkinHands {
  constructor(page, operator) {
    this.page = page;
    this.operator = operator;
  }

  told() {
    return this.page.evaluate(() => window.carpus?.skin());
  }

  scope() {
    return this.page.evaluate(() => window.carpus?.scope());
  }

  /** Of the hand that mouse and keys lead. */
  own(told) {
    return told.hands[this.operator.hand];
  }

  async hand() {
    return this.own(await this.told());
  }

  /** Holds a key until what is told of the skin satisfies `holds`. */
  async until(key, holds, what) {
    const { keyboard } = this.page;
    await keyboard.down(key);
    const end = Date.now() + PATIENCE_MS;
    try {
      for (;;) {
        const now = await this.told();
        if (now !== undefined && holds(now)) return now;
        if (Date.now() > end) throw new Error(`in vain: ${what}; ${JSON.stringify(now)}`);
        await new Promise((done) => setTimeout(done, 20));
      }
    } finally {
      await keyboard.up(key);
      await this.operator.settle(1);
    }
  }

  /** Out of the skin, and off it: by coarse steps for most of the way. */
  async drawOut() {
    const isOut = (mm) => (s) => this.own(s).under_mm <= mm;
    if (!isOut(2 * LAST_MM)(await this.told())) {
      await this.page.keyboard.press("y");
      await this.until("d", isOut(LAST_MM), "drawn back");
      await this.page.keyboard.press("y");
    }
    await this.until("d", isOut(0), "drawn out");
    await this.operator.push("d", 300);
  }

  /** The tip onto the skin there at once: one that is dragged over it cuts, or slips into a cut, on the way. */
  async put(at) {
    const { x, y } = await this.page.evaluate((mm) => window.carpus.pagePoint(mm), at);
    await this.page.mouse.move(x, y);
    await this.page.mouse.down();
    await this.operator.settle();
    await this.page.mouse.up();
    await this.operator.settle();
  }

  async prick(at) {
    await this.operator.take("needle_22g");
    expect((await this.hand()).under_mm === 0, "it pricks before it is placed");
    await this.put(at);
    await this.until("a", (s) => this.own(s).is_wet, "fluid");
  }

  /** The skin alone, along the limb, as long as the sheath is wide. */
  async cut(at) {
    const { page, operator } = this;
    await operator.take("blade_15");
    const { up } = await page.evaluate(() => window.carpus.screenAxes());
    await this.put(plus(at, up, -2.2));
    await this.until("a", (s) => this.own(s).under_mm > 1, "a cut");
    const start = (await this.hand()).on_skin_mm;
    const isLong = (s) => Math.abs(dot(minus(this.own(s).on_skin_mm, start), up)) > 4.2;
    await this.until("ArrowUp", isLong, "a cut as long as the sheath is wide");
    await this.drawOut();
  }

  async spread(at) {
    const { page, operator } = this;
    await operator.take("mosquito_clamp");
    await this.put(at);
    const lines = page.locator(".log li", { hasText: "Spread, down to the capsule" });
    const before = await lines.count();
    await this.until("a", (s) => this.own(s).under_mm > 13, "the clamp in the cut");
    for (let tries = 0; tries < 8 && (await lines.count()) === before; ++tries) {
      if (tries > 0) await operator.push("a", 900);
      await operator.push("Space", 600);
    }
    expect((await lines.count()) > before, "the way is not spread down to the capsule");
    await this.drawOut();
  }

  /** @param made  how many portals there are then */
  async enter(at, made) {
    await this.operator.take("scope_sheath_1_9");
    await this.put(at);
    await this.until("a", (s) => s.made === made, "the sheath in the joint");
  }

  /** The way in from a place on the skin to where a scope in a portal lies, leant towards it by so much of the way. @return towards the hand */
  static wayFrom(at, portal, lean) {
    const to = minus(at, portal.skin_mm);
    const aside = plus(to, portal.inwards, -dot(to, portal.inwards));
    const way = plus(portal.inwards.map((v) => -NEEDLE_DEEP_MM * v), aside, lean);
    return way.map((v) => v / size(way));
  }

  /** Leads the scope until it shows the point of what the other hand holds: from where its own portal comes in, where nothing
   * stands between, to before that point, and its view there; nearer or farther where that does not do. */
  async lookForPoint(isSeen) {
    const { page, operator } = this;
    const guide = new ScopeGuide(page, operator);
    const [way] = (await this.told()).ways;
    const { distal } = (await operator.exercise()).arthroscopy;
    const portal = { skin: way.skin_mm, inwards: way.inwards, up: distal };
    const hole = plus(way.skin_mm, way.inwards, way.capsule_mm);
    for (const far of LOOK_FROM_MM) {
      const point = Operator.held(await operator.snapshot(), 1 - operator.hand).tip_mm;
      const back = minus(hole, point);
      const tip = plus(point, back, far / size(back));
      for (let round = 0; round < 2; ++round)
        await guide.leadTo({ hand: operator.hand, tip, turn: await this.turnTo(point) }, portal, 1, 2);
      for (let waited = 0; waited < SEEN_WAIT_MS; waited += 100) {
        if (await isSeen()) return;
        await page.waitForTimeout(100);
      }
    }
  }

  /** That the scope's shaft is to be turned to, for its view to lean to a place [deg]. */
  async turnTo(place) {
    const { operator } = this;
    const { tip_mm: eye, shaft } = Operator.held(await operator.snapshot(), operator.hand);
    const { axis, shaft_deg: deg } = await this.scope();
    const about = (v) => plus(v, shaft, -dot(v, shaft));
    const [sight, wanted] = [about(axis), about(minus(place, eye))];
    return deg + DEG * Math.atan2(dot(cross(sight, wanted), shaft), dot(sight, wanted));
  }

  /** By the portal that it is held before. */
  async goIn() {
    const { page, operator } = this;
    const isIn = async () => (await this.scope())?.in_joint[operator.hand] === 1;
    const end = Date.now() + 3 * PATIENCE_MS; // two pictures are drawn meanwhile, on a slow machine slowly
    await page.keyboard.down("a");
    while (!(await isIn()) && Date.now() < end) await page.waitForTimeout(20);
    await page.keyboard.up("a");
    expect(await isIn(), `hand ${operator.hand} is not in: ${JSON.stringify(await this.scope())}`);
  }
}
