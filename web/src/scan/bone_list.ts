// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The bones by name and colour, and how sure the reconstruction is of each; those that are missing, too. A press
// takes the bone in hand and the crosshair there.
import { make } from "../dom";
import { isThere, SCAPHOID_DISTAL, type BoneNow } from "./bones_now_model";
import { boneTitle, cssColor } from "./scan_case_model";

export class BoneList {
  readonly element = make("ul.scan-bones", { "aria-label": "Bones" });
  private readonly items = new Map<number, HTMLButtonElement>();
  private shown = "";
  private inHand: number | undefined;

  constructor(
    private readonly colors: Uint32Array,
    private readonly go: (bone: BoneNow) => void,
  ) {}

  /** Only what changed is made anew: the focus stays where it is. */
  show(bones: readonly BoneNow[]): void {
    const text = JSON.stringify(bones);
    if (text === this.shown) return;
    this.shown = text;
    const focused = [...this.items].find(([, item]) => item === document.activeElement)?.[0];
    const { scrollTop } = this.element;
    this.items.clear();
    this.element.replaceChildren(...bones.map((bone) => this.line(bone)));
    this.element.scrollTop = scrollTop;
    if (focused !== undefined) this.items.get(focused)?.focus({ preventScroll: true });
  }

  /** @param label  of the bone under the crosshair, and of the one in hand */
  mark(label: number, inHand: number | undefined): void {
    for (const [of, item] of this.items) {
      if (of === label) item.setAttribute("aria-current", "true");
      else item.removeAttribute("aria-current");
      if (inHand !== undefined) item.setAttribute("aria-pressed", String(of === inHand));
    }
    if (inHand === undefined || inHand === this.inHand) return;
    this.inHand = inHand;
    this.items.get(inHand)?.scrollIntoView({ block: "nearest" });
  }

  private line(bone: BoneNow): HTMLElement {
    const item = make(
      `button.scan-bone${isThere(bone) ? "" : ".missing"}` as "button",
      { type: "button", "data-bone": bone.name },
      make("span.scan-swatch", {
        style: `background: ${cssColor(this.colors[bone.label] ?? 0xffffff)}`,
        "aria-hidden": "true",
      }),
      make("span.scan-bone-name", {}, boneTitle(bone.name)),
      ...trust(bone),
    );
    item.addEventListener("click", () => {
      this.go(bone);
    });
    this.items.set(bone.label, item);
    const line = make("li", {}, item);
    if (bone.flagged && bone.why !== "" && isThere(bone)) {
      line.append(make("p.scan-why", {}, bone.why));
    }
    return line;
  }
}

function trust(bone: BoneNow): Node[] {
  // A whole scaphoid has no distal part, and nothing is wrong with that.
  if (bone.presence === "not found" && bone.label === SCAPHOID_DISTAL) {
    return [make("span.secondary", {}, "if broken")];
  }
  if (bone.presence === "later") return [make("span.secondary", {}, "by hand")];
  if (!isThere(bone)) return [make("span.secondary", {}, bone.presence)];
  if (bone.flagged) return [make("span.badge", {}, "look here")];
  if (bone.confidence === undefined) return [];
  return [make("span.secondary", {}, `${Math.round(100 * bone.confidence)} %`)];
}
