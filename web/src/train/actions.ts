// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What a key or a button does once: looks, pictures, measuring, screws, pause, finish.
import type { CArmPanel } from "../c_arm";
import type { HelpOverlay } from "../help_overlay";
import { whyNot, type OnceAction } from "../operation";
import type { PageMessage, SnapshotMessage } from "../protocol";
import { VIEWS, type Theatre, type ViewId } from "../theatre";
import type { Hand } from "./hand";
import type { ScrewList } from "./screw_list";
import type { ViewBar } from "./view_bar";

/** What the actions reach in the room. */
export interface ActionRoom {
  readonly arm: CArmPanel;
  readonly hand: Hand;
  readonly theatre: Theatre;
  readonly views: ViewBar;
  readonly tray: ScrewList;
  readonly help: HelpOverlay;
  latest(): SnapshotMessage | undefined;
  tell(message: PageMessage): void;
  say(text: string): void;
  /** Asks before the operation ends. */
  finish(): void;
  pause(): void;
}

export class Actions {
  private view: ViewId = "dorsal";

  constructor(private readonly room: ActionRoom) {}

  act(action: OnceAction): void {
    const { arm, hand, help, theatre, tray, views } = this.room;
    switch (action.kind) {
      case "shot":
        arm.shoot(action.view);
        break;
      case "free_shot":
        arm.shootFree();
        break;
      case "turn_c_arm":
        arm.turn(action.rotationDeg, action.tiltDeg);
        break;
      case "invert":
        arm.invert();
        break;
      case "change_thrust":
        hand.changeThrust(action.byN);
        break;
      case "measure":
        if (!this.refusedBySituation("measure")) this.room.tell({ type: "measure" });
        break;
      case "screws": {
        const latest = this.room.latest();
        if (latest !== undefined && !this.refusedBySituation("screws")) {
          hand.releaseAll();
          tray.open(latest.screw_index, latest.measured_mm);
        }
        break;
      }
      case "choose_screw":
        this.chooseNeighbour(action.by);
        break;
      case "undo":
        this.room.tell({ type: "undo" });
        break;
      case "finish":
        this.room.finish();
        break;
      case "pause":
        this.room.pause();
        break;
      case "camera":
        this.look(VIEWS[(VIEWS.indexOf(this.view) + 1) % VIEWS.length] ?? "dorsal");
        break;
      case "skin":
        views.nextSkin();
        break;
      case "labels":
        theatre.showNames(!theatre.namesShown);
        views.showNames(theatre.namesShown);
        break;
      case "help":
        hand.releaseAll();
        help.toggle();
        break;
      case "full_screen":
        toggleFullScreen();
        break;
      case "zoom_in":
        theatre.zoom(0.85);
        break;
      case "zoom_out":
        theatre.zoom(1 / 0.85);
        break;
    }
  }

  look(view: ViewId): void {
    this.view = view;
    this.room.theatre.lookFrom(view);
    this.room.views.showView(view);
  }

  private chooseNeighbour(by: number): void {
    const latest = this.room.latest();
    if (latest === undefined || this.refusedBySituation("screws")) return;
    const screw = this.room.tray.neighbour(latest.screw_index, by);
    if (screw === undefined) return;
    this.room.tell({ type: "select_screw", index: screw.index });
    this.room.say(`On the driver: ${screw.name}`);
  }

  private refusedBySituation(action: string): boolean {
    const latest = this.room.latest();
    const hint = latest === undefined ? undefined : whyNot(action, latest);
    if (hint !== undefined) this.room.say(hint);
    return hint !== undefined;
  }
}

function toggleFullScreen(): void {
  if (document.fullscreenElement !== null) void document.exitFullscreen();
  else void document.documentElement.requestFullscreen();
}
