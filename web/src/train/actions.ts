// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What a key or a button does once: looks, pictures, instruments, pause, finish. What the host would
// refuse is not sent; its reason is said instead.
import type { CArmPanel } from "../c_arm";
import type { HelpOverlay } from "../help_overlay";
import {
  actMessage,
  heldItem,
  otherHand,
  type Asked,
  type HandIndex,
  type OfferedActions,
  type OnceAction,
} from "../operation";
import type { Aid, PageMessage, SnapshotMessage } from "../protocol";
import type { Sound } from "../sound";
import { nextCut, VIEWS, type Theatre, type ViewId } from "../theatre";
import type { ClosedWays } from "./bottom_bar";
import type { Hand } from "./hand";
import type { TrayDialog } from "./tray_dialog";
import type { ViewBar } from "./view_bar";

/** What the actions reach in the room. */
export interface ActionRoom {
  readonly arm: CArmPanel;
  readonly hand: Hand;
  readonly theatre: Theatre;
  readonly views: ViewBar;
  readonly tray: TrayDialog;
  readonly help: HelpOverlay;
  readonly sound: Sound;
  latest(): SnapshotMessage | undefined;
  offered(): OfferedActions;
  /** Id of what the current step is done with, or empty. */
  wantedInstrument(): string;
  tell(message: PageMessage): void;
  say(text: string): void;
  /** Asks before it goes back to a step. */
  confirmReturn(step: number): void;
  /** Asks before the operation ends. */
  finish(): void;
  /** Asks for what reasons. */
  decline(): void;
  pause(): void;
}

export class Actions {
  private view: ViewId = "dorsal";
  private stepToReturnTo: number | undefined;

  constructor(private readonly room: ActionRoom) {}

