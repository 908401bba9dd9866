// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Sound on or off, as the person left it; nothing is heard before a first gesture, as browsers ask.
import { remember, remembered } from "../dom";
import { SoundModel, type Heard } from "./sound_model";
import { Synthesizer } from "./synthesizer";

const KEY = "carpus.sound";
/** The host tells 60 times a second: after this long without a word nothing sounds [ms]. */
const SILENT_AFTER_MS = 300;

export type SoundState = "waiting" | "on" | "muted";

export class Sound {
  private readonly model = new SoundModel();
  private context: AudioContext | undefined;
  private synthesizer: Synthesizer | undefined;
  private isMuted = remembered(KEY) === "muted";
  private heardAtMs = -Infinity;
  /** Says whether it is wished. */
  onWish: ((on: boolean) => void) | undefined;

  constructor(signal: AbortSignal) {
    for (const gesture of ["pointerdown", "keydown"] as const)
      window.addEventListener(
        gesture,
        () => {
          this.wake();
        },
        { signal, capture: true },
      );
  }

  get state(): SoundState {
    if (this.isMuted) return "muted";
    return this.context?.state === "running" ? "on" : "waiting";
  }

  get isWished(): boolean {
    return !this.isMuted;
  }

  toggle(): void {
    this.isMuted = !this.isMuted;
    remember(KEY, this.isMuted ? "muted" : "on");
    if (this.isMuted) void this.context?.suspend();
    else this.wake();
    this.onWish?.(this.isWished);
  }

  hear(now: Heard): void {
    this.heardAtMs = now.nowMs;
    const sounds = this.model.hear(now);
    if (this.state === "on") this.synthesizer?.play(sounds);
  }

  /** A host that says nothing is no motor that runs on. */
  watch(nowMs: number): void {
    if (nowMs - this.heardAtMs > SILENT_AFTER_MS) this.synthesizer?.silence();
  }

  dispose(): void {
    void this.context?.close();
  }

  private wake(): void {
    if (this.isMuted) return;
    if (this.context === undefined) {
      this.context = new AudioContext({ latencyHint: "interactive" });
      this.synthesizer = new Synthesizer(this.context);
    }
    if (this.context.state === "suspended") void this.context.resume();
  }
}
