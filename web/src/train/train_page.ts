// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The room Train: joins panels, theatre, hand and the line to the host. The host owns the truth.
import { AppearancePanel } from "../appearance";
import { lostText } from "../devices";
import { setText } from "../dom";
import { lessonOf } from "../first_touch";
import { faceNames, makeFrameMap, type FrameMap } from "../frames";
import { GamepadHand } from "../gamepad";
import { Headset, headsetIsThere } from "../headset";
import { followLayout } from "../key_caps";
import type {
  CArmPicture,
  CaseDescription,
  CaseList,
  ExerciseMessage,
  HostMessage,
  ProcedureSummary,
} from "../protocol";
import { jointWallOf, ScopeDesk } from "../scope";
import { SkinDesk } from "../skin_work";
import { Sound } from "../sound";
import { Theatre, type CaseScene } from "../theatre";
import { Actions } from "./actions";
import { askedByPanels, type PanelsRoom } from "./asked_by_panels";
import { CaseChoice } from "./case_choice";
import { Connection } from "./connection";
import { DeviceHands } from "./device_hands";
import { startFrameLoop } from "./frame_loop";
import { Hand } from "./hand";
import { HandPointer } from "./hand_pointer";
import { headsetRoom } from "./headset_room";
import { listenToKeys } from "./keys";
import { layOut } from "./layout";
import { makePanels, type Panels } from "./panels";
import { padRoom } from "./pad_room";
import { showToTests } from "./shown_to_tests";
import { TakingPart } from "./taking_part";
import "./train.css";
import { whatIsDone } from "./what_is_done";
import { whatIsHeard } from "./what_is_heard";
import { WhatIsSeen } from "./what_is_seen";

export class TrainPage {
  private readonly panels: Panels;
  private readonly theatre: Theatre;
  private readonly appearance: AppearancePanel;
  private readonly seen: WhatIsSeen;
  private readonly hand: Hand;
  private readonly pointer: HandPointer;
  private readonly sound: Sound;
  private readonly gamepad: GamepadHand;
  private readonly headset: Headset;
  private newestPicture: CArmPicture | undefined;
  private readonly deviceHands: DeviceHands;
  private readonly scope: ScopeDesk;
  private readonly skin: SkinDesk;
  private readonly part: TakingPart;
  private readonly actions: Actions;
  private readonly connection: Connection;
  private readonly abort = new AbortController();
  private readonly stops: (() => void)[];
  private readonly cases: CaseChoice;
  /** An exercise ran when the host last said welcome. */
  private isBusyHere = false;

  constructor(
    app: HTMLElement,
    description: CaseDescription,
    procedures: readonly ProcedureSummary[],
    scene: CaseScene,
  ) {
    this.panels = this.makePanels(app, description, procedures);
    const frames = makeFrameMap(description.wrist_from_patient);
    const stage = layOut(app, this.panels);
    this.theatre = new Theatre(stage, scene, frames, faceNames(description.side));
    this.theatre.setSkin(this.panels.views.skinOpacity);
    this.appearance = this.makeAppearance(stage);
    this.panels.views.offerStructures(this.theatre.hasStructures);
    this.theatre.onViewLeft = () => {
      this.panels.views.showView(undefined);
    };
    this.seen = new WhatIsSeen(this.panels, this.theatre);
    this.hand = this.makeHand();
    this.pointer = new HandPointer(this.theatre, this.hand, this.abort.signal);
    this.part = new TakingPart({
      panels: this.panels,
      hand: this.hand,
      seen: this.seen,
      canvas: this.theatre.canvas,
      hasGamepad: () => this.gamepad.isConnected,
      tell: (message) => this.connection.tell(message),
    });
    this.sound = this.makeSound();
    this.actions = this.makeActions();
    this.scope = this.makeScope(stage, scene);
    this.gamepad = new GamepadHand(
      padRoom(this.panels, this.hand, this.actions, this.part, this.scope),
    );
    this.headset = this.makeHeadset(frames);
    this.deviceHands = new DeviceHands(this.theatre, (message) => this.connection.tell(message));
    this.skin = new SkinDesk({ stage, pagePoint: (mm) => this.theatre.pagePoint(mm) });
    this.panels.help.onOpen = (isOpen) => {
      this.part.showHelp(isOpen);
    };
    this.panels.devices.onOpen = (isOpen) => {
      this.part.showHelp(isOpen);
      // Else Space would press the button that opened it, instead of driving.
      if (!isOpen && this.part.operates) this.theatre.canvas.focus({ preventScroll: true });
    };
    this.listenToKeys();
    followLayout(this.abort.signal);
    this.panels.start.setReady(false, "Connecting to the host…");
    this.panels.start.open();
    this.cases = this.makeCaseChoice();
    this.connection = this.connect();
    this.stops = [
      showToTests(this.theatre, this.seen, this.scope, this.skin, this.sound, this.headset),
      this.startLoop(),
    ];
  }

  private makeCaseChoice(): CaseChoice {
    return new CaseChoice({
      start: this.panels.start,
      tell: (message) => this.connection.tell(message),
      runs: () => this.isBusyHere || this.part.operates,
    });
  }

