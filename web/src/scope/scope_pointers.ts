// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Pointers that are down on the round picture. The mouse and the first finger lean one hand; a second
// finger that comes down on the other half of the picture leans the other; two on one half go in by being
// spread and out by being pinched. Each is told by its id. Pure.
import type { Lead } from "./scope_hands";

export interface PointerDown {
  readonly id: number;
  readonly isFinger: boolean;
  /** Right button, or Shift: it turns instead. */
  readonly turns: boolean;
  readonly x: number;
  readonly y: number;
}

/** What a move asks for [CSS px], up and to the right positive. */
export type PointerAsk =
  | { readonly kind: "lean"; readonly lead: Lead; readonly right: number; readonly up: number }
  | { readonly kind: "turn"; readonly right: number }
  /** @param apart  two fingers went so much farther apart */
  | { readonly kind: "spread"; readonly apart: number };

interface Down {
  readonly lead: Lead;
  readonly turns: boolean;
  readonly isFinger: boolean;
  /** The finger that it spreads with. */
  partner: number | undefined;
  x: number;
  y: number;
}

export class ScopePointers {
  private readonly downs = new Map<number, Down>();

  /** @param middleX  between the picture's halves. @returns  whether it is taken */
  down({ id, isFinger, turns, x, y }: PointerDown, middleX: number): boolean {
    const others = [...this.downs];
    const [first] = others;
    if (first === undefined) {
      this.downs.set(id, { lead: "first", turns, isFinger, partner: undefined, x, y });
      return true;
    }
    const [firstId, other] = first;
    if (!isFinger || !other.isFinger || others.length > 1) return false;
    const lead = other.lead === "first" ? "second" : "first";
    const isSameHalf = x < middleX === other.x < middleX;
    if (isSameHalf) other.partner = id;
    const partner = isSameHalf ? firstId : undefined;
    this.downs.set(id, { lead, turns: false, isFinger, partner, x, y });
    return true;
  }

  /** @param turns  Shift is held meanwhile */
  move(id: number, x: number, y: number, turns: boolean): PointerAsk | undefined {
    const down = this.downs.get(id);
    if (down === undefined) return undefined;
    const partner = down.partner === undefined ? undefined : this.downs.get(down.partner);
    const before = partner && Math.hypot(down.x - partner.x, down.y - partner.y);
    const [right, up] = [x - down.x, down.y - y];
    down.x = x;
    down.y = y;
    if (partner !== undefined && before !== undefined) {
      return { kind: "spread", apart: Math.hypot(x - partner.x, y - partner.y) - before };
    }
    // What is left of two that spread moves nothing until it is lifted.
    if (down.partner !== undefined) return undefined;
    if (down.turns || turns) return { kind: "turn", right };
    return { kind: "lean", lead: down.lead, right, up };
  }

  up(id: number): void {
    this.downs.delete(id);
  }

  clear(): void {
    this.downs.clear();
  }
}