  act(action: OnceAction): void {
    const { arm, hand, help, theatre, views } = this.room;
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
      case "enlarge":
        arm.enlarge(!arm.enlarged);
        break;
      case "shrink":
        arm.enlarge(false);
        break;
      case "keep_reference":
        arm.keepAsReference();
        break;
      case "save_picture":
        arm.save();
        break;
      case "ruler":
        arm.toggleRuler();
        break;
      case "sound":
        this.room.sound.toggle();
        break;
      case "beam":
        arm.toggleBeam();
        break;
      case "invert":
        arm.invert();
        break;
      case "aim_along_sight":
        hand.aimAlongSight();
        break;
      case "coarse":
        hand.toggleCoarse();
        break;
      case "change_thrust":
        hand.changeThrust(action.byN);
        break;
      case "measure":
        this.askInTurn(this.measuring());
        break;
      case "tray":
        this.openTray();
        break;
      case "choose_screw":
        this.chooseNeighbour(action.by);
        break;
      case "put_down":
        this.ask({ id: "put_down", hand: hand.active });
        break;
      case "pick_up":
        this.pickUp();
        break;
      case "pick_up_far_end":
        this.pickUpFarEnd();
        break;
      case "switch_hand":
        this.useHand(otherHand(hand.active));
        break;
      case "undo":
        this.ask({ id: "undo" });
        break;
      case "finish":
        if (!this.isRefused({ id: "finish" })) this.room.finish();
        break;
      case "ghost":
        this.useAid("ghost", theatre.ghostIsShown, () => {
          theatre.showGhost(!theatre.ghostIsShown);
        });
        break;
      case "cut":
        this.useAid("section", theatre.cutIs !== "off", () => {
          theatre.setCut(nextCut(theatre.cutIs));
        });
        break;
      case "hint":
        this.ask({ id: "use_aid", hand: hand.active, aid: "hint" });
        break;
      case "voltage":
        arm.nextVoltage();
        break;
      case "dose":
        arm.nextDose();
        break;
      case "judge":
        this.ask({ id: "judge", displaced: action.displaced });
        break;
      case "decline":
        if (!this.isRefused({ id: "decline" })) this.room.decline();
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
      case "structures":
        this.toggleStructures();
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

  /** Mouse and keys move this hand from now on. */
  useHand(hand: HandIndex): void {
    if (hand === this.room.hand.active) return;
    this.room.hand.switchHand();
    this.room.say(`Mouse and keys move the ${hand === 0 ? "first" : "second"} hand.`);
  }

  /** Turning one on is asked for, and counted; what is on may be changed and turned off. */
  private useAid(aid: Aid, isOn: boolean, change: () => void): void {
    const asked: Asked = { id: "use_aid", aid };
    if (!isOn) {
      if (this.isRefused(asked)) return;
      this.room.tell(actMessage(asked));
    }
    change();
    this.room.views.showAids(this.room.theatre.ghostIsShown, this.room.theatre.cutIs);
  }

  /** Asks the host, or says why it would refuse. */
  ask(asked: Asked): void {
    if (!this.isRefused(asked)) this.room.tell(actMessage(asked));
  }

  askToReturn(step: number): void {
    if (this.isRefused({ id: "return_to_step", item: step })) return;
    this.stepToReturnTo = step;
    this.room.confirmReturn(step);
  }

  /** To the step that was asked for. */
  goBack(): void {
    if (this.stepToReturnTo !== undefined)
      this.ask({ id: "return_to_step", item: this.stepToReturnTo });
    this.stepToReturnTo = undefined;
  }

  /** Which ways are not open now. */
  closedWays(): ClosedWays {
    const offered = this.room.offered();
    const hand = this.room.hand.active;
    const [first] = this.measuring();
    return {
      measure: first === undefined ? "Nothing on the tray measures" : offered.whyNot(first),
      putDown: offered.whyNot({ id: "put_down", hand }),
      undo: offered.whyNot({ id: "undo" }),
      finish: offered.whyNot({ id: "finish" }),
      decline: offered.whyNot({ id: "decline" }),
      canPickUp: offered.pickUps(hand).length > 0,
      canPickUpFarEnd: offered.farEnds(hand).some((one) => one.allowed),
    };
  }

  private heldBy(hand: HandIndex): string {
    const latest = this.room.latest();
    return (latest === undefined ? undefined : heldItem(latest, hand)?.instrument) ?? "";
  }

  private isGauge(id: string): boolean {
    return this.room.tray.instruments.some((one) => one.id === id && one.is_gauge);
  }

  /** By a wire that this hand holds beside the one in bone; else by the other hand, unless this one holds the gauge. */
  private measuring(): readonly Asked[] {
    const { active } = this.room.hand;
    const byThisHand: Asked = { id: "read_gauge", hand: active };
    if (
      this.room.offered().find(byThisHand)?.allowed === true &&
      !this.isGauge(this.heldBy(active))
    )
      return [byThisHand];
    const { instruments } = this.room.tray;
    const hand = this.isGauge(this.heldBy(active)) ? active : otherHand(active);
    return this.room.offered().measuring(hand, this.heldBy(hand), instruments);
  }

  /** Only the first can be told beforehand: it changes what the others need. */
  private askInTurn(all: readonly Asked[]): void {
    const [first] = all;
    if (first === undefined || this.isRefused(first)) return;
    for (const asked of all) this.room.tell(actMessage(asked));
  }

  private isRefused(asked: Asked): boolean {
    const why = this.room.offered().whyNot(asked);
    if (why !== undefined) this.room.say(why);
    return why !== undefined;
  }

  private toggleStructures(): void {
    const { theatre, views } = this.room;
    if (!theatre.hasStructures) {
      this.room.say("This case has no tendons, arteries and nerves; make it again from its CT.");
      return;
    }
    theatre.showStructures(!theatre.structuresShown);
    views.showStructures(theatre.structuresShown);
  }

  private openTray(): void {
    const { hand, tray } = this.room;
    const latest = this.room.latest();
    if (latest === undefined) return;
    hand.releaseAll();
    tray.open({
      offered: this.room.offered(),
      hand: hand.active,
      held: this.heldBy(hand.active),
      wanted: this.room.wantedInstrument(),
      gaugeReadingMm: latest.gauge_reading_mm,
    });
  }

  /** The first that can be taken; where none can, the reason of the first. */
  private pickUp(): void {
    const hand = this.room.hand.active;
    const offers = this.room.offered().pickUps(hand);
    const offer = offers.find((one) => one.allowed) ?? offers[0];
    if (offer === undefined) this.room.say("Nothing lies in bone to take hold of.");
    else this.ask({ id: "pick_up", hand, item: offer.item });
  }

  /** As pickUp(), at the wire's other end. */
  private pickUpFarEnd(): void {
    const hand = this.room.hand.active;
    const offers = this.room.offered().farEnds(hand);
    const offer = offers.find((one) => one.allowed) ?? offers[0];
    if (offer === undefined) this.room.say("No wire that is let go of lies in bone.");
    else this.ask({ id: "pick_up_far_end", hand, item: offer.item });
  }

  private chooseNeighbour(by: number): void {
    const hand = this.room.hand.active;
    const screw = this.room.tray.neighbour(this.heldBy(hand), by);
    if (screw !== undefined) this.ask({ id: "take", hand, instrument: screw.id });
  }
}

function toggleFullScreen(): void {
  if (document.fullscreenElement !== null) void document.exitFullscreen();
  else void document.documentElement.requestFullscreen();
}
