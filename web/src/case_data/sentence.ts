// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0

/** "the wrist is small": "The wrist is small." */
export function sentence(words: string): string {
  const text = words.charAt(0).toUpperCase() + words.slice(1);
  return /[.!?]$/.test(text) ? text : `${text}.`;
}
