// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What the host offers now: whether something would be done and, in its words, why not.
import type { Action, ActionId, Aid, ActMessage, Instrument } from "../protocol";

/** What is asked for. */
export interface Asked {
  readonly id: ActionId;
  readonly hand?: number;
  /** Of take. */
  readonly instrument?: string;
  /** Of pick_up and pick_up_far_end. */
  readonly item?: number;
  /** Of decline: ids of the procedure's reasons. */
  readonly reasons?: readonly string[];
  /** Of use_aid. */
  readonly aid?: Aid;
  /** Of judge: what is said of the fracture. */
  readonly displaced?: boolean;
}

export function actMessage(asked: Asked): ActMessage {
  const { id, hand = null, instrument = null, item = null, reasons = null } = asked;
  const { aid = null, displaced = null } = asked;
  return { type: "act", id, hand, instrument, item, aid, reasons, displaced };
}

export class OfferedActions {
  constructor(private readonly actions: readonly Action[] = []) {}

  find(asked: Asked): Action | undefined {
    const { id, hand, instrument = "", item = -1 } = asked;
    return this.actions.find(
      (one) =>
        one.id === id &&
        (one.hand < 0 || one.hand === (hand ?? 0)) &&
        one.instrument === instrument &&
        one.item === item,
    );
  }

  /** Why it would be refused, in the host's words; nothing when it would be done or is not known. */
  whyNot(asked: Asked): string | undefined {
    const found = this.find(asked);
    return found === undefined || found.allowed ? undefined : found.reason;
  }

  /** What this hand can take hold of: what lies in bone and is in no hand. */
  pickUps(hand: number): readonly Action[] {
    return this.actions.filter((one) => one.id === "pick_up" && one.hand === hand);
  }

  /** What it can take hold of at its other end, beyond the bone. */
  farEnds(hand: number): readonly Action[] {
    return this.actions.filter((one) => one.id === "pick_up_far_end" && one.hand === hand);
  }

  /**
   * Measuring in one go: the hand takes the gauge, unless it holds it, reads it, and puts it down.
   * @return empty where nothing on the tray is a gauge
   */
  measuring(hand: number, held: string, instruments: readonly Instrument[]): readonly Asked[] {
    const gauge = instruments.find((one) => one.is_gauge);
    if (gauge === undefined) return [];
    const rest: Asked[] = [
      { id: "read_gauge", hand },
      { id: "put_down", hand },
    ];
    return held === gauge.id ? rest : [{ id: "take", hand, instrument: gauge.id }, ...rest];
  }
}
