// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A page's address can want another case opened, and another page after it: an attempt of that case is
// to be seen in its own bones. #/?case=ID&then=replay/12

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
  return { id, then: /^(?:attempts|replay)\/\d+$/.test(then) ? `#/${then}` : "" };
}

/** @param then  what follows `#/` of the page to go on to */
export function addressOfCase(id: string, then: string): string {
  return `#/?${new URLSearchParams({ case: id, then }).toString()}`;
}
