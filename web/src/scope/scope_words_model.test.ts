// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from "vitest";
import { scopeWords } from "./scope_words_model";

describe("words in the round picture", () => {
  it("say where the scope is and how it gets in", () => {
    expect(scopeWords({ portal: "", isInJoint: false, isSlack: false }, "3-4 portal")).toEqual({
      where: "The scope is outside.",
      next: "Enter through the 3-4 portal: hold",
      key: "in",
    });
    const between = { portal: "4-5", isInJoint: false, isSlack: false };
    expect(scopeWords(between, "3-4 portal").where).toContain("4-5");
  });
  it("tell to pull first while the joint is closed", () => {
    const { next, key } = scopeWords({ portal: "", isInJoint: false, isSlack: true }, "3-4 portal");
    expect(next).toContain("Pull");
    expect(key).toBe("pull");
  });
  it("leave the picture alone in the joint", () => {
    const { where, next } = scopeWords({ portal: "3-4", isInJoint: true, isSlack: true }, "3-4");
    expect([where, next]).toEqual(["", ""]);
  });
});