  private makeAppearance(stage: HTMLElement): AppearancePanel {
    const appearance = new AppearancePanel((look) => {
      this.theatre.setLook(look);
    });
    appearance.onOpen = (isOpen) => {
      this.panels.views.showAppearance(isOpen);
    };
    stage.after(appearance.element);
    appearance.begin();
    return appearance;
  }

  offerCases(list: CaseList): void {
    this.cases.offer(list);
  }

  dispose(): void {
    for (const stop of this.stops) stop();
    this.headset.dispose();
    this.panels.notice.dispose();
    this.sound.dispose();
    this.panels.arm.pedal.releaseAll();
    this.abort.abort();
    this.connection.dispose();
    this.hand.dispose();
    this.scope.dispose();
    this.theatre.dispose();
  }

  private makePanels(
    app: HTMLElement,
    description: CaseDescription,
    procedures: readonly ProcedureSummary[],
  ): Panels {
    const room = (): PanelsRoom => ({
      app,
      panels: this.panels,
      theatre: this.theatre,
      appearance: this.appearance,
      seen: this.seen,
      hand: this.hand,
      pointer: this.pointer,
      headset: this.headset,
      deviceHands: this.deviceHands,
      part: this.part,
      actions: this.actions,
      connection: this.connection,
      moveCArm: (type, rotationDeg, tiltDeg) => {
        this.moveCArm(type, rotationDeg, tiltDeg);
      },
    });
    return makePanels(description, procedures, askedByPanels(room));
  }

  private makeScope(stage: HTMLElement, scene: CaseScene): ScopeDesk {
    const walls = [...scene.jointWalls].flatMap(([joint, surface]) => {
      const wall = jointWallOf(joint, surface);
      return wall === undefined ? [] : [wall];
    });
    const desk = new ScopeDesk(
      {
        stage,
        operates: () => this.part.operates,
        send: (hand) => {
          this.connection.sendHand(hand);
        },
        turn: (shaftDeg, cameraDeg) => {
          this.connection.tell({ type: "turn_scope", shaft_deg: shaftDeg, camera_deg: cameraDeg });
        },
        turnMouth: (hand, mouthDeg) => {
          this.connection.tell({ type: "turn_mouth", hand, mouth_deg: mouthDeg });
        },
        take: (instrument, hand) => {
          this.actions.ask({ id: "take", hand, instrument });
        },
        pull: (byN) => {
          this.panels.wrist.move("traction_n", byN);
        },
        answer: (finding, grade) => {
          this.connection.tell({ type: "answer", finding, grade });
        },
        setFluid: (setting) => {
          this.connection.tell({ type: "set_fluid", ...setting });
        },
        say: (text) => {
          this.panels.notice.say(text);
        },
        showSide: (facing) => {
          const view = this.theatre.viewOf(facing);
          if (view !== undefined) this.actions.look(view);
        },
        showHand: (hand) => {
          // The tray, too, is this hand's.
          if (hand !== this.hand.active) this.hand.switchHand();
        },
        activeHand: () => this.hand.active,
        hasGamepad: () => this.gamepad.isConnected,
        tellPortals: (words) => {
          this.panels.steps.fill(words);
        },
      },
      walls,
      this.abort.signal,
    );
    stage.after(desk.element);
    this.panels.drive.element.before(desk.controls);
    return desk;
  }

  private moveCArm(type: "take_shot" | "c_arm", rotationDeg: number, tiltDeg: number): void {
    this.connection.tell({
      type,
      rotation_deg: rotationDeg,
      tilt_deg: tiltDeg,
      reference: "held_forearm",
    });
  }

  private makeHand(): Hand {
    return new Hand(this.theatre, {
      send: (hand) => {
        // What is in a portal is led from the scope's desk alone.
        if (!this.scope.isOn) this.connection.sendHand(hand);
      },
      moveWrist: (axis, by) => {
        this.panels.wrist.move(axis, by);
      },
      worksOnSkin: () => this.skin.isOn,
      whyHeldBySkin: (hand) => this.skin.whyHeld(this.seen.latest, hand),
      whyNotSwung: (hand) => this.skin.whyNotSwung(this.seen.latest, hand),
      label: (body) => this.seen.label(body),
      say: (hint) => {
        this.panels.notice.say(hint);
      },
      isJoystick: (id) =>
        this.panels.tray.instruments.some((one) => one.id === id && one.is_joystick),
      snapshot: () => this.seen.latest,
    });
  }

  /** Its button is there only where the browser has one. */
  private makeHeadset(frames: FrameMap): Headset {
    const { panels, hand, seen, part, theatre } = this;
    void headsetIsThere().then((isThere) => {
      panels.top.offerHeadset(isThere);
    });
    const actions = (): Actions => this.actions;
    const picture = (): CArmPicture | undefined => this.newestPicture;
    const room = headsetRoom({ panels, hand, seen, part, theatre, actions, picture });
    return new Headset(room, frames);
  }

