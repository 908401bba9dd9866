// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from "vitest";
import type {
  ExerciseMessage,
  Instrument,
  Item,
  ScopeMessage,
  SkinMessage,
  Vec3,
} from "../protocol";
import { mouthTowards, ScopeTools } from "./scope_tools";

const instrument = (id: string, ...has: ("has_jaws" | "has_bite" | "has_mouth")[]) => ({
  id,
  has_jaws: has.includes("has_jaws"),
  has_bite: has.includes("has_bite"),
  has_mouth: has.includes("has_mouth"),
});

function tools(...held: ReturnType<typeof instrument>[]): ScopeTools {
  const made = new ScopeTools();
  const instruments = [instrument("arthroscope_1_9_30"), ...held];
  made.begin({ instruments } as unknown as ExerciseMessage);
  return made;
}

const SHAVER = instrument("shaver_2_0", "has_mouth");
const GRASPER = instrument("grasper_2_0", "has_jaws");
const PUNCH = instrument("punch_2_0", "has_jaws", "has_bite");
const told = (running: number, mouthDeg: number): ScopeMessage =>
  ({
    running: [0, running],
    mouth_deg: [0, mouthDeg],
    jaws_closed: [0, 1],
  }) as unknown as ScopeMessage;
const item = (id: string): Item =>
  ({
    instrument: id,
    hand: 1,
    tip_mm: [1, 2, 3],
    shaft: [1, 0, 0],
  }) as unknown as Item;

const LEVEL: Vec3 = [0, 0, 1];

function expectWay(got: Vec3 | undefined, wanted: Vec3): void {
  wanted.forEach((value, i) => {
    expect(got?.[i]).toBeCloseTo(value, 6);
  });
}

describe("what works beside the scope", () => {
  it("is of the kind that an empty hand will take: the tray's last", () => {
    const kind = (one: ScopeTools): string => one.kindOf(undefined);
    expect(kind(tools())).toBe("probe");
    expect(kind(tools(GRASPER))).toBe("grasper");
    expect(kind(tools(SHAVER))).toBe("shaver");
    expect(kind(tools(PUNCH, SHAVER))).toBe("shaver");
    const twice = tools(SHAVER);
    twice.begin({ instruments: [] } as unknown as ExerciseMessage);
    expect(kind(twice)).toBe("probe");
  });

  it("is of the kind of what a hand holds, where the tray has more than one", () => {
    const both = tools(PUNCH, SHAVER);
    expect(both.kindOf("punch_2_0")).toBe("punch");
    expect(both.kindOf("shaver_2_0")).toBe("shaver");
    expect(both.kindOf("arthroscope_1_9_30")).toBe("probe");
    expect([both.hasJaws("punch_2_0"), both.hasMouth("punch_2_0")]).toEqual([true, false]);
    expect([both.hasJaws("shaver_2_0"), both.hasMouth("shaver_2_0")]).toEqual([false, true]);
    expect(both.driver(1, "punch_2_0", true)).toBe("reverse");
    both.setJaws(1, undefined);
    expect(both.driver(1, "punch_2_0", false)).toBe("forward");
    expect(both.driver(1, "shaver_2_0", false)).toBe("off");
  });

  it("is drawn as a punch, open and closed as the host has it", () => {
    const punch = tools(PUNCH, SHAVER);
    const look = (closed: number): string | undefined =>
      punch.rod(item("punch_2_0"), { ...told(0, 0), jaws_closed: [0, closed] }, LEVEL, 0, undefined)
        ?.look;
    expect([look(0), look(1)]).toEqual(["punch_open", "punch_closed"]);
    // However a shaver's mouth was turned before in that hand: upwards.
    expectWay(punch.rod(item("punch_2_0"), told(0, 90), LEVEL, 0, undefined)?.mouth, [0, 0, 1]);
  });

  it("runs while a pedal is down; jaws know no pedal, and a probe has neither", () => {
    expect([true, false].map((down) => tools(SHAVER).driver(1, "shaver_2_0", down))).toEqual([
      "forward",
      "off",
    ]);
    expect([true, false].map((down) => tools().driver(1, "arthroscope_1_9_30", down))).toEqual([
      "off",
      "off",
    ]);
    const grasper = tools(GRASPER);
    expect(grasper.driver(1, "grasper_2_0", true)).toBe("reverse");
    grasper.setJaws(1, undefined);
    expect(grasper.driver(1, "grasper_2_0", false)).toBe("forward");
  });

  it("turns its mouth from where the host has it, round and round", () => {
    const shaver = tools(SHAVER);
    expect(shaver.turnMouth(1, 30)).toBe(30);
    shaver.take(told(0, 170), () => true);
    expect(shaver.turnMouth(1, 20)).toBeCloseTo(-170, 9);
    expect(shaver.turnMouth(0, -5)).toBe(-5);
    expect(shaver.hasMouth("shaver_2_0")).toBe(true);
    expect(shaver.hasMouth("arthroscope_1_9_30")).toBe(false);
    expect(shaver.hasMouth(undefined)).toBe(false);
  });

  it("is drawn with its mouth as the host has it, and a blade that moves while it runs", () => {
    const shaver = tools(SHAVER);
    const looks = (running: number): Set<string | undefined> =>
      new Set(
        [0, 100, 200, 300].map(
          (ms) => shaver.rod(item("shaver_2_0"), told(running, 90), LEVEL, ms, undefined)?.look,
        ),
      );
    expect(looks(0)).toEqual(new Set(["shaver"]));
    expect(looks(1)).toEqual(new Set(["shaver", "blade"]));
    const rod = shaver.rod(item("shaver_2_0"), told(0, 90), LEVEL, 0, undefined);
    expect(rod?.tipMm).toEqual([1, 2, 3]);
    expectWay(rod?.mouth, [0, -1, 0]);
    const closed = tools(GRASPER).rod(item("grasper_2_0"), told(0, 90), LEVEL, 0, undefined);
    expect(closed?.look).toBe("closed");
    expect(closed?.mouth).toBeUndefined();
  });
});

