// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from "vitest";
import { withPortals } from "./portal_words_model";

const portal = (id: string, joint = "radiocarpal") => ({
  id,
  joint,
  name: `${id} portal`,
  landmarks: `where ${id} lies`,
});
const first = portal("3-4");
const second = portal("4-5");
const midcarpal = portal("MCR", "midcarpal");
const all = [first, second, midcarpal];

describe("a step's words for a portal", () => {
  it("are those of the one that was chosen", () => {
    const said = (scope: typeof first): string =>
      withPortals("In by the {scope:radiocarpal}.", all, { scope, tool: second });
    expect(said(first)).toBe("In by the 3-4 portal: where 3-4 lies.");
    expect(said(portal("6R"))).toBe("In by the 6R portal: where 6R lies.");
  });

  it("stay with the step's joint where the chosen one leads into another", () => {
    const text = "{scope:radiocarpal}; {scope:midcarpal}; {tool:radiocarpal}";
    const said = withPortals(text, all, { scope: midcarpal, tool: midcarpal }).split("; ");
    expect(said.map((one) => one.split(":")[0])).toEqual([
      "3-4 portal",
      "MCR portal",
      "3-4 portal",
    ]);
  });

  it("are not for two in one portal", () => {
    const said = withPortals("{tool:radiocarpal}", all, { scope: first, tool: midcarpal });
    expect(said).toBe("4-5 portal: where 4-5 lies");
  });

  it("leave other words alone, and name no portal that is not there", () => {
    const nothing = { scope: undefined, tool: undefined };
    expect(withPortals("Press {KeyA}.", [], nothing)).toBe("Press {KeyA}.");
    expect(withPortals("By the {scope:midcarpal}.", [], nothing)).toBe("By the midcarpal portal.");
  });
});
