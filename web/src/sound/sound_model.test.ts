// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The motor's pitch tells cortex from marrow and from nothing; screws click, the C-arm beeps.
import { describe, expect, it } from "vitest";
import { SoundModel, type Heard, type Sounds } from "./sound_model";

const rest: Heard = {
  nowMs: 0,
  driver: "off",
  drive: "powered",
  resistanceN: 0,
  torqueNMm: 0,
  depthMm: 0,
  pitchMm: 0,
  live: false,
  shots: 0,
  press: "none",
};

/** Told for so long, 60 times a second. */
function after(model: SoundModel, fromMs: number, ms: number, more: Partial<Heard>): Sounds {
  let sounds = model.hear({ ...rest, ...more, nowMs: fromMs });
  for (let t = 16; t <= ms; t += 16) sounds = model.hear({ ...rest, ...more, nowMs: fromMs + t });
  return sounds;
}

describe("SoundModel", () => {
  it("is silent at rest and for what is turned by hand", () => {
    expect(after(new SoundModel(), 0, 500, {})).toMatchObject({ motorHz: 0, clicks: 0 });
    const byHand = after(new SoundModel(), 0, 500, { driver: "forward", drive: "by_hand" });
    expect(byHand.motorHz).toBe(0);
  });

  it("falls in pitch with the load, and leaps on breakthrough", () => {
    const model = new SoundModel();
    const free = after(model, 0, 500, { driver: "forward" }).motorHz;
    const cortex = after(model, 500, 500, { driver: "forward", resistanceN: 35 }).motorHz;
    expect(cortex).toBeLessThan(0.75 * free);
    const through = after(model, 1000, 100, { driver: "forward", resistanceN: 0.3 }).motorHz;
    expect(through).toBeGreaterThan(free);
    const later = after(model, 1100, 500, { driver: "forward", resistanceN: 0.3 }).motorHz;
    expect(later).toBeLessThan(through);
    expect(Math.abs(later - free)).toBeLessThan(0.01 * free);
  });

  it("clicks twice a turn, in and out, but not for a jump", () => {
    const model = new SoundModel();
    const screw: Partial<Heard> = { driver: "forward", drive: "by_hand", pitchMm: 1 };
    let clicks = 0;
    for (let i = 0; i <= 300; ++i)
      clicks += model.hear({ ...rest, ...screw, nowMs: 16 * i, depthMm: 0.01 * i }).clicks;
    expect(clicks).toBe(6);
    expect(model.hear({ ...rest, torqueNMm: 80 }).tightness).toBe(0.5);
    expect(model.hear({ ...rest, torqueNMm: 900 }).tightness).toBe(1);
    expect(model.hear({ ...rest, ...screw, nowMs: 5000, depthMm: 0 }).clicks).toBe(0);
  });

  it("beeps while the pedal is down, and once for a shot", () => {
    const model = new SoundModel();
    model.hear(rest);
    expect(model.hear({ ...rest, shots: 1 }).shot).toBe(true);
    expect(model.hear({ ...rest, shots: 1 }).shot).toBe(false);
    const live = model.hear({ ...rest, shots: 2, live: true });
    expect([live.beeps, live.shot]).toEqual([true, false]);
  });

  it("takes no count from an operation that was begun before", () => {
    expect(new SoundModel().hear({ ...rest, shots: 7 }).shot).toBe(false);
  });

  it("knocks while something presses too hard in a joint, faster and harder where it does harm", () => {
    const knocks = (press: Heard["press"]): readonly number[] => {
      const model = new SoundModel();
      const heard = Array.from({ length: 60 }, (_, i) =>
        model.hear({ ...rest, press, nowMs: 16 * i }),
      );
      return heard.flatMap(({ knock }) => knock ?? []);
    };
    expect(knocks("none")).toEqual([]);
    expect(knocks("hard")).toEqual([0, 0, 0]);
    expect(knocks("harm").length).toBeGreaterThan(4);
    expect(knocks("harm")[0]).toBe(1);
  });
});
