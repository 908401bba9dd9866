// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Two hands before two portals of a made-up joint, led at once.
import { describe, expect, it } from "vitest";
import type { ExerciseMessage, HandMessage, ScopeMessage, SnapshotMessage } from "../protocol";
import { length, subtract } from "../tool_placement";
import { ScopeLeading } from "./scope_leading";

const PORTAL = {
  joint: "radiocarpal",
  body: "radius",
  inwards: [0, 0, -1],
  capsule_mm: 10,
  landmarks: "",
};
// Only what leading asks of it.
const EXERCISE = {
  bodies: [{ name: "radius" }],
  instruments: [
    { id: "scope", name: "Scope", has_jaws: false, has_mouth: false, skin_work: "none" },
    { id: "shaver", name: "Shaver", has_jaws: false, has_mouth: true, skin_work: "none" },
  ],
  tray: ["shaver"],
  arthroscopy: {
    distal: [0, 1, 0],
    portals: [
      { ...PORTAL, name: "3-4", skin_mm: [0, 0, 0] },
      { ...PORTAL, name: "4-5", skin_mm: [10, 0, 0] },
      { ...PORTAL, name: "VR", skin_mm: [0, 0, -40], inwards: [0, 0, 1] },
    ],
  },
} as unknown as ExerciseMessage;

const SCOPE = {
  hand: 0,
  shaft_deg: 0,
  camera_deg: 0,
  jaws_closed: [0, 0],
  mouth_deg: [0, 0],
  portals: ["3-4", "4-5"],
} as unknown as ScopeMessage;

/** @param tools  hand 1 has taken its instrument */
function snapshot(tools: boolean, forceN = 0): SnapshotMessage {
  const item = (hand: number, instrument: string, x: number): object => ({
    hand,
    instrument,
    tip_mm: [x, 0, -20],
    shaft: [0, 0, 1],
  });
  return {
    bodies: [{ quaternion: [1, 0, 0, 0], translation_mm: [0, 0, 0] }],
    items: [item(0, "scope", 0), ...(tools ? [item(1, "shaver", 10)] : [])],
    hands: [{ force_n: [0, 0, forceN] }, { force_n: [0, 0, 0] }],
  } as unknown as SnapshotMessage;
}

type Sent = Omit<HandMessage, "type" | "sequence">;

function desk(tools = true): {
  readonly leading: ScopeLeading;
  readonly sent: Sent[];
  readonly did: string[];
  frame(): readonly Sent[];
  /** As told last. */
  words(text: string): string;
} {
  const sent: Sent[] = [];
  const did: string[] = [];
  let told = (text: string): string => text;
  const leading = new ScopeLeading(
    {
      operates: () => true,
      send: (hand) => sent.push(hand),
      turn: (deg) => did.push(`turn ${deg.toFixed(0)}`),
      turnMouth: (hand) => did.push(`mouth ${hand}`),
      take: (instrument, hand) => did.push(`take ${instrument} ${hand}`),
      pull: () => undefined,
      say: () => undefined,
      showSide: (facing) => did.push(`show ${facing.map((v) => Math.round(v)).join()}`),
      showHand: () => undefined,
      tellPortals: (words) => {
        told = words;
      },
    },
    () => undefined,
  );
  leading.begin(EXERCISE);
  leading.see(snapshot(tools));
  leading.seeScope(SCOPE);
  let now = 1000;
  const frame = (): readonly Sent[] => {
    sent.length = 0;
    leading.frame((now += 16));
    return [...sent];
  };
  frame();
  return { leading, sent, did, frame, words: (text) => told(text) };
}

