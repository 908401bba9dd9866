// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from "vitest";
import { scopeWords } from "./scope_words_model";

describe("words in the round picture", () => {
  it("say where the scope is and how it gets in", () => {
    expect(scopeWords({ portal: "", isInJoint: false }, "3-4 portal")).toEqual({
      where: "The scope is outside.",
      next: "Enter through the 3-4 portal: hold",
    });
    expect(scopeWords({ portal: "4-5", isInJoint: false }, "3-4 portal").where).toContain("4-5");
  });
  it("leave the picture alone in the joint", () => {
    expect(scopeWords({ portal: "3-4", isInJoint: true }, "3-4")).toEqual({ where: "", next: "" });
  });
});
