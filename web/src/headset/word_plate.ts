// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What a trainee reads while the headset is worn: the step, what is held and chosen, what was said, and which
// button does what. The headset shows no page.
import { Plate } from "./plate";
import { wrapped } from "./wrapped";

export interface Words {
  readonly title: string;
  readonly instruction: string;
  /** "In the hand", "Chosen", …: a line each. */
  readonly readings: readonly (readonly [name: string, value: string])[];
  readonly notice: string;
}

const WIDTH = 1024;
const HEIGHT = 768;
const MARGIN = 44;
const FONT = "'Inter Variable', sans-serif";
const BUTTONS: readonly string[] = [
  "Hand: trigger drives, grip reverses, A next picture, B takes hold",
  "of a wire in bone, stick left and right chooses, pressed takes.",
  "Other hand: trigger live X-ray, grip carries the table, stick turns",
  "and enlarges it, pressed a hint; X same picture again, Y pause.",
];

export class WordPlate {
  private readonly plate: Plate;
  private written = "";

  constructor(widthM: number) {
    this.plate = new Plate(widthM, [WIDTH, HEIGHT]);
  }

  get mesh(): Plate["mesh"] {
    return this.plate.mesh;
  }

  /** What is written now, as one text. */
  get text(): string {
    return this.written;
  }

  show(words: Words): void {
    const text = [
      words.title,
      words.instruction,
      ...words.readings.map((reading) => reading.join(": ")),
      words.notice,
    ].join("\n");
    if (text === this.written) return;
    this.written = text;
    const context = this.plate.canvas.getContext("2d");
    if (context === null) return;
    context.fillStyle = "#10171b";
    context.fillRect(0, 0, WIDTH, HEIGHT);
    context.textBaseline = "top";
    let y = MARGIN;
    const write = (line: string, size: number, weight: number, color: string): void => {
      context.font = `${weight} ${size}px ${FONT}`;
      context.fillStyle = color;
      const width = (part: string): number => context.measureText(part).width;
      for (const part of wrapped(line, WIDTH - 2 * MARGIN, width)) {
        context.fillText(part, MARGIN, y);
        y += 1.28 * size;
      }
    };
    write(words.title, 46, 650, "#f1f5f6");
    y += 8;
    write(words.instruction, 31, 400, "#c9d5da");
    y += 18;
    for (const [name, value] of words.readings) write(`${name}: ${value}`, 31, 500, "#8fd0e8");
    y += 14;
    write(words.notice, 31, 500, "#f4c66b");
    y = HEIGHT - MARGIN - BUTTONS.length * 30;
    for (const line of BUTTONS) {
      context.font = `400 24px ${FONT}`;
      context.fillStyle = "#8b9aa1";
      context.fillText(line, MARGIN, y);
      y += 30;
    }
    this.plate.changed();
  }

  dispose(): void {
    this.plate.dispose();
  }
}