  private makeSound(): Sound {
    const sound = new Sound(this.abort.signal);
    sound.onWish = (on) => {
      this.panels.top.showSound(on);
    };
    this.panels.top.showSound(sound.isWished);
    return sound;
  }

  private makeActions(): Actions {
    const { arm, help, notice, tray, views } = this.panels;
    return new Actions({
      arm,
      help,
      tray,
      views,
      hand: this.hand,
      sound: this.sound,
      theatre: this.theatre,
      latest: () => this.seen.latest,
      offered: () => this.seen.offered,
      wantedInstrument: () => this.seen.wantedInstrument,
      tell: (message) => {
        this.connection.tell(message);
      },
      say: (text) => {
        notice.say(text);
      },
      confirmReturn: (step) => {
        this.panels.returnQuestion.ask(this.seen.titleOf(step));
      },
      finish: () => {
        this.part.askToFinish();
      },
      decline: () => {
        this.part.askToDecline();
      },
      pause: () => {
        this.part.togglePause();
      },
    });
  }

  private listenToKeys(): void {
    const { arm, help } = this.panels;
    listenToKeys(
      {
        hand: this.hand,
        pedal: arm.pedal,
        canvas: this.theatre.canvas,
        act: (action) => {
          this.actions.act(action);
        },
        closeHelp: () => {
          const { open } = help.element;
          if (open) help.toggle();
          return open;
        },
      },
      this.abort.signal,
    );
  }

  private connect(): Connection {
    return new Connection({
      onLink: (state, text) => {
        this.part.showLink(state, state === "open" ? text : this.cases.whyAway(text));
      },
      onMessage: (message) => {
        this.receive(message);
      },
      onPicture: (picture) => {
        this.newestPicture = picture;
        this.panels.arm.add(picture);
      },
      say: (text) => {
        this.panels.notice.say(text);
      },
    });
  }

  private startLoop(): () => void {
    return startFrameLoop({
      hand: (nowMs) => {
        this.gamepad.frame(nowMs);
        if (this.scope.isOn) this.scope.frame(nowMs);
        else this.hand.frame(nowMs);
      },
      draw: () => {
        this.theatre.draw();
        this.scope.draw();
      },
      readings: () => {
        this.sound.watch(performance.now());
        this.deviceHands.watch(this.panels.devices.hands, performance.now());
        this.scope.showReadings();
        this.skin.showReadings(this.seen.latest, this.hand.active);
        this.seen.showReadings(this.hand, this.actions.closedWays(), this.part.operates);
      },
    });
  }

  private offerFirstTouch(exercise: ExerciseMessage): void {
    const { firstTouch, help } = this.panels;
    const lesson = lessonOf(exercise);
    firstTouch.useLesson(lesson);
    help.offerFirstTouch(lesson !== undefined);
    if (this.part.operates && exercise.mode !== "assessed") firstTouch.offer();
  }

  private receive(message: HostMessage): void {
    const { notice, steps } = this.panels;
    switch (message.type) {
      case "snapshot":
        this.seen.take(message, this.hand);
        this.scope.see(message);
        if (this.part.operates) {
          const now = performance.now();
          this.sound.hear(
            whatIsHeard(message, this.seen.doing, this.hand, this.scope.pressGrade, now),
          );
          if (this.hand.placed)
            this.panels.firstTouch.observe(
              whatIsDone(message, this.scope.told, this.hand, this.theatre),
            );
        }
        this.part.showWaiting();
        break;
      case "exercise":
        this.newestPicture = undefined;
        this.seen.begin(message);
        this.scope.begin(message);
        this.skin.begin(message);
        this.offerFirstTouch(message);
        break;
      case "tissue":
        this.seen.takeTissue(message);
        break;
      case "scope":
        this.scope.seeScope(message);
        break;
      case "skin":
        if (this.skin.take(message, this.hand.active)) this.hand.feelGive();
        this.scope.seeSkin(message);
        this.theatre.showSkinWork(message);
        break;
      case "sheet":
        this.scope.seeSheet(message);
        break;
      case "actions":
        this.seen.takeActions(message);
        break;
      case "devices":
        this.panels.devices.show(message);
        this.panels.top.showDevices(message.hands);
        setText(this.panels.pausedWhy, lostText(message.hands));
        break;
      case "event":
        steps.addLog(message.tick, message.text);
        if (message.text.startsWith("Hint:")) notice.say(message.text);
        break;
      case "score":
        this.part.finished();
        location.hash = `#/attempts/${message.attempt_id}`;
        break;
      case "error":
        this.cases.refused();
        notice.say(
          message.what_to_do === "" ? message.reason : `${message.reason} ${message.what_to_do}`,
        );
        break;
      case "welcome":
        this.isBusyHere = message.exercise !== 0;
        void this.cases.follow();
        this.part.arrive(message.exercise, {
          trainee: message.trainee,
          startedAt: message.started_at,
          isOwn: message.is_own,
        });
        break;
      case "busy":
        this.part.wait(message.may_end);
        break;
    }
  }
}
