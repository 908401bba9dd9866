// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The bones by name and colour, and how sure the reconstruction is of each; a press takes the crosshair
// there.
import { make } from "../dom";
import { boneTitle, cssColor, type ScannedBone } from "./scan_case_model";

export class BoneList {
  readonly element = make("ul.scan-bones", { "aria-label": "Bones" });
  private readonly items = new Map<number, HTMLButtonElement>();

  constructor(bones: readonly ScannedBone[], colors: Uint32Array, go: (bone: ScannedBone) => void) {
    for (const bone of bones) {
      const item = make(
        "button.scan-bone",
        { type: "button", "data-bone": bone.name },
        make("span.scan-swatch", {
          style: `background: ${cssColor(colors[bone.label] ?? 0xffffff)}`,
          "aria-hidden": "true",
        }),
        make("span.scan-bone-name", {}, boneTitle(bone.name)),
        ...trust(bone),
      );
      item.addEventListener("click", () => {
        go(bone);
      });
      this.items.set(bone.label, item);
      const line = make("li", {}, item);
      if (bone.flagged && bone.why !== "") line.append(make("p.scan-why", {}, bone.why));
      this.element.append(line);
    }
  }

  /** The one under the crosshair. */
  mark(label: number): void {
    for (const [of, item] of this.items) {
      if (of === label) item.setAttribute("aria-current", "true");
      else item.removeAttribute("aria-current");
    }
  }
}

function trust(bone: ScannedBone): Node[] {
  if (bone.flagged) return [make("span.badge", {}, "look here")];
  if (bone.confidence === undefined) return [];
  return [make("span.secondary", {}, `${Math.round(100 * bone.confidence)} %`)];
}
