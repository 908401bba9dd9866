// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Knows how a practised hand goes round the joints, and leads the page's hands there by mouse and keys. What it
// knows is the motion of the scripted expert on the same case (`carpus simulate`, `carpus replay --motion`);
// where the tips really are and where the scope looks, the page says.
import { execFileSync } from "node:child_process";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { cross, dot, Operator } from "./operator.mjs";
import { program } from "./station.mjs";

const add = (a, b, f = 1) => a.map((v, i) => v + f * b[i]);
const size = (a) => Math.hypot(...a);
const unit = (a) => a.map((v) => v / size(a));
const DEG = 180 / Math.PI;

/** Of a drag that leans, of Shift + drag, of one notch of the wheel: web/src/scope/scope_listening.ts. */
const LEAN_DEG_PER_PX = 0.12;
const TURN_DEG_PER_PX = 0.6;
const WHEEL_MM = 0.6;
/** A drag stays on the picture. */
const MOST_DRAG_PX = 90;

/** A moment of the motion is gone through once a hand has moved so far since the last one. */
const STRIDE_MM = 3;
/** So near to the line through a portal it is before it. */
const BEFORE_MM = 5;
/** Less deep it is on its way in or out. */
const LEAST_DEPTH_MM = 5;
/** Over it the page warns: pressed so hard twice, a careful hand tries no more to get there. */
const WARN_N = 3;
const MOST_WARNINGS = 2;
/** At rest: it stays within so much for so long. */
const REST_MM = 0.35;
const REST_S = 1;

/** The expert's way: of each hand its places in order, those at rest marked. */
export function expertsWay(caseFolder, procedure, folder, seed = 1) {
  const recording = join(folder, `${procedure}.carpus`);
  const table = join(folder, `${procedure}.csv`);
  const run = (...args) => execFileSync(program(), args, { stdio: "pipe" });
  run("simulate", "--case", caseFolder, "--procedure", procedure, "--trainee", "expert",
    "--seed", String(seed), "--out", recording);
  run("replay", recording, "--case", caseFolder, "--motion", table, "--every", "50");
  const [heads, ...lines] = readFileSync(table, "utf8").trim().split("\n");
  const at = Object.fromEntries(heads.split(",").map((name, i) => [name, i]));
  const moments = lines.map((line) => {
    const cells = line.split(",");
    const number = (name) => Number(cells[at[name]]);
    const vector = (name, unitName = "") =>
      ["x", "y", "z"].map((axis) => number(`${name}_${axis}${unitName}`));
    return {
      seconds: number("time_s"),
      hand: number("hand"),
      tip: vector("tip", "_mm"),
      shaft: vector("shaft"),
      isIn: number("is_in_joint") === 1,
      turn: cells[at.view_x] === "" ? undefined : number("shaft_turn_deg"),
      seen: number("points_seen"),
    };
  });
  return placesOf(moments);
}

/** Of all moments those to go through: strides of the moving hand, and where it rests. */
function placesOf(moments) {
  const places = [];
  const last = new Map();
  const resting = new Map();
  let seenBefore = 0;
  for (const moment of moments) {
    const { hand, seconds, tip, turn } = moment;
    const rest = resting.get(hand);
    const isStill =
      rest !== undefined &&
      size(add(tip, rest.tip, -1)) < REST_MM &&
      Math.abs((turn ?? 0) - (rest.turn ?? 0)) < 2;
    if (!isStill) {
      resting.set(hand, { tip, turn, since: seconds, isTold: false });
    } else if (!rest.isTold && seconds - rest.since >= REST_S) {
      rest.isTold = true;
      // A look that brings nothing new is for the cartilage between: it is passed by.
      if (turn !== undefined && moment.seen === seenBefore) continue;
      if (turn !== undefined) seenBefore = moment.seen;
      places.push({ ...moment, isRest: true });
      last.set(hand, tip);
      continue;
    }
    const before = last.get(hand);
    if (before !== undefined && size(add(tip, before, -1)) < STRIDE_MM) continue;
    last.set(hand, tip);
    places.push({ ...moment, isRest: false });
  }
  return places;
}

