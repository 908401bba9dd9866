// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The fixtures that page and host share: every valid one is taken, every invalid one refused with a
// reason.
import { readdirSync, readFileSync } from "node:fs";
import { join } from "node:path";
import { describe, expect, it } from "vitest";
import { parseCaseDescription, parseHostMessage, parsePageMessage } from "./generated";

const FIXTURES = join(__dirname, "../../../protocol/fixtures");
const READERS = {
  page_to_host: parsePageMessage,
  host_to_page: parseHostMessage,
  http: parseCaseDescription,
} as const;

function fixtures(kind: string, direction: string): [string, string][] {
  const folder = join(FIXTURES, kind, direction);
  return readdirSync(folder).map((name) => [name, readFileSync(join(folder, name), "utf8")]);
}

for (const [direction, read] of Object.entries(READERS)) {
  describe(direction, () => {
    it.each(fixtures("valid", direction))("takes %s", (_name, text) => {
      expect(read(text)).toMatchObject({ ok: true });
    });
    it.each(fixtures("invalid", direction))("refuses %s", (_name, text) => {
      const parsed = read(text);
      expect(parsed.ok).toBe(false);
      expect(!parsed.ok && parsed.reason).not.toBe("");
    });
  });
}
