// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The typeface turns some letters x between figures into the sign and leaves others: all or none.

/** "0.3 x 0.3 x 0.5 mm" with × for every x between figures. */
export function withTimesSigns(text: string): string {
  return text.replace(/(\d) ?[x×] ?(?=\d)/g, "$1 × ");
}
