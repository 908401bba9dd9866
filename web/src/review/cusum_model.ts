// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The cumulative sum of failures against what is expected of one who can do it: down by s for each
// success, up by 1 - s for each failure. Below the lower limit the failure rate is acceptable, above
// the upper one it is not; either way it begins anew at 0, so that a relapse is seen (Wald's
// sequential test, as surgeons' learning curves use it).

export interface CusumRates {
  readonly acceptable: number;
  readonly unacceptable: number;
  /** Chance that a good one is called bad. */
  readonly falseAlarm: number;
  /** Chance that a bad one is called good. */
  readonly missedAlarm: number;
}

export interface CusumLimits {
  /** Down for each success. */
  readonly s: number;
  /** At -lower it is proficient, at +upper it is not. */
  readonly lower: number;
  readonly upper: number;
}

export type CusumVerdict = "" | "proficient" | "relapse";

export interface CusumPoint {
  readonly failed: boolean;
  readonly sum: number;
  readonly verdict: CusumVerdict;
}

export function cusumLimits(rates: CusumRates): CusumLimits {
  const p = Math.log(rates.unacceptable / rates.acceptable);
  const q = Math.log((1 - rates.acceptable) / (1 - rates.unacceptable));
  return {
    s: q / (p + q),
    lower: Math.log((1 - rates.falseAlarm) / rates.missedAlarm) / (p + q),
    upper: Math.log((1 - rates.missedAlarm) / rates.falseAlarm) / (p + q),
  };
}

/** @param failures  oldest first */
export function cusum(failures: readonly boolean[], limits: CusumLimits): CusumPoint[] {
  let sum = 0;
  return failures.map((failed) => {
    sum += failed ? 1 - limits.s : -limits.s;
    const verdict = sum <= -limits.lower ? "proficient" : sum >= limits.upper ? "relapse" : "";
    const point: CusumPoint = { failed, sum, verdict };
    if (verdict !== "") sum = 0;
    return point;
  });
}

/** The last verdict; none before there was any. */
export function standing(points: readonly CusumPoint[]): CusumVerdict {
  return points.filter((point) => point.verdict !== "").at(-1)?.verdict ?? "";
}