describe("two hands at a scope", () => {
  it("are led at once, the one by the keys, the other by the pad", () => {
    const { leading, frame } = desk();
    leading.press("ArrowRight", { kind: "lean", yaw: 1, pitch: 0 });
    leading.second.lean(0.1, 0);
    const [scope, shaver] = frame();
    expect([scope?.hand, shaver?.hand]).toEqual([0, 1]);
    expect(Math.abs(scope?.tip_mm[0] ?? 0)).toBeGreaterThan(0.05);
    expect(Math.abs((shaver?.tip_mm[0] ?? 10) - 10)).toBeGreaterThan(1.5);
    // Nobody moves the second one now: it is not told again.
    expect(frame().map((one) => one.hand)).toEqual([0]);
  });

  it("are exchanged: then the pad has the scope, and turns it", () => {
    const { leading, did, frame } = desk();
    leading.second.turn(5, 0);
    expect(did).toEqual(["mouth 1"]);
    leading.switchHands();
    frame();
    leading.second.turn(5, 0);
    frame();
    expect(did).toEqual(["mouth 1", "turn 5"]);
    leading.second.lean(0.1, 0);
    expect(frame().map((one) => one.hand)).toEqual([0]);
  });

  it("run what the pad's trigger holds, and let it go with the hand", () => {
    const { leading, frame } = desk();
    leading.second.hold("pad drive", { kind: "run" });
    expect(frame()).toMatchObject([{ hand: 1, driver: "forward" }]);
    leading.switchHands();
    expect(frame().every((one) => one.driver === "off")).toBe(true);
  });

  it("take what works beside the scope when they are first led, once", () => {
    const { leading, did, frame } = desk(false);
    leading.second.hold("pad 5", { kind: "advance", by: 1 });
    frame();
    frame();
    expect(did).toEqual(["take shaver 1"]);
    leading.see(snapshot(true));
    expect(frame()).toMatchObject([{ hand: 1 }]);
  });

  it("take nothing where no second portal was made, and go in where portals were made", () => {
    const { leading, did, frame } = desk(false);
    const [first] = EXERCISE.arthroscopy?.portals ?? [];
    leading.hands.setPortals(first === undefined ? [] : [{ ...first, skin_mm: [0, 3, 0] }]);
    leading.beginAnew();
    leading.seeScope(SCOPE);
    leading.second.hold("pad 5", { kind: "advance", by: 1 });
    frame();
    expect(did).toEqual([]);
    leading.letGo("pad 5");
    leading.advance(5);
    const [scope] = frame();
    // The shaft runs through the hole in the skin.
    const { tip_mm: tip = [0, 0, 0], shaft = [0, 0, 1] } = scope ?? {};
    expect(tip[1] - (tip[2] / shaft[2]) * shaft[1]).toBeCloseTo(3, 6);
  });

  it("tell a step's words of the portals that were chosen for them", () => {
    const { leading, words } = desk();
    const said = (): string => words("{scope:radiocarpal} {tool:radiocarpal}");
    expect(said()).toBe("3-4:  4-5: ");
    leading.seeScope({ ...SCOPE, portals: ["", ""] });
    leading.goToNextPortal(0);
    expect(said()).toBe("VR:  4-5: ");
    leading.goToNextPortal(1);
    expect(said()).toBe("VR:  3-4: ");
  });

  it("show the side that their portal faces as they go round to it", () => {
    const { leading, did } = desk();
    leading.seeScope({ ...SCOPE, portals: ["", ""] });
    leading.goToNextPortal(0);
    expect(did).toContain("show 0,0,-1");
  });

  it("begin before their portal with what was taken elsewhere, wherever that is", () => {
    const { leading, frame } = desk();
    leading.forgetScope();
    leading.beginAnew();
    leading.advance(1);
    expect(frame(), "before the host has said where it is").toEqual([]);
    leading.seeScope({ ...SCOPE, portals: ["", "4-5"] });
    frame();
    leading.advance(1);
    const [scope, shaver] = frame();
    expect(scope?.tip_mm[2]).toBeCloseTo(29, 6);
    expect(scope?.shaft).toEqual([-0, -0, 1]);
    expect(shaver).toBeUndefined();
  });

  /** From where the host has the scope's tip. */
  const ahead = ([sent]: readonly Sent[]): number =>
    length(subtract(sent?.tip_mm ?? [0, 0, 0], [0, 0, -20]));

  it("are told to the host no farther ahead of a tip than it may go unfelt, and go on as it follows", () => {
    const { leading, frame } = desk();
    leading.seeScope(SCOPE);
    leading.see(snapshot(true));
    leading.leanBy("first", 0.5, 0);
    const before = ahead(frame());
    expect(before).toBeGreaterThan(3);
    expect(before).toBeLessThan(4); // 8 N
    expect(frame()).toEqual([]); // nothing new to tell ...
    leading.see(snapshot(true));
    expect(frame().length).toBe(1); // ... until the tip may have followed
  });

  it("do not pull without end at what comes no farther", () => {
    const { leading, frame } = desk();
    leading.seeScope(SCOPE);
    leading.press("KeyD", { kind: "advance", by: -1 });
    let farthest = 0;
    for (let i = 0; i < 200; ++i) {
      leading.see(snapshot(true, 6));
      farthest = Math.max(farthest, ahead(frame()));
    }
    expect(farthest).toBeGreaterThan(1);
    expect(farthest).toBeLessThanOrEqual(5.001);
  });
});
