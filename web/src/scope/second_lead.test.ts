// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from "vitest";
import type { ToolKind } from "./scope_tools";
import { PadAtScope } from "./second_lead";

function padWith(tool: ToolKind): { readonly pad: PadAtScope; readonly did: string[] } {
  const did: string[] = [];
  const note =
    (what: string) =>
    (...values: readonly unknown[]): void => {
      const words = values.map((v) => (typeof v === "number" ? v.toFixed(2) : JSON.stringify(v)));
      did.push([what, ...words].join(" "));
    };
  const pad = new PadAtScope(
    {
      tool,
      lean: note("lean"),
      turn: note("turn"),
      hold: note("hold"),
      letGo: note("let go"),
      setJaws: note("jaws"),
      goToNextPortal: note("portal"),
      switchHands: note("switch"),
      pull: note("pull"),
    },
    note("focus"),
  );
  return { pad, did };
}

describe("a gamepad at a scope", () => {
  it("leans as fast as the arrows do, and turns with the stick", () => {
    const { pad, did } = padWith("probe");
    pad.moveTipBy(30, 0); // a second, pushed as far as it goes
    pad.turnShaftBy(Math.PI / 180, (2 * Math.PI) / 180);
    expect(did).toEqual([`lean ${((28 * Math.PI) / 180).toFixed(2)} 0.00`, "turn -1.00 2.00"]);
  });

  it("goes in and draws back by its bumpers", () => {
    const { pad, did } = padWith("probe");
    pad.hold("pad 5", { kind: "approach", closer: true });
    pad.hold("pad 4", { kind: "approach", closer: false });
    pad.letGo("pad 4");
    expect(did).toEqual([
      'hold "pad 5" {"kind":"advance","by":1}',
      'hold "pad 4" {"kind":"advance","by":-1}',
      'let go "pad 4"',
    ]);
  });

  it("does with its triggers what the instrument does, and nothing with a probe", () => {
    const drive = (tool: ToolKind, driver: "forward" | "reverse"): readonly string[] => {
      const { pad, did } = padWith(tool);
      pad.hold("pad drive", { kind: "drive", driver });
      return did;
    };
    expect(drive("grasper", "forward")).toEqual(["jaws true"]);
    expect(drive("grasper", "reverse")).toEqual(["jaws false"]);
    expect(drive("shaver", "forward")).toEqual(['hold "pad drive" {"kind":"run"}']);
    expect(drive("shaver", "reverse")).toEqual([]);
    expect(drive("probe", "forward")).toEqual([]);
  });

  it("keeps from the room what means something else at a scope, or nothing", () => {
    const { pad, did } = padWith("probe");
    expect(pad.act({ kind: "switch_hand" })).toBe(false);
    expect(pad.act({ kind: "aim_along_sight" })).toBe(false);
    expect(pad.act({ kind: "put_down" })).toBe(false);
    expect(pad.act({ kind: "pause" })).toBe(true);
    expect(pad.act({ kind: "finish" })).toBe(true);
    pad.hold("pad 12", { kind: "orbit", to: "up" });
    pad.hold("pad 14", { kind: "orbit", to: "left" });
    pad.hold("pad 15", { kind: "orbit", to: "right" });
    pad.hold("pad wrist", { kind: "move_wrist", axis: "flexion_deg", sign: 1 });
    expect(did).toEqual(["switch", "portal", "pull 5.00", "focus 1.00", "focus -1.00"]);
  });
});
