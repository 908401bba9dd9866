// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from "vitest";
import { addressOfCase, nextForWanted, wantedCase } from "./wanted_case_model";

describe("the case that an address wants", () => {
  it("is what was put into it", () => {
    const address = addressOfCase("displaced left & deep", "replay/12");
    expect(wantedCase(address)).toEqual({ id: "displaced left & deep", then: "#/replay/12" });
  });

  it("goes on to an attempt's pages and nowhere else", () => {
    expect(wantedCase("#/?case=easy&then=attempts/3")?.then).toBe("#/attempts/3");
    expect(wantedCase("#/?case=easy&then=replay/3/4")?.then).toBe("#/replay/3/4");
    expect(wantedCase("#/?case=easy&then=replay/3/4/5")?.then).toBe("");
    expect(wantedCase("#/?case=easy&then=scan")?.then).toBe("");
    expect(wantedCase("#/?case=easy")?.then).toBe("");
  });

  it("is none where the address names none", () => {
    for (const hash of ["", "#/", "#/?", "#/?case=", "#/replay/12", "#/scan/easy"]) {
      expect(wantedCase(hash)).toBeUndefined();
    }
  });
});

describe("what comes of it", () => {
  const shelved = (id: string) => ({ id, title: id, history: "", goal: "", difficulty: null });
  const cases = ["easy", "hard"].map((id) => ({
    ...shelved(id),
    flagged: [],
    of_scan: [],
    has_preview: false,
  }));
  const list = { open: "easy", cases };
  const wanted = (id: string) => ({ id, then: "#/replay/12" });

  it("opens another, and goes on where it is open", () => {
    expect(nextForWanted(list, wanted("hard"), false)).toEqual({ what: "choose", id: "hard" });
    expect(nextForWanted(list, wanted("easy"), true)).toEqual({ what: "go", hash: "#/replay/12" });
    expect(nextForWanted(list, undefined, false)).toEqual({ what: "nothing" });
  });

  it("ends no operation, and asks for no case that is not there", () => {
    expect(nextForWanted(list, wanted("hard"), true)).toMatchObject({ what: "say" });
    expect(nextForWanted(list, wanted("gone"), false)).toEqual({
      what: "say",
      text: "There is no case 'gone' here any more.",
    });
  });
});
