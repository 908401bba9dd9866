// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Whether what was true of an attempt may be seen afterwards. The host keeps to it too.
import type { Attempt } from "../protocol";

export function truthOf(attempt: Pick<Attempt, "mode" | "outcome" | "score">): "open" | "closed" {
  if (attempt.mode !== "assessed") return "open";
  const isDone = attempt.outcome === "finished" && attempt.score !== null;
  return isDone && attempt.score?.is_void !== true ? "open" : "closed";
}
