// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A gamepad that is not there: what the browser would say of one, and what the hand is told.
import { afterEach, beforeEach, describe, expect, it, vi } from "vitest";
import { GamepadHand, type PadRoom } from "./gamepad_hand";

const FRAME_MS = 16;

class FakePad {
  readonly connected = true;
  readonly mapping = "standard";
  readonly axes = [0, 0, 0, 0];
  readonly buttons = Array.from({ length: 17 }, () => ({ value: 0, pressed: false }));

  press(button: number, value = 1): void {
    this.buttons[button] = { value, pressed: value > 0.5 };
  }
}

interface FakeRoom {
  readonly room: PadRoom;
  readonly did: string[];
  free: boolean;
}

function fakeRoom(): FakeRoom {
  const did: string[] = [];
  const note = (what: string): void => {
    did.push(what);
  };
  const state: FakeRoom = {
    did,
    free: true,
    room: {
      isFree: () => state.free,
      moveTipBy: (right, up) => {
        note(`tip ${right.toFixed(2)} ${up.toFixed(2)}`);
      },
      turnShaftBy: () => {
        note("shaft");
      },
      hold: (holder) => {
        note(`hold ${holder}`);
      },
      letGo: (holder) => {
        note(`let go ${holder}`);
      },
      squeeze: (share) => {
        note(share === undefined ? "loose" : `squeeze ${share.toFixed(2)}`);
      },
      pedal: (down) => {
        note(down ? "pedal down" : "pedal up");
      },
      act: (action) => {
        note(action.kind);
      },
      goThroughDialog: (step) => {
        note(`dialog ${step}`);
      },
      nextShot: () => {
        note("next shot");
      },
      plugged: (on, wasDriving) => {
        note(`plugged ${String(on)} ${String(wasDriving)}`);
      },
    },
  };
  return state;
}

describe("GamepadHand", () => {
  let pads: (FakePad | null)[] = [];
  let now = 0;
  const hand = (room: PadRoom): { frame(): void; readonly pad: GamepadHand } => {
    const pad = new GamepadHand(room);
    return {
      pad,
      frame: () => {
        now += FRAME_MS;
        pad.frame(now);
      },
    };
  };

  beforeEach(() => {
    pads = [];
    now = 1000;
    vi.stubGlobal("navigator", { getGamepads: () => pads });
  });
  afterEach(() => {
    vi.unstubAllGlobals();
  });

  it("says when one is plugged in, once", () => {
    const { did, room } = fakeRoom();
    const { frame, pad } = hand(room);
    frame();
    expect(pad.isConnected).toBe(false);
    pads = [null, new FakePad()];
    frame();
    frame();
    expect(pad.isConnected).toBe(true);
    expect(did.filter((one) => one.startsWith("plugged"))).toEqual(["plugged true false"]);
  });

  it("moves the tip by the stick and drives by the trigger", () => {
    const { did, room } = fakeRoom();
    const { frame } = hand(room);
    const pad = new FakePad();
    pads = [pad];
    frame();
    did.length = 0;
    pad.axes[0] = 1;
    pad.press(7, 0.54);
    frame();
    expect(did).toContain(`tip ${((30 * FRAME_MS) / 1000).toFixed(2)} 0.00`);
    expect(did).toContain("squeeze 0.50");
    expect(did).toContain("hold pad drive");
  });

  it("unplugged while it drives, the driver is off before it is said why", () => {
    const { did, room } = fakeRoom();
    const { frame } = hand(room);
    const pad = new FakePad();
    pads = [pad];
    pad.press(7);
    pad.press(2);
    frame();
    did.length = 0;
    pads = [null];
    frame();
    expect(did).toEqual(["loose", "let go pad drive", "pedal up", "plugged false true"]);
    did.length = 0;
    frame();
    expect(did).toEqual([]);
  });

  it("an open dialog lets go of everything, and nothing goes on by itself afterwards", () => {
    const state = fakeRoom();
    const { frame } = hand(state.room);
    const pad = new FakePad();
    pads = [pad];
    pad.press(7);
    frame();
    state.free = false;
    state.did.length = 0;
    frame();
    expect(state.did).toEqual(["loose", "let go pad drive"]);
    state.did.length = 0;
    pad.press(13);
    frame();
    frame();
    pad.press(0);
    frame();
    expect(state.did).toEqual(["dialog next", "dialog choose"]);
  });

  it("Back is undo by itself, and none after something that it was held for", () => {
    const { did, room } = fakeRoom();
    const { frame } = hand(room);
    const pad = new FakePad();
    pads = [pad];
    frame();
    did.length = 0;
    const done = (): readonly string[] => did.filter((one) => one !== "loose");
    pad.press(8);
    frame();
    expect(done()).toEqual([]);
    pad.press(8, 0);
    frame();
    expect(done()).toEqual(["undo"]);
    did.length = 0;
    pad.press(8);
    pad.press(0);
    frame();
    pad.press(0, 0);
    pad.axes[1] = 1;
    frame();
    pad.axes[1] = 0;
    pad.press(8, 0);
    frame();
    expect(done()).toEqual([
      "measure",
      "hold pad wrist flexion_deg 1",
      "let go pad wrist flexion_deg 1",
    ]);
  });
});
