// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Beside the theatre's picture of the skin: what the hand feels there, in a word that goes with it.
import { make, setText } from "../dom";
import { heldItem, type HandIndex } from "../operation";
import type { ExerciseMessage, Instrument, SkinMessage, SnapshotMessage, Vec3 } from "../protocol";
import "./skin_desk.css";
import { skinWords, whyHeldBySkin, whyNotSwung, worksOnSkin } from "./skin_words_model";

/** Beside the place, so that neither finger nor needle hides it [CSS px]. */
const ASIDE_PX = 56;

export interface SkinRoom {
  readonly stage: HTMLElement;
  pagePoint(mm: Vec3): { readonly x: number; readonly y: number };
}

export class SkinDesk {
  private readonly word = make("p.skin-word", { role: "status", "aria-live": "polite" });
  private instruments: readonly Instrument[] = [];
  private isHere = false;
  private last: SkinMessage | undefined;

  constructor(private readonly room: SkinRoom) {
    this.word.hidden = true;
    room.stage.append(this.word);
  }

  /** Whether closed skin is worked on in this exercise. */
  get isOn(): boolean {
    return this.isHere;
  }

  get told(): SkinMessage | undefined {
    return this.last;
  }

  begin(exercise: ExerciseMessage): void {
    this.instruments = exercise.instruments;
    this.isHere = worksOnSkin(exercise.instruments);
    this.last = undefined;
    this.word.hidden = true;
  }

  /** @returns  whether fluid came back to this hand just now */
  take(message: SkinMessage, hand: HandIndex): boolean {
    const before = this.last?.hands[hand]?.is_wet;
    this.last = message;
    return before === false && message.hands[hand]?.is_wet === true;
  }

  private workOf(s: SnapshotMessage | undefined, hand: HandIndex): Instrument["skin_work"] {
    const item = s === undefined ? undefined : heldItem(s, hand);
    return this.instruments.find((one) => one.id === item?.instrument)?.skin_work ?? "none";
  }

  /** Why mouse and arrows would not move what this hand holds. */
  whyHeld(s: SnapshotMessage | undefined, hand: HandIndex): string | undefined {
    return this.isHere ? whyHeldBySkin(this.last?.hands[hand], this.workOf(s, hand)) : undefined;
  }

  /** Why what this hand holds would not be laid where one looks. */
  whyNotSwung(s: SnapshotMessage | undefined, hand: HandIndex): string | undefined {
    return this.isHere ? whyNotSwung(this.workOf(s, hand)) : undefined;
  }

  showReadings(s: SnapshotMessage | undefined, hand: HandIndex): void {
    const now = this.isHere ? this.last?.hands[hand] : undefined;
    const words = skinWords(now, this.workOf(s, hand));
    this.word.hidden = words === "";
    if (now === undefined || words === "") return;
    setText(this.word, words);
    const { x, y } = this.room.pagePoint(now.on_skin_mm);
    const box = this.room.stage.getBoundingClientRect();
    const left = Math.min(box.width - 160, Math.max(8, x - box.left + ASIDE_PX));
    const top = Math.min(box.height - 40, Math.max(8, y - box.top - ASIDE_PX));
    this.word.style.transform = `translate(${left}px, ${top}px)`;
  }
}
