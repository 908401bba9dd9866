// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What each hand holds, how well it works, a wall to feel, the guided calibration. Time stands still
// while it is open.
import { button, make, setText } from "../dom";
import type { HandIndex } from "../operation";
import type { DeviceAim, DevicesMessage, FoundDevice, HandDevice } from "../protocol";
import { aimsOf, figures, forceText, isWell } from "./device_model";
import { ForceDial } from "./force_dial";
import "./devices.css";

export interface DeviceHandlers {
  find(): void;
  /** @param id  empty: the page itself */
  use(hand: HandIndex, id: string): void;
  /** What the shaft of the device that this hand holds follows. */
  aim(hand: HandIndex, id: string, aim: DeviceAim): void;
  wall(hand: HandIndex, on: boolean): void;
  calibrate(hand: HandIndex, step: "begin" | "take" | "cancel"): void;
}

const PAGE = "Mouse, keys, touch or gamepad (this page)";
const HANDS = ["First hand", "Second hand"] as const;

class HandCard {
  readonly element: HTMLElement;
  private readonly choice: HTMLSelectElement;
  private readonly words = make("p.device-words", { role: "status" });
  private readonly figures = make("dl.device-figures");
  private readonly meter = make("meter", { min: "0", max: "8", value: "0" });
  private readonly force = make("span");
  private readonly dial = new ForceDial();
  private readonly forceRow: HTMLElement;
  private readonly aim: HTMLSelectElement;
  private readonly aimRow: HTMLElement;
  private aims = "";
  private id = "";
  private readonly wall: HTMLButtonElement;
  private readonly begin: HTMLButtonElement;
  private readonly guide = make("p.device-guide", { role: "status" });
  private readonly steps: HTMLElement;
  private options = "";
  private isTesting = false;

  constructor(hand: HandIndex, handlers: DeviceHandlers) {
    const id = `device-${hand}`;
    this.choice = make("select", { id });
    this.choice.addEventListener("change", () => {
      handlers.use(hand, this.choice.value);
    });
    this.aim = make("select", { id: `${id}-aim` });
    this.aim.addEventListener("change", () => {
      handlers.aim(hand, this.id, this.aim.value as DeviceAim);
    });
    this.aimRow = make(
      "p.device-aim",
      {},
      make("label", { for: `${id}-aim` }, "Direction"),
      this.aim,
    );
    this.wall = button("Feel a test wall", "", () => {
      handlers.wall(hand, !this.isTesting);
    });
    this.wall.title = "Level, 5 mm below the tip, 1 N/mm";
    this.begin = button(
      "Calibrate",
      "",
      () => {
        handlers.calibrate(hand, "begin");
      },
      ".quiet",
    );
    this.steps = make(
      "span.device-steps",
      {},
      button("Measure", "", () => {
        handlers.calibrate(hand, "take");
      }),
      button(
        "Stop here",
        "",
        () => {
          handlers.calibrate(hand, "cancel");
        },
        ".quiet",
      ),
    );
    this.meter.setAttribute("aria-label", `Force on the ${HANDS[hand].toLowerCase()}`);
    this.forceRow = make("p.device-force", {}, this.dial.element, this.meter, this.force);
    this.element = make(
      "section.device",
      { "aria-label": HANDS[hand] },
      make("label", { for: id }, HANDS[hand]),
      this.choice,
      this.words,
      this.aimRow,
      this.forceRow,
      this.figures,
      make("p.device-trials", {}, this.wall, this.begin, this.steps),
      this.guide,
    );
  }

