// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What cases are called where several of one title are to be told apart: with the folder's name, which no two have.
import type { CaseCard } from "../protocol";

/** "Waist fracture"; of several so called "Waist fracture (waist_left)". */
export function titleAmong(
  one: Pick<CaseCard, "id" | "title">,
  all: readonly Pick<CaseCard, "title">[],
): string {
  const alike = all.filter(({ title }) => title.trim() === one.title.trim());
  return alike.length > 1 && one.title !== one.id ? `${one.title} (${one.id})` : one.title;
}
