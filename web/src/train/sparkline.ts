// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The last seconds of the force, small.
import { make } from "../dom";

const SAMPLES = 120;
/** Top of the scale until something larger comes [N]. */
const SMALLEST_SCALE_N = 10;

export class Sparkline {
  readonly canvas = make("canvas.sparkline", { width: "240", height: "48", "aria-hidden": "true" });
  private readonly values = new Float32Array(SAMPLES);
  private next = 0;

  push(value: number): void {
    this.values[this.next] = value;
    this.next = (this.next + 1) % SAMPLES;
  }

  draw(): void {
    const context = this.canvas.getContext("2d");
    if (context === null) return;
    const { width, height } = this.canvas;
    let top = SMALLEST_SCALE_N;
    for (let i = 0; i < SAMPLES; ++i) top = Math.max(top, this.values[i] ?? 0);
    context.clearRect(0, 0, width, height);
    context.strokeStyle = "#2f3b41";
    context.lineWidth = 2;
    context.beginPath();
    context.moveTo(0, height - 1);
    context.lineTo(width, height - 1);
    context.stroke();
    context.strokeStyle = "#5cc8ff";
    context.beginPath();
    for (let i = 0; i < SAMPLES; ++i) {
      const value = this.values[(this.next + i) % SAMPLES] ?? 0;
      const x = (i / (SAMPLES - 1)) * width;
      const y = height - 3 - (value / top) * (height - 6);
      if (i === 0) context.moveTo(x, y);
      else context.lineTo(x, y);
    }
    context.stroke();
  }
}
