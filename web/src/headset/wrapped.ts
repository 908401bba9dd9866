// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0

/** Lines no wider than `most` by the measure, broken between words; a longer word stands alone. */
export function wrapped(text: string, most: number, width: (part: string) => number): string[] {
  const lines: string[] = [];
  let line = "";
  for (const word of text.split(/\s+/).filter((one) => one !== "")) {
    const longer = line === "" ? word : `${line} ${word}`;
    if (line !== "" && width(longer) > most) {
      lines.push(line);
      line = word;
    } else {
      line = longer;
    }
  }
  if (line !== "") lines.push(line);
  return lines;
}
