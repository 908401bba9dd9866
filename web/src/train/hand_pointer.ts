// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The pointer over the theatre moves the hand: the mouse lays the tip where it points; a finger pushes it
// along, so that it does not hide what it points at, and waits a moment whether a second one comes, since
// two fingers turn the view.
import type { Theatre } from "../theatre";
import type { Hand } from "./hand";

/** What one finger, or the mouse's main button, moves. */
export type DragMode = "tip" | "shaft" | "view";

/** A finger that has gone farther means it [CSS px]. */
const MEANT_PX = 8;

interface Drag {
  readonly pointerId: number;
  readonly turns: boolean;
  /** From the pointer to the tip: none for the mouse. */
  readonly offsetX: number;
  readonly offsetY: number;
  isMeant: boolean;
  x: number;
  y: number;
}

/** Listens until `signal` says stop. */
export class HandPointer {
  private drag: Drag | undefined;
  private mode: DragMode = "tip";
  /** Fingers that are down. */
  private readonly fingers = new Set<number>();

  constructor(
    private readonly theatre: Theatre,
    private readonly hand: Hand,
    signal: AbortSignal,
  ) {
    const { canvas } = theatre;
    const listen = (
      type: "pointerdown" | "pointermove" | "pointerup" | "pointercancel",
      then: (event: PointerEvent) => void,
    ): void => {
      canvas.addEventListener(type, then, { signal });
    };
    listen("pointerdown", (event) => {
      this.down(event);
    });
    listen("pointermove", (event) => {
      this.move(event);
    });
    for (const end of ["pointerup", "pointercancel"] as const) {
      listen(end, (event) => {
        this.up(event);
      });
    }
    window.addEventListener(
      "blur",
      () => {
        this.fingers.clear();
        this.drag = undefined;
      },
      { signal },
    );
  }

  setMode(mode: DragMode): void {
    this.mode = mode;
    this.drag = undefined;
    this.theatre.setDragLooks(mode === "view");
  }

  private down(event: PointerEvent): void {
    this.theatre.canvas.focus({ preventScroll: true });
    const isFinger = event.pointerType === "touch";
    if (isFinger) this.fingers.add(event.pointerId);
    if (this.fingers.size > 1) {
      this.drag = undefined;
      return;
    }
    if (event.button !== 0 || this.mode === "view" || !this.hand.isFree()) return;
    this.theatre.canvas.setPointerCapture(event.pointerId);
    const { clientX: x, clientY: y, pointerId } = event;
    const tip = isFinger ? this.hand.tipOnPage() : { x, y };
    const turns = event.shiftKey || this.mode === "shaft";
    const [offsetX, offsetY] = [tip.x - x, tip.y - y];
    this.drag = { pointerId, turns, offsetX, offsetY, isMeant: !isFinger, x, y };
    if (!isFinger && !turns) this.hand.moveTipTo(x, y);
  }

  private move(event: PointerEvent): void {
    const { drag } = this;
    if (drag?.pointerId !== event.pointerId) return;
    const [dx, dy] = [event.clientX - drag.x, event.clientY - drag.y];
    if (!drag.isMeant && Math.hypot(dx, dy) < MEANT_PX) return;
    drag.isMeant = true;
    if (drag.turns) this.hand.turnShaftByPixels(dx, dy);
    else this.hand.moveTipTo(event.clientX + drag.offsetX, event.clientY + drag.offsetY);
    drag.x = event.clientX;
    drag.y = event.clientY;
  }

  private up(event: PointerEvent): void {
    this.fingers.delete(event.pointerId);
    if (this.drag?.pointerId === event.pointerId) this.drag = undefined;
  }
}
