// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What cannot be a person's name, as the host judges it too (src/core/person_name.hpp).

/** Line breaks and other control characters. */
const CONTROL = /[\p{Cc}\u2028\u2029]/u;
/** What embeds, overrides or isolates the direction of writing. */
const DIRECTION = /[\u202a-\u202e\u2066-\u2069]/;

function sentence(what: string, found: string): string {
  const number = (found.codePointAt(0) ?? 0).toString(16).toUpperCase().padStart(4, "0");
  return `The name has ${what} (U+${number}); remove it.`;
}

/** Why this cannot be a name, in a sentence; undefined where it can. */
export function nameProblem(name: string): string | undefined {
  const control = CONTROL.exec(name)?.[0];
  const direction = DIRECTION.exec(name)?.[0];
  if (control !== undefined) return sentence("a line break or another control character", control);
  if (direction !== undefined)
    return sentence("an invisible character that turns the direction of writing", direction);
  return undefined;
}
