// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// All bars, lists and dialogs of the room. They show, and pass on what was asked for; they decide nothing.
import { CArmPanel, type CArmHandlers } from "../c_arm";
import { DevicesDialog, type DeviceHandlers } from "../devices";
import { make } from "../dom";
import { FirstTouchCard } from "../first_touch";
import { HelpOverlay } from "../help_overlay";
import { keyCap } from "../key_caps";
import type { HandIndex, OnceAction } from "../operation";
import type { CaseDescription, Instrument, ProcedureSummary, WristPose } from "../protocol";
import { StartDialog, type StartChoice } from "../start_dialog";
import type { ViewId } from "../theatre";
import { BottomBar } from "./bottom_bar";
import { ConfirmDialog } from "./confirm_dialog";
import { DeclineDialog } from "./decline_dialog";
import { DriveControls, type DriveHandlers } from "./drive_controls";
import { Notice } from "./notice";
import { StepPanel } from "./step_panel";
import { TopBar } from "./top_bar";
import { TrayDialog } from "./tray_dialog";
import { ViewBar } from "./view_bar";
import { WristPanel } from "./wrist_panel";

/** What the panels ask for. */
export interface Wishes {
  /** What a key does too. */
  act(action: OnceAction): void;
  look(view: ViewId): void;
  skin(opacity: number): void;
  /** Pictures, where the C-arm stands, its pedal. */
  readonly cArm: CArmHandlers;
  /** The hand, by what stands under the theatre. */
  readonly drive: DriveHandlers;
  /** What the hands hold. */
  readonly devices: DeviceHandlers;
  showDevices(): void;
  /** Puts the headset on, or takes it off. */
  headset(): void;
  showAppearance(): void;
  useHand(hand: HandIndex): void;
  take(instrument: Instrument, hand: HandIndex): void;
  moveWrist(wish: WristPose): void;
  start(choice: StartChoice): void;
  resume(choice: StartChoice): void;
  /** Asks before what was done is given up. */
  restart(): void;
  /** Was asked and is sure. */
  startAnew(): void;
  /** Ends what another page does here; was asked and is sure. */
  endOther(): void;
  /** Asks before what was done since is taken back. */
  returnToStep(step: number): void;
  judge(displaced: boolean): void;
  /** Was asked and is sure. */
  goBack(): void;
  finish(): void;
  /** Was asked for what reasons. */
  decline(reasons: readonly string[]): void;
}

export interface Panels {
  readonly top: TopBar;
  readonly steps: StepPanel;
  readonly views: ViewBar;
  readonly arm: CArmPanel;
  readonly bottom: BottomBar;
  readonly drive: DriveControls;
  readonly notice: Notice;
  readonly start: StartDialog;
  readonly help: HelpOverlay;
  readonly devices: DevicesDialog;
  readonly firstTouch: FirstTouchCard;
  readonly tray: TrayDialog;
  readonly wrist: WristPanel;
  readonly finishQuestion: ConfirmDialog;
  readonly declineQuestion: DeclineDialog;
  readonly anewQuestion: ConfirmDialog;
  readonly returnQuestion: ConfirmDialog;
  readonly endQuestion: ConfirmDialog;
  /** Over the scene while there is no connection. */
  readonly frozen: HTMLElement;
  /** Over the scene while time stands still. */
  readonly pausedSign: HTMLElement;
  /** In it: what keeps time still, where it is not a wish. */
  readonly pausedWhy: HTMLElement;
}

