// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What the scope truly saw of the joints' cartilage, painted on the bones, and where it was scuffed.
import { fetchSeenCartilage } from "../case_data";
import { make } from "../dom";
import type { Attempt, CaseDescription, ScoreReport, SeenCartilage } from "../protocol";
import { makeCartilageWorld } from "./cartilage_world";
import { moreText, scuffRows } from "./scuff_model";
import { TurningView } from "./turning_view";

const DISTANCE_M = 0.19;

/** @param staying  the view is to be disposed of when the page is left */
export function cartilageSection(
  attempt: Attempt,
  report: ScoreReport,
  description: CaseDescription,
  staying: { isLeft(): boolean; onLeave(done: () => void): void },
): HTMLElement {
  const place = make("div.cartilage-place", {}, make("p.secondary", {}, "Painting what was seen…"));
  const section = make(
    "section.cartilage",
    { "aria-labelledby": "cartilage-title" },
    make("h2", { id: "cartilage-title" }, "Cartilage that was seen"),
    place,
    ...scuffTable(report, attempt.id),
  );
  const scuffs = report.scuffs ?? [];
  void (async () => {
    try {
      const seen = await fetchSeenCartilage(attempt.id);
      if (staying.isLeft()) return;
      const view = await TurningView.make(
        description,
        (renderer) => makeCartilageWorld(renderer, description, seen, scuffs),
        { side: "Dorsal", distanceM: DISTANCE_M },
        {
          label: "Bones of the joints, drawn apart row from row",
          caption: `Rows are drawn apart. Green: seen near and steep enough, nothing before it; brown: not.${
            scuffs.length === 0 ? "" : " Red dots with numbers: scuffed."
          } Cartilage is generated, not seen in the CT.`,
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

/** None where nothing was scuffed. */
function scuffTable(report: ScoreReport, attempt: number): readonly HTMLElement[] {
  const scuffs = report.scuffs ?? [];
  if (scuffs.length === 0) return [];
  const counted = report.items.find(({ id }) => id === "cartilage_scuffs");
  const more = moreText(scuffs.length, counted?.value);
  return [
    make(
      "table.cartilage-scuffs",
      {},
      make("caption", {}, "Where cartilage was scuffed; times lead into the replay"),
      make(
        "tbody",
        {},
        ...scuffRows(scuffs, attempt).map(({ number, bone, how, at, replay }) =>
          make(
            "tr",
            {},
            make("td.figure", {}, make("span.scuff-number", {}, number)),
            make("th", { scope: "row" }, bone),
            make("td", {}, how),
            make("td.figure", {}, make("a", { href: replay, title: "In the replay" }, at)),
          ),
        ),
      ),
    ),
    ...(more === "" ? [] : [make("p.secondary", {}, more)]),
  ];
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
