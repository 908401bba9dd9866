// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What this device keeps of a person's wishes. Storage may be forbidden: then it is said again.

/** Empty where nothing is kept. */
export function remembered(key: string): string {
  try {
    return localStorage.getItem(key) ?? "";
  } catch {
    return "";
  }
}

export function remember(key: string, value: string): void {
  try {
    localStorage.setItem(key, value);
  } catch {
    // Nothing is lost but the wish.
  }
}
