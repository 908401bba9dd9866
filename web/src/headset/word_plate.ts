// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What a trainee reads while the headset is worn: the step, what is held and chosen, what was said, and which
// button does what. The headset shows no page.
import { Plate } from "./plate";
import { writtenLines, type Paragraph } from "./written_lines";

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
const BUTTONS: readonly Paragraph[] = [
  "Hand: trigger drives, grip reverses, A next picture, B takes hold of a wire in bone, stick left and right chooses, pressed takes.",
  "Other hand: trigger live X-ray, stick turns the table and enlarges it, pressed a hint; X same picture again, Y pause.",
  "Its grip carries the table; held with the stick it flexes and deviates the wrist, with X and Y it supinates and pronates.",
].map((text) => ({ text, sizePx: 25, weight: 400, color: "#9aaab1", gapPx: 0 }));
/** Two lines each. */
const BUTTONS_HEIGHT = 6 * 1.28 * 25;
/** Between the words and the buttons. */
const APART = 16;

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
    const width = WIDTH - 2 * MARGIN;
    const write = (paragraphs: readonly Paragraph[], top: number, height: number): void => {
      const lines = writtenLines(
        paragraphs,
        { widthPx: width, heightPx: height },
        (part, sizePx, weight) => {
          context.font = `${weight} ${sizePx}px ${FONT}`;
          return context.measureText(part).width;
        },
      );
      for (const { text: line, topPx, sizePx, of } of lines) {
        context.font = `${of.weight} ${sizePx}px ${FONT}`;
        context.fillStyle = of.color;
        context.fillText(line, MARGIN, top + topPx);
      }
    };
    const buttonsTop = HEIGHT - MARGIN - BUTTONS_HEIGHT;
    write(paragraphsOf(words), MARGIN, buttonsTop - MARGIN - APART);
    write(BUTTONS, buttonsTop, BUTTONS_HEIGHT + 1);
    this.plate.changed();
  }

  dispose(): void {
    this.plate.dispose();
  }
}

function paragraphsOf({ title, instruction, readings, notice }: Words): readonly Paragraph[] {
  const reading = { sizePx: 31, weight: 500, color: "#8fd0e8" };
  const last = readings.length - 1;
  return [
    { text: title, sizePx: 46, weight: 650, color: "#f1f5f6", gapPx: 8 },
    { text: instruction, sizePx: 31, weight: 400, color: "#c9d5da", gapPx: 18 },
    ...readings.map((one, i) => ({
      ...reading,
      text: one.join(": "),
      gapPx: i === last ? 14 : 0,
    })),
    { text: notice, sizePx: 31, weight: 500, color: "#f4c66b", gapPx: 0 },
  ];
}
