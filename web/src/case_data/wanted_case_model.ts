// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A page's address can want another case opened, and another page after it: an attempt of that case is
// to be seen in its own bones. #/?case=ID&then=replay/12
import type { CaseList } from "../protocol";

export interface WantedCase {
  /** Its id. */
  readonly id: string;
  /** The hash to go on to once it is open; empty where none is named. */
  readonly then: string;
}

export function wantedCase(hash: string): WantedCase | undefined {
  const query = /^#\/\?(.*)$/.exec(hash)?.[1];
  if (query === undefined) return undefined;
  const asked = new URLSearchParams(query);
  const id = asked.get("case") ?? "";
  if (id === "") return undefined;
  const then = asked.get("then") ?? "";
  // An attempt's pages alone: an address is nothing to trust.
  const isAttempts = /^(?:attempts\/\d+|replay\/\d+(?:\/\d+)?)$/.test(then);
  return { id, then: isAttempts ? `#/${then}` : "" };
}

/** @param then  what follows `#/` of the page to go on to */
export function addressOfCase(id: string, then: string): string {
  return `#/?${new URLSearchParams({ case: id, then }).toString()}`;
}

export type NextForWanted =
  | { readonly what: "nothing" }
  /** It is open. @param hash  to go on to; empty: to stay */
  | { readonly what: "go"; readonly hash: string }
  | { readonly what: "choose"; readonly id: string }
  /** It is given up, and why. */
  | { readonly what: "say"; readonly text: string };

/** @param runs  an operation does, which another case would end: no address ends it */
export function nextForWanted(
  list: Pick<CaseList, "open" | "cases">,
  wanted: WantedCase | undefined,
  runs: boolean,
): NextForWanted {
  if (wanted === undefined) return { what: "nothing" };
  if (list.open === wanted.id) return { what: "go", hash: wanted.then };
  if (!list.cases.some(({ id }) => id === wanted.id)) {
    return { what: "say", text: `There is no case '${wanted.id}' here any more.` };
  }
  if (runs) {
    return { what: "say", text: "An operation waits here: end it, then choose the other case." };
  }
  return { what: "choose", id: wanted.id };
}