export class ScopeGuide {
  constructor(page, operator) {
    this.page = page;
    this.operator = operator;
    /** By hand: its place in the plan's portals, as the page begins, and whether it is in there. */
    this.at = [0, 1];
    this.isIn = [false, false];
  }

  scope() {
    return this.page.evaluate(() => window.carpus.scope());
  }

  /** The portals where they lie now. */
  async portals() {
    const { plan, bodies } = await this.page.evaluate(() => ({
      plan: window.carpus.exercise().arthroscopy,
      bodies: window.carpus.bodyPoses(),
    }));
    return plan.portals.map((portal) => {
      const pose = bodies[portal.body];
      const place = (mm) => Operator.moved(pose, mm);
      const skin = place(portal.skin_mm);
      return {
        name: portal.name,
        joint: portal.joint,
        capsuleMm: portal.capsule_mm,
        skin,
        inwards: add(place(add(portal.skin_mm, portal.inwards)), skin, -1),
        up: add(place(add(portal.skin_mm, plan.distal)), skin, -1),
      };
    });
  }

  /** How something with its tip there leans in its portal: depth [mm], to the side and up [deg]. */
  static lean(tip, { skin, inwards, up }) {
    const side = unit(cross(inwards, up));
    const to = add(tip, skin, -1);
    const along = dot(to, inwards);
    if (along <= 3) return { depth: along, yaw: 0, pitch: 0 };
    return {
      depth: size(to),
      yaw: DEG * Math.atan2(dot(to, side), along),
      pitch: DEG * Math.atan2(dot(to, cross(side, inwards)), along),
    };
  }

  /** Of all portals the one through whose hole a shaft goes. */
  static portalOf({ tip, shaft }, portals) {
    const off = ({ skin }) => {
      const to = add(skin, tip, -1);
      const back = dot(to, shaft);
      return back > 0 ? size(add(to, shaft, -back)) : Infinity;
    };
    return portals.reduce((a, b) => (off(b) < off(a) ? b : a));
  }

  /** Goes through all places; meanwhile(place) is called where a hand is to rest. */
  async walk(places, meanwhile) {
    for (const place of places) {
      const portals = await this.portals();
      const portal = ScopeGuide.portalOf(place, portals);
      if (ScopeGuide.lean(place.tip, portal).depth < LEAST_DEPTH_MM) continue;
      if (this.operator.hand !== place.hand) await this.operator.otherHand();
      await this.goIn(place.hand, portals, portals.indexOf(portal));
      await this.leadTo(place, portal, place.isRest ? 0.5 : 1.5, place.isRest ? 10 : 3);
      if (place.isRest) await meanwhile(place);
    }
  }

  /** Out of the portal that a hand is in, by V to before another, and in to its capsule. */
  async goIn(hand, portals, wanted) {
    const { page, operator } = this;
    if (this.at[hand] !== wanted || !this.isIn[hand]) {
      if (this.isIn[hand]) await this.drawOut(hand);
      await this.goOn(hand, wanted, portals.length);
      const portal = portals[wanted];
      const depth = (s) => ScopeGuide.lean(Operator.held(s, hand).tip_mm, portal).depth;
      const isBefore = (s) => {
        const item = Operator.held(s, hand);
        if (item === undefined) return false;
        const to = add(item.tip_mm, portal.skin, -1);
        return size(add(to, portal.inwards, -dot(to, portal.inwards))) < BEFORE_MM;
      };
      await operator.until(isBefore, `hand ${hand} before ${portal.name}`);
      await operator.holdKey("a", (s) => depth(s) > portal.capsuleMm + 1, `through ${portal.name}`);
      this.isIn[hand] = true;
    }
  }

