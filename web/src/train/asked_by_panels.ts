// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What is asked by the panels' buttons and fields, and who of the room does it.
import type { AppearancePanel } from "../appearance";
import type { Headset } from "../headset";
import type { Theatre } from "../theatre";
import type { Actions } from "./actions";
import type { Connection } from "./connection";
import type { DeviceHands } from "./device_hands";
import type { Hand } from "./hand";
import type { HandPointer } from "./hand_pointer";
import type { Panels, Wishes } from "./panels";
import type { TakingPart } from "./taking_part";
import type { WhatIsSeen } from "./what_is_seen";

export interface PanelsRoom {
  readonly app: HTMLElement;
  readonly panels: Panels;
  readonly theatre: Theatre;
  readonly appearance: AppearancePanel;
  readonly seen: WhatIsSeen;
  readonly hand: Hand;
  readonly pointer: HandPointer;
  readonly headset: Headset;
  readonly deviceHands: DeviceHands;
  readonly part: TakingPart;
  readonly actions: Actions;
  readonly connection: Connection;
  moveCArm(type: "take_shot" | "c_arm", rotationDeg: number, tiltDeg: number): void;
}

/** @param room  asked when something is: panels come before the rest of it */
export function askedByPanels(room: () => PanelsRoom): Wishes {
  return {
    act: (action) => {
      room().actions.act(action);
    },
    look: (view) => {
      room().actions.look(view);
    },
    skin: (opacity) => {
      room().theatre.setSkin(opacity);
    },
    cArm: {
      takeShot: (rotationDeg, tiltDeg) => {
        const refused = room().seen.offered.whyNot({ id: "take_shot" });
        if (refused === undefined) room().moveCArm("take_shot", rotationDeg, tiltDeg);
        else room().panels.notice.say(refused);
      },
      stand: (rotationDeg, tiltDeg) => {
        if (room().part.operates) room().moveCArm("c_arm", rotationDeg, tiltDeg);
      },
      tube: (kv, level) => {
        if (room().part.operates)
          room().connection.tell({ type: "tube", tube_kv: kv, dose_level: level });
      },
      holdWrist: (wish) => {
        room().panels.wrist.hold(wish);
      },
      enlarge: (on) => {
        room().app.firstElementChild?.classList.toggle("enlarged", on);
      },
      beam: (on) => {
        room().theatre.wishBeam(on);
      },
      whyNot: () => room().seen.offered.whyNot({ id: "take_shot" }),
      send: (down) => {
        if (room().part.operates) room().connection.tell({ type: "pedal", down });
      },
      say: (text) => {
        room().panels.notice.say(text);
      },
    },
    drive: {
      hold: (holder, action) => {
        room().hand.hold(holder, action, performance.now());
      },
      letGo: (holder) => {
        room().hand.letGo(holder, performance.now());
      },
      push: (n) => {
        room().hand.setThrust(n);
      },
      drags: (mode) => {
        room().pointer.setMode(mode);
      },
      aimAlongSight: () => {
        room().hand.aimAlongSight();
      },
      coarse: () => {
        room().hand.toggleCoarse();
      },
    },
    devices: {
      find: () => {
        room().connection.tell({ type: "find_devices" });
      },
      use: (hand, id) => {
        room().deviceHands.use(hand, id);
      },
      aim: (hand, id, aim) => {
        room().deviceHands.use(hand, id, aim);
      },
      wall: (hand, on) => {
        room().connection.tell({ type: "test_wall", hand, on });
      },
      calibrate: (hand, step) => {
        room().connection.tell({ type: "calibrate", hand, step });
      },
    },
    headset: () => {
      void room().headset.toggle();
    },
    showDevices: () => {
      room().panels.devices.open();
    },
    showAppearance: () => {
      room().appearance.open(!room().appearance.isOpen);
    },
    useHand: (hand) => {
      room().actions.useHand(hand);
    },
    take: (instrument, hand) => {
      room().actions.ask({ id: "take", hand, instrument: instrument.id });
      room().seen.sayTaken(instrument);
    },
    moveWrist: (wish) => {
      if (room().part.operates) room().connection.tell({ type: "wrist", ...wish });
    },
    start: (choice) => {
      room().part.start(choice);
    },
    resume: (choice) => {
      room().part.resume(choice);
    },
    returnToStep: (step) => {
      room().actions.askToReturn(step);
    },
    judge: (displaced) => {
      room().actions.act({ kind: "judge", displaced });
    },
    goBack: () => {
      room().actions.goBack();
    },
    restart: () => {
      room().part.restart();
    },
    startAnew: () => {
      room().part.startAnew();
    },
    endOther: () => {
      room().connection.endOther();
    },
    finish: () => {
      room().actions.ask({ id: "finish" });
    },
    decline: (reasons) => {
      room().actions.ask({ id: "decline", reasons });
    },
  };
}