describe("what makes a portal, as the scope shows it", () => {
  const made = new ScopeTools();
  const works = (id: string, work: Instrument["skin_work"]) => ({
    ...instrument(id),
    skin_work: work,
  });
  const instruments = [
    works("needle_22g", "needle"),
    works("mosquito_clamp", "spread"),
    works("fingertip", "palpate"),
  ];
  made.begin({ instruments } as unknown as ExerciseMessage);
  const skin = (spreads: boolean): SkinMessage =>
    ({ hands: [{ is_spreading: false }, { is_spreading: spreads }] }) as unknown as SkinMessage;
  const seen = (id: string, spreads = false) =>
    made.rod(item(id), told(0, 0), LEVEL, 0, skin(spreads));

  it("is drawn by its own parts, where the host has its tip", () => {
    expect(seen("needle_22g")).toMatchObject({ instrument: "needle_22g", tipMm: [1, 2, 3] });
  });

  it("is a pair of open jaws while a clamp spreads", () => {
    expect(seen("mosquito_clamp")?.instrument).toBe("mosquito_clamp");
    expect(seen("mosquito_clamp", true)).toMatchObject({ look: "open" });
    expect(seen("mosquito_clamp", true)?.instrument).toBeUndefined();
  });

  it("is nothing for a fingertip, which stays outside", () => {
    expect(seen("fingertip")).toBeUndefined();
  });
});

describe("where a mouth looks", () => {
  it("is towards what is level, across the shaft, turning right-handed about it", () => {
    // As the host's own test has it: simulation/shaving_test.cpp.
    expectWay(mouthTowards([1, 0, 0], LEVEL, 0), [0, 0, 1]);
    expectWay(mouthTowards([1, 0, 0], LEVEL, 90), [0, -1, 0]);
    expectWay(mouthTowards([1, 0, 0], LEVEL, 180), [0, 0, -1]);
    expectWay(mouthTowards([1, 0, 0], LEVEL, -90), [0, 1, 0]);
    // A shaft that comes from above by 3 : 4.
    expectWay(mouthTowards([0.8, 0, 0.6], LEVEL, 0), [-0.6, 0, 0.8]);
    expectWay(mouthTowards([0.8, 0, 0.6], LEVEL, 90), [0, -1, 0]);
    expectWay(mouthTowards([0.8, 0, 0.6], LEVEL, 30), [
      -0.6 * Math.cos(Math.PI / 6),
      -0.5,
      0.8 * Math.cos(Math.PI / 6),
    ]);
  });

  it("is somewhere across the shaft where that is level itself", () => {
    const way = mouthTowards(LEVEL, LEVEL, 0);
    expect(Math.hypot(...way)).toBeCloseTo(1, 9);
    expect(way[2]).toBeCloseTo(0, 9);
  });
});