export function makePanels(
  description: CaseDescription,
  procedures: readonly ProcedureSummary[],
  wishes: Wishes,
): Panels {
  const act = (
    kind:
      | "pause"
      | "help"
      | "full_screen"
      | "tray"
      | "measure"
      | "pick_up"
      | "pick_up_far_end"
      | "put_down"
      | "undo"
      | "finish"
      | "decline"
      | "ghost"
      | "cut"
      | "hint"
      | "sound",
  ) => {
    return (): void => {
      wishes.act({ kind });
    };
  };
  const wrist = new WristPanel((wish) => {
    wishes.moveWrist(wish);
  });
  const firstTouch = new FirstTouchCard(() => {
    wishes.restart();
  });
  const pausedWhy = make("span.paused-why");
  const panels: Panels = {
    top: new TopBar(description, {
      pause: act("pause"),
      sound: act("sound"),
      help: act("help"),
      fullScreen: act("full_screen"),
      devices: () => {
        wishes.showDevices();
      },
      headset: () => {
        wishes.headset();
      },
    }),
    steps: new StepPanel(
      firstTouch.element,
      wrist.element,
      (step) => {
        wishes.returnToStep(step);
      },
      (displaced) => {
        wishes.judge(displaced);
      },
    ),
    wrist,
    views: new ViewBar({
      look: (view) => {
        wishes.look(view);
      },
      skin: (opacity) => {
        wishes.skin(opacity);
      },
      names: () => {
        wishes.act({ kind: "labels" });
      },
      ghost: act("ghost"),
      cut: act("cut"),
      hint: act("hint"),
      structures: () => {
        wishes.act({ kind: "structures" });
      },
      appearance: () => {
        wishes.showAppearance();
      },
    }),
    arm: new CArmPanel(patientText(description), wishes.cArm),
    bottom: new BottomBar({
      hand: (hand) => {
        wishes.useHand(hand);
      },
      tray: act("tray"),
      measure: act("measure"),
      pickUp: act("pick_up"),
      pickUpFarEnd: act("pick_up_far_end"),
      putDown: act("put_down"),
      undo: act("undo"),
      restart: () => {
        wishes.restart();
      },
      finish: act("finish"),
      decline: act("decline"),
    }),
    drive: new DriveControls(wishes.drive),
    notice: new Notice(),
    start: new StartDialog(
      description,
      procedures,
      (choice) => {
        wishes.start(choice);
      },
      (choice) => {
        wishes.resume(choice);
      },
      () => {
        panels.endQuestion.ask();
      },
    ),
    help: new HelpOverlay(() => {
      firstTouch.begin();
    }),
    devices: new DevicesDialog(wishes.devices),
    firstTouch,
    tray: new TrayDialog((instrument, hand) => {
      wishes.take(instrument, hand);
    }),
    finishQuestion: new ConfirmDialog(
      "Finish the operation?",
      "The placement is measured and stored. After this nothing can be changed.",
      "Finish and score",
      () => {
        wishes.finish();
      },
    ),
    declineQuestion: new DeclineDialog((reasons) => {
      wishes.decline(reasons);
    }),
    anewQuestion: new ConfirmDialog(
      "Start anew?",
      "What was done so far is stored as unfinished.",
      "Start anew",
      () => {
        wishes.startAnew();
      },
    ),
    returnQuestion: new ConfirmDialog(
      "Do this step again?",
      "What was done since is taken back for practice, and stays in the score: as a step taken back, and with the harm that it did.",
      "Go back",
      () => {
        wishes.goBack();
      },
    ),
    endQuestion: new ConfirmDialog(
      "End that operation?",
      "What was done there is stored as unfinished, and its page is told.",
      "End it",
      () => {
        wishes.endOther();
      },
      "Let it go on",
    ),
    frozen: make("p.frozen", { role: "alert" }),
    pausedWhy,
    pausedSign: make(
      "p.paused",
      { role: "status" },
      make("strong", {}, "Paused"),
      pausedWhy,
      "time stands still; ",
      keyCap("{KeyP}"),
      " goes on",
    ),
  };
  panels.frozen.hidden = panels.pausedSign.hidden = true;
  return panels;
}

/** As pictures that leave the page name the patient. */
function patientText({ pseudonym, simulated }: CaseDescription): string {
  return simulated ? `${pseudonym} (simulated)` : pseudonym;
}
