// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from "vitest";
import { cusum, cusumLimits, standing } from "./cusum_model";
import { CUSUM_LIMITS } from "./review_limits";

const limits = cusumLimits({
  acceptable: 0.1,
  unacceptable: 0.3,
  falseAlarm: 0.05,
  missedAlarm: 0.2,
});

describe("cusumLimits", () => {
  it("are those of the sequential test, by hand", () => {
    // ln 3 = 1.0986, ln(0.9 / 0.7) = 0.2513
    expect(limits.s).toBeCloseTo(0.2513 / 1.3499, 3);
    expect(limits.lower).toBeCloseTo(Math.log(4.75) / 1.3499, 3);
    expect(limits.upper).toBeCloseTo(Math.log(16) / 1.3499, 3);
  });
  it("of the data ask for a handful of good attempts, and mind the second bad one", () => {
    expect(Math.ceil(CUSUM_LIMITS.lower / CUSUM_LIMITS.s)).toBe(6);
    expect(Math.ceil(CUSUM_LIMITS.upper / (1 - CUSUM_LIMITS.s))).toBe(2);
  });
});

describe("cusum", () => {
  it("falls with success, rises with failure and begins anew at a limit", () => {
    const points = cusum([true, false, false], limits);
    expect(points.map((point) => point.sum)).toEqual([
      expect.closeTo(1 - limits.s),
      expect.closeTo(1 - 2 * limits.s),
      expect.closeTo(1 - 3 * limits.s),
    ]);
    const good = cusum(
      Array.from({ length: 12 }, () => false),
      limits,
    );
    expect(good.findIndex((point) => point.verdict === "proficient")).toBe(6);
    expect(good[7]?.sum).toBeCloseTo(-limits.s);
    expect(standing(good)).toBe("proficient");
  });
  it("sees a relapse", () => {
    const series = [...Array.from({ length: 7 }, () => false), true, true, true];
    const points = cusum(series, limits);
    expect(points.map((point) => point.verdict).filter(Boolean)).toEqual(["proficient", "relapse"]);
    expect(standing(points)).toBe("relapse");
    expect(standing([])).toBe("");
  });
});
