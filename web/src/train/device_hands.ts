// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Tells the host which device a hand holds, and how its right and up lie while the view turns.
import { DeviceView } from "../devices";
import type { HandIndex } from "../operation";
import type { DeviceAim, HandDevice, PageMessage } from "../protocol";
import type { Theatre } from "../theatre";

export class DeviceHands {
  private readonly views = [new DeviceView(), new DeviceView()] as const;

  constructor(
    private readonly theatre: Theatre,
    private readonly tell: (message: PageMessage) => void,
  ) {}

  /** @param device  id; empty: the page itself. @param aim  none: as before */
  use(hand: HandIndex, device: string, aim?: DeviceAim): void {
    const { right, up } = this.theatre.screenAxes();
    this.views[hand].tell({ right, up });
    this.tell({ type: "use_device", hand, device, aim: aim ?? null, right, up });
  }

  /** Several times a second. @param hands  as the host told them last */
  watch(hands: readonly HandDevice[], nowMs: number): void {
    const { right, up } = this.theatre.screenAxes();
    hands.forEach(({ id }, i) => {
      const hand: HandIndex = i === 0 ? 0 : 1;
      if (id !== "" && this.views[hand].turned({ right, up }, nowMs)) this.use(hand, id);
    });
  }
}
