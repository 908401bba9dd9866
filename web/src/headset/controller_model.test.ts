// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from "vitest";
import { instrumentWish, tableWish, type ControllerState } from "./controller_model";

function controller(down: Readonly<Record<number, number>> = {}, x = 0, y = 0): ControllerState {
  const buttons = [0, 1, 2, 3, 4, 5].map((button) => {
    const value = down[button] ?? 0;
    return { value, pressed: value > 0.1 };
  });
  return { axes: [0, 0, x, y], buttons };
}

describe("the controller that is the instrument", () => {
  it("drives as deep as its trigger is pressed", () => {
    expect(instrumentWish(controller({ 0: 0.05 }), undefined).held.size).toBe(0);
    const half = instrumentWish(controller({ 0: 0.54 }), undefined);
    expect(half.held.get("headset drive")).toEqual({ kind: "drive", driver: "forward" });
    expect(half.squeeze).toBeCloseTo(0.5);
    expect(instrumentWish(controller({ 0: 1 }), undefined).squeeze).toBe(1);
  });

  it("comes back where both are pressed", () => {
    const held = instrumentWish(controller({ 0: 1, 1: 1 }), undefined).held;
    expect([...held.keys()]).toEqual(["headset reverse"]);
  });

  it("takes a picture once, however long the button is down", () => {
    const down = controller({ 4: 1 });
    expect(instrumentWish(down, controller()).once).toEqual([{ kind: "next_shot" }]);
    expect(instrumentWish(down, down).once).toEqual([]);
  });

  it("chooses by a flick, one at a time", () => {
    expect(instrumentWish(controller({}, 0.9), controller()).once).toEqual([
      { kind: "choose", by: 1 },
    ]);
    expect(instrumentWish(controller({}, 1), controller({}, 0.9)).once).toEqual([]);
    expect(instrumentWish(controller({}, -0.9), controller({}, 0.3)).once).toEqual([
      { kind: "choose", by: -1 },
    ]);
    expect(instrumentWish(controller({}, 0.5), controller()).once).toEqual([]);
  });

  it("stands what a browser leaves out", () => {
    const wish = instrumentWish({ axes: [], buttons: [] }, undefined);
    expect(wish).toEqual({ held: new Map(), squeeze: 0, once: [] });
  });
});

describe("the controller that holds the table", () => {
  it("holds the pedal, carries the table", () => {
    expect(tableWish(controller({ 0: 1 }), undefined)).toMatchObject({ pedal: true });
    expect(tableWish(controller({ 1: 1 }), undefined)).toMatchObject({ carries: true });
  });

  it("turns or enlarges, never both, and rests with a worn stick", () => {
    expect(tableWish(controller({}, 1, 0.5), undefined)).toMatchObject({ turn: 1, grow: 0 });
    expect(tableWish(controller({}, 0.1, -1), undefined)).toMatchObject({ turn: 0, grow: 1 });
    expect(tableWish(controller({}, 0.15, 0.15), undefined)).toMatchObject({ turn: 0, grow: 0 });
  });

  it("moves the wrist with what it grips, and carries nothing meanwhile", () => {
    const flexed = tableWish(controller({ 1: 1 }, 0.2, 0.9), undefined);
    expect([...flexed.wrist.values()]).toEqual([
      { kind: "move_wrist", axis: "flexion_deg", sign: 1 },
    ]);
    expect(flexed).toMatchObject({ carries: false, turn: 0, grow: 0 });
    const turned = tableWish(controller({ 1: 1, 4: 1 }, -0.8, 0), controller());
    expect([...turned.wrist.values()]).toEqual([
      { kind: "move_wrist", axis: "radial_deviation_deg", sign: -1 },
      { kind: "move_wrist", axis: "pronation_deg", sign: -1 },
    ]);
    expect(turned.once).toEqual([]);
    expect(tableWish(controller({ 4: 1 }, 0, 1), undefined).wrist.size).toBe(0);
  });

  it("stops the clock once", () => {
    const down = controller({ 5: 1 });
    expect(tableWish(down, controller()).once).toEqual([{ kind: "pause" }]);
    expect(tableWish(down, down).once).toEqual([]);
  });
});
