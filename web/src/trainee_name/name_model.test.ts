// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Any alphabet is a name; what makes a list read as something else is not.
import { describe, expect, it } from "vitest";
import { nameProblem } from "./name_model";

describe("nameProblem", () => {
  it.each(["", "Ada", "José María", "张伟", "محمد", "👩‍⚕️", "O'Neill <b>"])("accepts %j", (name) => {
    expect(nameProblem(name)).toBeUndefined();
  });
  it.each([
    ["Ada\n", "control character (U+000A)"],
    ["Ada\u0000", "control character (U+0000)"],
    ["\u001b[31mAda", "control character (U+001B)"],
    ["Ada\u0085", "control character (U+0085)"],
    ["Ada\u2028", "control character (U+2028)"],
    ["gpj.\u202eada", "direction of writing (U+202E)"],
    ["\u2067Ada", "direction of writing (U+2067)"],
  ])("refuses %j by its number", (name, why) => {
    expect(nameProblem(name)).toContain(why);
  });
});
