// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The fixtures that page and host share: every valid one is taken, every invalid one and every
// change that breaks a rule refused with a reason.
import { readdirSync, readFileSync } from "node:fs";
import { join } from "node:path";
import { describe, expect, it } from "vitest";
import {
  parseAssetForms,
  parseAssetRating,
  parseAttempt,
  parseAttemptList,
  parseCaseList,
  parseCaseDescription,
  parseCasePathology,
  parseHostMessage,
  parseInstrumentList,
  parsePageMessage,
  parsePathologyWish,
  parsePictureTruth,
  parseProcedureList,
  parseQuizAnswerList,
  parseSeenCartilage,
  parseViewDebrief,
} from "./generated";
import type { Parsed } from "./validator";

const FIXTURES = join(__dirname, "../../../protocol/fixtures");
/** By the first words of "direction/name", longer ones first; stored/ is the host's own. */
const READERS: readonly (readonly [string, (text: string) => Parsed<unknown>])[] = [
  ["page_to_host/", parsePageMessage],
  ["host_to_page/", parseHostMessage],
  ["http/case_description", parseCaseDescription],
  ["http/instrument_list", parseInstrumentList],
  ["http/procedure_list", parseProcedureList],
  ["http/attempt_list", parseAttemptList],
  ["http/quiz_answer_list", parseQuizAnswerList],
  ["http/asset_forms", parseAssetForms],
  ["http/asset_rating", parseAssetRating],
  ["http/case_list", parseCaseList],
  ["http/case_pathology", parseCasePathology],
  ["http/pathology_wish", parsePathologyWish],
  ["http/picture_truth", parsePictureTruth],
  ["http/view_debrief", parseViewDebrief],
  ["http/seen_cartilage", parseSeenCartilage],
  ["http/attempt", parseAttempt],
];
const DIRECTIONS = ["page_to_host", "host_to_page", "http"];

function parse(fixture: string, text: string): Parsed<unknown> {
  const reader = READERS.find(([name]) => fixture.startsWith(name))?.[1];
  if (reader === undefined) throw new Error(`${fixture}: no reader; add it above`);
  return reader(text);
}

function textOf(fixture: string): string {
  return readFileSync(join(FIXTURES, fixture), "utf8");
}

function fixtures(kind: string): string[] {
  return DIRECTIONS.flatMap((direction) =>
    readdirSync(join(FIXTURES, kind, direction)).map((name) => `${direction}/${name}`),
  );
}

describe("fixtures", () => {
  it.each(fixtures("valid"))("takes %s", (fixture) => {
    const text = textOf(`valid/${fixture}`);
    const parsed = parse(fixture, text);
    expect(parsed).toMatchObject({ ok: true });
    // What is missing reads as null, and so are the lowest.
    const lowest = fixture.replace("_absent.json", "_lowest.json");
    expect(parsed.ok && parsed.value).toEqual(
      JSON.parse(lowest === fixture ? text : textOf(`valid/${lowest}`)),
    );
  });

  it.each(fixtures("invalid"))("refuses %s", (fixture) => {
    const parsed = parse(fixture, textOf(`invalid/${fixture}`));
    expect(parsed.ok).toBe(false);
    expect(!parsed.ok && parsed.reason).not.toBe("");
  });
});

type Path = readonly (string | number)[];
type Change = readonly [Path] | readonly [Path, unknown];
type Node = Record<string | number, unknown>;

/** [path, value] sets, [path] removes. */
function changed(text: string, change: Change): string {
  const root: Node = JSON.parse(text) as Node;
  let at = root;
  const steps = change[0];
  for (const step of steps.slice(0, -1)) at = at[step] as Node;
  const last = steps.at(-1) ?? "";
  if (change.length === 2) at[last] = change[1];
  // eslint-disable-next-line @typescript-eslint/no-dynamic-delete
  else delete at[last];
  return JSON.stringify(root);
}

describe("changes that break one rule", () => {
  const all = JSON.parse(textOf("refused_changes.json")) as Record<string, readonly Change[]>;
  const ours = Object.entries(all).filter(([fixture]) =>
    DIRECTIONS.some((direction) => fixture.startsWith(`${direction}/`)),
  );
  it.each(ours)("are refused in %s", (fixture, changes) => {
    const text = textOf(`valid/${fixture}`);
    for (const change of changes) {
      const parsed = parse(fixture, changed(text, change));
      expect(parsed.ok, JSON.stringify(change)).toBe(false);
    }
  });
  it("are many", () => {
    expect(ours.reduce((count, [, changes]) => count + changes.length, 0)).toBeGreaterThan(800);
  });
});

describe("refusals", () => {
  it("say where in the text it is", () => {
    const text = textOf("valid/host_to_page/score_highest.json");
    const parsed = parseHostMessage(changed(text, [["report", "items", 1, "points"], 101]));
    expect(parsed).toEqual({
      ok: false,
      reason: "score: field 'report.items[1].points' must be number from 0 to 100",
    });
  });
  it("come before parsing where a text is too long in bytes", () => {
    const text = JSON.stringify({ type: "pause", x: "é".repeat(8200) });
    expect(text.length).toBeLessThan(16384);
    expect(parsePageMessage(text)).toEqual({ ok: false, reason: "longer than 16384 bytes" });
  });
});