  show(device: HandDevice, found: readonly FoundDevice[]): void {
    this.showChoice(device, found);
    const held = device.id !== "";
    const well = isWell(device);
    setText(this.words, held ? device.words : "");
    this.words.classList.toggle("well", well);
    this.forceRow.hidden = !held || device.most_force_n === 0;
    this.meter.max = device.most_force_n > 0 ? device.most_force_n : 1;
    this.meter.value = device.force_n;
    setText(this.force, forceText(device));
    this.dial.show(device);
    this.id = device.id;
    this.showAims(device);
    this.showFigures(device);
    this.isTesting = device.is_testing;
    this.wall.hidden = !held || device.most_force_n === 0;
    this.wall.disabled = !well;
    this.wall.setAttribute("aria-pressed", String(device.is_testing));
    const guided = device.calibration !== "";
    this.begin.hidden = !device.may_calibrate || guided;
    this.steps.hidden = !guided;
    setText(this.guide, [device.calibration, device.calibration_note].filter(Boolean).join(" — "));
  }

  /** The list is left alone while nothing of it changed, so that it can be opened. */
  private showChoice({ id, name }: HandDevice, found: readonly FoundDevice[]): void {
    const all = [{ id: "", name: PAGE }, ...found];
    // What is held stays to be seen when it is unplugged.
    if (!all.some((one) => one.id === id)) all.push({ id, name });
    const options = JSON.stringify(all);
    if (options !== this.options) {
      this.options = options;
      this.choice.replaceChildren(...all.map((one) => make("option", { value: one.id }, one.name)));
    }
    if (document.activeElement !== this.choice || this.choice.value !== id) this.choice.value = id;
  }

  private showAims(device: HandDevice): void {
    const all = aimsOf(device);
    this.aimRow.hidden = device.id === "" || all.length < 2;
    const aims = JSON.stringify(all);
    if (aims !== this.aims) {
      this.aims = aims;
      this.aim.replaceChildren(...all.map(([aim, text]) => make("option", { value: aim }, text)));
    }
    if (document.activeElement !== this.aim || this.aim.value !== device.aim)
      this.aim.value = device.aim;
  }

  private showFigures(device: HandDevice): void {
    const rows = figures(device);
    const cells = rows.flat();
    if (this.figures.children.length !== cells.length) {
      this.figures.replaceChildren(...rows.flatMap(() => [make("dt"), make("dd")]));
    }
    cells.forEach((text, i) => {
      const cell = this.figures.children[i];
      if (cell !== undefined) setText(cell, text);
    });
  }
}

export class DevicesDialog {
  readonly element: HTMLDialogElement;
  /** Told when it opens and closes. */
  onOpen: (isOpen: boolean) => void = () => undefined;
  private readonly cards: readonly [HandCard, HandCard];
  private readonly none = make("p.secondary");
  private shown: DevicesMessage | undefined;

  constructor(private readonly handlers: DeviceHandlers) {
    this.cards = [new HandCard(0, handlers), new HandCard(1, handlers)];
    const close = button("Close", "Esc", () => {
      this.element.close();
    });
    close.autofocus = true;
    this.element = make(
      "dialog.devices",
      { "aria-labelledby": "devices-title" },
      make(
        "div.devices-body",
        {},
        make(
          "header",
          {},
          make("h2", { id: "devices-title" }, "Devices"),
          make(
            "span.devices-ways",
            {},
            button(
              "Look again",
              "",
              () => {
                handlers.find();
              },
              ".quiet",
            ),
            close,
          ),
        ),
        make(
          "p.secondary",
          {},
          "A device moves the tip along the screen's right and up. One that gives forces is pushed with; the driver stays with Space.",
        ),
        make("div.device-cards", {}, this.cards[0].element, this.cards[1].element),
        this.none,
      ),
    );
    this.element.addEventListener("close", () => {
      this.onOpen(false);
    });
  }

  get hands(): readonly HandDevice[] {
    return this.shown?.hands ?? [];
  }

  open(): void {
    if (this.element.open) return;
    this.handlers.find();
    this.element.showModal();
    this.onOpen(true);
  }

  show(message: DevicesMessage): void {
    this.shown = message;
    message.hands.forEach((device, hand) => {
      this.cards[hand === 0 ? 0 : 1].show(device, message.found);
    });
    setText(
      this.none,
      message.found.some((one) => one.id !== "haply")
        ? ""
        : "No device is plugged in at the station. Nothing at hand? There: carpus device simulate.",
    );
  }
}
