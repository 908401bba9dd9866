// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Names beside a picture: long ones on several lines, so that they stay beside it, in two columns in
// which none overlap. Pure.

export interface Label {
  /** Of what it names, on the screen [px]. */
  y: number;
  left: boolean;
  /** Middle of the label [px]. */
  labelY: number;
  height: number;
}

/** Room for names at either side of the picture [px]. */
export function roomAside(width: number): number {
  return Math.min(190, Math.max(84, 0.2 * width));
}

/** Breaks between words where it must; a word that is too long stands alone. */
export function linesOf(text: string, width: number, measure: (text: string) => number): string[] {
  const lines: string[] = [];
  let line = "";
  for (const word of text.split(" ")) {
    const longer = line === "" ? word : `${line} ${word}`;
    if (line !== "" && measure(longer) > width) {
      lines.push(line);
      line = word;
    } else {
      line = longer;
    }
  }
  lines.push(line);
  return lines;
}

/** Puts the labels of one side where none overlap: downwards in turn, then back up from the bottom. */
export function spread(labels: readonly Label[], left: boolean, top: number, bottom: number): void {
  const side = labels.filter((label) => label.left === left).sort((a, b) => a.y - b.y);
  let free = top;
  for (const label of side) {
    label.labelY = Math.max(label.y, free + label.height / 2);
    free = label.labelY + label.height / 2;
  }
  let end = bottom;
  for (const label of side.reverse()) {
    label.labelY = Math.min(label.labelY, end - label.height / 2);
    end = label.labelY - label.height / 2;
  }
}
