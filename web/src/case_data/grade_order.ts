// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// In which order grades are shown: the host's, which grows at its end, but classes such as Palmer's by name.

const CLASS = /^\d[A-Z]$/;

/** What is well first. */
export function inOrder<G extends { readonly id: string }>(grades: readonly G[]): readonly G[] {
  const [well, ...wrong] = grades;
  if (well === undefined || !wrong.every(({ id }) => CLASS.test(id))) return grades;
  return [well, ...wrong.sort((a, b) => (a.id < b.id ? -1 : 1))];
}
