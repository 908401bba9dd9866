// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What the scope truly saw of the joints' cartilage, painted on the bones.
import { fetchSeenCartilage } from "../case_data";
import { make } from "../dom";
import type { Attempt, CaseDescription, SeenCartilage } from "../protocol";
import { makeCartilageWorld } from "./cartilage_world";
import { TurningView } from "./turning_view";

const DISTANCE_M = 0.19;

/** @param staying  the view is to be disposed of when the page is left */
export function cartilageSection(
  attempt: Attempt,
  description: CaseDescription,
  staying: { isLeft(): boolean; onLeave(done: () => void): void },
): HTMLElement {
  const place = make("div.cartilage-place", {}, make("p.secondary", {}, "Painting what was seen…"));
  const section = make(
    "section.cartilage",
    { "aria-labelledby": "cartilage-title" },
    make("h2", { id: "cartilage-title" }, "Cartilage that was seen"),
    place,
  );
  void (async () => {
    try {
      const seen = await fetchSeenCartilage(attempt.id);
      if (staying.isLeft()) return;
      const view = await TurningView.make(
        description,
        (renderer) => makeCartilageWorld(renderer, description, seen),
        { side: "Dorsal", distanceM: DISTANCE_M },
        {
          label: "Bones of the joints, drawn apart row from row",
          caption:
            "Rows are drawn apart. Green: seen near and steep enough, nothing before it; brown: not.",
        },
      );
      if (staying.isLeft()) {
        view.dispose();
        return;
      }
      staying.onLeave(() => {
        view.dispose();
      });
      place.replaceChildren(view.element, shares(seen));
    } catch (error) {
      const why = error instanceof Error ? error.message : String(error);
      place.replaceChildren(make("p.secondary", {}, why));
    }
  })();
  return section;
}

function shares(seen: SeenCartilage): HTMLElement {
  const row = (name: string, share: number): HTMLElement =>
    make(
      "tr",
      {},
      make("th", { scope: "row" }, name.replaceAll("_", " ")),
      make("td.figure", {}, `${Math.round(share)} %`),
    );
  return make(
    "table.cartilage-shares",
    {},
    make("caption", {}, "Share seen, by area"),
    make(
      "tbody",
      {},
      row("all of it", seen.share),
      ...seen.bones.map((bone) => row(bone.bone, bone.seen_share)),
    ),
  );
}
