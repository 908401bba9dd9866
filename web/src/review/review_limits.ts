// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// data/review_limits.json, as the review room uses it.
import data from "../../../data/review_limits.json";
import { cusumLimits } from "./cusum_model";

const { acceptable_failure_rate, unacceptable_failure_rate, false_alarm, missed_alarm } =
  data.cusum;

export const CUSUM_LIMITS = cusumLimits({
  acceptable: acceptable_failure_rate.value,
  unacceptable: unacceptable_failure_rate.value,
  falseAlarm: false_alarm.value,
  missedAlarm: missed_alarm.value,
});

export const PROFICIENT_SCORE = data.score.proficient.value;
export const FLAT_AFTER = data.attempts;

/** Every value with where it is from, for the foot of the page. */
export const LIMIT_SOURCES: readonly (readonly [string, string])[] = [
  [`Acceptable failures ${percent(acceptable_failure_rate.value)}`, acceptable_failure_rate.source],
  [
    `Unacceptable failures ${percent(unacceptable_failure_rate.value)}`,
    unacceptable_failure_rate.source,
  ],
  [`False alarms ${percent(false_alarm.value)}`, false_alarm.source],
  [`Missed alarms ${percent(missed_alarm.value)}`, missed_alarm.source],
  [`Score ${PROFICIENT_SCORE}`, data.score.proficient.source],
  ...FLAT_AFTER.map(
    ({ from, to, text, source }) =>
      [`Attempt ${from === to ? from : `${from} to ${to}`}, ${text}`, source] as const,
  ),
];

function percent(share: number): string {
  return `${Math.round(100 * share)} %`;
}
