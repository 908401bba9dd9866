// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Page and host agree on who operates what, whenever the line breaks.
import { describe, expect, it } from "vitest";
import { Participation } from "./participation_model";

function operating(exercise: number): Participation {
  const part = new Participation();
  part.ask();
  expect(part.arrive(exercise, true)).toBe("begun");
  return part;
}

describe("Participation", () => {
  it("begins what it asked for", () => {
    const part = new Participation();
    expect(part.arrive(0, false)).toBe("free");
    expect(part.operates).toBe(false);
    part.ask();
    expect(part.operates).toBe(true);
    expect(part.arrive(7, true)).toBe("begun");
    expect(part.operates).toBe(true);
  });

  it("goes on after a lost connection", () => {
    const part = operating(7);
    part.lose();
    expect(part.arrive(7, true)).toBe("goes_on");
    expect(part.operates).toBe(true);
  });

  it("starts anew in the middle", () => {
    const part = operating(7);
    part.ask();
    expect(part.arrive(8, true)).toBe("begun");
    expect(part.arrive(8, true)).toBe("goes_on");
  });

  it("goes on with the old one when the request for a new one was lost", () => {
    const part = operating(7);
    part.ask();
    expect(part.arrive(7, true)).toBe("goes_on");
  });

  it("is told when its exercise has ended", () => {
    const part = operating(7);
    expect(part.arrive(0, false)).toBe("ended");
    expect(part.operates).toBe(false);
    expect(part.isOffered).toBe(false);
  });

  it("does not take another's exercise for its own", () => {
    const part = operating(7);
    expect(part.arrive(9, false)).toBe("replaced");
    expect(part.operates).toBe(false);
    expect(part.isOffered).toBe(false);
    expect(part.endsOne).toBe(true);
  });

  it("may only end another's that stands still, by a start of its own", () => {
    const part = new Participation();
    expect(part.arrive(7, false)).toBe("foreign");
    expect(part.isOffered).toBe(false);
    expect(part.endsOne).toBe(true);
    part.ask();
    expect(part.arrive(8, true)).toBe("begun");
    expect(part.endsOne).toBe(false);
  });

  it("does not begin another's when its own request was lost", () => {
    const part = new Participation();
    part.ask();
    expect(part.arrive(9, false)).toBe("free");
    expect(part.operates).toBe(false);
    expect(part.endsOne).toBe(true);
  });

  it("goes on with one that waits, after a reload", () => {
    const part = new Participation();
    expect(part.arrive(7, true)).toBe("offered");
    expect(part.operates).toBe(false);
    part.goOn();
    expect(part.operates).toBe(true);
    expect(part.isOffered).toBe(false);
    expect(part.arrive(7, true)).toBe("goes_on");
  });

  it("offers nothing while the line is lost", () => {
    const part = new Participation();
    part.arrive(7, true);
    part.lose();
    expect(part.isOffered).toBe(false);
  });

  it("asks again when its first request was lost", () => {
    const part = new Participation();
    part.ask();
    expect(part.arrive(0, false)).toBe("free");
    expect(part.operates).toBe(false);
  });
});
