// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What is painted is shown as it will be: the host makes the bones that were touched anew, one look after the
// other, and where the marker was used lets the water in from it first.
import { changesToTake, type MendedBone } from "./mended_model";
import { lookAtMended } from "./new_case_client";
import { packedLabels, unpackedLabels } from "./packed_labels";
import type { Volume } from "./nifti_model";
import type { LabelPaint } from "./paint_model";
import { boneTitle } from "./scan_case_model";

/** Strokes that follow each other at once are looked at together. */
const REST_MS = 200;

export interface MendedLooksWishes {
  /** Whenever the host is as far, whatever a person does by then. */
  say(text: string): void;
  /** @param glb  surfaces of those bones that have voxels */
  show(bones: readonly MendedBone[], glb: ArrayBuffer | undefined): void;
  /** The host changed labels. */
  labelsChanged(): void;
}

function isSame(a: Uint8Array, b: Uint8Array): boolean {
  return a.every((value, i) => b[i] === value);
}

export class MendedLooks {
  private readonly values: Uint8Array;
  private looked: Uint8Array;
  private lookedPacked: Blob | undefined;
  /** `unmarked`: the labels before what the marker marked since; undefined where it was not used. */
  private wanted: { readonly unmarked: Uint8Array | undefined } | undefined;
  private running: Promise<void> | undefined;
  private readonly abort = new AbortController();
  private isHeld = false;

  /** @param id  of the case whose labels they are */
  constructor(
    private readonly id: string,
    private readonly labels: Volume,
    private readonly paint: LabelPaint,
    private readonly wishes: MendedLooksWishes,
  ) {
    if (!(labels.values instanceof Uint8Array)) throw new Error("labels are uint8");
    this.values = labels.values;
    this.looked = this.values.slice();
  }

  dispose(): void {
    this.abort.abort();
  }

  /** @param grows  the latest change is the marker's: its bone's border is to be found */
  changed(grows: boolean): void {
    const marked = this.wanted?.unmarked;
    this.wanted = { unmarked: marked ?? (grows ? this.paint.beforeLatest() : undefined) };
    if (this.running !== undefined || this.isHeld) return;
    this.running = this.run().finally(() => {
      this.running = undefined;
    });
  }

  /** The host does one thing at a time: while it does something else, nothing is looked at. */
  async whileHeld(act: () => Promise<void>): Promise<void> {
    this.isHeld = true;
    try {
      await this.running;
      await act();
    } finally {
      this.isHeld = false;
      if (this.wanted !== undefined) this.changed(false);
    }
  }

  private async run(): Promise<void> {
    for (;;) {
      await new Promise((wake) => setTimeout(wake, REST_MS));
      const { wanted } = this;
      if (wanted === undefined || this.isHeld || this.abort.signal.aborted) return;
      this.wanted = undefined;
      try {
        const { unmarked } = wanted;
        // What was done before is no marker, however soon the marker follows.
        if (unmarked !== undefined) {
          await this.look(unmarked, false);
          this.wanted = undefined; // what came meanwhile is in what follows
        }
        const isStill = await this.look(this.values.slice(), unmarked !== undefined);
        // What is left of the marker is looked for anew.
        if (!isStill) this.wanted = wanted;
      } catch (error) {
        if (this.abort.signal.aborted) return;
        const why = error instanceof Error ? error.message : String(error);
        this.wishes.say(`The surfaces are those from before: ${why}`);
      }
    }
  }

  /** @return whether what was sent was there still when its border came; if not, that is not taken */
  private async look(sent: Uint8Array, grows: boolean): Promise<boolean> {
    const began = performance.now();
    const latest = this.paint.latest;
    if (isSame(sent, this.looked)) return true;
    this.wishes.say(grows ? "Looking for the bone's border…" : "Making the surface anew…");
    const labels = await packedLabels({ ...this.labels, values: sent });
    const wish = { of: this.id, labels, before: this.lookedPacked, grows };
    const look = await lookAtMended(wish, this.abort.signal);
    this.looked = sent;
    this.lookedPacked = labels;
    if (look.labels !== undefined) {
      const grown = await unpackedLabels(look.labels);
      this.looked = grown;
      this.lookedPacked = look.labels;
      if (latest === undefined || !this.paint.holds(latest)) return false;
      const { indices, labels: taken } = changesToTake(sent, grown, this.values);
      this.paint.take(indices, taken, latest === this.paint.latest);
      this.wishes.labelsChanged();
    }
    this.wishes.show(look.bones, look.glb);
    const seconds = ((performance.now() - began) / 1000).toFixed(1);
    const names = look.bones.map((bone) => boneTitle(bone.name)).join(", ");
    this.wishes.say(`${names}: surface made anew in ${seconds} s`);
    return true;
  }
}
