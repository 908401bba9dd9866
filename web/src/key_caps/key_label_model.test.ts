// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Keys are named as the person's own keyboard has them.
import { describe, expect, it } from "vitest";
import { labelled, labelOf, labelsOf, learnt, type KeyLabels } from "./key_label_model";

const none: KeyLabels = new Map();
const german = labelsOf([
  ["BracketLeft", "ü"],
  ["BracketRight", "+"],
  ["Minus", "ß"],
  ["KeyZ", "y"],
  ["Digit7", "7"],
]);
const french = labelsOf([
  ["KeyA", "q"],
  ["Digit1", "&"],
]);

describe("labelled", () => {
  it("names keys as an English keyboard where nothing is known", () => {
    expect(labelled("{BracketLeft} / {BracketRight}, {KeyA}, hold Space", none)).toBe(
      "[ / ], A, hold Space",
    );
  });

  it("names them as the person's layout has them", () => {
    expect(labelled("{BracketLeft} / {BracketRight}", german)).toBe("Ü / +");
    expect(labelled("undo {KeyZ}", german)).toBe("undo Y");
    expect(labelled("{KeyA}", french)).toBe("Q");
  });

  it("leaves other braces alone", () => {
    expect(labelled("{not a key} {}", german)).toBe("{not a key} {}");
  });
});

describe("labelOf", () => {
  it("shows a digit on its key even where it needs Shift", () => {
    expect(labelOf("Digit1", french)).toBe("1");
  });

  it("keeps a letter that has no capital of its own", () => {
    expect(labelOf("Minus", german)).toBe("ß");
  });
});

describe("learnt", () => {
  it("takes the character of a plain key", () => {
    const labels = learnt(none, { code: "KeyQ", key: "a", modified: false });
    expect(labelOf("KeyQ", labels)).toBe("A");
  });

  it("learns nothing of modified, dead, named or unprinted keys", () => {
    for (const typed of [
      { code: "KeyQ", key: "@", modified: true },
      { code: "Backquote", key: "Dead", modified: false },
      { code: "ArrowUp", key: "ArrowUp", modified: false },
      { code: "Space", key: " ", modified: false },
      { code: "KeyQ", key: "q", modified: false },
    ])
      expect(learnt(none, typed)).toBe(none);
  });
});
