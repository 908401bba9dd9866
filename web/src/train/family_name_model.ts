// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What screws of one family are called together: the words with which all their names begin.

/** "Screw A" of "Screw A 10 mm" and "Screw A 12 mm"; all of it where there is but one. */
export function commonBeginning(names: readonly string[]): string {
  const [first = [], ...others] = names.map((name) => name.split(" "));
  const differs = first.findIndex((word, i) => others.some((other) => other[i] !== word));
  return (differs < 0 || others.length === 0 ? first : first.slice(0, differs)).join(" ");
}
