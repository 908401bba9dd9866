// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What is offered is found by what is asked for; the reason is the host's.
import { describe, expect, it } from "vitest";
import type { Action, Instrument } from "../protocol";
import { actMessage, OfferedActions } from "./offered_actions";

function action(more: Partial<Action>): Action {
  return {
    id: "take",
    hand: 0,
    instrument: "",
    item: -1,
    label: "",
    allowed: true,
    refusal: "none",
    reason: "",
    ...more,
  };
}

const offered = new OfferedActions([
  action({ instrument: "gauge", allowed: false, refusal: "no_wire", reason: "No wire lies there" }),
  action({ instrument: "wire" }),
  action({ hand: 1, instrument: "gauge" }),
  action({ id: "pick_up", hand: 1, item: 3 }),
  action({ id: "undo", hand: -1, allowed: false, reason: "Nothing to undo" }),
]);

describe("OfferedActions", () => {
  it("tells hands and instruments apart", () => {
    expect(offered.whyNot({ id: "take", instrument: "gauge" })).toBe("No wire lies there");
    expect(offered.whyNot({ id: "take", hand: 1, instrument: "gauge" })).toBeUndefined();
    expect(offered.whyNot({ id: "take", instrument: "wire" })).toBeUndefined();
  });

  it("finds what no hand is meant for, whichever hand asks", () => {
    expect(offered.whyNot({ id: "undo", hand: 1 })).toBe("Nothing to undo");
  });

  it("lists what a hand can take hold of", () => {
    expect(offered.pickUps(1).map((one) => one.item)).toEqual([3]);
    expect(offered.pickUps(0)).toEqual([]);
  });

  it("measures by taking, reading and putting down, without taking what is held", () => {
    const tray = [{ id: "wire" }, { id: "gauge", is_gauge: true }] as Instrument[];
    const ids = (held: string): string[] =>
      offered.measuring(1, held, tray).map((asked) => asked.id);
    expect(ids("wire")).toEqual(["take", "read_gauge", "put_down"]);
    expect(ids("gauge")).toEqual(["read_gauge", "put_down"]);
    expect(offered.measuring(1, "", [])).toEqual([]);
  });
});

describe("actMessage", () => {
  it("says nothing of what is not meant", () => {
    expect(actMessage({ id: "undo" })).toEqual({
      type: "act",
      id: "undo",
      hand: null,
      instrument: null,
      item: null,
      reasons: null,
      aid: null,
      displaced: null,
    });
  });
});