  /** By V, portal by portal, past the one of the other hand; which makes way where it is the one that is wanted. */
  async goOn(hand, wanted, count) {
    const { page, operator } = this;
    const other = 1 - hand;
    if (this.at[other] === wanted && this.at[hand] !== wanted) {
      await operator.otherHand();
      if (this.isIn[other]) await this.drawOut(other);
      await this.goOn(other, (wanted + 1) % count === this.at[hand] ? (wanted + 2) % count : (wanted + 1) % count, count);
      await operator.otherHand();
    }
    while (this.at[hand] !== wanted) {
      await page.keyboard.press("v");
      const next = (this.at[hand] + 1) % count;
      this.at[hand] = next === this.at[other] ? (next + 1) % count : next;
    }
  }

  async drawOut(hand) {
    await this.page.keyboard.down("d");
    try {
      for (let tries = 0; (await this.scope()).portals[hand] !== ""; ++tries) {
        if (tries > 100) {
          const s = await this.operator.snapshot(); const ps = await this.portals();
          const it = Operator.held(s, hand);
          throw new Error(`hand ${hand} does not come out ${JSON.stringify([it, s.hands[hand], ps.map((p) => ScopeGuide.lean(it.tip_mm, p)), await this.scope()])}`);
        }
        await this.page.waitForTimeout(100);
      }
      await this.page.waitForTimeout(400);
    } finally {
      await this.page.keyboard.up("d");
    }
    this.isIn[hand] = false;
  }

  /** Of the picture, on the page. */
  async middle() {
    const box = await this.page.locator(".scope-picture").boundingBox();
    return { x: box.x + box.width / 2, y: box.y + box.height / 2 };
  }

  async drag(right, up, shift = false) {
    const { mouse, keyboard } = this.page;
    const { x, y } = await this.middle();
    const within = (px) => Math.max(-MOST_DRAG_PX, Math.min(MOST_DRAG_PX, px));
    await mouse.move(x, y);
    if (shift) await keyboard.down("Shift");
    await mouse.down();
    await mouse.move(x + within(right), y - within(up), { steps: 2 });
    await mouse.up();
    if (shift) await keyboard.up("Shift");
  }

  /** Leans, goes in or out and turns until the tip lies there, as near as it can without pressing hard. @return how far it is off [mm] */
  async leadTo(place, portal, withinMm, rounds) {
    const { page, operator } = this;
    let off = Infinity;
    let warnings = 0;
    for (let round = 0; round < rounds; ++round) {
      const [now, scope] = [await operator.snapshot(), await this.scope()];
      const item = Operator.held(now, place.hand);
      off = size(add(item.tip_mm, place.tip, -1));
      const turn = place.turn === undefined ? 0 : ((place.turn - scope.shaft_deg + 540) % 360) - 180;
      if (off < withinMm && Math.abs(turn) < 4) break;
      const isWarned = size(now.hands[place.hand].force_n) > WARN_N;
      if (isWarned && ++warnings >= MOST_WARNINGS) break;
      const [is, wanted] = [item.tip_mm, place.tip].map((tip) => ScopeGuide.lean(tip, portal));
      const { x, y } = await this.middle();
      await page.mouse.move(x, y);
      const deeper = Math.round((wanted.depth - is.depth) / WHEEL_MM);
      for (let notch = 0; notch < Math.min(8, Math.abs(deeper)); ++notch)
        await page.mouse.wheel(0, deeper > 0 ? -100 : 100);
      const [right, up] = [wanted.yaw - is.yaw, wanted.pitch - is.pitch];
      if (Math.hypot(right, up) > 0.3) await this.drag(right / LEAN_DEG_PER_PX, up / LEAN_DEG_PER_PX);
      if (Math.abs(turn) > 3) await this.drag(-turn / TURN_DEG_PER_PX, 0, true);
      await page.waitForTimeout(160);
    }
    return off;
  }
}
